# SPDX-License-Identifier: GPL-3.0-or-later
"""Quality of each face, for viewing. The library measures whole meshes; these are its definitions for one triangle."""

import numpy

from . import library

# Of the triangles of a larger face the worst counts.
WORST_IS_LARGEST = {library.EDGE_RATIO, library.MAX_ANGLE, library.RADIUS_RATIO}


def triangle_values(positions, triangles, parameter):
    """One value of the parameter for each triangle: float64; infinite where a triangle without area has none."""
    corners = positions.astype(numpy.float64)[triangles]
    sides = corners[:, [1, 2, 0]] - corners
    lengths = numpy.linalg.norm(sides, axis=2)
    area = numpy.linalg.norm(numpy.cross(sides[:, 0], sides[:, 1]), axis=1) / 2
    with numpy.errstate(divide="ignore", invalid="ignore"):
        return numpy.nan_to_num(_value(parameter, lengths, area), nan=numpy.inf, posinf=numpy.inf)


def _value(parameter, lengths, area):
    if parameter == library.EDGE_RATIO:
        return lengths.max(axis=1) / lengths.min(axis=1)
    if parameter == library.SHAPE:
        return 4 * numpy.sqrt(3) * area / (lengths**2).sum(axis=1)
    if parameter == library.RADIUS_RATIO:
        return lengths.prod(axis=1) * lengths.sum(axis=1) / (16 * area**2)
    angles = _angles(lengths, area)
    return angles.min(axis=1) if parameter == library.MIN_ANGLE else angles.max(axis=1)


def _angles(lengths, area):
    """Degrees, by sine and cosine together: either alone loses digits somewhere."""
    squares = lengths**2
    twice_cosines = squares.sum(axis=1, keepdims=True) - 2 * squares
    return numpy.degrees(numpy.arctan2(4 * area[:, None], twice_cosines))


def face_values(values, faces, count, parameter):
    """The worst of the triangles of each face: float32, (count,). faces: the face of each triangle."""
    largest = parameter in WORST_IS_LARGEST
    found = numpy.full(count, -numpy.inf if largest else numpy.inf)
    (numpy.maximum if largest else numpy.minimum).at(found, faces, values)
    return found.astype(numpy.float32)
