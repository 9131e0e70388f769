# SPDX-License-Identifier: GPL-3.0-or-later
"""Which vertices may move: not hidden, selected if asked for, and in the vertex group if one is named."""

import numpy

from . import mesh_read
from .refusal import Refusal


def free_vertices(obj, mesh, settings):
    """bool, (vertices,). Raises Refusal for a vertex group that the object does not have."""
    free = ~mesh_read.flags(mesh, "vertices", "hide", [".hide_vert"])
    if restricted(obj, settings):
        free &= selected_vertices(mesh)
    if settings.vertex_group:
        free &= _group_members(obj, mesh, settings.vertex_group) ^ settings.invert_vertex_group
    return free


def free_faces(obj, mesh, settings):
    """Faces that may be treated: bool, (faces,)."""
    free = ~mesh_read.flags(mesh, "polygons", "hide", [".hide_poly"])
    if restricted(obj, settings):
        free &= mesh_read.flags(mesh, "polygons", "select", [".select_poly"])
    return free


def restricted(obj, settings):
    """Whether the selection counts: only in Edit Mode, where the user sees it."""
    return obj.mode == "EDIT" and settings.selected_only


def selected_vertices(mesh):
    """bool, (vertices,)."""
    return mesh_read.flags(mesh, "vertices", "select", [".select_vert"])


def _group_members(obj, mesh, name):
    """Vertices with a weight of at least a half."""
    group = obj.vertex_groups.get(name)
    if group is None:
        raise Refusal(f"'{obj.name}' has no vertex group '{name}'")
    number = group.index
    return numpy.fromiter(
        (any(entry.group == number and entry.weight >= 0.5 for entry in vertex.groups) for vertex in mesh.vertices),
        dtype=bool,
        count=len(mesh.vertices),
    )
