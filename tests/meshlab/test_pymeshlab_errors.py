"""Bad input gets an error that a script can catch, and the layer stays as it was."""
import unittest

import numpy

import meshes
from pymeshlab_host import IMPROVE, SMOOTH, Case, layer_of, select

BOTH = (SMOOTH, IMPROVE)


class Layers(Case):
    def test_a_vertex_that_is_not_finite_is_named(self):
        for bad in (numpy.nan, numpy.inf):
            vertices = meshes.WART.copy()
            vertices[3, 1] = bad
            for name in BOTH:
                layer = layer_of(vertices, meshes.WART_FACES)
                self.assertRefused('vertex 3 has a coordinate that is not finite', layer, name)

    def test_a_point_cloud(self):
        for name in BOTH:
            self.assertRefused('does not have Any Faces', layer_of(meshes.WART), name)

    def test_an_empty_layer(self):
        for name in BOTH:
            layer = layer_of(meshes.WART)
            select(layer, vertices='vi >= 0')
            layer.apply_filter('meshing_remove_selected_vertices')
            layer.current_mesh().compact()
            self.assertRefused('does not have Any Faces', layer, name)

    def test_polygons_cannot_be_improved_but_smoothed(self):
        square = numpy.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
        layer = layer_of(square, face_list_of_indices=[numpy.array([0, 1, 2, 3])])
        self.assertRefused('Turn into a Pure-Triangular mesh', layer, IMPROVE)
        layer.apply_filter(SMOOTH)
        self.assertEqual(len(layer.current_mesh().polygonal_face_list()), 1)

    def test_bad_elements_are_left_alone(self):
        vertices, faces = meshes.grid(4)
        vertices = numpy.vstack([vertices, [[7, 7, 7]]])
        faces = numpy.vstack([faces, [[0, 0, 1], faces[0]]])
        for name in BOTH:
            values = layer_of(vertices, faces).apply_filter(name)
            self.assertEqual(values['kept_unreferenced'], 1)
            self.assertGreater(values['kept_non_manifold'], 0)


class Options(Case):
    BAD = {
        'relaxation': (3.0, 'relaxation'),
        'iterations': (-1, 'iterations is -1, not in 0 to 10000'),
        'threads': (-2, 'threads is -2, not in 0 to 1024'),
        'feature_angle': (0.0, 'switch off Keep features'),
        'quality_floor': (1.5, 'quality_floor'),
        'interval_width': (0.0, 'interval_width'),
        'sample_limit': (0.5, 'sample_limit'),
    }
    BAD_TAIL = {
        'tail_edge_ratio': (1.0, 'edge_ratio'),
        'tail_min_angle': (60.0, 'min_angle'),
        'tail_max_angle': (60.0, 'max_angle'),
        'tail_attempts': (0, 'attempts'),
        'tail_operations': (-1, 'tail_operations is -1, not at least 0'),
    }

    def test_a_value_out_of_range_is_named(self):
        for name, bad in ((SMOOTH, self.BAD), (IMPROVE, {**self.BAD, **self.BAD_TAIL})):
            for option, (value, message) in bad.items():
                with self.subTest(filter=name, option=option):
                    self.assertRefused(message, layer_of(*meshes.grid(4)), name, **{option: value})

    def test_an_unknown_choice_is_refused_by_the_host(self):
        for option in ('plane', 'ideal', 'boundary', 'order'):
            with self.assertRaises(Exception):
                layer_of(*meshes.grid(4)).apply_filter(SMOOTH, **{option: 'nonsense'})

    def test_smoothing_has_no_options_of_the_tail(self):
        names = layer_of(*meshes.grid(4)).filter_parameter_values(SMOOTH)
        self.assertEqual([name for name in names if 'tail' in name or name in ('flips', 'select_leftovers')], [])


if __name__ == '__main__':
    unittest.main()
