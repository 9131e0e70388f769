"""Improve Triangles: what the mesh carries comes along."""

import bpy
import numpy

from situation import Situation, add, ball, choose, coordinates, edit_and_back, faces, grid, key_coordinates, part

# Triangles around the vertices that dented() adds have an angle of 120 degrees, which only their removal can mend.
CURE = {"tail_max_angle": numpy.radians(110)}


def dented():
    """A ball with a vertex of three flat triangles in the middle of some of its triangles."""
    positions, triangles = ball(2)
    inner = numpy.arange(0, len(triangles), 9)
    middles = positions[triangles[inner]].mean(axis=1)
    tips = len(positions) + numpy.arange(len(inner))
    a, b, c = triangles[inner].T
    fans = [numpy.stack(corners, axis=1) for corners in ((a, b, tips), (b, c, tips), (c, a, tips))]
    rest = numpy.delete(triangles, inner, axis=0)
    return numpy.concatenate([positions, middles]).astype(numpy.float32), numpy.concatenate([rest, *fans])


class Improve(Situation):
    def setUp(self):
        super().setUp()
        self.positions, self.triangles = dented()
        self.obj = add(self.positions, self.triangles)
        self.mesh = self.obj.data

    def expected(self, positions=None):
        """What the library makes of the mesh for the same options."""
        options = part("library").default_options()
        options.tail_max_angle = 110
        positions = self.positions if positions is None else positions
        return part("library").improve(positions, self.triangles.astype(numpy.uint32), options)

    def attribute(self, name, kind, domain, values):
        self.mesh.attributes.new(name, kind, domain).data.foreach_set("value", values)

    def read(self, name, count):
        found = numpy.empty(count, dtype=numpy.int32)
        self.mesh.attributes[name].data.foreach_get("value", found)
        return found

    def corner_data(self, layer, name, width):
        found = numpy.empty((len(self.mesh.loops), width), dtype=numpy.float32)
        layer.data.foreach_get(name, found.ravel())
        return found

    def test_the_mesh_is_the_library_s(self):
        expected = self.expected()
        self.assertLess(len(expected.positions), len(self.positions))
        self.assertEqual(bpy.ops.mesh.qsmesh_improve(**CURE), {"FINISHED"})
        self.assert_same_bits(coordinates(self.obj), expected.positions)
        self.assert_same_bits(faces(self.obj), expected.triangles)
        self.assertFalse(self.mesh.validate(verbose=True), "Blender finds the mesh at fault")

    def test_edit_mode_makes_the_same_mesh(self):
        expected = self.expected()
        self.assertEqual(edit_and_back(bpy.ops.mesh.qsmesh_improve, selected_only=False, **CURE), {"FINISHED"})
        self.assert_same_bits(coordinates(self.obj), expected.positions)
        self.assert_same_bits(faces(self.obj), expected.triangles)
        self.assertFalse(self.mesh.validate(verbose=True), "Blender finds the mesh at fault")

    def test_no_edge_is_left_behind(self):
        bpy.ops.mesh.qsmesh_improve(**CURE)
        self.assertEqual(2 * len(self.mesh.edges), 3 * len(self.mesh.polygons))
        self.assertEqual(len(self.mesh.vertices) - len(self.mesh.edges) + len(self.mesh.polygons), 2)

    def test_attributes_of_vertices_and_faces_come_along_in_both_modes(self):
        for call in (bpy.ops.mesh.qsmesh_improve, lambda **options: edit_and_back(
                bpy.ops.mesh.qsmesh_improve, selected_only=False, **options)):
            self.setUp()
            expected = self.expected()
            self.attribute("vertex", "INT", "POINT", numpy.arange(len(self.positions), dtype=numpy.int32))
            self.attribute("face", "INT", "FACE", numpy.arange(len(self.triangles), dtype=numpy.int32))
            call(**CURE)
            self.assert_same_bits(self.read("vertex", len(expected.positions)), expected.vertex_source)
            self.assert_same_bits(self.read("face", len(expected.triangles)), expected.triangle_source)

    def test_uv_colour_weight_and_material_come_along(self):
        left = self.positions[self.triangles][:, :, 0].mean(axis=1) < 0
        for name in ("one", "two"):
            self.mesh.materials.append(bpy.data.materials.new(name))
        self.mesh.polygons.foreach_set("material_index", left.astype(numpy.int32))
        at_corners = self.positions[self.triangles.ravel()]
        uv = at_corners[:, :2] + numpy.where(numpy.repeat(left, 3), 5, 0)[:, None]
        self.mesh.uv_layers.new(name="Map").data.foreach_set("uv", uv.astype(numpy.float32).ravel())
        colours = numpy.concatenate([at_corners, numpy.ones((len(at_corners), 1))], axis=1).astype(numpy.float32)
        layer = self.mesh.color_attributes.new("Colour", "FLOAT_COLOR", "CORNER")
        layer.data.foreach_set("color", colours.ravel())
        group = self.obj.vertex_groups.new(name="Group")
        for number in range(len(self.positions)):
            group.add([number], number / len(self.positions), "REPLACE")
        self.mesh.attributes.new("was", "INT", "POINT").data.foreach_set("value", range(len(self.positions)))

        bpy.ops.mesh.qsmesh_improve(**CURE)

        self.assertLess(len(self.mesh.vertices), len(self.positions))
        was = self.read("was", len(self.mesh.vertices))
        corner_was = self.positions[was[faces(self.obj).ravel()]]
        materials = numpy.array([polygon.material_index for polygon in self.mesh.polygons])
        self.assertEqual(set(materials), {0, 1})
        uv = corner_was[:, :2] + numpy.where(numpy.repeat(materials == 1, 3), 5, 0)[:, None]
        self.assert_same_bits(self.corner_data(self.mesh.uv_layers["Map"], "uv", 2), uv.astype(numpy.float32))
        colours = self.corner_data(self.mesh.color_attributes["Colour"], "color", 4)
        self.assert_same_bits(colours[:, :3], corner_was)
        weights = numpy.array([vertex.groups[0].weight for vertex in self.mesh.vertices], dtype=numpy.float32)
        self.assert_same_bits(weights, (was / len(self.positions)).astype(numpy.float32))

    def test_shape_keys_come_along_and_the_basis_drags_them(self):
        self.obj.shape_key_add(name="Basis")
        wide = (2 * self.positions + 1).astype(numpy.float32)
        self.obj.shape_key_add(name="Wide").data.foreach_set("co", wide.ravel())
        self.obj.active_shape_key_index = 0
        expected = self.expected()
        bpy.ops.mesh.qsmesh_improve(**CURE)
        was = expected.vertex_source
        self.assert_same_bits(key_coordinates(self.obj, "Basis"), expected.positions)
        self.assert_same_bits(coordinates(self.obj), expected.positions)
        step = expected.positions - self.positions[was]
        self.assertLess(numpy.abs(key_coordinates(self.obj, "Wide") - (wide[was] + step)).max(), 1e-6)

    def test_a_key_that_is_not_the_basis_is_improved_by_its_own_shape(self):
        for in_edit_mode in (False, True):
            self.setUp()
            self.obj.shape_key_add(name="Basis")
            wide = (self.positions * [1, 1, 2]).astype(numpy.float32)
            self.obj.shape_key_add(name="Wide").data.foreach_set("co", wide.ravel())
            self.obj.active_shape_key_index = 1
            expected = self.expected(wide)
            if in_edit_mode:
                edit_and_back(bpy.ops.mesh.qsmesh_improve, selected_only=False, **CURE)
            else:
                bpy.ops.mesh.qsmesh_improve(**CURE)
            self.assertLess(len(self.mesh.vertices), len(self.positions))
            self.assert_same_bits(key_coordinates(self.obj, "Wide"), expected.positions)
            self.assert_same_bits(key_coordinates(self.obj, "Basis"), self.positions[expected.vertex_source])

    def test_larger_faces_are_refused_with_the_reason(self):
        positions, quads, _ = grid()
        obj = add(positions, quads, "quads")
        self.assert_refused("'quads' has faces with more than three corners", bpy.ops.mesh.qsmesh_improve)
        bpy.ops.object.mode_set(mode="EDIT")
        self.assert_refused("'quads' has faces with more than three corners", bpy.ops.mesh.qsmesh_improve)
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assert_same_bits(coordinates(obj), positions)

    def test_only_selected_triangles_are_treated(self):
        right = self.positions[:, 0] > 0
        choose(self.obj, right)
        edit_and_back(bpy.ops.mesh.qsmesh_improve, **CURE)
        self.assertNotEqual(faces(self.obj).tolist(), self.triangles.tolist())
        rest = {tuple(place) for place in self.positions[~right].tolist()}
        self.assertLessEqual(rest, {tuple(place) for place in coordinates(self.obj).tolist()})

    def test_an_end_of_a_loose_edge_is_not_removed(self):
        tips = numpy.arange(len(self.positions))[-2:].tolist()
        self.mesh.edges.add(1)
        self.mesh.edges[-1].vertices = tips
        self.mesh.update()
        bpy.ops.mesh.qsmesh_improve(**CURE)
        self.assertLess(len(self.mesh.vertices), len(self.positions))
        loose = [edge for edge in self.mesh.edges if edge.is_loose]
        self.assertEqual(len(loose), 1)
        self.assert_same_bits(coordinates(self.obj)[list(loose[0].vertices)], self.positions[tips])

    def test_hidden_triangles_stay(self):
        left = self.positions[:, 0] <= 0
        choose(self.obj, left, "hide")
        bpy.ops.mesh.qsmesh_improve(**CURE)
        rest = {tuple(place) for place in self.positions[left].tolist()}
        self.assertLessEqual(rest, {tuple(place) for place in coordinates(self.obj).tolist()})
        self.assertLess(len(self.mesh.vertices), len(self.positions))

    def test_hidden_faces_are_not_taken_up_even_where_their_vertices_show(self):
        for hidden in (True, False):
            self.mesh.polygons.foreach_set("hide", numpy.full(len(self.triangles), hidden))
            bpy.ops.mesh.qsmesh_improve(iterations=0, **CURE)
            self.assertEqual(numpy.array_equal(coordinates(self.obj), self.positions), hidden)

    def test_marked_edges_stay_where_triangles_beside_them_change(self):
        self.attribute("was", "INT", "POINT", numpy.arange(len(self.positions), dtype=numpy.int32))
        sides = {}
        for polygon in self.mesh.polygons:
            for key in polygon.edge_keys:
                sides.setdefault(key, set()).add(polygon.center[0] < 0)
        line = {key for key, found in sides.items() if len(found) == 2}
        for edge in self.mesh.edges:
            marked = tuple(sorted(edge.vertices)) in line
            edge.use_edge_sharp, edge.use_seam = marked, marked
        expected = len(self.mesh.vertices)
        bpy.ops.mesh.qsmesh_improve(**CURE)
        self.assertLess(len(self.mesh.vertices), expected)
        was = self.read("was", len(self.mesh.vertices))
        for mark in ("use_edge_sharp", "use_seam"):
            found = {tuple(sorted(was[list(edge.vertices)])) for edge in self.mesh.edges if getattr(edge, mark)}
            self.assertEqual(found, line)
