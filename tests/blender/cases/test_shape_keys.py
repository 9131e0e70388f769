"""The active shape key is smoothed; keys that are relative to it go along."""

import bpy
import numpy

from situation import Situation, add, ball, choose, coordinates, edit_and_back, key_coordinates, part


class ShapeKeys(Situation):
    def setUp(self):
        super().setUp()
        self.positions, triangles = ball()
        self.plain = add(self.positions, triangles, "plain")
        self.obj = add(self.positions, triangles)
        offsets = {"Basis": 0.0, "Wide": 0.5, "Wider": 1.0, "Apart": 2.0}
        self.keys = {}
        for name, offset in offsets.items():
            key = self.obj.shape_key_add(name=name)
            self.keys[name] = (self.positions * numpy.float32(1 + offset)).astype(numpy.float32)
            key.data.foreach_set("co", self.keys[name].ravel())
        blocks = self.obj.data.shape_keys.key_blocks
        blocks["Wider"].relative_key = blocks["Wide"]
        blocks["Apart"].relative_key = blocks["Apart"]

    def smooth(self, name, in_edit_mode):
        self.obj.active_shape_key_index = list(self.keys).index(name)
        if in_edit_mode:
            choose(self.obj, numpy.ones(len(self.positions), dtype=bool))
            return edit_and_back(bpy.ops.mesh.qsmesh_smooth)
        return bpy.ops.mesh.qsmesh_smooth()

    def expected(self, name):
        """What a mesh without keys becomes that looks like the key."""
        after = self.keys[name].copy()
        triangles = numpy.array([tuple(polygon.vertices) for polygon in self.obj.data.polygons], dtype=numpy.uint32)
        part("library").smooth(after, triangles, part("library").default_options())
        return after

    def assert_keys(self, active, dragged):
        step = self.expected(active) - self.keys[active]
        self.assertGreater(numpy.abs(step).max(), 0.001)
        for name, before in self.keys.items():
            after = key_coordinates(self.obj, name)
            if name == active:
                self.assert_same_bits(after, self.expected(active))
            elif name in dragged:
                self.assertLess(numpy.abs(after - (before + step)).max(), 1e-6, name)
            else:
                self.assert_same_bits(after, before)
        self.assert_same_bits(coordinates(self.obj), key_coordinates(self.obj, "Basis"))

    def test_the_basis_drags_its_relative_keys_in_object_mode(self):
        self.smooth("Basis", False)
        self.assert_keys("Basis", {"Wide", "Wider"})

    def test_the_basis_drags_its_relative_keys_in_edit_mode(self):
        self.smooth("Basis", True)
        # In Edit Mode it is Blender that drags; before 4.0 it dragged only the keys next to the active one.
        self.assert_keys("Basis", {"Wide", "Wider"} if bpy.app.version >= (4, 0) else {"Wide"})

    def test_another_key_leaves_the_basis_alone_in_object_mode(self):
        self.smooth("Apart", False)
        self.assert_keys("Apart", set())

    def test_another_key_leaves_the_basis_alone_in_edit_mode(self):
        self.smooth("Apart", True)
        self.assert_keys("Apart", set())

    def test_a_key_drags_those_relative_to_it(self):
        self.smooth("Wide", False)
        self.assert_keys("Wide", {"Wider"})

    def test_absolute_keys_are_not_dragged(self):
        self.obj.data.shape_keys.use_relative = False
        self.smooth("Basis", False)
        self.assert_keys("Basis", set())
