#!/usr/bin/env python3
"""Checks the figures that the project promises, on what the command writes.

Where the reference meshes and their ruler lie beside the project (../shared), each row of MESHES is smoothed by the
command and measured by the ruler, which shares no code with the project. Where they don't, only the demo mesh, which the
command makes for itself, is checked, and a line says so. The ruler's packages go into a virtual environment in target/.
"""

import itertools
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SHARED = ROOT.parent / "shared"
RULER = SHARED / "measure" / "metrics.py"
COMMAND = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "release" / "qsmesh"
PACKAGES = ["numpy==2.4.*", "libigl==2.6.*", "pymeshlab==2025.7.*"]

OFF = ["--feature-angle", "off"]
# Mesh, options, bounds on the ruler's figures: at most, or at least where the bound starts with ">".
MESHES = [
    ("horse.ply", ["--iterations", "1", "--relaxation", "1", *OFF], {"AR_M": 1.460, "AR_D": 0.062, "AR_max": 6}),
    ("horse.ply", OFF, {"AR_M": 1.411, "AR_D": 0.051, "amin": ">10", "H_max": 0.004, "selfint": 0}),
    ("horse.ply", ["--iterations", "10", "--relaxation", "1.6", *OFF], {"AR_M": 1.33}),
    ("horse.ply", [], {"AR_M": 1.425, "H_max": 0.0012, "amin": ">5"}),
    ("fandisk.obj", [], {"AR_M": 1.342, "H_max": 0.0010}),
    ("rockerarm.obj", [], {"AR_M": 1.43, "H_max": 0.0018, "amin": ">8", "flips_same": 0}),
    ("mc_tangle.ply", [], {"AR_M": 1.420, "amin": ">15", "H_max": 0.0004, "flips_same": 0}),
    ("plane_graded.off", [], {"AR_M": 1.465, "amin": ">8", "flips_same": 0}),
    ("nasty_zeroarea.off", OFF, {"amin": ">20"}),
    ("nasty_zeroarea.off", [], {"nan": 0}),
    ("nasty_dup.off", [], {"nan": 0}),
    ("nasty_nonman.off", [], {"nan": 0}),
]
# The same with the tail treated. "removed" and "unchanged" are shares of the vertices and of the triangles.
FINE = ["--tail-min-angle", "30", "--tail-max-angle", "115", "--tail-edge-ratio", "2.6", *OFF]
CURED = {"amin": ">20", "amax": 130, "AR_max": 3.0, "removed": 0.001, "unchanged": ">0.997"}
TAILS = [
    ("horse.ply", OFF, {**CURED, "H_max": 0.004, "selfint": 3}),
    ("mc_tangle.ply", [], {**CURED, "selfint": 0}),
    ("plane_graded.off", [], {"amin": ">17.5", "unchanged": ">0.98", "selfint": 0}),
    ("rockerarm.obj", [], {"amin": ">18", "H_max": 0.002, "selfint": 0}),
    ("fandisk.obj", [], {"H_max": 0.0010, "selfint": 0}),
    ("horse.ply", FINE, {"lt30": 0.0004, "unchanged": ">0.975", "selfint": 3}),
    ("mc_tangle.ply", FINE, {"lt30": 0.0012, "unchanged": ">0.93", "selfint": 0}),
    ("horse.ply", [], {"selfint": 3}),
    ("nasty_zeroarea.off", [], {}),
    ("nasty_zeroarea.off", OFF, {}),
    ("nasty_dup.off", [], {}),
    ("nasty_nonman.off", [], {}),
]
# In all of them these hold too.
ALWAYS = {"nan": 0}
CLOSED = ["horse.ply", "fandisk.obj", "rockerarm.obj", "mc_tangle.ply", "nasty_zeroarea.off"]
SETTINGS = [
    [*plane, *ideal, *features, *sweeps]
    for plane, ideal, features, sweeps in itertools.product(
        ([], ["--plane", "least-squares"]),
        ([], ["--ideal", "equilateral"]),
        ([], OFF),
        ([], ["--iterations", "5", "--relaxation", "1.8"]),
    )
]
FLOOR = 0.5

passed, failed = 0, 0


def check(holds, what):
    global passed, failed
    passed, failed = passed + bool(holds), failed + (not holds)
    print(("ok    " if holds else "FAILED"), what, flush=True)


