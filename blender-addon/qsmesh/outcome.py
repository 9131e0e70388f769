# SPDX-License-Identifier: GPL-3.0-or-later
"""What was done to one object, and how the user is told."""

from dataclasses import dataclass, field

from .library import Kept, Measurement, Report

REASONS = {
    "unreferenced": "in no face", "locked": "not chosen or hidden", "non_manifold": "on non-manifold edges",
    "degenerate": "among faces without area", "boundary": "on the boundary", "corner": "on corners of features",
    "guard": "could only make triangles worse", "deviation": "would leave the surface too far",
    "settled": "already in place",
}


@dataclass
class Outcome:
    """Figures of one object."""

    name: str
    moved: int
    # None where no figures were wanted.
    before: Measurement = None
    after: Measurement = None
    kept: Kept = None
    tail: Report = None
    notes: list = field(default_factory=list)


def text(outcomes):
    """One line for the status bar."""
    if len(outcomes) > 1:
        return f"{len(outcomes)} objects: moved {sum(outcome.moved for outcome in outcomes):,} vertices"
    return one(outcomes[0])


def one(outcome):
    """The line for one object."""
    if not outcome.moved and outcome.tail is None:
        return f"No vertex of '{outcome.name}' moved{_why(outcome.kept)}"
    parts = [f"Moved {outcome.moved:,} vertices", *_tail(outcome.tail), *_quality(outcome.before, outcome.after)]
    return "; ".join(parts)


def _why(kept):
    if kept is None:
        return ""
    counts = [(getattr(kept, name), reason) for name, reason in REASONS.items()]
    found = [f"{count:,} {reason}" for count, reason in sorted(counts, reverse=True) if count]
    return ": " + (", ".join(found) or "it has none")


def _tail(report):
    if report is None:
        return []
    cured = f"bad triangles {report.tails_before:,} → {report.tails_after:,}"
    return [f"{cured}, {report.vertices_removed:,} vertices removed"]


def _quality(before, after):
    if before is None:
        return []
    ratio = f"edge ratio {before.edge_ratio.mean:.3f} → {after.edge_ratio.mean:.3f}"
    return [f"{ratio}, smallest angle {before.min_angle.min:.1f}° → {after.min_angle.min:.1f}°"]
