"""Without its native library, or with one for another machine, the add-on still registers and says what is wrong."""

import importlib
import os
import shutil
import subprocess
import sys
import tempfile

import bpy

import situation
from situation import Situation, add, ball, coordinates, part


class Library(Situation):
    """Each case has a copy of the add-on of its own: what a process has loaded from a path, it never loads anew."""

    def setUp(self):
        super().setUp()
        self.folder = tempfile.TemporaryDirectory()
        self.name = f"spoilt_{self._testMethodName}"
        copy = os.path.join(self.folder.name, self.name)
        shutil.copytree(os.path.dirname(part("library").path()) + "/..", copy)
        self.place = os.path.join(copy, "lib", os.path.basename(part("library").path()))
        os.remove(self.place)
        sys.path.insert(0, self.folder.name)
        bpy.ops.preferences.addon_disable(module=situation.ADDON)

    def tearDown(self):
        bpy.ops.preferences.addon_disable(module=self.name)
        sys.path.remove(self.folder.name)
        self.folder.cleanup()
        bpy.ops.preferences.addon_enable(module=situation.ADDON)
        self.assertEqual(bpy.ops.mesh.qsmesh_smooth(), {"FINISHED"})

    def assert_says(self, words):
        self.assertEqual(bpy.ops.preferences.addon_enable(module=self.name), {"FINISHED"})
        self.assertEqual(importlib.import_module(f"{self.name}.library").path(), self.place)
        obj = add(*ball())
        before = coordinates(obj)
        for operator in ("qsmesh_smooth", "qsmesh_improve", "qsmesh_measure"):
            self.assert_refused(words, getattr(bpy.ops.mesh, operator))
        self.assert_same_bits(coordinates(obj), before)

    def test_a_missing_library_is_named(self):
        self.assert_says("native library is missing")

    def test_a_library_of_another_machine_is_named(self):
        with open(self.place, "wb") as file:
            file.write(b"MZ" + bytes(4096))
        self.assert_says("does not load on this machine")

    def test_a_library_without_the_functions_is_named(self):
        source = os.path.join(self.folder.name, "other.c")
        with open(source, "w") as file:
            file.write("int other(void) { return 0; }\n")
        subprocess.run(["cc", "-shared", "-fPIC", source, "-o", self.place], check=True)
        self.assert_says("does not load on this machine")
