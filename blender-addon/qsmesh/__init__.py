# SPDX-License-Identifier: GPL-3.0-or-later
"""Better triangles for meshes, with the shape kept: the library qsmesh inside Blender."""

import bpy

from . import menus
from .improve_operator import QSMESH_OT_improve
from .measure_operator import QSMESH_OT_measure, QSMESH_OT_write_quality
from .panel import QSMESH_PT_quality
from .smooth_operator import QSMESH_OT_smooth

# Read by Blender before 4.2; later versions read blender_manifest.toml.
bl_info = {
    "name": "qsmesh",
    "description": "Better triangles for meshes, with shape and volume kept",
    "author": "The qsmesh project",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Object Mode: Object; Edit Mode: Vertex, Mesh > Clean Up; Sidebar > qsmesh",
    "category": "Mesh",
}

CLASSES = (
    QSMESH_OT_smooth, QSMESH_OT_improve, QSMESH_OT_measure, QSMESH_OT_write_quality, QSMESH_PT_quality,
)


def register():
    for kind in CLASSES:
        bpy.utils.register_class(kind)
    menus.register()


def unregister():
    menus.unregister()
    for kind in reversed(CLASSES):
        bpy.utils.unregister_class(kind)
