# SPDX-License-Identifier: GPL-3.0-or-later
"""Places of the operators in Blender's menus; F3 finds what is in a menu."""

import bpy

from .improve_operator import QSMESH_OT_improve
from .smooth_operator import QSMESH_OT_smooth

MENUS = (
    "VIEW3D_MT_edit_mesh_vertices", "VIEW3D_MT_edit_mesh_clean", "VIEW3D_MT_edit_mesh_context_menu", "VIEW3D_MT_object",
)


def _draw(self, _context):
    self.layout.separator()
    self.layout.operator(QSMESH_OT_smooth.bl_idname)
    self.layout.operator(QSMESH_OT_improve.bl_idname)


def register():
    for name in MENUS:
        getattr(bpy.types, name).append(_draw)


def unregister():
    for name in MENUS:
        getattr(bpy.types, name).remove(_draw)
