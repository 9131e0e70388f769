"""The quality of what a peer made: by the ruler where it lies beside the project, else by the command."""

import importlib.util
import json
import subprocess

import numpy


def load_ruler(path):
    """The ruler, a program that shares no code with the project; None where it is not there."""
    if not path.exists():
        return None
    spec = importlib.util.spec_from_file_location("metrics", path)
    ruler = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(ruler)
    return ruler


def by_ruler(ruler, before, after, triangles):
    figures = ruler.compare(before, triangles, after, triangles, si=False)
    return {
        "mean": figures["AR_M"],
        "variance": figures["AR_D"],
        "smallest angle": figures["amin"],
        "volume": figures["dvol"],
        "deviation": figures["H_max"],
    }


def by_command(command, folder, before, after, triangles):
    old, new = (measured(command, folder, positions, triangles) for positions in (before, after))
    closed = old["boundary_edges"] == 0 and old["non_manifold_edges"] == 0 and old["volume"]
    return {
        "mean": new["edge_ratio"]["mean"],
        "variance": new["edge_ratio"]["variance"],
        "smallest angle": new["min_angle"]["min"],
        "volume": (new["volume"] - old["volume"]) / abs(old["volume"]) if closed else None,
        "deviation": None,
    }


def measured(command, folder, positions, triangles):
    path = folder / "measured.off"
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"OFF\n{len(positions)} {len(triangles)} 0\n")
        numpy.savetxt(file, positions, "%.17g")
        numpy.savetxt(file, numpy.insert(triangles, 0, 3, axis=1), "%d")
    run = subprocess.run([command, "measure", path, "--json"], capture_output=True, text=True, check=False)
    if run.returncode:
        raise RuntimeError(f"measuring fails: {run.stderr.strip()}")
    return json.loads(run.stdout)
