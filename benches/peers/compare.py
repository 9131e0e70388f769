"""Times qsmesh and its peers on the same meshes, taking turns, and judges what they made; `run` calls it.

All but one are tied to one processor, whatever threads they start, and their time is processor time, which is the wall
clock's on an idle machine; only qsmesh on all threads goes by the wall clock. Of all turns the fastest counts.
"""

import argparse
import json
import os
import subprocess
import sys
import time
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "benches"))

import document  # noqa: E402
import machine  # noqa: E402
import meshlab_peer  # noqa: E402
import native_peers  # noqa: E402
import numpy  # noqa: E402
import quality  # noqa: E402
import tables  # noqa: E402
import trueform_peer  # noqa: E402
import vtk_peers  # noqa: E402

SHARED = ROOT.parent / "shared"
WORK = ROOT / "target" / "peers"
COMMAND = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "release" / "qsmesh"
MESHES = ["horse.ply", "fandisk.obj", "rockerarm.obj", "mc_tangle.ply", "plane_graded.off"]
PYTHON_PEERS = [*meshlab_peer.PEERS, *vtk_peers.PEERS, *trueform_peer.PEERS]
FEW, MANY = 2, 6


class Times:
    """Seconds of every turn, by peer and number of iterations."""

    def __init__(self):
        self.adjacency, self.smoothing = defaultdict(list), defaultdict(list)

    def add(self, name, iterations, adjacency, smoothing):
        self.adjacency[name].append(adjacency)
        self.smoothing[name, iterations].append(smoothing)

    def figures(self, name, vertices):
        """Nanoseconds per vertex and iteration: with adjacency; of the call alone; of one more iteration."""
        few, many = (min(self.smoothing[name, iterations]) for iterations in (FEW, MANY))
        return {
            "whole": (few + min(self.adjacency[name])) * 1e9 / (FEW * vertices),
            "call": few * 1e9 / (FEW * vertices),
            "marginal": (many - few) * 1e9 / ((MANY - FEW) * vertices),
        }


def main():
    arguments = parse()
    everywhere = os.sched_getaffinity(0)
    ruler = quality.load_ruler(SHARED / "measure" / "metrics.py")
    described = machine.describe()
    results = {}
    for path in meshes(arguments.mesh):
        print(f"-- {path.name}", file=sys.stderr, flush=True)
        positions, triangles = load(path, ruler)
        times, made = compare(positions, triangles, arguments, everywhere)
        results[path.name] = {
            "vertices": len(positions),
            "triangles": len(triangles),
            "before": judge(ruler, positions, positions, triangles),
            "peers": {
                name: {**times.figures(name, len(positions)), **judge(ruler, positions, after, triangles)}
                for name, after in made.items()
            },
        }
    figures = {"machine": described, "ruler": ruler is not None, "meshes": results}
    (WORK / "figures.json").write_text(json.dumps(figures, indent=1))
    text = f"{machine.sentence(described)}\n\n{tables.document(results)}"
    print(text)
    if not arguments.keep_document:
        document.replace("peers", text)


def parse():
    parser = argparse.ArgumentParser(prog="benches/peers/run", description="Compares qsmesh with its peers.")
    parser.add_argument("mesh", nargs="*", type=Path, help="PLY, OBJ or OFF files of triangles")
    parser.add_argument("--rounds", type=int, default=3, help="how often every program is started; default 3")
    parser.add_argument("--repetitions", type=int, default=3, help="turns in each round; default 3")
    parser.add_argument("--keep-document", action="store_true", help="only print; leave docs/performance.md alone")
    return parser.parse_args()


def meshes(named):
    """The meshes that are named, else the reference meshes, else the one that the command makes for itself."""
    if named:
        return named
    if (SHARED / "data").exists():
        return [SHARED / "data" / name for name in MESHES]
    demo = WORK / "demo"
    demo.mkdir(exist_ok=True)
    subprocess.run([COMMAND, "demo", "-o", demo], check=True, capture_output=True)
    print("the reference meshes are not there; the command's own mesh stands in for them", file=sys.stderr)
    return [demo / "demo_before.ply"]


def load(path, ruler):
    if ruler:
        positions, triangles = ruler.load(str(path))
        return numpy.ascontiguousarray(positions, float), numpy.ascontiguousarray(triangles)
    import pymeshlab

    loaded = pymeshlab.MeshSet()
    loaded.load_new_mesh(str(path))
    return loaded.current_mesh().vertex_matrix(), loaded.current_mesh().face_matrix().astype(int)


def compare(positions, triangles, arguments, everywhere):
    """Times of all peers, and what each made of the mesh in two iterations."""
    times, mesh = Times(), WORK / "mesh.bin"
    native_peers.write(mesh, positions, triangles)
    made = {}
    for _ in range(arguments.rounds):
        os.sched_setaffinity(0, {max(everywhere)})
        for turn in native_peers.turns("processor", mesh, WORK, arguments.repetitions, native_peers.NAMES):
            times.add(*turn)
        for _ in range(arguments.repetitions):
            made.update((peer.name, python_turn(peer, positions, triangles, times)) for peer in PYTHON_PEERS)
        os.sched_setaffinity(0, everywhere)
        for turn in native_peers.turns("wall", mesh, WORK, arguments.repetitions, native_peers.ALL_THREADS):
            times.add(*turn)
    names = [*native_peers.NAMES, *native_peers.ALL_THREADS]
    return times, {name: native_peers.positions(WORK, name) for name in names} | made


def python_turn(peer, positions, triangles, times):
    """One turn with many iterations and one with few, whose result is returned."""
    for iterations in (MANY, FEW):
        built = peer(positions, triangles)
        start = time.process_time()
        built.smooth(iterations)
        times.add(peer.name, iterations, 0.0, time.process_time() - start)
    return built.positions()


def judge(ruler, before, after, triangles):
    if ruler:
        return quality.by_ruler(ruler, before, after, triangles)
    return quality.by_command(COMMAND, WORK, before, after, triangles)


main()
