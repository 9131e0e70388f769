"""Quasi-statistical improvement through PyMeshLab: what goes, and what everything that stays carries along."""
import unittest

import numpy

import meshes
from pymeshlab_host import IMPROVE, Case, layer_from, layer_of, layer_value, select

# With these the wart's vertex is removed, and nothing else happens.
REMOVE = {'tail_max_angle': 110.0}


class Wart(Case):
    def test_its_vertex_is_removed_and_the_octahedron_left(self):
        layer = layer_of(meshes.WART, meshes.WART_FACES)
        values = layer.apply_filter(IMPROVE, **REMOVE)
        mesh = layer.current_mesh()
        self.assertEqual((values['removed'], values['vertices_removed'], values['triangles_removed']), (1, 1, 2))
        self.assertEqual((values['tails_before'], values['tails_after']), (3, 0))
        self.assertEqual((mesh.vertex_number(), mesh.face_number(), mesh.is_compact()), (6, 8, True))
        self.assertBits(mesh.vertex_matrix(), meshes.WART[1:])
        self.assertAlmostEqual(meshes.volume(mesh.vertex_matrix(), mesh.face_matrix()), 4 / 3)
        self.assertEqual(values['min_angle_after'], values['max_angle_after'])

    def test_vertices_and_faces_carry_what_they_had(self):
        layer = layer_of(meshes.WART, meshes.WART_FACES, v_color_matrix=shades(7))
        mesh = layer.current_mesh()
        layer.apply_filter('compute_scalar_by_function_per_vertex', q='vi')
        layer.apply_filter('compute_scalar_by_function_per_face', q='fi')
        layer.apply_filter('compute_color_by_function_per_face', r='20*fi', g='0', b='255-20*fi')
        mesh.add_vertex_custom_scalar_attribute(numpy.arange(7.0), 'number')
        mesh.add_face_custom_scalar_attribute(numpy.arange(10.0), 'number')
        colours, face_colours = mesh.vertex_color_matrix(), mesh.face_color_matrix()
        select(layer, vertices='vi == 2 || vi == 0', faces='fi == 3 || fi == 9')
        layer.apply_filter(IMPROVE, selected=False, keep_color_borders=False, **REMOVE)
        number = mesh.vertex_custom_scalar_attribute_array('number').astype(int)
        self.assertEqual(list(number), [1, 2, 3, 4, 5, 6])
        self.assertBits(mesh.vertex_scalar_array(), number.astype(float))
        self.assertBits(mesh.vertex_color_matrix(), colours[number])
        self.assertEqual(list(number[mesh.vertex_selection_array()]), [2])
        face = mesh.face_custom_scalar_attribute_array('number').astype(int)
        self.assertEqual(set(face) & set(range(3, 10)), set(range(3, 10)))
        self.assertBits(mesh.face_scalar_array(), face.astype(float))
        self.assertBits(mesh.face_color_matrix(), face_colours[face])
        self.assertEqual(sorted(face[mesh.face_selection_array()]), [3, 9])
        unchanged = [tuple(number[corners]) for corners in mesh.face_matrix()[face > 2]]
        self.assertEqual(unchanged, [tuple(meshes.WART_FACES[source]) for source in face[face > 2]])

    def test_other_filters_find_a_sound_layer(self):
        layer = layer_of(meshes.WART, meshes.WART_FACES)
        layer.apply_filter('get_topological_measures')
        layer.apply_filter(IMPROVE, **REMOVE)
        found = layer.apply_filter('get_topological_measures')
        self.assertEqual((found['vertices_number'], found['faces_number'], found['edges_number']), (6, 8, 12))
        self.assertEqual((found['boundary_edges'], found['genus'], found['non_two_manifold_edges']), (0, 0, 0))

    def test_leftovers_are_counted_and_selected(self):
        layer = layer_of(meshes.WART, meshes.WART_FACES)
        values = layer.apply_filter(IMPROVE, iterations=0, tail_operations=0, tail_min_angle=59.9, tail_max_angle=60.1,
                                    max_deviation=layer_value(0.0), select_leftovers=True)
        reasons = sum(values[name] for name in values if name.startswith('left_'))
        self.assertEqual(reasons, values['tails_after'])
        self.assertEqual(layer.current_mesh().selected_face_number(), values['tails_after'])

    def test_polyline_vertices_stay(self):
        layer = layer_of(meshes.WART, meshes.WART_FACES, edge_matrix=numpy.array([[0, 1]]))
        values = layer.apply_filter(IMPROVE, **REMOVE)
        self.assertEqual((values['kept_locked'], values['vertices_removed']), (2, 0))
        self.assertEqual(layer.current_mesh().edge_number(), 1)


