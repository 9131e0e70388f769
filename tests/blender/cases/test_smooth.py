"""Quasi-statistical Smooth in Object Mode, and what it leaves alone."""

import bpy
import numpy

from situation import Situation, add, ball, coordinates, grid, part, split


class Smooth(Situation):
    def test_triangles_get_better_and_the_volume_stays(self):
        positions, triangles = ball()
        obj = add(positions, triangles)
        before = part("library").measure(positions, triangles.astype(numpy.uint32))
        self.assertEqual(bpy.ops.mesh.qsmesh_smooth(), {"FINISHED"})
        after = part("library").measure(coordinates(obj), triangles.astype(numpy.uint32))
        self.assertLess(after.edge_ratio.mean, 0.9 * before.edge_ratio.mean)
        self.assertLess(abs(after.volume / before.volume - 1), 1e-7)

    def test_quads_stay_quads_and_only_coordinates_change(self):
        positions, quads, border = grid()
        obj = add(positions, quads)
        bpy.ops.mesh.qsmesh_smooth()
        self.assertEqual([tuple(polygon.vertices) for polygon in obj.data.polygons], [tuple(quad) for quad in quads])
        self.assert_same_bits(coordinates(obj)[border], positions[border])
        self.assert_some_moved(coordinates(obj), positions)
        self.assertEqual(numpy.abs(coordinates(obj)[:, 2]).max(), 0)

    def test_faces_of_any_size_are_treated_as_blender_draws_them(self):
        positions, quads, _ = grid()
        mixed = [list(quad) for quad in quads[2:]] + [[0, 1, 2, 11, 10, 9]]
        obj = add(positions, quads[:1])
        obj.data.clear_geometry()
        obj.data.from_pydata(positions.tolist(), [], mixed)
        obj.data.calc_loop_triangles()
        drawn = numpy.array([tuple(triangle.vertices) for triangle in obj.data.loop_triangles], dtype=numpy.uint32)
        expected = positions.copy()
        part("library").smooth(expected, drawn, part("library").default_options())
        bpy.ops.mesh.qsmesh_smooth()
        self.assert_some_moved(expected, positions)
        self.assert_same_bits(coordinates(obj), expected)

    def test_boundary_slides_on_request(self):
        positions, quads, _ = grid()
        obj = add(positions, split(quads))
        positions = coordinates(obj)
        positions[1, 0] += 0.1
        obj.data.vertices.foreach_set("co", positions.ravel())
        bpy.ops.mesh.qsmesh_smooth(boundary="SLIDE")
        edge = positions[:, 1] == -1
        self.assert_some_moved(coordinates(obj)[edge], positions[edge])
        self.assert_same_bits(coordinates(obj)[edge, 1], positions[edge, 1])
        corners = (numpy.abs(positions[:, :2]) == 1).all(axis=1)
        self.assert_same_bits(coordinates(obj)[corners], positions[corners])

    def test_hidden_vertices_never_move(self):
        positions, triangles = ball()
        obj = add(positions, triangles)
        hidden = positions[:, 0] > 0
        obj.data.vertices.foreach_set("hide", hidden)
        bpy.ops.mesh.qsmesh_smooth()
        self.assert_same_bits(coordinates(obj)[hidden], positions[hidden])
        self.assert_some_moved(coordinates(obj)[~hidden], positions[~hidden])

    def test_limit_of_deviation_is_a_distance_in_the_scene(self):
        positions, triangles = ball()
        obj = add(positions, triangles)
        obj.scale = (10, 10, 10)
        bpy.context.view_layer.update()
        options = part("library").default_options()
        options.max_deviation = 0.002
        expected = positions.copy()
        report = part("library").smooth(expected, triangles.astype(numpy.uint32), options)
        self.assertGreater(report.kept.deviation + report.moves_halved, 0, "the limit bounds nothing")
        bpy.ops.mesh.qsmesh_smooth(use_max_deviation=True, max_deviation=0.02)
        self.assertLess(numpy.abs(coordinates(obj) - expected).max(), 1e-6)
