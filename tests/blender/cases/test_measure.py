"""The sidebar's figures, its histogram, and quality as an attribute."""

import bpy
import numpy

from situation import Situation, add, ball, coordinates, edit_and_back, grid, part

WORST = {"EDGE_RATIO": "max", "MIN_ANGLE": "min", "MAX_ANGLE": "max", "SHAPE": "min", "RADIUS_RATIO": "max"}


class Measure(Situation):
    def setUp(self):
        super().setUp()
        self.positions, self.triangles = ball()
        self.obj = add(self.positions, self.triangles)
        self.figures = part("library").measure(self.positions, self.triangles.astype(numpy.uint32))

    def test_figures_are_the_library_s(self):
        for call in (bpy.ops.mesh.qsmesh_measure, lambda: edit_and_back(bpy.ops.mesh.qsmesh_measure)):
            part("measure_operator").last_figures = None
            self.assertEqual(call(), {"FINISHED"})
            found = part("measure_operator").last_figures
            rows = {name: cells for name, *cells in part("measuring").figure_rows(found)}
            self.assertEqual(float(rows["Edge Ratio"][0]), round(self.figures.edge_ratio.mean, 3))
            self.assertEqual(rows["Min Angle"][1], f"{self.figures.min_angle.min:.1f}°")
            self.assertEqual(rows["Max Angle"][1], f"{self.figures.max_angle.max:.1f}°")
            self.assertEqual(dict(part("measuring").count_rows(found))["Triangles"], f"{len(self.triangles):,}")

    def test_the_histogram_counts_every_triangle(self):
        for parameter in WORST:
            bpy.ops.mesh.qsmesh_measure(parameter=parameter)
            found = part("measure_operator").last_figures
            self.assertEqual(sum(found.counts), len(self.triangles))
            lines = part("measuring").histogram_rows(found)
            self.assertEqual(max(len(bar) for _, bar, _ in lines), part("measuring").BAR)
            self.assertEqual([len(bar) > 0 for _, bar, _ in lines], [count > 0 for count in found.counts])

    def test_the_attribute_holds_the_library_s_values(self):
        for parameter, worst in WORST.items():
            for call in (bpy.ops.mesh.qsmesh_write_quality, lambda **options: edit_and_back(
                    bpy.ops.mesh.qsmesh_write_quality, **options)):
                call(parameter=parameter)
                values = self.values(parameter)
                expected = getattr(self.figures, parameter.lower())
                self.assertAlmostEqual(float(values.mean(dtype=numpy.float64)), expected.mean, places=4)
                self.assertAlmostEqual(float(getattr(values, worst)()), getattr(expected, worst), places=4)
                self.obj.data.attributes.remove(self.obj.data.attributes[f"qsmesh_{parameter.lower()}"])
        self.assert_same_bits(coordinates(self.obj), self.positions)

    def test_it_is_written_again_in_place(self):
        bpy.ops.mesh.qsmesh_write_quality()
        first = self.values("EDGE_RATIO")
        bpy.ops.mesh.qsmesh_smooth()
        bpy.ops.mesh.qsmesh_write_quality()
        self.assertLess(self.values("EDGE_RATIO").mean(), first.mean())
        self.assertEqual(len([name for name in self.obj.data.attributes.keys() if name.startswith("qsmesh")]), 1)

    def test_of_a_larger_face_the_worst_triangle_counts(self):
        positions, quads, _ = grid()
        self.obj = add(positions, quads)
        self.obj.data.calc_loop_triangles()
        drawn = numpy.array([tuple(found.vertices) for found in self.obj.data.loop_triangles], dtype=numpy.uint32)
        of_face = numpy.array([found.polygon_index for found in self.obj.data.loop_triangles])
        bpy.ops.mesh.qsmesh_write_quality(parameter="SHAPE")
        each = part("library").triangle_quality(positions, drawn, part("library").SHAPE)
        expected = [each[of_face == face].min() for face in range(len(quads))]
        self.assert_same_bits(self.values("SHAPE"), numpy.array(expected, dtype=numpy.float32))

    def values(self, parameter):
        found = numpy.empty(len(self.obj.data.polygons), dtype=numpy.float32)
        self.obj.data.attributes[f"qsmesh_{parameter.lower()}"].data.foreach_get("value", found)
        return found


class Degenerate(Situation):
    def test_a_triangle_without_area_has_the_worst_values(self):
        add([(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 0, 0)], [(0, 1, 2)])
        value = part("library").triangle_quality
        positions = numpy.array([(0, 0, 0), (1, 0, 0), (2, 0, 0)], dtype=numpy.float32)
        library = part("library")
        for parameter, expected in ((library.SHAPE, 0), (library.MIN_ANGLE, 0), (library.MAX_ANGLE, 180),
                                    (library.RADIUS_RATIO, numpy.inf), (library.EDGE_RATIO, 2)):
            self.assertEqual(value(positions, numpy.array([[0, 1, 2]], dtype=numpy.uint32), parameter)[0], expected)
        point = numpy.zeros((3, 3), dtype=numpy.float32)
        self.assertEqual(value(point, numpy.array([[0, 1, 2]], dtype=numpy.uint32), library.EDGE_RATIO)[0], numpy.inf)