def smooth(source, target, options):
    return run_command("smooth", source, target, options)


def run_command(verb, source, target, options):
    """Runs the command; returns its report."""
    result = subprocess.run(
        [COMMAND, verb, source, "-o", target, "--json", *options], capture_output=True, text=True, check=False
    )
    if result.returncode:
        raise RuntimeError(f"{source}: {result.stderr.strip()}")
    return json.loads(result.stdout)


def within(value, bound):
    if isinstance(bound, str):
        return value is not None and value >= float(bound[1:])
    return value is not None and value <= bound


def check_demo(folder):
    """The mesh that the command makes for itself gets better, and its volume stays."""
    run = subprocess.run([COMMAND, "demo", "-o", folder], capture_output=True, text=True, check=False)
    check(run.returncode == 0, f"demo runs: {run.stderr.strip()}")
    again = Path(folder) / "again.ply"
    report = smooth(Path(folder) / "demo_before.ply", again, [])
    before, after = report["before"], report["after"]
    check(again.read_bytes() == (Path(folder) / "demo_after.ply").read_bytes(), "demo: smooth writes the same bits again")
    check(before["below_20"] > 1000, f"demo: {before['below_20']} triangles below 20° before")
    check(after["below_20"] < before["below_20"] / 20, f"demo: {after['below_20']} after")
    means = [state["edge_ratio"]["mean"] for state in (before, after)]
    check(means[1] < means[0] / 5, f"demo: edge_ratio mean {means[0]:.4f} -> {means[1]:.4f}")
    check(abs(report["volume_relative_change"]) < 1e-6, f"demo: volume {report['volume_relative_change']:.1e}")


def check_mesh(ruler, folder, name, options, bounds):
    source, target = SHARED / "data" / name, Path(folder) / f"out{Path(name).suffix}"
    report = smooth(source, target, options)
    positions, triangles = ruler.load(str(source))
    after, new_triangles = ruler.load(str(target))
    figures = ruler.compare(positions, triangles, after, new_triangles, si="selfint" in bounds)
    label = f"{name} {' '.join(options)}"
    check(len(after) == len(positions) and (triangles == new_triangles).all(), f"{label}: same vertices and triangles")
    for key, bound in {**ALWAYS, **bounds}.items():
        check(within(figures[key], bound), f"{label}: {key} {figures[key]:.6g} (bound {bound})")
    turned, folded = turned_and_folded(positions, after, triangles)
    check(turned <= folded, f"{label}: {len(turned)} triangles turned, all among the {len(folded)} that came folded over")
    moved = (positions != after).any(1).sum()
    check(moved == report["moved"], f"{label}: {moved} vertices moved, the rest has its bits; reported {report['moved']}")
    check(sum(report["kept"].values()) + moved == len(positions), f"{label}: every vertex is counted")


def turned_and_folded(before, after, triangles):
    """Triangles turned by more than a right angle, and those that opposed the average normals of all their corners."""
    import numpy

    def normals(positions):
        a, b, c = (positions[triangles[:, k]] for k in range(3))
        return numpy.cross(b - a, c - a)

    old, new = normals(before), normals(after)
    sums = numpy.zeros_like(before)
    for corner in range(3):
        numpy.add.at(sums, triangles[:, corner], old)
    opposed = [(old * sums[triangles[:, corner]]).sum(1) < 0 for corner in range(3)]
    turned = (old * new).sum(1) < 0
    return set(numpy.flatnonzero(turned)), set(numpy.flatnonzero(numpy.logical_and.reduce(opposed)))


def check_boundary(ruler, folder):
    import numpy

    source, target = SHARED / "data" / "plane_graded.off", Path(folder) / "out.off"
    smooth(source, target, [])
    positions, triangles = ruler.load(str(source))
    after, _ = ruler.load(str(target))
    edges = numpy.sort(numpy.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    unique, count = numpy.unique(edges, axis=0, return_counts=True)
    boundary = numpy.unique(unique[count == 1])
    check(len(boundary) > 400 and (positions[boundary] == after[boundary]).all(), f"{len(boundary)} boundary vertices keep their bits")


def shapes(ruler, positions, triangles):
    import numpy

    a, b, c = (positions[triangles[:, k]] for k in range(3))
    squares = ((b - a) ** 2).sum(1) + ((c - b) ** 2).sum(1) + ((a - c) ** 2).sum(1)
    areas = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1)
    return 2 * numpy.sqrt(3) * areas / numpy.where(squares > 0, squares, 1)


