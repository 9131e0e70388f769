# SPDX-License-Identifier: GPL-3.0-or-later
"""From arrays to Blender's meshes: coordinates alone, everything else stays."""

import bmesh
import numpy

from . import mesh_read


def moved_vertices(before, after):
    """Numbers of the vertices whose bits differ."""
    return numpy.flatnonzero((before != after).any(axis=1))


def positions(mesh, coordinates):
    """Writes float32 coordinates, (vertices, 3), in Object Mode."""
    if mesh_read.HAS_ATTRIBUTES and len(coordinates):
        mesh.attributes["position"].data.foreach_set("vector", coordinates.ravel())
    else:
        mesh.vertices.foreach_set("co", coordinates.ravel())
    mesh.update()


def edited_positions(mesh, coordinates, moved):
    """Writes the moved vertices of a mesh in Edit Mode, where the edited copy counts and the mesh itself does not."""
    edited = bmesh.from_edit_mesh(mesh)
    edited.verts.ensure_lookup_table()
    for number, place in zip(moved.tolist(), coordinates[moved].tolist()):
        edited.verts[number].co = place
    edited.normal_update()
    bmesh.update_edit_mesh(mesh, loop_triangles=True, destructive=False)
