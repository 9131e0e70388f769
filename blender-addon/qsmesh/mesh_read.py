# SPDX-License-Identifier: GPL-3.0-or-later
"""From Blender's meshes to arrays. The fastest way differs between versions; each difference stands here once."""

from contextlib import contextmanager

import bpy
import numpy

HAS_ATTRIBUTES = bpy.app.version >= (4, 1)


@contextmanager
def readable(obj):
    """The mesh of an object, up to date, with all of its layers.

    In Edit Mode most layers of the mesh itself are out of reach and look empty, so a copy is lent out.
    """
    if obj.mode != "EDIT":
        yield obj.data
        return
    obj.update_from_editmode()
    copy = obj.data.copy()
    try:
        yield copy
    finally:
        bpy.data.meshes.remove(copy)


def positions(mesh):
    """Coordinates of the mesh itself: float32, (vertices, 3)."""
    found = numpy.empty((len(mesh.vertices), 3), dtype=numpy.float32)
    # A mesh of nothing has not even the attribute.
    if HAS_ATTRIBUTES and len(found):
        mesh.attributes["position"].data.foreach_get("vector", found.ravel())
    else:
        mesh.vertices.foreach_get("co", found.ravel())
    return found


def only_triangles(mesh):
    """Whether every face is a triangle. No face has less than three corners, so counting is enough."""
    return len(mesh.loops) == 3 * len(mesh.polygons)


def triangles(mesh):
    """Vertex numbers: uint32, (triangles, 3). Larger faces come as the triangles that Blender draws them with."""
    if only_triangles(mesh):
        return corner_vertices(mesh).reshape(-1, 3)
    mesh.calc_loop_triangles()
    found = numpy.empty((len(mesh.loop_triangles), 3), dtype=numpy.int32)
    mesh.loop_triangles.foreach_get("vertices", found.ravel())
    return found.view(numpy.uint32)


def triangle_faces(mesh):
    """For each triangle of triangles() the face that it belongs to: int32, (triangles,)."""
    if only_triangles(mesh):
        return numpy.arange(len(mesh.polygons), dtype=numpy.int32)
    mesh.calc_loop_triangles()
    found = numpy.empty(len(mesh.loop_triangles), dtype=numpy.int32)
    mesh.loop_triangles.foreach_get("polygon_index", found)
    return found


def corner_vertices(mesh):
    """The vertex of each corner, face after face: uint32, (corners,)."""
    return _corners(mesh, ".corner_vert", "vertex_index").view(numpy.uint32)


def corner_edges(mesh):
    """The edge that leads from each corner to the next one of its face: int32, (corners,)."""
    return _corners(mesh, ".corner_edge", "edge_index")


def _corners(mesh, attribute, name):
    found = numpy.empty(len(mesh.loops), dtype=numpy.int32)
    if HAS_ATTRIBUTES and len(found):
        mesh.attributes[attribute].data.foreach_get("value", found)
    else:
        mesh.loops.foreach_get(name, found)
    return found


def edge_vertices(mesh):
    """The two vertices of each edge: uint32, (edges, 2)."""
    found = numpy.empty((len(mesh.edges), 2), dtype=numpy.int32)
    mesh.edges.foreach_get("vertices", found.ravel())
    return found.view(numpy.uint32)


def face_sizes(mesh):
    """Corners of each face: int32, (faces,)."""
    found = numpy.empty(len(mesh.polygons), dtype=numpy.int32)
    mesh.polygons.foreach_get("loop_total", found)
    return found


def flags(mesh, elements, name, attributes):
    """A yes or no for each of elements ("vertices", "edges" or "polygons"): bool, one each.

    attributes: the names under which newer versions store it; where none of them exists, no element has it.
    """
    collection = getattr(mesh, elements)
    found = numpy.zeros(len(collection), dtype=bool)
    if not HAS_ATTRIBUTES:
        collection.foreach_get(name, found)
        return found
    for attribute in attributes:
        if attribute in mesh.attributes:
            mesh.attributes[attribute].data.foreach_get("value", found)
    return found
