# SPDX-License-Identifier: GPL-3.0-or-later
"""Improves one object of triangles: read, let the library smooth and treat the tail, write or rebuild."""

import numpy

from . import library, mesh_write, rebuild, shape_keys, surface
from .options import library_options
from .outcome import Outcome


def improve(obj, settings, tell):
    """Improves obj and returns its Outcome. tell(share) hears of the progress. Raises Refusal and LibraryError."""
    found, faces = surface.read_triangles(obj, settings)
    options = library_options(settings, found.world)
    options.call_back(tell)
    options.lock(~found.free)
    options.mark(found.marked)
    options.take_up(faces)
    entered = found.world.enter(found.positions)
    improved = library.improve(entered, found.triangles, options)
    stayed = improved.vertex_source
    after = found.world.leave(found.positions[stayed], entered[stayed], improved.positions)
    moved = _write(obj, found, improved, after)
    report = improved.report
    return Outcome(obj.name, moved, report.before, report.after, tail=report)


def _write(obj, found, improved, after):
    """Rebuilds the mesh only if its triangles are others than before. Returns how many of the vertices moved."""
    if numpy.array_equal(improved.triangles, found.triangles):
        return shape_keys.write(obj, found.positions, after)
    rebuild.rebuild(obj, found, improved, after)
    return len(mesh_write.moved_vertices(found.positions[improved.vertex_source], after))
