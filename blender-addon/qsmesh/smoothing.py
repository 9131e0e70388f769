# SPDX-License-Identifier: GPL-3.0-or-later
"""Smooths one object: read, let the library move vertices, write."""

import numpy

from . import library, mirror, shape_keys, surface
from .options import library_options
from .outcome import Outcome


def smooth(obj, settings, tell):
    """Smooths obj and returns its Outcome. tell(share) hears of the progress. Raises Refusal and LibraryError."""
    found = surface.read(obj, settings, with_edges=bool(settings.mirror))
    call = _Call(found, settings, tell)
    if settings.mirror:
        after, notes = _both_sides(found, settings, call)
    else:
        after, notes = call.move(found.positions, found.free, found.marked), []
    moved = shape_keys.write(obj, found.positions, after)
    if not settings.tell_quality:
        return Outcome(obj.name, moved, notes=notes)
    first, last = call.reports[0], call.reports[-1]
    measured = library.measure(found.world.enter(after), found.triangles) if settings.mirror else last.after
    return Outcome(obj.name, moved, first.before, measured, kept=last.kept, notes=notes)


class _Call:
    """Calls of the library on one object."""

    def __init__(self, found, settings, tell):
        self.found = found
        self.figures = settings.tell_quality
        self.reports = []
        self.options = library_options(settings, found.world)
        self.options.call_back(tell)

    def move(self, positions, free, marked):
        """New positions of the object's own, float32."""
        entered = self.found.world.enter(positions)
        worked = entered.copy()
        self.options.lock(~free)
        self.options.mark(marked)
        self.reports.append(library.smooth(worked, self.found.triangles, self.options, self.figures))
        return self.found.world.leave(positions, entered, worked)


def _both_sides(found, settings, call):
    symmetry = mirror.Symmetry(found.positions, [("X", "Y", "Z").index(axis) for axis in sorted(settings.mirror)])

    def move(positions, free, seams):
        return call.move(positions, free, numpy.concatenate([found.marked, seams]))

    after = mirror.smooth(symmetry, symmetry.free_together(found.free, found.hidden), found.edges, move)
    alone = symmetry.without_partner()
    return after, [f"{alone:,} vertices have no mirror image and moved by themselves"] if alone else []
