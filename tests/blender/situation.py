"""Small meshes and what cases ask of them."""

import importlib
import unittest

import bpy
import numpy

# Set by host.py: the add-on's package, the qsmesh command, and a mesh file.
ADDON = COMMAND = MESH_FILE = None


def part(name):
    """A module of the installed add-on."""
    return importlib.import_module(f"{ADDON}.{name}")


class Situation(unittest.TestCase):
    """A case with an empty scene."""

    def setUp(self):
        if bpy.context.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        for kind in (bpy.data.objects, bpy.data.meshes, bpy.data.materials):
            for item in list(kind):
                kind.remove(item)
        bpy.context.view_layer.update()

    def assert_same_bits(self, first, second):
        self.assertTrue(numpy.array_equal(first, second), f"{(first != second).sum()} numbers differ")

    def assert_some_moved(self, before, after):
        self.assertTrue((before != after).any(), "nothing moved")

    def assert_refused(self, words, function, **arguments):
        """The operator reports an error with these words, which Blender hands to scripts as an exception."""
        with self.assertRaises(RuntimeError) as caught:
            function(**arguments)
        self.assertIn(words, str(caught.exception))


def uneven(positions, amount, keep):
    """Moves vertices at random, the same way every time, but for those to keep."""
    noise = numpy.random.default_rng(1).uniform(-amount, amount, positions.shape)
    return numpy.where(keep[:, None], positions, positions + noise).astype(numpy.float32)


def grid(size=8, flat=True):
    """A uneven square of size by size quads from -1 to 1: positions, quads, and which vertices lie on its border."""
    steps = numpy.linspace(-1, 1, size + 1)
    x, y = (values.ravel() for values in numpy.meshgrid(steps, steps))
    positions = numpy.stack([x, y, numpy.zeros_like(x)], axis=1)
    border = (numpy.abs(positions[:, :2]) == 1).any(axis=1)
    moved = uneven(positions, 0.6 / size, border)
    if flat:
        moved[:, 2] = 0
    corner = (numpy.arange(size)[:, None] * (size + 1) + numpy.arange(size)).ravel()
    quads = numpy.stack([corner, corner + 1, corner + size + 2, corner + size + 1], axis=1)
    return moved, quads, border


def split(quads):
    """Two triangles for each quad."""
    return numpy.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def ball(subdivisions=3):
    """An uneven ball of triangles: positions and triangles."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=subdivisions)
    obj = bpy.context.object
    positions, triangles = coordinates(obj), faces(obj)
    bpy.data.objects.remove(obj)
    positions = uneven(positions, 0.06, numpy.zeros(len(positions), dtype=bool))
    return positions / numpy.linalg.norm(positions, axis=1, keepdims=True).astype(numpy.float32), triangles


def add(positions, polygons, name="mesh"):
    """A new object, selected and active, alone."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(numpy.asarray(positions).tolist(), [], numpy.asarray(polygons).tolist())
    mesh.update()
    # Blender 5.0 gives the edges that it adds here a selection of pairs of integers, over which it stumbles later.
    selection = mesh.attributes.get(".select_edge")
    if selection is not None and selection.data_type != "BOOLEAN":
        mesh.attributes.remove(selection)
    return place(bpy.data.objects.new(name, mesh))


def place(obj):
    """Puts an object into the scene, selected and active, alone."""
    bpy.context.scene.collection.objects.link(obj)
    select(obj)
    return obj


def select(*objects):
    # What was linked or removed since shows only after an update.
    bpy.context.view_layer.update()
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj in objects)
    bpy.context.view_layer.objects.active = objects[0]
    bpy.context.view_layer.update()


def coordinates(obj):
    """The mesh's own coordinates: float32, (vertices, 3)."""
    found = numpy.empty((len(obj.data.vertices), 3), dtype=numpy.float32)
    obj.data.vertices.foreach_get("co", found.ravel())
    return found


def key_coordinates(obj, name):
    found = numpy.empty((len(obj.data.vertices), 3), dtype=numpy.float32)
    obj.data.shape_keys.key_blocks[name].data.foreach_get("co", found.ravel())
    return found


def faces(obj):
    """Vertex numbers of a mesh of triangles: (triangles, 3)."""
    return numpy.array([tuple(polygon.vertices) for polygon in obj.data.polygons])


def choose(obj, chosen, name="select"):
    """Selects vertices, in Object Mode, and with them the edges and faces between them; or hides them."""
    mesh = obj.data
    edges = [all(chosen[vertex] for vertex in edge.vertices) for edge in mesh.edges]
    polygons = [all(chosen[vertex] for vertex in polygon.vertices) for polygon in mesh.polygons]
    _flag(mesh, "vertices", name, "vert", "POINT", chosen)
    _flag(mesh, "edges", name, "edge", "EDGE", edges)
    _flag(mesh, "polygons", name, "poly", "FACE", polygons)
    mesh.update()


def _flag(mesh, elements, name, short, domain, values):
    if bpy.app.version < (4, 1):
        getattr(mesh, elements).foreach_set(name, values)
        return
    layer = f".{name}_{short}"
    attribute = mesh.attributes.get(layer) or mesh.attributes.new(layer, "BOOLEAN", domain)
    attribute.data.foreach_set("value", values)


def edit_and_back(function, **arguments):
    """Calls an operator in Edit Mode; returns what it returned, and the mode is Object again."""
    bpy.ops.object.mode_set(mode="EDIT")
    try:
        return function(**arguments)
    finally:
        bpy.ops.object.mode_set(mode="OBJECT")


def as_typed(value):
    """The shortest number for a property in single precision."""
    return str(numpy.float32(value))
