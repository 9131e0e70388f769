"""Which vertices move: selection, hiding, vertex groups, several objects."""

import bpy
import numpy

from situation import Situation, add, ball, choose, coordinates, edit_and_back, grid, select


class Selection(Situation):
    def setUp(self):
        super().setUp()
        self.positions, triangles = ball()
        self.obj = add(self.positions, triangles)
        self.right = self.positions[:, 0] > 0.2

    def test_edit_mode_moves_selected_vertices_alone(self):
        choose(self.obj, self.right)
        self.assertEqual(edit_and_back(bpy.ops.mesh.qsmesh_smooth), {"FINISHED"})
        self.assert_some_moved(coordinates(self.obj)[self.right], self.positions[self.right])
        self.assert_same_bits(coordinates(self.obj)[~self.right], self.positions[~self.right])

    def test_edit_mode_moves_all_on_request(self):
        choose(self.obj, self.right)
        edit_and_back(bpy.ops.mesh.qsmesh_smooth, selected_only=False)
        self.assert_some_moved(coordinates(self.obj)[~self.right], self.positions[~self.right])

    def test_the_selection_does_not_count_in_object_mode(self):
        choose(self.obj, self.right)
        bpy.ops.mesh.qsmesh_smooth()
        self.assert_some_moved(coordinates(self.obj)[~self.right], self.positions[~self.right])

    def test_the_selection_stays(self):
        choose(self.obj, self.right)
        edit_and_back(bpy.ops.mesh.qsmesh_smooth)
        self.assertEqual([vertex.select for vertex in self.obj.data.vertices], self.right.tolist())

    def test_nothing_selected_is_a_warning_and_changes_nothing(self):
        choose(self.obj, numpy.zeros(len(self.positions), dtype=bool))
        for operator in (bpy.ops.mesh.qsmesh_smooth, bpy.ops.mesh.qsmesh_improve):
            self.assertEqual(edit_and_back(operator), {"CANCELLED"})
        self.assert_same_bits(coordinates(self.obj), self.positions)

    def test_hidden_vertices_never_move_in_edit_mode(self):
        choose(self.obj, numpy.ones(len(self.positions), dtype=bool))
        choose(self.obj, self.right, "hide")
        edit_and_back(bpy.ops.mesh.qsmesh_smooth, selected_only=False)
        self.assert_same_bits(coordinates(self.obj)[self.right], self.positions[self.right])
        self.assert_some_moved(coordinates(self.obj)[~self.right], self.positions[~self.right])

    def test_several_objects_in_edit_mode(self):
        positions, quads, _ = grid()
        other = add(positions, quads, "other")
        choose(self.obj, self.right)
        choose(other, numpy.zeros(len(positions), dtype=bool))
        select(self.obj, other)
        self.assertEqual(edit_and_back(bpy.ops.mesh.qsmesh_smooth), {"FINISHED"})
        self.assert_some_moved(coordinates(self.obj)[self.right], self.positions[self.right])
        self.assert_same_bits(coordinates(other), positions)
        choose(other, numpy.ones(len(positions), dtype=bool))
        edit_and_back(bpy.ops.mesh.qsmesh_smooth)
        self.assert_some_moved(coordinates(other), positions)

    def test_several_objects_in_object_mode(self):
        positions, quads, _ = grid()
        other, third = add(positions, quads, "other"), add(positions, quads, "third")
        select(self.obj, other)
        bpy.ops.mesh.qsmesh_smooth()
        self.assert_some_moved(coordinates(self.obj), self.positions)
        self.assert_some_moved(coordinates(other), positions)
        self.assert_same_bits(coordinates(third), positions)


class VertexGroup(Situation):
    def setUp(self):
        super().setUp()
        self.positions, triangles = ball()
        self.obj = add(self.positions, triangles)
        heavy = self.positions[:, 2] > 0
        group = self.obj.vertex_groups.new(name="Top")
        group.add(numpy.flatnonzero(heavy).tolist(), 0.75, "REPLACE")
        group.add(numpy.flatnonzero(~heavy)[::2].tolist(), 0.25, "REPLACE")
        self.heavy = heavy

    def test_only_heavy_vertices_move(self):
        for call in (lambda **options: bpy.ops.mesh.qsmesh_smooth(**options),
                     lambda **options: edit_and_back(bpy.ops.mesh.qsmesh_smooth, selected_only=False, **options)):
            call(vertex_group="Top")
            self.assert_same_bits(coordinates(self.obj)[~self.heavy], self.positions[~self.heavy])
            self.assert_some_moved(coordinates(self.obj)[self.heavy], self.positions[self.heavy])

    def test_inverted_only_the_others_move(self):
        bpy.ops.mesh.qsmesh_smooth(vertex_group="Top", invert_vertex_group=True)
        self.assert_same_bits(coordinates(self.obj)[self.heavy], self.positions[self.heavy])
        self.assert_some_moved(coordinates(self.obj)[~self.heavy], self.positions[~self.heavy])

    def test_an_unknown_group_is_an_error(self):
        self.assert_refused("'mesh' has no vertex group 'Bottom'", bpy.ops.mesh.qsmesh_smooth, vertex_group="Bottom")
        self.assert_same_bits(coordinates(self.obj), self.positions)
