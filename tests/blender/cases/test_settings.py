"""The redo panel has every option of the library, with the library's defaults and ranges."""

import math

import bpy
import numpy

from situation import Situation, add, ball, coordinates, part

# What the options of the library are called in the panel where the names differ.
NAMES = {"feature_angle": "use_features feature_angle", "max_deviation": "use_max_deviation max_deviation",
         "vertex_lock": "selected_only vertex_group invert_vertex_group", "triangle_mask": "selected_only",
         "feature_edges": "keep_sharp keep_seams keep_creases keep_materials keep_uv_borders"}
INTERNAL = {"struct_size", "feature_edge_count", "progress", "user", "unused"}
# What nothing in Blender stands for.
NOT_OFFERED = {"seeds", "visits", "visit_count"}


def properties(operator):
    return getattr(bpy.ops.mesh, operator).get_rna_type().properties


class Settings(Situation):
    def test_every_option_is_in_the_panel(self):
        fields = [name for name, *_ in part("library").Options._fields_ if name not in INTERNAL | NOT_OFFERED]
        tail = fields[fields.index("tail_edge_ratio") : fields.index("triangle_mask") + 1]
        for operator, wanted in (("qsmesh_smooth", set(fields) - set(tail)), ("qsmesh_improve", set(fields))):
            offered = set(properties(operator).keys())
            for name in wanted:
                self.assertLessEqual(set(NAMES.get(name, name).split()), offered, operator)
        self.assertIn("mirror", properties("qsmesh_smooth").keys())

    def test_choices_are_the_library_s(self):
        constants = vars(part("library"))
        for option in part("options").CHOICES:
            offered = [item.identifier for item in properties("qsmesh_smooth")[option].enum_items]
            known = [name.removeprefix(f"{option.upper()}_") for name in constants if name.startswith(option.upper())]
            self.assertEqual(offered, [name for name in known if name != "GIVEN"], option)

    def test_defaults_are_the_library_s(self):
        defaults = part("library").default_options()
        world = part("world_shape").WorldShape(numpy.eye(4))
        found = part("options").library_options(Defaults(), world)
        for name, *_ in part("library").Options._fields_:
            if name not in INTERNAL and not name.endswith(("lock", "edges", "mask", "seeds", "visits")):
                self.assertEqual(getattr(found, name), getattr(defaults, name), name)

    def test_every_property_explains_itself(self):
        for operator in ("qsmesh_smooth", "qsmesh_improve"):
            for name, found in properties(operator).items():
                if name != "rna_type":
                    self.assertTrue(found.description, name)

    def test_angles_and_distances_have_units(self):
        for name in ("feature_angle", "tail_min_angle", "tail_max_angle"):
            self.assertEqual(properties("qsmesh_improve")[name].unit, "ROTATION")
        self.assertEqual(properties("qsmesh_smooth")["max_deviation"].unit, "LENGTH")

    def test_angles_arrive_as_typed(self):
        for degrees in (0.1, 1, 12.5, 20, 33.3, 40, 130, 179):
            self.assertEqual(part("options").in_degrees(float(numpy.float32(math.radians(degrees)))), degrees)

    def test_numbers_arrive_as_typed(self):
        for number in (1.2, 0.1, 1e-5, 3.0, 123.456):
            self.assertEqual(part("options").as_typed(float(numpy.float32(number))), number)

    def test_operators_are_in_the_menus(self):
        for name in ("VIEW3D_MT_edit_mesh_vertices", "VIEW3D_MT_edit_mesh_clean", "VIEW3D_MT_edit_mesh_context_menu",
                     "VIEW3D_MT_object"):
            self.assertIn(part("menus")._draw, getattr(bpy.types, name).draw._draw_funcs)


class Undo(Situation):
    def test_undo_gives_the_bits_back_and_redo_takes_them_again(self):
        for operator in ("qsmesh_smooth", "qsmesh_improve"):
            positions, triangles = ball()
            add(positions, triangles, operator)
            bpy.ops.ed.undo_push(message="before")
            getattr(bpy.ops.mesh, operator)("EXEC_DEFAULT", True)
            after = coordinates(bpy.data.objects[operator])
            self.assert_some_moved(after, positions)
            bpy.ops.ed.undo()
            self.assert_same_bits(coordinates(bpy.data.objects[operator]), positions)
            bpy.ops.ed.redo()
            self.assert_same_bits(coordinates(bpy.data.objects[operator]), after)


class Defaults:
    """Every property of both operators at its default."""

    def __getattr__(self, name):
        found = properties("qsmesh_improve").get(name)
        if found is None:
            raise AttributeError(name)
        return found.default
