"""Marked edges are kept: vertices on the line between two halves of a flat square stay on it, each mark by itself."""

import bmesh
import bpy
import numpy

from situation import Situation, add, coordinates, edit_and_back, grid, split

LINE = "keep_sharp keep_seams keep_creases keep_materials keep_uv_borders".split()


class Features(Situation):
    def setUp(self):
        super().setUp()
        self.positions, quads, border = grid()
        straight = numpy.arange(81) % 9 == 4
        self.positions[straight, 0] = 0
        self.line = straight & ~border
        self.obj = add(self.positions, split(quads))
        self.triangles = split(quads)
        self.left = self.positions[self.triangles][:, :, 0].mean(axis=1) < 0

    def assert_kept_by(self, option):
        """With the option the line stays straight, in both modes; without it, it does not."""
        others = {name: False for name in LINE}
        for mode in (bpy.ops.mesh.qsmesh_smooth, self._in_edit_mode):
            self._reset()
            mode(**{**others, option: True})
            self.assert_some_moved(coordinates(self.obj)[self.line], self.positions[self.line])
            self.assertEqual(numpy.abs(coordinates(self.obj)[self.line, 0]).max(), 0)
            self._reset()
            mode(**others)
            self.assertGreater(numpy.abs(coordinates(self.obj)[self.line, 0]).max(), 1e-3)

    def _in_edit_mode(self, **options):
        edit_and_back(bpy.ops.mesh.qsmesh_smooth, selected_only=False, **options)

    def _reset(self):
        self.obj.data.vertices.foreach_set("co", self.positions.ravel())

    def _line_edges(self):
        ends = [(edge, [self.positions[vertex, 0] for vertex in edge.vertices]) for edge in self.obj.data.edges]
        return [edge for edge, (first, second) in ends if first == second == 0]

    def test_sharp_edges(self):
        for edge in self._line_edges():
            edge.use_edge_sharp = True
        self.assert_kept_by("keep_sharp")

    def test_seams(self):
        for edge in self._line_edges():
            edge.use_seam = True
        self.assert_kept_by("keep_seams")

    def test_creases(self):
        numbers = [edge.index for edge in self._line_edges()]
        edited = bmesh.new()
        edited.from_mesh(self.obj.data)
        old = getattr(edited.edges.layers, "crease", None)
        layer = old.verify() if old is not None else edited.edges.layers.float.new("crease_edge")
        edited.edges.ensure_lookup_table()
        for number in numbers:
            edited.edges[number][layer] = 0.5
        edited.to_mesh(self.obj.data)
        edited.free()
        self.assert_kept_by("keep_creases")

    def test_borders_of_materials(self):
        for name in ("one", "two"):
            self.obj.data.materials.append(bpy.data.materials.new(name))
        self.obj.data.polygons.foreach_set("material_index", self.left.astype(numpy.int32))
        self.assert_kept_by("keep_materials")

    def test_borders_of_uv_maps(self):
        layer = self.obj.data.uv_layers.new(name="Map")
        for corner, vertex in enumerate(self.triangles.ravel()):
            layer.data[corner].uv = self.positions[vertex, :2] + (5 * self.left[corner // 3], 0)
        self.assert_kept_by("keep_uv_borders")

    def test_sharp_angles(self):
        folded = self.positions.copy()
        folded[:, 2] = numpy.abs(folded[:, 0])
        self.positions = folded
        for used in (True, False):
            self._reset()
            bpy.ops.mesh.qsmesh_smooth(use_features=used, quality_floor=0)
            largest = numpy.abs(coordinates(self.obj)[self.line, 0]).max()
            self.assertEqual(largest == 0, used)
        self._reset()
        bpy.ops.mesh.qsmesh_smooth(feature_angle=numpy.radians(100), quality_floor=0)
        self.assertGreater(numpy.abs(coordinates(self.obj)[self.line, 0]).max(), 0)
