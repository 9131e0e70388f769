"""What Blender costs: the operator in Object Mode against the library's own call, in one run, on one mesh.

Run in a Blender as a Python module, with the add-on's zip and a PLY mesh as arguments. The native call is the one that
the operator makes: the same buffers, options and report; beside them stand both without a report, which is where most
of the time goes. Prints the medians and their ratios; the operator's is to stay below 3, with and without.
"""

import importlib
import pathlib
import statistics
import sys
import tempfile
import time
import zipfile

import bpy
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import ply

ROUNDS = 15


def main():
    archive, mesh_file = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        zipfile.ZipFile(archive).extractall(folder)
        sys.path.insert(0, folder)
        library = importlib.import_module("qsmesh.library")
        importlib.import_module("qsmesh").register()
        positions, triangles = ply.read(mesh_file)
        mesh = add(positions, triangles)
        seconds = {"native call": [], "native call without report": [], "operator": [],
                   "operator without report": [], "operator with undo": []}
        for _ in range(ROUNDS):
            seconds["native call"].append(native(library, positions, triangles))
            seconds["native call without report"].append(native(library, positions, triangles, False))
            seconds["operator"].append(operator(mesh, positions, ()))
            seconds["operator without report"].append(operator(mesh, positions, (), tell_quality=False))
            seconds["operator with undo"].append(operator(mesh, positions, ("EXEC_DEFAULT", True)))
    medians = {name: statistics.median(found) for name, found in seconds.items()}
    for name, median in medians.items():
        base = "native call without report" if "without" in name else "native call"
        print(f"{name}: {1000 * median:.1f} ms, {median / medians[base]:.2f} times the {base}")


def add(positions, triangles):
    mesh = bpy.data.meshes.new("mesh")
    mesh.from_pydata(positions.tolist(), [], triangles.tolist())
    mesh.update()
    obj = bpy.data.objects.new("mesh", mesh)
    bpy.context.scene.collection.objects.link(obj)
    bpy.context.view_layer.update()
    for other in bpy.context.view_layer.objects:
        other.select_set(other == obj)
    bpy.context.view_layer.objects.active = obj
    return mesh


def native(library, positions, triangles, figures=True):
    buffer, numbers = positions.copy(), triangles.astype(numpy.uint32)
    options = library.default_options()
    start = time.perf_counter()
    library.smooth(buffer, numbers, options, figures)
    return time.perf_counter() - start


def operator(mesh, positions, how, **options):
    mesh.vertices.foreach_set("co", positions.ravel())
    mesh.update()
    bpy.context.view_layer.update()
    start = time.perf_counter()
    bpy.ops.mesh.qsmesh_smooth(*how, **options)
    return time.perf_counter() - start


main()
