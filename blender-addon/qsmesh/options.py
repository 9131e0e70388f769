# SPDX-License-Identifier: GPL-3.0-or-later
"""From the properties of an operator to the options of the library."""

from math import degrees

import numpy

from . import library

SAME_NAME = (
    "iterations", "threads", "relaxation", "quality_floor", "interval_width", "sample_limit", "tail_edge_ratio",
    "tail_attempts", "tail_operations", "flips", "keep_sizes",
)
ANGLES = ("tail_min_angle", "tail_max_angle")
CHOICES = ("plane", "ideal", "boundary", "order", "method", "metric")


def library_options(settings, world_shape):
    """Options as set; what settings does not have keeps its default."""
    options = library.default_options()
    for name in SAME_NAME:
        if hasattr(settings, name):
            setattr(options, name, as_typed(getattr(settings, name)))
    for name in ANGLES:
        if hasattr(settings, name):
            setattr(options, name, in_degrees(getattr(settings, name)))
    for name in CHOICES:
        setattr(options, name, getattr(library, f"{name}_{getattr(settings, name)}".upper()))
    options.feature_angle = in_degrees(settings.feature_angle) if settings.use_features else 0.0
    if settings.use_max_deviation:
        options.max_deviation = world_shape.distance(as_typed(settings.max_deviation))
    return options


def as_typed(value):
    """The shortest number that the property can stand for: properties are single, and 1.2 is not 1.2000000477."""
    return float(str(numpy.float32(value))) if isinstance(value, float) else value


def in_degrees(angle):
    """Degrees as the user typed them, from radians in single precision."""
    return round(degrees(angle), 4)
