"""A symmetric mesh stays symmetric, to the bit."""

import bpy
import numpy

from situation import Situation, add, choose, coordinates, edit_and_back, grid, part

MIDDLE = 4


class Mirror(Situation):
    def setUp(self):
        super().setUp()
        self.positions, quads, self.border = grid()
        rows, columns = numpy.divmod(numpy.arange(81), 9)
        self.across = rows * 9 + 8 - columns
        self.upside = (8 - rows) * 9 + columns
        self.middle = columns == MIDDLE
        self.positions = symmetric(self.positions, 0, self.across, columns < MIDDLE, self.middle)
        self.quads = quads
        self.columns, self.rows = columns, rows

    def assert_symmetric(self, positions, axis, partner):
        image = positions[partner].copy()
        image[:, axis] *= -1
        self.assert_same_bits(positions, image)

    def test_both_sides_move_alike_and_the_middle_stays_in_its_plane(self):
        obj = add(self.positions, self.quads)
        bpy.ops.mesh.qsmesh_smooth()
        plain = coordinates(obj)
        self.assertTrue((plain[self.across] * [-1, 1, 1] != plain).any(), "symmetric without the option too")
        obj.data.vertices.foreach_set("co", self.positions.ravel())
        bpy.ops.mesh.qsmesh_smooth(mirror={"X"})
        self.assert_symmetric(coordinates(obj), 0, self.across)
        for part in (self.middle, self.columns < MIDDLE):
            inside = part & ~self.border
            self.assert_some_moved(coordinates(obj)[inside], self.positions[inside])

    def test_the_middle_keeps_its_distance_from_the_plane_to_the_bit(self):
        almost = self.positions.copy()
        almost[self.middle, 0] = numpy.linspace(-1e-6, 1e-6, 9)[[4, 0, 7, 2, 8, 1, 6, 3, 5]]
        obj = add(almost, self.quads)
        bpy.ops.mesh.qsmesh_smooth(mirror={"X"})
        inside = self.middle & ~self.border
        self.assert_some_moved(coordinates(obj)[inside], almost[inside])
        self.assert_same_bits(coordinates(obj)[self.middle, 0], almost[self.middle, 0])

    def test_two_axes(self):
        positions = symmetric(self.positions, 1, self.upside, self.rows < MIDDLE, self.rows == MIDDLE)
        obj = add(positions, self.quads)
        bpy.ops.mesh.qsmesh_smooth(mirror={"X", "Y"})
        self.assert_some_moved(coordinates(obj), positions)
        self.assert_symmetric(coordinates(obj), 0, self.across)
        self.assert_symmetric(coordinates(obj), 1, self.upside)

    def test_what_is_selected_on_one_side_moves_on_both(self):
        obj = add(self.positions, self.quads)
        chosen = (self.columns < MIDDLE - 1) & (self.rows > MIDDLE)
        choose(obj, chosen)
        edit_and_back(bpy.ops.mesh.qsmesh_smooth, mirror={"X"})
        self.assert_symmetric(coordinates(obj), 0, self.across)
        self.assert_some_moved(coordinates(obj)[chosen], self.positions[chosen])
        untouched = ~(chosen | chosen[self.across])
        self.assert_same_bits(coordinates(obj)[untouched], self.positions[untouched])

    def test_a_hidden_image_holds_both(self):
        obj = add(self.positions, self.quads)
        hidden = self.columns > MIDDLE + 1
        obj.data.vertices.foreach_set("hide", hidden)
        bpy.ops.mesh.qsmesh_smooth(mirror={"X"})
        held = hidden | hidden[self.across]
        self.assert_same_bits(coordinates(obj)[held], self.positions[held])
        self.assert_some_moved(coordinates(obj), self.positions)

    def test_vertices_without_an_image_move_by_themselves(self):
        lopsided = self.positions.copy()
        lonely = 2 * 9 + 2
        lopsided[lonely, 0] += 0.05
        obj = add(lopsided, self.quads)
        bpy.ops.mesh.qsmesh_smooth(mirror={"X"})
        self.assert_some_moved(coordinates(obj)[lonely], lopsided[lonely])

    def test_the_mesh_s_own_symmetry_is_where_the_option_starts(self):
        obj = add(self.positions, self.quads)
        for axes in (set(), {"X"}, {"Y", "Z"}):
            for axis in "XYZ":
                setattr(obj.data, f"use_mirror_{axis.lower()}", axis in axes)
            self.assertEqual(part("mirror").chosen_axes(obj), axes)


def symmetric(positions, axis, partner, there, middle):
    positions = positions.copy()
    positions[there] = positions[partner[there]]
    positions[there, axis] *= -1
    positions[middle, axis] = 0
    return positions
