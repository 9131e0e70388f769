# SPDX-License-Identifier: GPL-3.0-or-later
"""The native library, reached through ctypes: a mirror of include/qsmesh.h, and nothing of Blender.

Positions are C-contiguous arrays of shape (vertices, 3), float32 or float64; triangles are uint32 of shape
(triangles, 3).
"""

import ctypes
import os
import platform
import sys
from ctypes import POINTER, byref, c_char, c_char_p, c_double, c_float, c_int32, c_size_t, c_uint8, c_uint32, c_uint64
from ctypes import c_void_p
from dataclasses import dataclass

import numpy

MESSAGE_BYTES = 260
NO_OFFENDER = 2**64 - 1

OK = 0
NULL_POINTER = 1
BAD_STRUCT_SIZE = 2
BAD_STRIDE = 3
MISALIGNED = 4
COUNT_OVERFLOW = 5
INDEX_COUNT = 6
INDEX_OUT_OF_RANGE = 7
NON_FINITE_VERTEX = 8
BAD_OPTION = 9
FEATURE_EDGE_OUT_OF_RANGE = 10
OVERLAP = 11
CANCELLED = 12
OUT_OF_MEMORY = 13
PANIC = 14

PLANE_VECTOR_AREA = 0
PLANE_LEAST_SQUARES = 1
IDEAL_MODELLED = 0
IDEAL_EQUILATERAL = 1
BOUNDARY_FIXED = 0
BOUNDARY_SLIDE = 1
ORDER_COLORS = 0
ORDER_INDEX = 1
CONTINUE = 0
CANCEL = 1

EDGE_RATIO = 0
MIN_ANGLE = 1
MAX_ANGLE = 2
SHAPE = 3
RADIUS_RATIO = 4

DEFECT_DEGENERATE = 0
DEFECT_NEEDLE = 1
DEFECT_CAP = 2
DEFECT_SMALL_ANGLE = 3
REASON_FEATURE = 0
REASON_LOCKED = 1
REASON_BOUNDARY = 2
REASON_TOPOLOGY = 3
REASON_DEVIATION = 4
REASON_FOLD = 5
REASON_NO_GAIN = 6

PROGRESS = ctypes.CFUNCTYPE(c_int32, c_double, c_void_p)


class Options(ctypes.Structure):
    """qsm_options."""

    _fields_ = [
        ("struct_size", c_size_t),
        ("iterations", c_uint32),
        ("plane", c_int32),
        ("ideal", c_int32),
        ("boundary", c_int32),
        ("order", c_int32),
        ("threads", c_uint32),
        ("relaxation", c_double),
        ("interval_width", c_double),
        ("sample_limit", c_double),
        ("quality_floor", c_double),
        ("feature_angle", c_double),
        ("max_deviation", c_double),
        ("vertex_lock", POINTER(c_uint8)),
        ("feature_edges", POINTER(c_uint32)),
        ("feature_edge_count", c_size_t),
        ("progress", PROGRESS),
        ("user", c_void_p),
        ("tail_edge_ratio", c_double),
        ("tail_min_angle", c_double),
        ("tail_max_angle", c_double),
        ("tail_attempts", c_uint32),
        ("flips", c_int32),
        ("tail_operations", c_size_t),
        ("triangle_mask", POINTER(c_uint8)),
    ]

    def lock(self, locked):
        """Vertices that keep their bits: bool of shape (vertices,)."""
        self._locked = numpy.ascontiguousarray(locked, dtype=numpy.uint8)
        self.vertex_lock = _pointer(self._locked, c_uint8)

    def mark(self, edges):
        """Edges to be kept as features: vertex numbers of shape (edges, 2)."""
        self._edges = numpy.ascontiguousarray(edges, dtype=numpy.uint32)
        self.feature_edges = _pointer(self._edges, c_uint32)
        self.feature_edge_count = len(edges)

    def take_up(self, wanted):
        """Triangles that may be taken up as part of the tail: bool of shape (triangles,)."""
        self._wanted = numpy.ascontiguousarray(wanted, dtype=numpy.uint8)
        self.triangle_mask = _pointer(self._wanted, c_uint8)

    def call_back(self, tell):
        """Calls tell(share), share from 0 to 1, now and then during the call. tell must not raise."""
        # What C holds a pointer to, Python must not collect: the structure keeps it.
        self._tell = PROGRESS(lambda share, _user: tell(share) or CONTINUE)
        self.progress = self._tell


class Distribution(ctypes.Structure):
    """qsm_distribution."""

    _fields_ = [
        ("count", c_size_t),
        ("infinite", c_size_t),
        ("mean", c_double),
        ("variance", c_double),
        ("min", c_double),
        ("max", c_double),
        ("percentiles", c_double * 7),
    ]


