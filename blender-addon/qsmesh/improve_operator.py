# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator Improve Triangles."""

import bpy

from . import improving, mesh_read, settings, surface, targets
from .mesh_operator import MeshOperator


class QSMESH_OT_improve(
    MeshOperator, settings.RegionSettings, settings.FeatureSettings, settings.MethodSettings, settings.TailSettings,
    bpy.types.Operator,
):
    bl_idname = "mesh.qsmesh_improve"
    bl_label = "Improve Triangles"
    bl_description = (
        "Smooth, then cure the triangles that are still bad by moving, flipping and collapsing. For meshes of triangles"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if not MeshOperator.poll.__func__(cls, context):
            return False
        # In Edit Mode the mesh is not up to date; there the operator itself looks, and says the same.
        if context.mode == "OBJECT":
            objects = targets.objects(context)
            if not any(mesh_read.only_triangles(obj.data) for obj in objects):
                cls.poll_message_set(surface.larger_faces(objects[0]))
                return False
        return True

    def draw(self, context):
        settings.draw(self, context)

    def treat(self, obj, tell):
        return improving.improve(obj, self, tell)
