# SPDX-License-Identifier: GPL-3.0-or-later
"""Which objects an operator works on."""


def objects(context):
    """Meshes in Edit Mode, or else selected ones; of objects that share a mesh the active one, or else the first."""
    editing = context.mode == "EDIT_MESH"
    layer = context.view_layer.objects
    wanted = [obj for obj in layer if obj.mode == "EDIT"] if editing else list(layer.selected)
    meshes = [obj for obj in wanted if obj.type == "MESH"]
    meshes.sort(key=lambda obj: obj != layer.active)
    found = {}
    for obj in meshes:
        found.setdefault(obj.data.name_full, obj)
    return list(found.values())


def linked(obj):
    """What to tell the user of an object whose mesh belongs to another file, or None."""
    if obj.data.library is None:
        return None
    return f"The mesh of '{obj.name}' is linked from another file: make it local to change it"
