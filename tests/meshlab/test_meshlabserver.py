"""The filters in Debian's MeshLab 2020.09, in single precision."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy

import meshes
from meshlabserver_host import IMPROVE, SMOOTH, run


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def given(self, vertices, faces):
        path = self.folder / 'in.ply'
        meshes.write_ply(path, vertices, faces, 'f')
        return path

    def apply(self, mesh, *filters):
        """The vertices and faces that come out, and the log."""
        status, log, out = run(self.folder, mesh, *filters)
        self.assertEqual(status, 0, log)
        return (*meshes.read_ply(out), log)

    def assertFails(self, message, mesh, *filters):
        status, log, out = run(self.folder, mesh, *filters)
        # A crash would be a negative status, or 134 and 139 by way of a shell.
        self.assertEqual(status, 255, log)
        self.assertIn(message, log)
        self.assertFalse(out.exists())

    def assertBits(self, left, right):
        self.assertEqual((left.dtype, left.shape), (right.dtype, right.shape))
        self.assertEqual(left.tobytes(), right.tobytes())


class Command(Case):
    """The same bits as from the command, on the horse if it is there, else on the command's demonstration."""

    def compare(self, verb, name, options, arguments):
        model, out = self.folder / 'model.ply', self.folder / 'command.ply'
        meshes.write_ply(model, *meshes.read_ply(pathlib.Path(os.environ['QSMESH_MODEL'])), 'f')
        call = [os.environ['QSMESH_COMMAND'], verb, str(model), '-o', str(out), '--json', '--quiet', *arguments]
        told = json.loads(subprocess.run(call, check=True, stdout=subprocess.PIPE).stdout)
        vertices, faces, log = self.apply(model, (name, options))
        expected = meshes.read_ply(out)
        self.assertBits(vertices, expected[0])
        self.assertEqual(meshes.rotated(faces), meshes.rotated(expected[1]))
        self.assertGreater(told['moved'], 10000)
        self.assertIn(f'Moved {told["moved"]} of ', log)
        # This host shows of the progress its text alone.
        self.assertGreater(log.count(f'{name}...'), 3)
        before, after = meshes.volume(*meshes.read_ply(model)), meshes.volume(vertices, faces)
        self.assertLess(abs(after / before - 1), 1e-6)
        return log

    def test_smoothing(self):
        self.compare('smooth', SMOOTH, {}, [])

    def test_improvement(self):
        log = self.compare('improve', IMPROVE, {'tail_min_angle': 30.0, 'tail_max_angle': 115.0, 'relaxation': 1.6},
                           ['--tail-min-angle', '30', '--tail-max-angle', '115', '--relaxation', '1.6'])
        self.assertRegex(log, r'Tail: \d+ triangles, \d+ left; 9\d\.\d+ % of the triangles')


class Log(Case):
    def test_table(self):
        _, _, log = self.apply(self.given(*meshes.grid(80)), (SMOOTH, {}))
        self.assertRegex(log, r'edge ratio, mean: [\d.]+ -> [\d.]+')
        self.assertRegex(log, r'smallest angle \(degrees\): [\d.]+ -> [\d.]+')
        self.assertRegex(log, r'Kept in place: boundary 316')


class Layer(Case):
    def test_deleted_elements_count_for_nothing(self):
        vertices, faces = meshes.grid()
        kept = faces[(faces != 40).all(axis=1)]
        clean = numpy.delete(vertices, 40, axis=0), kept - (kept > 40)
        delete = [('Conditional Vertex Selection', {'condSelect': '(vi == 40)'}), ('Delete Selected Vertices', {})]
        for name, options in ((SMOOTH, {}), (IMPROVE, {'tail_min_angle': 35.0, 'flips': True})):
            with self.subTest(name):
                after = self.apply(self.given(vertices, faces), *delete, (name, options))
                expected = self.apply(self.given(*clean), (name, options))
                self.assertIn('of 80 vertices', after[2])
                self.assertBits(after[0], expected[0])
                self.assertEqual(meshes.rotated(after[1]), meshes.rotated(expected[1]))

    def test_only_the_selection_moves(self):
        vertices, faces = meshes.grid()
        select = ('Conditional Vertex Selection', {'condSelect': '(vi >= 30 && vi < 33)'})
        after, _, log = self.apply(self.given(vertices, faces), select, (SMOOTH, {'selected': True}))
        others = numpy.delete(numpy.arange(81), range(30, 33))
        self.assertBits(after[others], vertices[others].astype('<f4'))
        self.assertIn('Moved 3 of 81', log)

    def test_only_vertices_inside_selected_faces_move(self):
        vertices, faces = meshes.grid()
        select = ('Conditional Face Selection', {'condSelect': '(fi < 16 || (fi >= 64 && fi < 80))'})
        after, _, log = self.apply(self.given(vertices, faces), select, (SMOOTH, {'selected': True}))
        others = numpy.delete(numpy.arange(81), range(10, 17))
        self.assertBits(after[others], vertices[others].astype('<f4'))
        self.assertIn('Moved 7 of 81', log)


class Errors(Case):
    def test_an_error_is_told_and_nothing_written(self):
        broken = meshes.WART.copy()
        broken[3, 1] = numpy.nan
        grid = meshes.grid(4)
        for name in (SMOOTH, IMPROVE):
            for message, mesh, options in (
                    ('vertex 3 has a coordinate that is not finite', (broken, meshes.WART_FACES), {}),
                    ('nothing is selected', grid, {'selected': True}),
                    ('iterations is -1, not in 0 to 10000', grid, {'iterations': -1}),
                    ('relaxation', grid, {'relaxation': 2.5}),
                    ('there are no triangles to improve', (meshes.WART, meshes.WART_FACES[:0]), {})):
                with self.subTest(name, message=message):
                    self.assertFails(message, self.given(*mesh), (name, options))


if __name__ == '__main__':
    unittest.main()
