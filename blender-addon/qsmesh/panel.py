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
    _draw_rows(box, measuring.figure_rows(figures), 0.44, 0.48)
    _draw_rows(box, measuring.count_rows(figures), 0.6)
    box.label(text=f"{measuring.PARAMETERS[figures.parameter][1]} from")
    _draw_rows(box, measuring.histogram_rows(figures), 0.22, 0.6)


def _draw_rows(box, rows, share, middle_share=1.0):
    """The first cell of a row has a share of the width, the middle one of the rest; the last stands at the right."""
    column = box.column(align=True)
    column.scale_y = 0.75
    for first, *middle, last in rows:
        row = column.split(factor=share)
        row.label(text=first)
        row = row.split(factor=middle_share) if middle else row
        for text in middle:
            row.label(text=text)
        row = row.row()
        row.alignment = "RIGHT"
        row.label(text=last)


def _draw_wrapped(layout, text):
    """Labels do not break lines, and a message that is cut off helps nobody."""
    line = ""
    for word in text.split():
        if len(line) + len(word) > 36:
            layout.label(text=line)
            line = ""
        line = f"{line} {word}".strip()
    layout.label(text=line)