def check_promises(ruler, folder, name, options):
    """Volume in double precision, and the worst triangle below the floor, for one closed mesh and one setting."""
    positions, triangles = ruler.load(str(SHARED / "data" / name))
    source, target = Path(folder) / "double.off", Path(folder) / "double_out.off"
    rows = [f"{x!r} {y!r} {z!r}" for x, y, z in positions.tolist()] + [f"3 {a} {b} {c}" for a, b, c in triangles.tolist()]
    source.write_text("\n".join(["OFF", f"{len(positions)} {len(triangles)} 0", *rows, ""]))
    smooth(source, target, options)
    after, _ = ruler.load(str(target))
    figures = [ruler.quality(p, triangles)[0] for p in (positions, after)]
    change = (figures[1]["vol"] - figures[0]["vol"]) / abs(figures[0]["vol"])
    worst = [shapes(ruler, p, triangles).min() for p in (positions, after)]
    label = f"{name} {' '.join(options)}"
    check(abs(change) <= 1e-12, f"{label}: volume {change:.1e}")
    check(worst[1] >= min(worst[0], FLOOR) * (1 - 1e-9), f"{label}: worst shape {worst[0]:.4g} -> {worst[1]:.4g}")


def write_numbered(path, positions, triangles):
    """A PLY file in double precision in which vertices and faces carry their numbers."""
    import numpy

    vertices = numpy.empty(len(positions), [("place", "<f8", 3), ("id", "<i4")])
    vertices["place"], vertices["id"] = positions, numpy.arange(len(positions))
    faces = numpy.empty(len(triangles), FACE)
    faces["count"], faces["corners"], faces["id"] = 3, triangles, numpy.arange(len(triangles))
    header = [
        "ply", "format binary_little_endian 1.0",
        f"element vertex {len(vertices)}", *(f"property double {axis}" for axis in "xyz"), "property int id",
        f"element face {len(faces)}", "property list uchar int vertex_indices", "property int id", "end_header", "",
    ]
    path.write_bytes("\n".join(header).encode() + vertices.tobytes() + faces.tobytes())


FACE = [("count", "u1"), ("corners", "<i4", 3), ("id", "<i4")]


def read_numbered(path):
    """Positions, vertex numbers, triangles and face numbers of what came of such a file."""
    import numpy

    header, body = path.read_bytes().split(b"end_header\n", 1)
    counts = [int(line.split()[2]) for line in header.decode().splitlines() if line.startswith("element")]
    vertices = numpy.frombuffer(body, [("place", "<f8", 3), ("id", "<i4")], counts[0])
    faces = numpy.frombuffer(body, FACE, counts[1], vertices.nbytes)
    return vertices["place"], vertices["id"], faces["corners"].astype(int), faces["id"]


def turned_to_least(triangles):
    """Each triangle turned until its least vertex stands first; the winding stays."""
    import numpy

    turn = (triangles.argmin(1)[:, None] + numpy.arange(3)) % 3
    return numpy.take_along_axis(triangles, turn, 1)


