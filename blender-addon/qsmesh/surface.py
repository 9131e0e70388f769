# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that the library is told about one object, read in one go."""

from dataclasses import dataclass

import numpy

from . import features, mesh_read, selection, shape_keys
from .refusal import NothingSelected, Refusal
from .world_shape import WorldShape


@dataclass
class Surface:
    """Arrays of one object; vertices, faces and edges are numbered as in Blender."""

    positions: numpy.ndarray  # what the user edits: float32, (vertices, 3)
    triangles: numpy.ndarray  # uint32, (triangles, 3)
    free: numpy.ndarray  # vertices that may move: bool
    hidden: numpy.ndarray  # vertices: bool
    marked: numpy.ndarray  # edges kept as features: uint32, (marked, 2)
    edges: numpy.ndarray  # uint32, (edges, 2); empty if not wanted
    world: WorldShape


def read(obj, settings, with_edges=False):
    """Reads an object for smoothing. Raises Refusal."""
    with mesh_read.readable(obj) as mesh:
        return _read(obj, mesh, settings, with_edges)


def read_triangles(obj, settings):
    """Reads an object for a change of connectivity: the surface, and the faces that may be treated. Raises Refusal."""
    with mesh_read.readable(obj) as mesh:
        if not mesh_read.only_triangles(mesh):
            raise Refusal(larger_faces(obj))
        surface = _read(obj, mesh, settings, with_edges=True)
        surface.free &= ~_on_loose_edges(mesh, surface)
        return surface, selection.free_faces(obj, mesh, settings)


def larger_faces(obj):
    """What to tell the user of an object with faces that are not triangles."""
    return (
        f"'{obj.name}' has faces with more than three corners, which Improve Triangles cannot rebuild: "
        "triangulate them first (Ctrl T), or use Quasi-statistical Smooth"
    )


def _read(obj, mesh, settings, with_edges):
    if selection.restricted(obj, settings) and not selection.selected_vertices(mesh).any():
        raise NothingSelected(f"Nothing is selected in '{obj.name}'")
    return Surface(
        positions=shape_keys.read(obj, mesh),
        triangles=mesh_read.triangles(mesh),
        free=selection.free_vertices(obj, mesh, settings),
        hidden=mesh_read.flags(mesh, "vertices", "hide", [".hide_vert"]),
        marked=features.marked_edges(mesh, settings),
        edges=mesh_read.edge_vertices(mesh) if with_edges else numpy.empty((0, 2), dtype=numpy.uint32),
        world=WorldShape(obj.matrix_world),
    )


def _on_loose_edges(mesh, surface):
    """Vertices at which an edge without faces ends: the library does not see it, so it must not remove them."""
    loose = numpy.ones(len(surface.edges), dtype=bool)
    loose[mesh_read.corner_edges(mesh)] = False
    found = numpy.zeros(len(surface.positions), dtype=bool)
    found[surface.edges[loose]] = True
    return found
