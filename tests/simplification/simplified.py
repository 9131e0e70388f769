"""Simplifies a mesh in PyMeshLab, improves it with the command and checks what became of it, by figures of its own.

Arguments: the command, a mesh file.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy
import pymeshlab

COMMAND, MESH = sys.argv[1:]
SHARE = 0.1
OFF = ["--feature-angle", "off"]
# What is done with the simplified mesh: subcommand and options.
STEPS = [("smooth", []), ("improve", []), ("smooth", OFF), ("improve", OFF)]

failed = 0


def check(holds, what):
    global failed
    failed += not holds
    print("ok    " if holds else "FAILED", what, flush=True)


def simplified():
    """Positions and triangles that quadric edge collapse leaves."""
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(MESH)
    faces = meshes.current_mesh().face_number()
    meshes.meshing_decimation_quadric_edge_collapse(targetperc=SHARE)
    mesh = meshes.current_mesh()
    print(f"{Path(MESH).name}: {faces} triangles, simplified to {mesh.face_number()}")
    check(abs(mesh.face_number() / faces - SHARE) < 0.001, f"{SHARE:.0%} of the faces are left")
    return mesh.vertex_matrix(), mesh.face_matrix()


def write(path, positions, triangles):
    """All digits of the positions."""
    points = [f"{x!r} {y!r} {z!r}" for x, y, z in positions.tolist()]
    faces = [f"3 {a} {b} {c}" for a, b, c in triangles.tolist()]
    path.write_text("\n".join(["OFF", f"{len(points)} {len(faces)} 0", *points, *faces, ""]))


def read(path):
    """Positions and triangles of such a file."""
    lines = path.read_text().split("\n")
    vertices, faces, _ = map(int, lines[1].split())
    positions = numpy.array([line.split() for line in lines[2 : 2 + vertices]], float)
    triangles = numpy.array([line.split()[1:] for line in lines[2 + vertices : 2 + vertices + faces]], int)
    return positions, triangles


def figures(positions, triangles):
    """Quality of the triangles, and the volume that they enclose."""
    a, b, c = (positions[triangles[:, k]] for k in range(3))
    sides = numpy.stack([numpy.linalg.norm(x, axis=1) for x in (b - c, c - a, a - b)])
    areas = 0.5 * numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1)
    squares = sides**2
    cosines = (squares.sum(0) - 2 * squares) / (2 * sides.prod(0) / sides)
    angles = numpy.degrees(numpy.arccos(numpy.clip(cosines, -1, 1)))
    ratio = sides.max(0) / sides.min(0)
    centre = positions.mean(0)
    return {
        "triangles": len(triangles),
        "mean": ratio.mean(),
        "variance": ratio.var(),
        "worst": ratio.max(),
        "angle": angles.min(),
        "below_30": (angles.min(0) < 30).mean(),
        "shape": (4 * numpy.sqrt(3) * areas / squares.sum(0)).min(),
        "volume": (numpy.cross(a - centre, b - centre) * (c - centre)).sum() / 6,
    }


def show(label, found, deviation=""):
    ratio = f"edge_ratio mean {found['mean']:.3f}, variance {found['variance']:.3f}, greatest {found['worst']:.2f}"
    angle = f"least angle {found['angle']:.2f}°, below 30° {100 * found['below_30']:.2f} %"
    print(f"{label:28} {found['triangles']:6} triangles, {ratio}, {angle}{deviation}")


def run(*arguments):
    return subprocess.run([COMMAND, *map(str, arguments)], check=True, capture_output=True, text=True).stdout


def check_step(folder, source, before, subcommand, options):
    """One way to improve the mesh: it gets better on average and at its worst, and keeps its volume."""
    target = folder / "improved.off"
    report = json.loads(run(subcommand, source, "-o", target, "--json", *options))
    positions, triangles = read(target)
    after = figures(positions, triangles)
    label = " ".join([subcommand, *options])
    diagonal = numpy.linalg.norm(numpy.ptp(read(source)[0], axis=0))
    show(label, after, f", moved by at most {report['max_deviation'] / diagonal:.4f} of the diagonal")
    check(after["mean"] < before["mean"] and after["variance"] < before["variance"], f"{label}: mean and variance fall")
    check(after["shape"] > before["shape"] and after["angle"] > before["angle"], f"{label}: the worst triangle is better")
    change = after["volume"] / before["volume"] - 1
    check(abs(change) <= 1e-12, f"{label}: volume {change:+.1e}")


def check_painted(folder, positions, triangles):
    """PyMeshLab reads the qualities and colours of the faces that the command has written."""
    source, target = folder / "source.ply", folder / "painted.ply"
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(positions, triangles))
    meshes.save_current_mesh(str(source), save_face_color=True, save_face_quality=True, save_vertex_quality=False)
    run("smooth", source, "-o", target, "--quality-colors")
    meshes.load_new_mesh(str(source))
    expected = shapes(meshes.current_mesh())
    meshes.load_new_mesh(str(target))
    mesh = meshes.current_mesh()
    off = numpy.abs(mesh.face_scalar_array() - expected).max()
    check(off < 1e-6, f"PyMeshLab reads the qualities of {len(expected)} faces (off by at most {off:.1e})")
    light = (mesh.face_color_matrix()[:, :3] ** 2.2) @ [0.2126, 0.7152, 0.0722]
    bad, good = light[expected < 0.3], light[expected > 0.9]
    check(len(bad) > 0 and bad.max() < good.min(), f"its colours: {len(bad)} bad faces are darker than {len(good)} good ones")
    again = folder / "again.ply"
    run("smooth", target, "-o", again, "--iterations", "0", "--quality-colors=after")
    meshes.load_new_mesh(str(again))
    off = numpy.abs(meshes.current_mesh().face_scalar_array() - shapes(mesh)).max()
    check(off < 1e-6, f"the command reads its own file, and replaces them (off by at most {off:.1e})")


def shapes(mesh):
    """Mean ratio of each triangle."""
    a, b, c = (mesh.vertex_matrix()[mesh.face_matrix()[:, k]] for k in range(3))
    squares = sum(((x - y) ** 2).sum(1) for x, y in ((a, b), (b, c), (c, a)))
    return 2 * numpy.sqrt(3) * numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1) / squares


def main():
    positions, triangles = simplified()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        source = folder / "simplified.off"
        write(source, positions, triangles)
        before = figures(positions, triangles)
        show("simplified", before)
        for subcommand, options in STEPS:
            check_step(folder, source, before, subcommand, options)
        check_painted(folder, positions, triangles)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