class Measurement(ctypes.Structure):
    """qsm_measurement."""

    _fields_ = [
        ("struct_size", c_size_t),
        ("vertices", c_size_t),
        ("triangles", c_size_t),
        ("edge_ratio", Distribution),
        ("min_angle", Distribution),
        ("max_angle", Distribution),
        ("shape", Distribution),
        ("radius_ratio", Distribution),
        ("below_10", c_size_t),
        ("below_20", c_size_t),
        ("below_30", c_size_t),
        ("zero_area", c_size_t),
        ("boundary_edges", c_size_t),
        ("non_manifold_edges", c_size_t),
        ("volume", c_double),
        ("area", c_double),
    ]


class Kept(ctypes.Structure):
    """qsm_kept."""

    _fields_ = [
        ("unreferenced", c_size_t),
        ("locked", c_size_t),
        ("non_manifold", c_size_t),
        ("degenerate", c_size_t),
        ("boundary", c_size_t),
        ("corner", c_size_t),
        ("guard", c_size_t),
        ("deviation", c_size_t),
        ("settled", c_size_t),
    ]


class Seconds(ctypes.Structure):
    """qsm_seconds."""

    _fields_ = [
        ("total", c_double),
        ("adjacency", c_double),
        ("features", c_double),
        ("sweeps", c_double),
        ("tail", c_double),
    ]


class Report(ctypes.Structure):
    """qsm_report."""

    _fields_ = [
        ("struct_size", c_size_t),
        ("offender", c_uint64),
        ("offender_name", c_char_p),
        ("status", c_int32),
        ("message", c_char * MESSAGE_BYTES),
        ("before", Measurement),
        ("after", Measurement),
        ("volume_relative_change", c_double),
        ("moved", c_size_t),
        ("kept", Kept),
        ("skipped_triangles", c_size_t),
        ("feature_edges", c_size_t),
        ("moves_halved", c_size_t),
        ("moves_refused", c_size_t),
        ("max_deviation", c_double),
        ("seconds", Seconds),
        ("tails_before", c_size_t),
        ("tails_after", c_size_t),
        ("tail_moved", c_size_t),
        ("collapsed", c_size_t),
        ("removed", c_size_t),
        ("flipped", c_size_t),
        ("general_flips", c_size_t),
        ("vertices_removed", c_size_t),
        ("triangles_removed", c_size_t),
        ("triangles_unchanged", c_double),
    ]


class Leftover(ctypes.Structure):
    """qsm_leftover."""

    _fields_ = [("triangle", c_uint32), ("defect", c_int32), ("reason", c_int32)]


class Maps(ctypes.Structure):
    """qsm_maps."""

    _fields_ = [
        ("struct_size", c_size_t),
        ("vertex_source", POINTER(c_uint32)),
        ("triangle_source", POINTER(c_uint32)),
        ("corner_source", POINTER(c_uint32)),
        ("leftovers", POINTER(Leftover)),
        ("leftover_capacity", c_size_t),
        ("leftover_count", c_size_t),
    ]


class LibraryError(Exception):
    """The library cannot be loaded, or has refused a call. The text is for users; status is None if it did not load."""

    def __init__(self, message, status=None):
        super().__init__(message)
        self.status = status


@dataclass
class Improved:
    """What improve hands back: the new mesh and, for everything in it, where it came from."""

    positions: numpy.ndarray
    triangles: numpy.ndarray
    vertex_source: numpy.ndarray
    triangle_source: numpy.ndarray
    corner_source: numpy.ndarray
    report: Report


def path():
    """Where the native library is expected: in lib/ beside this file."""
    name = {"win32": "qsmesh.dll", "darwin": "libqsmesh.dylib"}.get(sys.platform, "libqsmesh.so")
    return os.path.join(os.path.dirname(os.path.abspath(__file__)), "lib", name)


_loaded = None


def load():
    """The loaded library. Raises LibraryError, in the user's words, if it is missing or not made for this machine."""
    global _loaded
    if _loaded is None:
        place = path()
        machine = f"{platform.system()} {platform.machine()}"
        if not os.path.isfile(place):
            raise LibraryError(
                f"qsmesh's native library is missing: {os.path.basename(place)} is not in the add-on's folder 'lib'. "
                f"Install the zip that was built for {machine}"
            )
        try:
            _loaded = _declare(ctypes.CDLL(place))
        except (OSError, AttributeError) as error:
            raise LibraryError(f"qsmesh's native library does not load on this machine ({machine}): {error}") from error
    return _loaded


def _declare(native):
    """Return types; a library without one of these functions raises AttributeError."""
    for name in ("smooth", "improve", "collapse_tails", "measure", "histogram", "triangle_quality"):
        for precision in ("f32", "f64"):
            getattr(native, f"qsm_{name}_{precision}").restype = c_int32
    for name in ("options", "report", "measurement", "maps"):
        getattr(native, f"qsm_{name}_init").restype = None
    native.qsm_version.restype = c_char_p
    native.qsm_status_string.restype = c_char_p
    return native


