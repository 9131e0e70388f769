"""Quasi-statistical smoothing through PyMeshLab: what moves, what stays, what comes back."""
import unittest

import numpy

import meshes
from pymeshlab_host import SMOOTH, Case, layer_from, layer_of


class Figures(Case):
    def test_output_values_are_numbers_that_tell_what_was_done(self):
        values = layer_of(*meshes.grid()).apply_filter(SMOOTH)
        self.assertTrue(all(isinstance(value, (int, float)) for value in values.values()))
        self.assertEqual(values['vertices_after'], 81)
        self.assertEqual(values['kept_boundary'], 32)
        self.assertEqual(values['moved'] + sum(values[name] for name in values if name.startswith('kept_')), 81)
        self.assertLess(values['edge_ratio_mean_after'], values['edge_ratio_mean_before'])
        self.assertLess(values['edge_ratio_variance_after'], values['edge_ratio_variance_before'])
        self.assertGreater(values['min_angle_after'], values['min_angle_before'])
        self.assertGreater(values['seconds'], 0)

    def test_figures_before_and_after_are_measured(self):
        right_angle = numpy.array([[0, 0, 0], [4, 0, 0], [0, 3, 0]], float), numpy.array([[0, 1, 2]])
        values = layer_of(*right_angle).apply_filter(SMOOTH)
        for when in ('before', 'after'):
            self.assertAlmostEqual(values[f'edge_ratio_max_{when}'], 5 / 3)
            self.assertAlmostEqual(values[f'max_angle_{when}'], 90)
        self.assertEqual((values['moved'], values['kept_boundary']), (0, 3))

    def test_quality_of_each_face_is_its_shape(self):
        layer = layer_of(*meshes.grid())
        values = layer.apply_filter(SMOOTH, face_quality=True)
        mesh = layer.current_mesh()
        quality = mesh.face_scalar_array()
        a, b, c = mesh.vertex_matrix()[mesh.face_matrix()].transpose(1, 0, 2)
        area = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1) / 2
        squares = sum((side ** 2).sum(axis=1) for side in (a - b, b - c, c - a))
        numpy.testing.assert_allclose(quality, 4 * numpy.sqrt(3) * area / squares)
        self.assertAlmostEqual(quality.mean(), values['shape_mean_after'])
        layer.apply_filter('compute_color_from_scalar_per_face')
        self.assertGreater(len(numpy.unique(mesh.face_color_matrix(), axis=0)), 50)

    def test_no_quality_is_written_unasked(self):
        layer = layer_of(*meshes.grid())
        layer.apply_filter(SMOOTH)
        self.assertFalse(layer.current_mesh().has_face_scalar())


class Layer(Case):
    def test_connectivity_and_attributes_stay(self):
        vertices, faces = meshes.grid()
        colours = numpy.linspace(0, 1, 4 * len(vertices)).round(1).reshape(-1, 4)
        layer = layer_of(vertices, faces, v_color_matrix=colours)
        layer.apply_filter('compute_scalar_by_function_per_vertex', q='vi')
        mesh = layer.current_mesh()
        before = mesh.vertex_color_matrix()
        layer.apply_filter(SMOOTH)
        self.assertBits(mesh.face_matrix(), faces.astype('i4'))
        self.assertBits(mesh.vertex_color_matrix(), before)
        self.assertBits(mesh.vertex_scalar_array(), numpy.arange(81.0))
        self.assertFalse(numpy.array_equal(mesh.vertex_matrix(), vertices))

    def test_texture_coordinates_of_wedges_stay(self):
        vertices, faces = meshes.grid()
        texture = numpy.arange(6.0 * len(faces)).reshape(-1, 2) / 512
        meshes.write_obj(self.folder / 'in.obj', vertices, faces, texture)
        layer = layer_from(self.folder / 'in.obj')
        self.assertGreater(layer.apply_filter(SMOOTH, keep_seams=False)['moved'], 0)
        self.assertBits(layer.current_mesh().wedge_tex_coord_matrix(), texture)

    def test_seams_are_features_if_wanted(self):
        vertices, faces = meshes.grid()
        left = (vertices[faces].mean(axis=1)[:, 0] < 4).repeat(3)
        texture = numpy.stack([left, left], axis=1).astype(float)
        meshes.write_obj(self.folder / 'in.obj', vertices, faces, texture)
        seam = layer_from(self.folder / 'in.obj').apply_filter(SMOOTH)
        self.assertGreaterEqual(seam['feature_edges'], 8)
        self.assertEqual(layer_from(self.folder / 'in.obj').apply_filter(SMOOTH, keep_seams=False)['feature_edges'], 0)

    def test_a_seam_may_begin_at_either_end_of_an_edge(self):
        vertices, faces = meshes.grid(2)
        whole = vertices[faces.ravel()][:, :2]
        for corner in range(6):
            texture = whole.copy()
            texture[corner] += 0.5
            meshes.write_obj(self.folder / 'in.obj', vertices, faces, texture)
            values = layer_from(self.folder / 'in.obj').apply_filter(SMOOTH)
            self.assertEqual(values['feature_edges'], 1 if faces.ravel()[corner] in (0, 3) else 0)

    def test_borders_of_face_colours_are_features_where_colours_are_few(self):
        vertices, faces = meshes.grid()
        left = vertices[faces].mean(axis=1)[:, 0] < 4
        few = numpy.where(left[:, None], [[1, 0, 0, 1]], [[0, 0, 1, 1]]).astype(float)
        many = numpy.stack([numpy.arange(len(faces)) / 127] * 3 + [numpy.ones(len(faces))], axis=1)
        self.assertGreaterEqual(layer_of(vertices, faces, f_color_matrix=few).apply_filter(SMOOTH)['feature_edges'], 8)
        self.assertEqual(layer_of(vertices, faces, f_color_matrix=many).apply_filter(SMOOTH)['feature_edges'], 0)
        forced = layer_of(vertices, faces, f_color_matrix=many).apply_filter(SMOOTH, keep_color_borders=True)
        self.assertEqual(forced['feature_edges'], 3 * 128 // 2 - 16)

    def test_normals_and_box_follow(self):
        vertices, faces = meshes.WART * [1, 1, 1], meshes.WART_FACES
        layer = layer_of(vertices, faces)
        layer.apply_filter(SMOOTH, features=False, iterations=3)
        moved = layer.current_mesh()
        fresh = layer_of(moved.vertex_matrix(), faces)
        fresh.apply_filter('compute_normal_per_face')
        numpy.testing.assert_allclose(normalized(moved.face_normal_matrix()), normalized(
            fresh.current_mesh().face_normal_matrix()), atol=1e-12)
        self.assertBits(moved.bounding_box().max(), moved.vertex_matrix().max(axis=0))
        self.assertFalse(numpy.array_equal(moved.vertex_matrix(), vertices))


def normalized(normals):
    return normals / numpy.linalg.norm(normals, axis=1)[:, None]


if __name__ == '__main__':
    unittest.main()
