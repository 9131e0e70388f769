"""What the user is told, and that no mesh brings Blender down."""

import bpy
import numpy

from situation import Situation, add, ball, coordinates, part, place, select


def operators():
    return bpy.ops.mesh.qsmesh_smooth, bpy.ops.mesh.qsmesh_improve


class Messages(Situation):
    def test_a_coordinate_that_is_no_number_is_named(self):
        positions, triangles = ball()
        obj = add(positions, triangles, "Statue")
        positions[12, 1] = numpy.nan
        obj.data.vertices.foreach_set("co", positions.ravel())
        for operator in operators():
            self.assert_refused("'Statue': ", operator)
            self.assert_refused("12", operator)
        self.assertTrue(numpy.array_equal(coordinates(obj), positions, equal_nan=True))

    def test_odd_meshes_do_no_harm(self):
        positions, triangles = ball(2)
        odd = {
            "nothing": (numpy.zeros((0, 3)), numpy.zeros((0, 3), dtype=int)),
            "one vertex": (numpy.zeros((1, 3)), numpy.zeros((0, 3), dtype=int)),
            "one triangle": (numpy.eye(3), [[0, 1, 2]]),
            "no area": (numpy.zeros((3, 3)), [[0, 1, 2]]),
            "three faces at an edge": (numpy.eye(5)[:, :3], [[0, 1, 2], [0, 1, 3], [1, 0, 4]]),
            "a face twice": (positions, [*triangles.tolist(), triangles[0].tolist()]),
            "a face turned": (positions, [*triangles[1:].tolist(), triangles[0, ::-1].tolist()]),
            "all in one point": (numpy.ones_like(positions), triangles),
            "huge": (positions * 1e37, triangles),
            "tiny": (positions * 1e-37, triangles),
        }
        for name, (places, polygons) in odd.items():
            with self.subTest(name):
                obj = add(places, polygons, name)
                before = coordinates(obj)
                for operator in operators():
                    self.assertEqual(operator(), {"FINISHED"})
                bpy.ops.object.mode_set(mode="EDIT")
                bpy.ops.mesh.qsmesh_smooth(selected_only=False)
                bpy.ops.mesh.qsmesh_improve(selected_only=False)
                bpy.ops.object.mode_set(mode="OBJECT")
                bpy.ops.mesh.qsmesh_measure()
                self.assertTrue(numpy.isfinite(coordinates(obj)).all())
                if name not in ("huge", "tiny", "a face twice", "a face turned"):
                    self.assert_same_bits(coordinates(obj), before.astype(numpy.float32))

    def test_why_nothing_moved(self):
        positions, triangles = ball(2)
        obj = add(positions, triangles)
        obj.data.vertices.foreach_set("hide", numpy.ones(len(positions), dtype=bool))
        figures = part("smoothing").smooth(obj, Plain(), lambda share: None)
        self.assertEqual(part("outcome").text([figures]),
                         f"No vertex of 'mesh' moved: {len(positions)} not chosen or hidden")

    def test_without_figures_the_result_and_the_faults_are_the_same(self):
        positions, triangles = ball()
        plain, quick = add(positions, triangles, "plain"), add(positions, triangles, "quick")
        select(plain)
        bpy.ops.mesh.qsmesh_smooth()
        select(quick)
        bpy.ops.mesh.qsmesh_smooth(tell_quality=False)
        self.assert_same_bits(coordinates(quick), coordinates(plain))
        positions[12, 1] = numpy.nan
        quick.data.vertices.foreach_set("co", positions.ravel())
        self.assert_refused("vertex 12", bpy.ops.mesh.qsmesh_smooth, tell_quality=False)

    def test_without_a_mesh_the_operators_are_not_offered(self):
        curve = place(bpy.data.objects.new("curve", bpy.data.curves.new("curve", "CURVE")))
        for operator in operators():
            self.assertFalse(operator.poll())
        mesh = add(*ball(1))
        select(curve, mesh)
        self.assertEqual(bpy.ops.mesh.qsmesh_smooth(), {"FINISHED"})

    def test_progress_rises_to_the_end(self):
        obj = add(*ball())
        told = []
        part("smoothing").smooth(obj, Plain(), told.append)
        self.assertEqual(told, sorted(told))
        self.assertEqual(told[-1], 1)


class Plain:
    """The operator's settings with every default, outside of the operator."""

    def __getattr__(self, name):
        properties = bpy.ops.mesh.qsmesh_smooth.get_rna_type().properties
        if name not in properties:
            raise AttributeError(name)
        found = properties[name]
        return set() if getattr(found, "is_enum_flag", False) else found.default
