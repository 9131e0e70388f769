# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of one object, and the panel's text of them."""

from dataclasses import dataclass

import bpy

from . import library, mesh_read, shape_keys
from .world_shape import WorldShape

# For each parameter: number in the library, name, first value and width of the histogram's intervals.
PARAMETERS = {
    "EDGE_RATIO": (library.EDGE_RATIO, "Edge Ratio", 1.0, 0.25),
    "MIN_ANGLE": (library.MIN_ANGLE, "Smallest Angle", 0.0, 5.0),
    "MAX_ANGLE": (library.MAX_ANGLE, "Largest Angle", 60.0, 10.0),
    "SHAPE": (library.SHAPE, "Shape", 0.0, 0.1),
    "RADIUS_RATIO": (library.RADIUS_RATIO, "Radius Ratio", 1.0, 0.25),
}
BINS = {"SHAPE": 10}
MOST_BINS = 12
# Characters of the longest bar; the sidebar has room for no more.
BAR = 7


def parameter_property():
    """The choice of a parameter, for an operator."""
    return bpy.props.EnumProperty(
        name="Parameter", default="EDGE_RATIO", description="Quality parameter of the triangles",
        items=[
            ("EDGE_RATIO", "Edge Ratio", "Longest over shortest edge; 1 is best"),
            ("MIN_ANGLE", "Smallest Angle", "Degrees; 60 is best"),
            ("MAX_ANGLE", "Largest Angle", "Degrees; 60 is best"),
            ("SHAPE", "Shape", "Area over squared edges; 0 has no area, 1 is equilateral"),
            ("RADIUS_RATIO", "Radius Ratio", "Circumradius over twice the inradius; 1 is best"),
        ],
    )


@dataclass
class Figures:
    """What the panel shows."""

    name: str
    parameter: str
    measurement: library.Measurement
    counts: list


def buffers(obj, mesh):
    """Coordinates as they stand in the scene, and triangles."""
    return WorldShape(obj.matrix_world).enter(shape_keys.read(obj, mesh)), mesh_read.triangles(mesh)


def measure(obj, parameter):
    """Figures of obj with the histogram of a parameter (a key of PARAMETERS). Raises LibraryError."""
    number, _, lower, interval = PARAMETERS[parameter]
    with mesh_read.readable(obj) as mesh:
        positions, triangles = buffers(obj, mesh)
    counts = library.histogram(positions, triangles, number, lower, interval, BINS.get(parameter, MOST_BINS))
    return Figures(obj.name, parameter, library.measure(positions, triangles), counts)


def figure_rows(figures):
    """(name, mean, worst) for each parameter that the panel shows; as short as the sidebar is narrow."""
    found = figures.measurement
    angles = (("Min Angle", found.min_angle, found.min_angle.min), ("Max Angle", found.max_angle, found.max_angle.max))
    return [
        ("", "Mean", "Worst"),
        ("Edge Ratio", f"{found.edge_ratio.mean:.3f}", f"{found.edge_ratio.max:.1f}"),
        *((name, f"{values.mean:.1f}°", f"{worst:.1f}°") for name, values, worst in angles),
        ("Shape", f"{found.shape.mean:.3f}", f"{found.shape.min:.3f}"),
    ]


def count_rows(figures):
    """(name, count) pairs."""
    found = figures.measurement
    counts = [
        ("Triangles", found.triangles), ("Below 10°", found.below_10), ("Below 20°", found.below_20),
        ("Below 30°", found.below_30), ("Without Area", found.zero_area), ("Open Edges", found.boundary_edges),
        ("Non-manifold", found.non_manifold_edges),
    ]
    return [(name, f"{count:,}") for name, count in counts]


def histogram_rows(figures):
    """(start of the interval, bar, count) for each interval; a bar is never empty where there is a triangle."""
    _, _, lower, interval = PARAMETERS[figures.parameter]
    most = max(figures.counts) or 1
    starts = (f"{lower + number * interval:g}" for number in range(len(figures.counts)))
    return [(start, "█" * -(-BAR * count // most), f"{count:,}") for start, count in zip(starts, figures.counts)]
