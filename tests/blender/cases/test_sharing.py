"""Meshes that several objects share, that another file owns, and objects with scale that is not applied."""

import os
import tempfile

import bpy
import numpy

from situation import Situation, add, ball, coordinates, part, place, select


class Sharing(Situation):
    def setUp(self):
        super().setUp()
        self.positions, self.triangles = ball()

    def smoothed(self, positions):
        after = positions.copy()
        part("library").smooth(after, self.triangles.astype(numpy.uint32), part("library").default_options())
        return after

    def test_a_shared_mesh_is_smoothed_once(self):
        obj = add(self.positions, self.triangles)
        twin = place(bpy.data.objects.new("twin", obj.data))
        select(obj, twin)
        bpy.ops.mesh.qsmesh_smooth()
        self.assertEqual(obj.data, twin.data)
        self.assert_same_bits(coordinates(obj), self.smoothed(self.positions))

    def test_a_linked_mesh_is_refused_and_stays(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "other.blend")
            obj = add(self.positions, self.triangles, "linked")
            bpy.data.libraries.write(path, {obj.data})
            bpy.data.objects.remove(obj)
            bpy.data.meshes.remove(bpy.data.meshes["linked"])
            with bpy.data.libraries.load(path, link=True) as (_, wanted):
                wanted.meshes = ["linked"]
            obj = place(bpy.data.objects.new("linked", bpy.data.meshes["linked"]))
            before = coordinates(obj)
            for operator in ("qsmesh_smooth", "qsmesh_improve", "qsmesh_write_quality"):
                self.assert_refused("linked from another file", getattr(bpy.ops.mesh, operator))
            self.assert_same_bits(coordinates(obj), before)
            bpy.data.libraries.remove(bpy.data.libraries[0])

    def test_the_rest_is_done_where_one_object_is_refused(self):
        obj = add(self.positions, self.triangles)
        broken = self.positions.copy()
        broken[7, 1] = numpy.nan
        other = add(self.positions, self.triangles, "other")
        other.data.vertices.foreach_set("co", broken.ravel())
        select(other, obj)
        self.assertEqual(bpy.ops.mesh.qsmesh_smooth(), {"FINISHED"})
        self.assert_same_bits(coordinates(obj), self.smoothed(self.positions))


class Scale(Situation):
    def setUp(self):
        super().setUp()
        self.positions, self.triangles = ball()

    def test_triangles_are_judged_as_they_stand_in_the_scene(self):
        scale = numpy.array([1, 1, 4])
        flat = (self.positions / scale).astype(numpy.float32)
        obj = add(flat, self.triangles)
        obj.scale = scale.tolist()
        obj.rotation_euler = (0.3, 0.2, 0.1)
        bpy.context.view_layer.update()
        bpy.ops.mesh.qsmesh_smooth()
        expected = flat.astype(numpy.float64) * scale
        part("library").smooth(expected, self.triangles.astype(numpy.uint32), part("library").default_options())
        self.assertLess(numpy.abs(coordinates(obj) * scale - expected).max(), 1e-5)
        unscaled = flat.copy()
        part("library").smooth(unscaled, self.triangles.astype(numpy.uint32), part("library").default_options())
        self.assertGreater(numpy.abs(coordinates(obj) - unscaled).max(), 1e-3)

    def test_vertices_that_stay_keep_their_bits_under_uneven_scale(self):
        obj = add(self.positions, self.triangles)
        obj.scale = (1, 2, 3)
        hidden = self.positions[:, 0] > 0
        obj.data.vertices.foreach_set("hide", hidden)
        bpy.context.view_layer.update()
        bpy.ops.mesh.qsmesh_smooth()
        self.assert_same_bits(coordinates(obj)[hidden], self.positions[hidden])
        self.assert_some_moved(coordinates(obj), self.positions)

    def test_equal_scale_and_rotation_change_no_bit(self):
        plain, obj = add(self.positions, self.triangles), add(self.positions, self.triangles)
        obj.scale, obj.rotation_euler, obj.location = (-7, -7, -7), (1, 2, 3), (100, 0, 0)
        select(plain, obj)
        bpy.ops.mesh.qsmesh_smooth()
        self.assert_same_bits(coordinates(obj), coordinates(plain))

    def test_an_object_scaled_to_nothing_is_judged_by_its_own_shape(self):
        for scale in ((0, 1, 1), (0, 0, 0)):
            plain, obj = add(self.positions, self.triangles), add(self.positions, self.triangles)
            obj.scale = scale
            select(plain, obj)
            self.assertEqual(bpy.ops.mesh.qsmesh_smooth(), {"FINISHED"})
            self.assert_same_bits(coordinates(obj), coordinates(plain))