def version():
    """Version of the native library, such as "1.2.3"."""
    return load().qsm_version().decode()


def default_options():
    """Options with every default."""
    options = Options()
    load().qsm_options_init(byref(options))
    return options


def smooth(positions, triangles, options, figures=True):
    """Moves the vertices of positions in place. On LibraryError positions are as they were.

    Returns the report, or None if no figures are wanted: measuring takes longer than smoothing.
    """
    function, count, stride = _call("smooth", positions)
    report = _new_report() if figures else None
    status = function(
        _pointer(positions, c_float), c_size_t(count), c_size_t(stride), _pointer(triangles, c_uint32),
        c_size_t(triangles.size), byref(options), byref(report) if figures else None,
    )
    if status != OK and not figures:
        # Only a report says what is at fault.
        return smooth(positions, triangles, options)
    _check(status, report)
    return report


def improve(positions, triangles, options):
    """Smooths and treats the tail on copies of the buffers; returns what came out as Improved."""
    function, count, stride = _call("improve", positions)
    positions, triangles = positions.copy(), triangles.copy()
    vertex_count, index_count = c_size_t(count), c_size_t(triangles.size)
    maps, arrays = _new_maps(count, triangles.size)
    report = _new_report()
    status = function(
        _pointer(positions, c_float), byref(vertex_count), c_size_t(stride), _pointer(triangles, c_uint32),
        byref(index_count), byref(options), byref(maps), byref(report),
    )
    _check(status, report)
    vertices, corners = vertex_count.value, index_count.value
    filled = [array[:length] for array, length in zip(arrays, (vertices, corners // 3, corners))]
    return Improved(positions[:vertices], triangles[: corners // 3], *filled, report)


def measure(positions, triangles):
    """Measurement of a mesh."""
    function, count, stride = _call("measure", positions)
    measurement = Measurement()
    load().qsm_measurement_init(byref(measurement))
    status = function(
        _pointer(positions, c_float), c_size_t(count), c_size_t(stride), _pointer(triangles, c_uint32),
        c_size_t(triangles.size), byref(measurement),
    )
    _check(status)
    return measurement


def histogram(positions, triangles, parameter, lower, interval, bins):
    """How many triangles have a value of parameter in each of bins intervals from lower on: list of int."""
    function, count, stride = _call("histogram", positions)
    counts = (c_size_t * bins)()
    status = function(
        _pointer(positions, c_float), c_size_t(count), c_size_t(stride), _pointer(triangles, c_uint32),
        c_size_t(triangles.size), c_int32(parameter), c_double(lower), c_double(interval), counts, c_size_t(bins),
    )
    _check(status)
    return list(counts)


def triangle_quality(positions, triangles, parameter):
    """The value of parameter for each triangle: float64; infinite where one without area has none that is finite."""
    function, count, stride = _call("triangle_quality", positions)
    values = numpy.empty(triangles.size // 3, dtype=numpy.float64)
    status = function(
        _pointer(positions, c_float), c_size_t(count), c_size_t(stride), _pointer(triangles, c_uint32),
        c_size_t(triangles.size), c_int32(parameter), _pointer(values, c_double),
    )
    _check(status)
    return values


def _call(name, positions):
    """The function for the precision of positions, the number of vertices, and the bytes from one to the next."""
    precision = {numpy.dtype(numpy.float32): "f32", numpy.dtype(numpy.float64): "f64"}[positions.dtype]
    return getattr(load(), f"qsm_{name}_{precision}"), len(positions), 3 * positions.itemsize


def _new_report():
    report = Report()
    load().qsm_report_init(byref(report))
    return report


def _new_maps(vertices, corners):
    """Maps with room for everything, and the arrays that they fill."""
    maps = Maps()
    load().qsm_maps_init(byref(maps))
    arrays = [numpy.empty(length, dtype=numpy.uint32) for length in (vertices, corners // 3, corners)]
    maps.vertex_source, maps.triangle_source, maps.corner_source = (_pointer(array, c_uint32) for array in arrays)
    return maps, arrays


def _pointer(array, kind):
    """Address of an array's first entry. C gets no shape and no strides, so the array must lie in one piece."""
    if not array.flags.c_contiguous:
        raise ValueError("array is not contiguous")
    return ctypes.cast(array.ctypes.data, POINTER(kind))


def _check(status, report=None):
    if status != OK:
        text = report.message.decode(errors="replace") if report is not None else ""
        raise LibraryError(text or load().qsm_status_string(c_int32(status)).decode(), status)
