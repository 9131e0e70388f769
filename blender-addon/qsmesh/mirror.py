# SPDX-License-Identifier: GPL-3.0-or-later
"""Keeps a mesh symmetric: one side is improved and the other becomes its image; vertices between slide in the plane."""

import numpy
from mathutils.kdtree import KDTree

# Partners may miss each other by this part of the mesh's size, as after a round trip through a text file.
PARTNER_DISTANCE = 1e-5


def chosen_axes(obj):
    """The axes that the user has chosen for the object's mesh, beside Blender's own tools: a set of "X", "Y", "Z"."""
    if obj.type != "MESH":
        return set()
    return {axis for axis in "XYZ" if getattr(obj.data, f"use_mirror_{axis.lower()}")}


class Symmetry:
    """Which vertices are images of each other in planes through the origin."""

    def __init__(self, positions, axes):
        """positions: float32, (vertices, 3). axes: numbers 0 to 2 of the axes across which the mesh is mirrored."""
        self.axes = axes
        self.positions = positions
        self.tolerance = PARTNER_DISTANCE * float(numpy.ptp(positions, axis=0).max()) if len(positions) else 0.0
        tree = _tree(positions)
        self.partners = [self._partners(tree, axis) for axis in axes]
        numbers = numpy.arange(len(positions))
        planes = [partner == numbers for partner in self.partners]
        self.between = numpy.logical_or.reduce(planes)
        # A vertex without a partner belongs to no image: it is treated on whichever side it is.
        sides = [(positions[:, a] >= -self.tolerance) | (p < 0) for a, p in zip(axes, self.partners)]
        self.here = numpy.logical_and.reduce(sides)

    def without_partner(self):
        """How many vertices have no image."""
        return int(numpy.logical_or.reduce([partner < 0 for partner in self.partners]).sum())

    def free_together(self, free, hidden):
        """free, with the images of what is free; but no vertex whose image is hidden."""
        for partner in self.partners:
            paired = partner >= 0
            free, hidden = free.copy(), hidden.copy()
            free[paired] |= free[partner[paired]]
            hidden[paired] |= hidden[partner[paired]]
        return free & ~hidden

    def reflect(self, positions):
        """Makes the other sides images of this one, where this one has moved."""
        positions = positions.copy()
        for axis, partner in zip(self.axes, self.partners):
            there = numpy.flatnonzero((self.positions[:, axis] < -self.tolerance) & (partner >= 0))
            there = there[(positions[partner[there]] != self.positions[partner[there]]).any(axis=1)]
            positions[there] = positions[partner[there]]
            positions[there, axis] *= -1
        return positions

    def put_back_between(self, positions):
        """Gives vertices in a plane back the coordinate that keeps them there."""
        for axis, partner in zip(self.axes, self.partners):
            inside = partner == numpy.arange(len(partner))
            positions[inside, axis] = self.positions[inside, axis]

    def seams(self, edges):
        """Edges between two vertices of the same plane: (seams, 2)."""
        inside = [partner == numpy.arange(len(partner)) for partner in self.partners]
        return edges[numpy.logical_or.reduce([plane[edges].all(axis=1) for plane in inside])]

    def _partners(self, tree, axis):
        images = self.positions.copy()
        images[:, axis] *= -1
        nearest = (tree.find(image) for image in images.tolist())
        found = [number if apart <= self.tolerance else -1 for _, number, apart in nearest]
        found = numpy.array(found, dtype=numpy.int64)
        # Where several vertices share a place, it is open who belongs to whom.
        mutual = (found >= 0) & (found[found] == numpy.arange(len(found)))
        return numpy.where(mutual, found, -1)


def smooth(symmetry, free, edges, move):
    """The new positions. move(positions, free, marked) improves the free vertices and keeps the marked edges."""
    nothing = numpy.empty((0, 2), dtype=numpy.uint32)
    moved = move(symmetry.positions, free & symmetry.here & ~symmetry.between, nothing)
    moved = symmetry.reflect(moved)
    seams = symmetry.seams(edges)
    # Only a vertex with a seam on either side of it has a line to slide along.
    guided = numpy.bincount(seams.ravel(), minlength=len(free)) >= 2
    moved = move(moved, free & symmetry.here & symmetry.between & guided, seams)
    symmetry.put_back_between(moved)
    return symmetry.reflect(moved)


def _tree(positions):
    tree = KDTree(len(positions))
    for number, place in enumerate(positions.tolist()):
        tree.insert(place, number)
    tree.balance()
    return tree
