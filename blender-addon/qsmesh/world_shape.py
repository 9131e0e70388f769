# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles are judged as they stand in the scene. Scale that is the same in all directions makes no difference to them
and only changes distances; any other scale has to be applied before the library looks, and taken back after."""

import numpy

# Matrices come in single precision: rotated ones miss equal scale by about 1e-7.
EQUAL_SCALE = 1e-5


class WorldShape:
    """How an object's own coordinates become those that the library works on, and back."""

    def __init__(self, matrix):
        """matrix: the object's matrix_world, or any rows of at least 3 by 3 numbers."""
        linear = numpy.array([list(row)[:3] for row in matrix][:3], dtype=numpy.float64)
        gram = linear.T @ linear
        self.scale = float(numpy.sqrt(numpy.trace(gram) / 3)) or 1.0
        uneven = numpy.abs(gram - self.scale**2 * numpy.eye(3)).max() > EQUAL_SCALE * self.scale**2
        flat = abs(numpy.linalg.det(linear)) < 1e-9 * self.scale**3
        # An object that is scaled to nothing in some direction cannot be taken back; its own shape is what it has.
        self.linear = linear if uneven and not flat else None

    def enter(self, positions):
        """A copy for the library: float32 as it is, or float64 where the scale is uneven."""
        if self.linear is None:
            return positions.copy()
        return positions.astype(numpy.float64) @ self.linear.T

    def leave(self, positions, entered, worked):
        """The object's own coordinates, float32, after entered has become worked; what has not moved keeps its bits."""
        if self.linear is None:
            return worked
        moved = (worked != entered).any(axis=1)
        own = positions.copy()
        own[moved] = worked[moved] @ numpy.linalg.inv(self.linear).T
        return own

    def distance(self, scene_distance):
        """A distance in the scene, in the units of what enter() returns."""
        return scene_distance if self.linear is not None else scene_distance / self.scale
