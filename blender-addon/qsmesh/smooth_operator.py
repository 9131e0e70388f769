# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator Quasi-statistical Smooth."""

import bpy

from . import mirror, settings, smoothing
from .mesh_operator import MeshOperator


class QSMESH_OT_smooth(
    MeshOperator, settings.RegionSettings, settings.MirrorSettings, settings.FeatureSettings, settings.MethodSettings,
    settings.TellSettings, bpy.types.Operator,
):
    bl_idname = "mesh.qsmesh_smooth"
    bl_label = "Quasi-statistical Smooth"
    bl_description = "Make triangles rounder by moving vertices; shape, volume, edges and connectivity stay"
    bl_options = {"REGISTER", "UNDO"}

    def invoke(self, context, event):
        # Symmetry is a setting of the mesh that Blender's own tools follow; the user can still change it afterwards.
        if context.object is not None and not self.properties.is_property_set("mirror"):
            self.mirror = mirror.chosen_axes(context.object)
        return self.execute(context)

    def draw(self, context):
        settings.draw(self, context)

    def treat(self, obj, tell):
        return smoothing.smooth(obj, self, tell)
