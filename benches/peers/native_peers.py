"""The peers that are C++ programs' libraries, and qsmesh through its C interface: all in one program."""

import subprocess

import numpy

NAMES = [
    "qsmesh",
    "qsmesh, features off",
    "OpenMesh tangential",
    "CGAL tangential_relaxation",
    "CGAL angle smoothing",
    "CGAL angle smoothing, projected",
    "plain Laplacian, flat arrays",
]
ALL_THREADS = ["qsmesh, all threads"]


def write(path, positions, triangles):
    """Writes a mesh as the program reads it."""
    counts = numpy.array([len(positions), len(triangles)], numpy.uint64)
    parts = counts, positions.astype(numpy.float64), triangles.astype(numpy.uint32)
    path.write_bytes(b"".join(part.tobytes() for part in parts))


def turns(clock, mesh, folder, repetitions, names):
    """Yields name, iterations, seconds of adjacency, seconds of smoothing, on the clock "processor" or "wall"."""
    program = folder / "natives"
    command = [program, clock, mesh, folder, str(repetitions), *names]
    lines = subprocess.run(command, capture_output=True, text=True, check=False)
    if lines.returncode:
        raise RuntimeError(f"{program} ends with {lines.returncode}: {lines.stderr.strip()}")
    for line in lines.stdout.splitlines():
        name, iterations, adjacency, smoothing = line.split("\t")
        yield name, int(iterations), float(adjacency), float(smoothing)


def positions(folder, name):
    """What the peer made of the mesh in two iterations."""
    return numpy.fromfile(folder / f"{name}.positions").reshape(-1, 3)
