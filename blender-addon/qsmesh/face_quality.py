# SPDX-License-Identifier: GPL-3.0-or-later
"""Quality of each face from that of its triangles."""

import numpy

from . import library

# Of the triangles of a larger face the worst counts.
WORST_IS_LARGEST = {library.EDGE_RATIO, library.MAX_ANGLE, library.RADIUS_RATIO}


def face_values(values, faces, count, parameter):
    """The worst of the triangles of each face: float32, (count,). faces: the face of each triangle."""
    largest = parameter in WORST_IS_LARGEST
    found = numpy.full(count, -numpy.inf if largest else numpy.inf)
    (numpy.maximum if largest else numpy.minimum).at(found, faces, values)
    return found.astype(numpy.float32)
