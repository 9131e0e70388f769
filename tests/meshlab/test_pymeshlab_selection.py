"""Only what is selected changes, in both filters."""
import unittest

import numpy

import meshes
from pymeshlab_host import IMPROVE, SMOOTH, Case, layer_of, select


class Smoothing(Case):
    def test_selected_vertices_alone_move(self):
        vertices, faces = meshes.grid()
        layer = layer_of(vertices, faces)
        select(layer, vertices='vi > 36 && vi < 44')
        self.assertTrue(layer.filter_parameter_values(SMOOTH)['selected'])
        values = layer.apply_filter(SMOOTH)
        inside = numpy.isin(numpy.arange(81), range(37, 44))
        self.assertBits(layer.current_mesh().vertex_matrix()[~inside], vertices[~inside])
        self.assertEqual(values['moved'], 7)
        self.assertEqual(values['kept_locked'], 74)

    def test_vertices_move_whose_faces_are_all_selected(self):
        vertices, faces = meshes.grid()
        layer = layer_of(vertices, faces)
        select(layer, faces='fi < 16 || (fi >= 64 && fi < 80)')
        layer.apply_filter(SMOOTH)
        chosen = numpy.isin(numpy.arange(128), [*range(16), *range(64, 80)])
        inside = ~numpy.isin(numpy.arange(81), faces[~chosen])
        after = layer.current_mesh().vertex_matrix()
        self.assertBits(after[~inside], vertices[~inside])
        inner = inside & (numpy.arange(81) >= 9) & (numpy.arange(81) % 9 > 0) & (numpy.arange(81) % 9 < 8)
        self.assertEqual(inner.sum(), 7)
        self.assertTrue((after[inner] != vertices[inner]).any(axis=1).all())

    def test_selection_is_ignored_on_request(self):
        layer = layer_of(*meshes.grid())
        select(layer, vertices='vi == 40')
        self.assertEqual(layer.apply_filter(SMOOTH, selected=False)['kept_locked'], 0)

    def test_nothing_selected_is_an_error(self):
        layer = layer_of(*meshes.grid())
        self.assertRefused('nothing is selected', layer, SMOOTH, selected=True)

    def test_too_few_faces_selected_are_an_error(self):
        layer = layer_of(*meshes.grid())
        select(layer, faces='fi == 40')
        self.assertRefused('no vertex has all its faces selected', layer, SMOOTH)


class Improvement(Case):
    """A sheet of bad triangles, those on the left selected."""

    def setUp(self):
        super().setUp()
        self.vertices, self.faces = meshes.squashed_grid()
        self.faces_inside = (self.vertices[self.faces][:, :, 0] < 4.5).all(axis=1)
        self.vertices_inside = ~numpy.isin(numpy.arange(len(self.vertices)), self.faces[~self.faces_inside])

    def improve(self, vertices='vi < 0', faces='fi < 0', **options):
        layer = layer_of(self.vertices, self.faces)
        mesh = layer.current_mesh()
        mesh.add_vertex_custom_scalar_attribute(numpy.arange(float(len(self.vertices))), 'number')
        select(layer, vertices, faces)
        values = layer.apply_filter(IMPROVE, iterations=0, **options)
        number = mesh.vertex_custom_scalar_attribute_array('number').astype(int)
        return values, number, mesh.vertex_matrix(), number[mesh.face_matrix()]

    def assert_only_inside_changed(self, inside, number, vertices, faces):
        kept = set(number)
        self.assertTrue(kept.issuperset(numpy.flatnonzero(~inside)))
        after = dict(zip(number, vertices))
        for vertex in numpy.flatnonzero(~inside):
            self.assertBits(after[vertex], self.vertices[vertex])
        outside = self.faces[~inside[self.faces].any(axis=1)]
        self.assertTrue(set(meshes.rotated(faces)).issuperset(meshes.rotated(outside)))

    def test_all_without_selection(self):
        values, number, _, _ = self.improve()
        self.assertLess(values['tails_after'], values['tails_before'])
        self.assertGreater(values['vertices_removed'], 0)

    def test_selected_faces(self):
        condition = ' || '.join(f'fi == {face}' for face in numpy.flatnonzero(self.faces_inside))
        for flips in (False, True):
            values, number, vertices, faces = self.improve(faces=condition, flips=flips)
            # All are bad, and those are counted that are selected.
            self.assertEqual(values['tails_before'], self.faces_inside.sum())
            self.assertGreater(values['tail_moved'] + values['removed'] + values['collapsed'] + values['flipped'], 0)
            self.assert_only_inside_changed(self.vertices_inside, number, vertices, faces)

    def test_selected_vertices(self):
        condition = ' || '.join(f'vi == {vertex}' for vertex in numpy.flatnonzero(self.vertices_inside))
        for flips in (False, True):
            values, number, vertices, faces = self.improve(vertices=condition, flips=flips)
            self.assertEqual(values['tails_before'], self.vertices_inside[self.faces].any(axis=1).sum())
            self.assertGreater(values['tail_moved'] + values['removed'] + values['collapsed'] + values['flipped'], 0)
            self.assert_only_inside_changed(self.vertices_inside, number, vertices, faces)

    def test_nothing_selected_is_an_error(self):
        self.assertRefused('nothing is selected', layer_of(self.vertices, self.faces), IMPROVE, selected=True)


if __name__ == '__main__':
    unittest.main()
