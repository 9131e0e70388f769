# SPDX-License-Identifier: GPL-3.0-or-later
"""The sidebar's panel."""

import bpy

from . import library, measure_operator, measuring
from .improve_operator import QSMESH_OT_improve
from .smooth_operator import QSMESH_OT_smooth


class QSMESH_PT_quality(bpy.types.Panel):
    bl_idname = "QSMESH_PT_quality"
    bl_label = "Triangle Quality"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "qsmesh"

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "MESH"

    def draw(self, context):
        layout = self.layout
        try:
            library.load()
        except library.LibraryError as error:
            _draw_wrapped(layout, str(error))
            return
        column = layout.column(align=True)
        column.operator(QSMESH_OT_smooth.bl_idname)
        column.operator(QSMESH_OT_improve.bl_idname)
        layout.operator_menu_enum(measure_operator.QSMESH_OT_measure.bl_idname, "parameter")
        layout.operator_menu_enum(measure_operator.QSMESH_OT_write_quality.bl_idname, "parameter")
        if measure_operator.last_figures is not None:
            _draw_figures(layout.box(), measure_operator.last_figures)


def _draw_figures(box, figures):
    box.label(text=figures.name, icon="MESH_DATA")
    _draw_rows(box, measuring.figure_lines(figures), 0.45)
    box.label(text=measuring.PARAMETERS[figures.parameter][1])
    _draw_rows(box, [(label, f"{bar} {count}") for label, bar, count in measuring.histogram_lines(figures)], 0.3)


def _draw_rows(box, rows, share):
    column = box.column(align=True)
    column.scale_y = 0.7
    for label, value in rows:
        row = column.split(factor=share)
        row.label(text=label)
        row.label(text=value)


def _draw_wrapped(layout, text):
    """Labels do not break lines, and a message that is cut off helps nobody."""
    line = ""
    for word in text.split():
        if len(line) + len(word) > 36:
            layout.label(text=line)
            line = ""
        line = f"{line} {word}".strip()
    layout.label(text=line)