def euler(triangles):
    """Euler characteristic, boundary edges, non-manifold edges."""
    import numpy

    edges = numpy.sort(numpy.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    unique, count = numpy.unique(edges, axis=0, return_counts=True)
    used = len(numpy.unique(triangles))
    return used - len(unique) + len(triangles), int((count == 1).sum()), int((count > 2).sum())


def edges_of(triangles):
    """Each edge once, least vertex first, with up to two of its triangles (the same one twice on the boundary)."""
    import numpy

    edges = numpy.sort(numpy.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    unique, inverse = numpy.unique(edges, axis=0, return_inverse=True)
    owners = numpy.tile(numpy.arange(len(triangles)), 3)
    first, second = numpy.empty(len(unique), int), numpy.empty(len(unique), int)
    first[inverse.ravel()] = owners
    second[inverse.ravel()[::-1]] = owners[::-1]
    return unique, first, second


def check_boundary_kept(label, positions, triangles, after, vertex_ids):
    import numpy

    edges, first, second = edges_of(triangles)
    rim = numpy.unique(edges[first == second])
    kept = numpy.isin(rim, vertex_ids)
    same = positions[rim[kept]] == after[numpy.searchsorted(vertex_ids, rim[kept])]
    check(kept.all() and same.all(), f"{label}: all {len(rim)} boundary vertices keep their bits")


def check_creases_kept(label, positions, triangles, after, vertex_ids, new_triangles):
    """Every edge sharper than 30° is still an edge, and its ends lie on the line that these edges made before."""
    import numpy

    edges, first, second = edges_of(triangles)
    a, b, c = (positions[triangles[:, k]] for k in range(3))
    normals = numpy.cross(b - a, c - a)
    normals /= numpy.linalg.norm(normals, axis=1)[:, None]
    sharp = edges[(normals[first] * normals[second]).sum(1) < numpy.cos(numpy.radians(30))]
    now = {tuple(edge) for edge in edges_of(vertex_ids[new_triangles])[0].tolist()}
    lost = sum(tuple(edge) not in now for edge in sharp.tolist())
    check(lost == 0, f"{label}: {lost} of {len(sharp)} sharp edges lost")
    ends = numpy.unique(sharp)
    places = after[numpy.searchsorted(vertex_ids, ends)]
    start, along = positions[sharp[:, 0]], positions[sharp[:, 1]] - positions[sharp[:, 0]]
    share = ((places[:, None] - start) * along).sum(2) / (along**2).sum(1)
    feet = start + numpy.clip(share, 0, 1)[:, :, None] * along
    distance = numpy.linalg.norm(places[:, None] - feet, axis=2).min(1).max()
    distance /= numpy.linalg.norm(numpy.ptp(positions, axis=0))
    check(distance <= 0.001, f"{label}: ends of sharp edges at most {distance:.5f} of the diagonal from their line")


def check_tail(ruler, folder, name, options, bounds):
    """One mesh improved: figures by the ruler, topology, and what the file's own numbers say of the maps."""
    positions, triangles = ruler.load(str(SHARED / "data" / name))
    source, target = Path(folder) / "numbered.ply", Path(folder) / "improved.ply"
    write_numbered(source, positions, triangles)
    report = run_command("improve", source, target, options)
    after, vertex_ids, new_triangles, face_ids = read_numbered(target)
    named = vertex_ids[new_triangles]
    same = (turned_to_least(named) == turned_to_least(triangles[face_ids])).all(1)
    figures = ruler.compare(positions, triangles, after, new_triangles, si="selfint" in bounds)
    figures["removed"] = 1 - len(after) / len(positions)
    figures["unchanged"] = same.sum() / len(triangles)
    label = f"{name} improved {' '.join(options)}"
    for key, bound in {**ALWAYS, **bounds}.items():
        check(within(figures[key], bound), f"{label}: {key} {figures[key]:.6g} (bound {bound})")
    check((vertex_ids[1:] > vertex_ids[:-1]).all(), f"{label}: surviving vertices keep their order")
    check((face_ids[same][1:] > face_ids[same][:-1]).all(), f"{label}: so do untouched triangles")
    check(abs(report["tail"]["triangles_unchanged"] - figures["unchanged"]) < 1e-9, f"{label}: reported share unchanged")
    if name.startswith("nasty"):
        return
    shape = [euler(t) for t in (triangles, new_triangles)]
    check(shape[0] == shape[1], f"{label}: Euler characteristic, boundary and non-manifold edges {shape[1]}")
    if figures["dvol"] is not None:
        check(abs(figures["dvol"]) <= 1e-12, f"{label}: volume {figures['dvol']:.1e}")
    check_boundary_kept(label, positions, triangles, after, vertex_ids)
    if name == "fandisk.obj":
        check_creases_kept(label, positions, triangles, after, vertex_ids, new_triangles)
    leftovers = report["tail"]["leftovers"]
    check(all(one["reason"] for one in leftovers), f"{label}: {len(leftovers)} leftovers, each with its reason")


def check_orders(ruler, folder):
    """The worst triangle is better where the worst come first."""
    target, worst = Path(folder) / "order.ply", {}
    for order in ("index", "tail"):
        smooth(SHARED / "data" / "horse.ply", target, [*OFF, "--order", order])
        worst[order] = shapes(ruler, *ruler.load(str(target))).min()
    check(worst["tail"] > worst["index"], f"horse.ply: worst shape {worst['tail']:.3f} by tail, {worst['index']:.3f} by index")


def log_sizes(positions, triangles):
    """Per vertex the logarithm of the mean, over the vertices at most two edges away, of the mean area of their triangles."""
    import numpy

    a, b, c = (positions[triangles[:, k]] for k in range(3))
    area = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1) / 2
    count = len(positions)
    corners = triangles.ravel()
    mean = numpy.bincount(corners, area.repeat(3), count) / numpy.bincount(corners, minlength=count)
    pairs = numpy.concatenate([triangles[:, [i, j]] for i in range(3) for j in range(3)])
    near = numpy.unique(pairs[:, 0] * count + pairs[:, 1])
    start, end = near // count, near % count
    first = numpy.searchsorted(start, numpy.arange(count + 1))
    lengths = (first[1:] - first[:-1])[end]
    offsets = numpy.arange(lengths.sum()) - (lengths.cumsum() - lengths).repeat(lengths)
    around = numpy.unique(start.repeat(lengths) * count + end[first[end].repeat(lengths) + offsets])
    members = numpy.bincount(around // count, minlength=count)
    return numpy.log(numpy.bincount(around // count, mean[around % count], count) / members)


def check_sizes(ruler, folder):
    """With sizes kept, those of the result go with those of the input."""
    import numpy

    source, target = SHARED / "data" / "horse.ply", Path(folder) / "sizes.ply"
    positions, triangles = ruler.load(str(source))
    before = log_sizes(positions, triangles.astype(numpy.int64))
    for sweeps, bounds in ((2, (0.985, 1.45)), (10, (0.95, 1.40))):
        report = smooth(source, target, [*OFF, "--keep-sizes", "--iterations", str(sweeps)])
        after = log_sizes(ruler.load(str(target))[0], triangles.astype(numpy.int64))
        found, mean = numpy.corrcoef(before, after)[0, 1], report["after"]["edge_ratio"]["mean"]
        figures = f"correlation of sizes {found:.4f}, edge_ratio mean {mean:.4f} (bounds {bounds})"
        check(found >= bounds[0] and mean <= bounds[1], f"horse.ply, sizes kept, {sweeps} sweeps: {figures}")


def check_refusal(folder):
    """A NaN is an error that names vertex and line, and no file is written."""
    source, target = SHARED / "data" / "nasty_nan.off", Path(folder) / "refused.off"
    run = subprocess.run([COMMAND, "smooth", source, "-o", target], capture_output=True, text=True, check=False)
    line = next(i for i, text in enumerate(source.read_text().splitlines(), 1) if "nan" in text.lower())
    named = f"line {line}" in run.stderr and "vertex" in run.stderr
    check(run.returncode == 1 and named and not target.exists(), f"nasty_nan.off is refused: {run.stderr.strip()}")


def load_ruler():
    """Imports the ruler, in a virtual environment with its packages; restarts this program in it first."""
    environment = COMMAND.parent.parent / "python"
    python = environment / "bin" / "python"
    if Path(sys.prefix) != environment:
        if not python.exists():
            subprocess.run([sys.executable, "-m", "venv", environment], check=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *PACKAGES], check=True)
        os.execv(python, [str(python), __file__])
    sys.path.insert(0, str(RULER.parent))
    import metrics

    return metrics


def main():
    ruler = load_ruler() if RULER.exists() else None
    with tempfile.TemporaryDirectory() as folder:
        check_demo(folder)
        if ruler is None:
            print("reference meshes: not beside the project, only the demo mesh was checked")
        else:
            for row in MESHES:
                check_mesh(ruler, folder, *row)
            for row in TAILS:
                check_tail(ruler, folder, *row)
            check_boundary(ruler, folder)
            for name, options in itertools.product(CLOSED, SETTINGS):
                check_promises(ruler, folder, name, options)
            check_orders(ruler, folder)
            check_sizes(ruler, folder)
            check_refusal(folder)
    print(f"{passed} passed, {failed} failed")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
