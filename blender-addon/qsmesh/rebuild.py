# SPDX-License-Identifier: GPL-3.0-or-later
"""Gives a mesh the triangles that came out of the library. Only faces that are new are made; all else stays in place,
so that every layer of Blender's, known here or not, is carried along by Blender itself."""

import bmesh
import numpy

from . import shape_keys


def rebuild(obj, found, improved, after):
    """found: the Surface that went in. after: float32 coordinates of the vertices that came out."""
    mesh = obj.data
    if obj.mode == "EDIT":
        edited = bmesh.from_edit_mesh(mesh)
        _change(edited, found, improved, after)
        edited.select_flush_mode()
        bmesh.update_edit_mesh(mesh, loop_triangles=True, destructive=True)
        return
    keys = _changed_keys(obj, found, improved, after)
    edited = bmesh.new()
    try:
        edited.from_mesh(mesh)
        _change(edited, found, improved, after)
        edited.to_mesh(mesh)
    finally:
        edited.free()
    _write_keys(mesh, keys)
    mesh.update()


def _changed_keys(obj, found, improved, after):
    """New coordinates of every shape key, by name."""
    if obj.data.shape_keys is None:
        return {}
    stayed = improved.vertex_source
    step = after - found.positions[stayed]
    along = {key.name for key in shape_keys.dragged(obj)}
    keys = {key.name: shape_keys.key_positions(key)[stayed] for key in obj.data.shape_keys.key_blocks}
    moved = (step != 0).any(axis=1)
    for name in along:
        keys[name][moved] += step[moved]
    keys[obj.active_shape_key.name] = after
    return keys


def _write_keys(mesh, keys):
    for name, coordinates in keys.items():
        mesh.shape_keys.key_blocks[name].data.foreach_set("co", coordinates.ravel())
    if keys:
        mesh.vertices.foreach_set("co", keys[mesh.shape_keys.reference_key.name].ravel())


def _change(edited, found, improved, after):
    change = _Change(edited, found, improved)
    change.move(after)
    places, doomed = change.exchange_faces()
    change.remove(doomed)
    for face, place in places:
        face.index = place
    edited.faces.sort()
    edited.normal_update()


class _Change:
    """From the triangles that went in to those that came out, in a BMesh."""

    def __init__(self, edited, found, improved):
        self.edited, self.found, self.improved = edited, found, improved
        # Blender's own tables of elements are void as soon as an element is made.
        self.vertices, self.faces = list(edited.verts), list(edited.faces)
        gone = numpy.setdiff1d(numpy.arange(len(found.positions)), improved.vertex_source)
        self.removed = [self.vertices[number] for number in gone.tolist()]

    def move(self, after):
        stayed = self.improved.vertex_source
        moved = numpy.flatnonzero((self.found.positions[stayed] != after).any(axis=1))
        for number, place in zip(stayed[moved].tolist(), after[moved].tolist()):
            self.vertices[number].co = place

    def exchange_faces(self):
        """Makes new faces. Returns (face, place in the new order) for all that stay, and the faces that go."""
        before, sources = self.found.triangles, self.improved.triangle_source
        new = self.improved.vertex_source[self.improved.triangles]
        same = (new == before[sources]).all(axis=1)
        staying = zip(numpy.flatnonzero(same).tolist(), sources[same].tolist())
        places = [(self.faces[old], place) for place, old in staying]
        doomed = numpy.setdiff1d(numpy.arange(len(before)), sources[same]).tolist()
        doomed = {frozenset(before[old].tolist()): self.faces[old] for old in doomed}
        for place in numpy.flatnonzero(~same).tolist():
            # A triangle may come out in another's slot: then its face is there already, and cannot be made twice.
            face = doomed.pop(frozenset(new[place].tolist()), None)
            places.append((face or self._new_face(new[place].tolist(), place), place))
        return places, list(doomed.values())

    def _new_face(self, numbers, place):
        """A face like the one in whose place it comes. New edges bear no mark: marked ones are never exchanged."""
        corners = [self.vertices[number] for number in numbers]
        example = self.faces[int(self.improved.triangle_source[place])]
        face = self.edited.faces.new(corners, example)
        for corner, source in zip(face.loops, self.improved.corner_source[3 * place : 3 * place + 3].tolist()):
            corner.copy_from(self.faces[source // 3].loops[source % 3])
        face.select = example.select
        return face

    def remove(self, faces):
        edges = {edge for face in faces for edge in face.edges}
        for face in faces:
            self.edited.faces.remove(face)
        for edge in edges:
            if not edge.link_faces:
                self.edited.edges.remove(edge)
        for vertex in self.removed:
            self.edited.verts.remove(vertex)
