"""A result in Blender is the command's for the same options, on a real mesh."""

import json
import os
import subprocess
import tempfile

import bpy
import numpy

import ply
import situation
from situation import Situation, add, coordinates, edit_and_back, faces


def real_mesh():
    return ply.read(situation.MESH_FILE)


def command(positions, triangles, *arguments):
    """Positions, triangles and report that the command makes of a mesh."""
    with tempfile.TemporaryDirectory() as folder:
        source, target = os.path.join(folder, "in.ply"), os.path.join(folder, "out.ply")
        ply.write(source, positions, triangles)
        call = [situation.COMMAND, *arguments, source, "-o", target, "--json"]
        done = subprocess.run(call, check=True, capture_output=True, text=True)
        return *ply.read(target), json.loads(done.stdout)


def in_order(triangles):
    """The same triangles, in an order that depends on nothing else."""
    return triangles[numpy.lexsort(triangles.T)]


class Command(Situation):
    def test_smooth_with_defaults_gives_the_same_bits(self):
        positions, triangles = real_mesh()
        obj = add(positions, triangles)
        self.assertEqual(bpy.ops.mesh.qsmesh_smooth(), {"FINISHED"})
        expected, _, report = command(positions, triangles, "smooth")
        self.assert_same_bits(coordinates(obj), expected)
        self.assertEqual(report["moved"], (expected != positions).any(axis=1).sum())

    def test_smooth_with_every_option_changed_gives_the_same_bits(self):
        positions, triangles = real_mesh()
        obj = add(positions, triangles)
        size = float(numpy.ptp(positions))
        distance = float(numpy.float32(f"{size / 400:.3g}"))
        bpy.ops.mesh.qsmesh_smooth(
            iterations=3, relaxation=1.1, plane="LEAST_SQUARES", ideal="EQUILATERAL", feature_angle=numpy.radians(40),
            use_max_deviation=True, max_deviation=distance, quality_floor=0.4, interval_width=0.3, sample_limit=4,
            order="INDEX", boundary="SLIDE", threads=1,
        )
        expected, _, _ = command(
            positions, triangles, "smooth", "--iterations=3", "--relaxation=1.1", "--plane=least-squares",
            "--ideal=equilateral", "--feature-angle=40", f"--max-deviation={situation.as_typed(distance)}",
            "--quality-floor=0.4", "--interval-width=0.3", "--sample-limit=4", "--order=index", "--boundary=slide",
        )
        self.assert_some_moved(positions, expected)
        self.assert_same_bits(coordinates(obj), expected)

    def test_methods_metrics_and_orders_give_the_same_bits(self):
        positions, triangles = real_mesh()
        choices = (
            ({"metric": "SHAPE", "keep_sizes": True, "order": "TAIL"}, ["--metric=shape", "--keep-sizes", "--order=tail"]),
            ({"method": "TANGENTIAL_LAPLACIAN", "order": "WAVE"}, ["--method=tangential-laplacian", "--order=wave"]),
        )
        for options, arguments in choices:
            with self.subTest(options=options):
                obj = add(positions, triangles)
                bpy.ops.mesh.qsmesh_smooth(**options)
                expected, _, _ = command(positions, triangles, "smooth", *arguments)
                self.assert_some_moved(positions, expected)
                self.assert_same_bits(coordinates(obj), expected)

    def test_features_off_is_the_command_s_off(self):
        positions, triangles = real_mesh()
        obj = add(positions, triangles)
        bpy.ops.mesh.qsmesh_smooth(use_features=False, iterations=1)
        expected, _, _ = command(positions, triangles, "smooth", "--feature-angle=off", "--iterations=1")
        self.assert_same_bits(coordinates(obj), expected)

    def test_improve_gives_the_same_vertices_and_triangles(self):
        positions, triangles = real_mesh()
        obj = add(positions, triangles)
        options = {"tail_edge_ratio": 2.6, "tail_min_angle": numpy.radians(30), "tail_max_angle": numpy.radians(115)}
        self.assertEqual(bpy.ops.mesh.qsmesh_improve(use_features=False, flips=True, **options), {"FINISHED"})
        expected, expected_triangles, report = command(
            positions, triangles, "improve", "--feature-angle=off", "--tail-edge-ratio=2.6", "--tail-min-angle=30",
            "--tail-max-angle=115", "--flips",
        )
        self.assertLess(len(expected), len(positions), "the tail of this mesh asks for no removal")
        self.assert_same_bits(coordinates(obj), expected)
        # The command sorts triangles by the faces that its file keeps; corners stay in their order.
        self.assert_same_bits(in_order(faces(obj)), in_order(expected_triangles))

    def test_edit_mode_gives_the_same_bits(self):
        positions, triangles = real_mesh()
        obj = add(positions, triangles)
        edit_and_back(bpy.ops.mesh.qsmesh_smooth, selected_only=False)
        expected, _, _ = command(positions, triangles, "smooth")
        self.assert_same_bits(coordinates(obj), expected)
