# SPDX-License-Identifier: GPL-3.0-or-later
"""Coordinates of the active shape key, and of its relative keys, which go along when it changes, as in Edit Mode."""

import numpy

from . import mesh_read, mesh_write


def active_number(obj):
    """Number of the key that the user edits, or None where the mesh has no keys."""
    return None if obj.data.shape_keys is None else obj.active_shape_key_index


def read(obj, mesh):
    """What the user edits: float32, (vertices, 3). mesh is the object's mesh or a copy of it."""
    number = active_number(obj)
    if number is None:
        return mesh_read.positions(mesh)
    return key_positions(mesh.shape_keys.key_blocks[number])


def key_positions(key):
    """Coordinates of one key: float32, (vertices, 3)."""
    found = numpy.empty((len(key.data), 3), dtype=numpy.float32)
    key.data.foreach_get("co", found.ravel())
    return found


def write(obj, before, after):
    """Gives the object's vertices new coordinates, float32 (vertices, 3), in either mode. Returns how many moved."""
    moved = mesh_write.moved_vertices(before, after)
    if obj.mode == "EDIT":
        mesh_write.edited_positions(obj.data, after, moved)
    elif obj.data.shape_keys is None:
        mesh_write.positions(obj.data, after)
    else:
        _write_keys(obj, before, after, moved)
    return len(moved)


def dragged(obj):
    """The keys that go along with the active one: those that are relative to it, and those relative to them."""
    keys = obj.data.shape_keys
    if not keys.use_relative:
        return []
    active = obj.active_shape_key
    found = [active]
    # A key that is its own reference, or keys in a ring, must not be visited twice.
    for leader in found:
        found += [key for key in keys.key_blocks if key.relative_key == leader and key not in found]
    return found[1:]


def _write_keys(obj, before, after, moved):
    mesh, active = obj.data, obj.active_shape_key
    for key in dragged(obj):
        followed = key_positions(key)
        followed[moved] += after[moved] - before[moved]
        key.data.foreach_set("co", followed.ravel())
    active.data.foreach_set("co", after.ravel())
    # The mesh itself holds the reference key, which may be one of those that went along.
    mesh_write.positions(mesh, key_positions(mesh.shape_keys.reference_key))
