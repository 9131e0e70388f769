# SPDX-License-Identifier: GPL-3.0-or-later
"""Edges that the user has marked, or that part two materials or two pieces of a UV map: they are kept as features."""

import bpy
import numpy

from . import mesh_read

# Points of a UV map that differ by less are one: editors weld them no better.
UV_APART = 1e-5


def marked_edges(mesh, settings):
    """Vertex numbers of the edges to be kept: uint32, (edges, 2)."""
    sources = (
        (settings.keep_sharp, _sharp), (settings.keep_seams, _seams), (settings.keep_creases, _creases),
        (settings.keep_materials, _material_borders), (settings.keep_uv_borders, _uv_borders),
    )
    marked = numpy.zeros(len(mesh.edges), dtype=bool)
    for wanted, find in sources:
        if wanted:
            marked |= find(mesh)
    return mesh_read.edge_vertices(mesh)[marked] if marked.any() else numpy.empty((0, 2), dtype=numpy.uint32)


def _sharp(mesh):
    return mesh_read.flags(mesh, "edges", "use_edge_sharp", ["sharp_edge"])


def _seams(mesh):
    return mesh_read.flags(mesh, "edges", "use_seam", ["uv_seam", ".uv_seam"])


def _creases(mesh):
    weights = numpy.zeros(len(mesh.edges), dtype=numpy.float32)
    if bpy.app.version < (4, 0):
        mesh.edges.foreach_get("crease", weights)
    elif "crease_edge" in mesh.attributes:
        mesh.attributes["crease_edge"].data.foreach_get("value", weights)
    return weights > 0


def _material_borders(mesh):
    materials = numpy.empty(len(mesh.polygons), dtype=numpy.int32)
    mesh.polygons.foreach_get("material_index", materials)
    if len(materials) == 0 or (materials == materials[0]).all():
        return numpy.zeros(len(mesh.edges), dtype=bool)
    of_corner = numpy.repeat(materials, mesh_read.face_sizes(mesh))
    return _parted(mesh, of_corner[:, None], 0)


def _uv_borders(mesh):
    borders = numpy.zeros(len(mesh.edges), dtype=bool)
    for layer in mesh.uv_layers:
        borders |= _parted(mesh, _edge_ends(mesh, _uv_points(layer)), UV_APART)
    return borders


def _uv_points(layer):
    points = numpy.empty((len(layer.data), 2), dtype=numpy.float32)
    if mesh_read.HAS_ATTRIBUTES:
        layer.uv.foreach_get("vector", points.ravel())
    else:
        layer.data.foreach_get("uv", points.ravel())
    return points


def _edge_ends(mesh, of_corner):
    """For each corner, what its edge has at its first and at its second vertex: (corners, 2 * width)."""
    sizes = mesh_read.face_sizes(mesh)
    ends = numpy.cumsum(sizes)
    following = numpy.arange(1, len(of_corner) + 1)
    following[ends - 1] = ends - sizes
    pairs = numpy.stack([of_corner, of_corner[following]], axis=1)
    first = mesh_read.edge_vertices(mesh)[mesh_read.corner_edges(mesh), 0]
    backwards = mesh_read.corner_vertices(mesh) != first
    pairs[backwards] = pairs[backwards][:, ::-1]
    return pairs.reshape(len(of_corner), -1)


def _parted(mesh, of_corner, tolerance):
    """Edges at which two faces have values that differ by more than tolerance: bool, (edges,)."""
    edges = mesh_read.corner_edges(mesh)
    order = numpy.argsort(edges, kind="stable")
    edges, of_corner = edges[order], of_corner[order].astype(numpy.float64)
    apart = (numpy.abs(of_corner[1:] - of_corner[:-1]) > tolerance).any(axis=1) & (edges[1:] == edges[:-1])
    found = numpy.zeros(len(mesh.edges), dtype=bool)
    found[edges[1:][apart]] = True
    return found
