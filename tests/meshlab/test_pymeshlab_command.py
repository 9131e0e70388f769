"""A filter and the command make the same bits out of the same mesh with the same options."""
import json
import os
import pathlib
import unittest

import numpy

import meshes
from pymeshlab_host import IMPROVE, SMOOTH, Case, command, layer_from, layer_value

SAME = {
    SMOOTH: [
        ({}, []),
        ({'iterations': 3, 'relaxation': 1.7, 'features': False, 'order': 'index'},
         ['--iterations', '3', '--relaxation', '1.7', '--feature-angle', 'off', '--order', 'index']),
        ({'plane': 'least squares', 'ideal': 'equilateral', 'boundary': 'slide', 'feature_angle': 41.3, 'threads': 1},
         ['--plane', 'least-squares', '--ideal', 'equilateral', '--boundary', 'slide', '--feature-angle', '41.3',
          '--threads', '1']),
        ({'max_deviation': layer_value(0.0001), 'quality_floor': 0.3, 'interval_width': 0.7, 'sample_limit': 2.3},
         ['--max-deviation', '0.0001', '--quality-floor', '0.3', '--interval-width', '0.7', '--sample-limit', '2.3']),
    ],
    IMPROVE: [
        ({}, []),
        ({'tail_min_angle': 30.0, 'tail_max_angle': 115.5, 'tail_edge_ratio': 2.6, 'tail_attempts': 2, 'flips': True,
          'features': False},
         ['--tail-min-angle', '30', '--tail-max-angle', '115.5', '--tail-edge-ratio', '2.6', '--tail-attempts', '2',
          '--flips', '--feature-angle', 'off']),
    ],
}


class Command(Case):
    """On the horse if it is there, else on the mesh that the command makes for its demonstration."""

    def setUp(self):
        super().setUp()
        given = pathlib.Path(os.environ['QSMESH_MODEL'])
        vertices, faces = meshes.read_ply(given)
        self.model = self.folder / 'in.ply'
        meshes.write_ply(self.model, vertices, faces, 'd')

    def compare(self, name, options, arguments):
        out = self.folder / 'out.ply'
        verb = 'smooth' if name == SMOOTH else 'improve'
        told = json.loads(command(verb, self.model, '-o', out, '--json', '--quiet', *arguments))
        vertices, faces = meshes.read_ply(out)
        layer = layer_from(self.model)
        values = layer.apply_filter(name, **options)
        mesh = layer.current_mesh()
        self.assertGreater(values['moved'], 10000)
        self.assertBits(mesh.vertex_matrix(), vertices.astype(float))
        self.assertEqual(meshes.rotated(mesh.face_matrix()), meshes.rotated(faces))
        self.assertEqual(values['moved'], told['moved'])
        self.assertEqual(values['edge_ratio_mean_after'], told['after']['edge_ratio']['mean'])
        self.assertEqual(values['volume_relative_change'], told['volume_relative_change'])
        self.assertEqual(values['max_deviation'], told['max_deviation'])
        self.assertLess(abs(values['volume_relative_change']), 1e-13)
        return values, told

    def test_smoothing(self):
        for options, arguments in SAME[SMOOTH]:
            with self.subTest(options=options):
                self.compare(SMOOTH, options, arguments)

    def test_improvement(self):
        for options, arguments in SAME[IMPROVE]:
            with self.subTest(options=options):
                values, told = self.compare(IMPROVE, options, arguments)
                self.assertGreater(values['tails_before'], values['tails_after'])
                for figure in ('tails_before', 'tails_after', 'collapsed', 'removed', 'flipped', 'general_flips'):
                    self.assertEqual(values[figure], told['tail'][figure])


if __name__ == '__main__':
    unittest.main()
