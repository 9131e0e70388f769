"""Has Blender's own tool for extensions judge the zip's manifest, and a spoilt one, which it must refuse.

Arguments: the zip, and the virtual environment with Blender as a module.
"""

import pathlib
import subprocess
import sys
import tempfile
import zipfile


def accepted(tool, folder):
    return subprocess.run([sys.executable, tool, "validate", folder], capture_output=True, text=True)


def main():
    (tool,) = pathlib.Path(sys.argv[2]).rglob("bl_pkg/cli/blender_ext.py")
    with tempfile.TemporaryDirectory() as folder:
        zipfile.ZipFile(sys.argv[1]).extractall(folder)
        addon = pathlib.Path(folder) / "qsmesh"
        for judged in (sys.argv[1], addon):
            answer = accepted(tool, judged)
            if answer.returncode != 0:
                raise SystemExit(f"{judged}: {answer.stdout}{answer.stderr}")
        manifest = addon / "blender_manifest.toml"
        manifest.write_text(manifest.read_text().replace('id = "qsmesh"', 'id = "not an identifier"'))
        if accepted(tool, addon).returncode == 0:
            raise SystemExit("the tool accepts a manifest with a bad identifier, so its judgement is worth nothing")
    print(f"valid for {tool.parents[4].name}")


main()
