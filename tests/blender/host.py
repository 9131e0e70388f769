"""Runs inside a Blender, of whichever version: installs the add-on's zip as a user would, then runs the cases.

After "--": the zip, the qsmesh command, a mesh file, the way to install ("addon" or "extension"), and, if only
some cases are to run, their names, such as cases.test_smooth.
"""

import pathlib
import sys
import unittest

import bpy

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER))
sys.dont_write_bytecode = True


def install(archive, way):
    """Installs and enables the zip; returns the name of the add-on's package."""
    if way == "extension":
        bpy.ops.extensions.package_install_files(filepath=archive, repo="user_default", enable_on_install=True)
        return "bl_ext.user_default.qsmesh"
    bpy.ops.preferences.addon_install(filepath=archive)
    bpy.ops.preferences.addon_enable(module="qsmesh")
    return "qsmesh"


def main():
    archive, command, mesh_file, way, *names = sys.argv[sys.argv.index("--") + 1 :]
    import situation

    situation.ADDON = install(archive, way)
    situation.COMMAND, situation.MESH_FILE = command, mesh_file
    loader = unittest.TestLoader()
    tests = loader.loadTestsFromNames(names) if names else loader.discover(FOLDER / "cases", top_level_dir=FOLDER)
    result = unittest.TextTestRunner(stream=sys.stdout, verbosity=1).run(tests)
    print(f"Blender {bpy.app.version_string}, {way}: {result.testsRun} cases")
    if not result.wasSuccessful() or result.testsRun == 0:
        sys.exit(1)


main()