class Sheet(Case):
    """A flat sheet with bad triangles, textured: u tells the vertex, v the chart."""

    def setUp(self):
        super().setUp()
        self.vertices, self.faces = meshes.squashed_grid()

    def improve(self, chart, **options):
        """Gives some faces their own chart, runs the filter; returns figures, faces, seams before and after."""
        where = numpy.isin(numpy.arange(len(self.faces)), chart).repeat(3)
        texture = numpy.stack([self.faces.ravel() / 128, where], axis=1)
        meshes.write_obj(self.folder / 'in.obj', self.vertices, self.faces, texture)
        layer = layer_from(self.folder / 'in.obj')
        mesh = layer.current_mesh()
        mesh.add_vertex_custom_scalar_attribute(numpy.arange(float(len(self.vertices))), 'number')
        mesh.add_face_custom_scalar_attribute(numpy.arange(float(len(self.faces))), 'number')
        layer.apply_filter('compute_scalar_by_function_per_face', q='fi')
        values = layer.apply_filter(IMPROVE, **options)
        after = mesh.vertex_custom_scalar_attribute_array('number').astype(int)[mesh.face_matrix()]
        wedges = mesh.wedge_tex_coord_matrix().reshape(-1, 3, 2)
        self.assertGreater(values['collapsed'] + values['removed'] + values['flipped'], 0)
        # Every wedge still has the coordinates of its vertex.
        self.assertBits(wedges[:, :, 0] * 128, after.astype(float))
        # Every face has all that its source had.
        self.source = mesh.face_custom_scalar_attribute_array('number')
        self.assertBits(mesh.face_scalar_array(), self.source)
        return values, after, seam(self.faces, where.reshape(-1, 3)), seam(after, wedges[:, :, 1])

    def test_charts_side_by_side_keep_their_seam(self):
        left = numpy.flatnonzero(numpy.arange(128) % 64 % 8 < 4)
        _, _, before, after = self.improve(left)
        self.assertEqual(len(before), 8)
        self.assertEqual(after, before)
        # Here some faces share a source.
        self.assertLess(len(set(self.source)), len(self.source))

    def test_a_triangle_that_would_go_stays_where_it_is_a_chart(self):
        _, after, _, _ = self.improve([])
        gone = set(meshes.rotated(self.faces)) - set(meshes.rotated(after))
        inner = [face for face, corners in enumerate(self.faces)
                 if meshes.rotated([corners])[0] in gone and self.is_inside(corners)]
        chart = inner[:1]
        _, _, before, after = self.improve(chart)
        self.assertEqual(len(before), 3)
        self.assertEqual(after, before)
        _, _, before, after = self.improve(chart, keep_seams=False)
        self.assertNotEqual(after, before)

    def is_inside(self, corners):
        return (numpy.isin(corners // 9, range(1, 8)) & numpy.isin(corners % 9, range(1, 8))).all()

    def test_general_flips_on_request(self):
        self.assertGreater(self.improve([], flips=True)[0]['general_flips'], 0)
        self.assertEqual(self.improve([])[0]['general_flips'], 0)


def seam(faces, charts):
    """Edges along which the charts of the corners, as many as in faces, part."""
    sides = {}
    for corners, where in zip(faces, charts):
        for k in range(3):
            ends = sorted([(int(corners[k]), where[k]), (int(corners[k - 1]), where[k - 1])])
            sides.setdefault((ends[0][0], ends[1][0]), set()).add((ends[0][1], ends[1][1]))
    return {edge for edge, values in sides.items() if len(values) > 1}


def shades(count):
    """Colours that 8 bits hold exactly."""
    return numpy.stack([numpy.arange(count) / 255, numpy.zeros(count), numpy.ones(count), numpy.ones(count)], axis=1)


if __name__ == '__main__':
    unittest.main()
