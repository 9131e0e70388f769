# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators behind the buttons of the panel: measure, and write the quality of each face as an attribute."""

import bmesh
import bpy

from . import face_quality, library, measuring, mesh_read, targets
from .library import LibraryError

# What was measured last, for the panel. Nothing of it belongs into a file.
last_figures = None


class ActiveMesh:
    """For operators that work on the active object alone."""

    @classmethod
    def poll(cls, context):
        if context.object is None or context.object.type != "MESH" or context.mode not in {"OBJECT", "EDIT_MESH"}:
            cls.poll_message_set("Choose a mesh, in Object Mode or in Edit Mode")
            return False
        return True


class QSMESH_OT_measure(ActiveMesh, bpy.types.Operator):
    bl_idname = "mesh.qsmesh_measure"
    bl_label = "Measure Triangles"
    bl_description = "Show the quality of the active object's triangles in the sidebar"
    bl_options = {"REGISTER"}

    parameter: measuring.parameter_property()

    def execute(self, context):
        global last_figures
        try:
            last_figures = measuring.measure(context.object, self.parameter)
        except LibraryError as error:
            self.report({"ERROR"}, str(error) if error.status is None else f"'{context.object.name}': {error}")
            return {"CANCELLED"}
        return {"FINISHED"}


class QSMESH_OT_write_quality(ActiveMesh, bpy.types.Operator):
    bl_idname = "mesh.qsmesh_write_quality"
    bl_label = "Write Quality Attribute"
    bl_description = "Write the quality of each face into a face attribute, for materials, nodes and the spreadsheet"
    bl_options = {"REGISTER", "UNDO"}

    parameter: measuring.parameter_property()

    def execute(self, context):
        obj = context.object
        if targets.linked(obj):
            self.report({"ERROR"}, targets.linked(obj))
            return {"CANCELLED"}
        name = f"qsmesh_{self.parameter.lower()}"
        _write_attribute(obj, name, _values(obj, self.parameter))
        self.report({"INFO"}, f"Wrote the face attribute '{name}'")
        return {"FINISHED"}


def _values(obj, parameter):
    number = measuring.PARAMETERS[parameter][0]
    with mesh_read.readable(obj) as mesh:
        values = library.triangle_quality(*measuring.buffers(obj, mesh), number)
        return face_quality.face_values(values, mesh_read.triangle_faces(mesh), len(mesh.polygons), number)


def _write_attribute(obj, name, values):
    mesh = obj.data
    if obj.mode == "EDIT":
        edited = bmesh.from_edit_mesh(mesh)
        layer = edited.faces.layers.float.get(name) or edited.faces.layers.float.new(name)
        for face, value in zip(edited.faces, values.tolist()):
            face[layer] = value
        bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
        return
    attribute = mesh.attributes.get(name) or mesh.attributes.new(name, "FLOAT", "FACE")
    attribute.data.foreach_set("value", values)
    mesh.update()
