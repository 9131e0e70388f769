"""Compares library.py of the add-on with include/qsmesh.h: sizes of structs, places of fields, values of constants.

Argument: the add-on's zip. The C compiler is asked, so what is compared is what the library's callers in C get.
"""

import ctypes
import importlib.util
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
HEADER = ROOT / "include" / "qsmesh.h"
STRUCTS = re.compile(r"typedef struct (qsm_\w+) \{(.*?)\} \1;", re.S)
FIELDS = re.compile(r"(\w+)(?:\[\w+\])?;|\(\*(\w+)\)\([^)]*\);")
CONSTANTS = re.compile(r"^#define QSM_(\w+) (\S+)$", re.M)


def main():
    text = re.sub(r"/\*.*?\*/", "", HEADER.read_text(), flags=re.S)
    structs = {name: [a or b for a, b in FIELDS.findall(body)] for name, body in STRUCTS.findall(text)}
    constants = dict(CONSTANTS.findall(text))
    with tempfile.TemporaryDirectory() as folder:
        expected = in_c(structs, constants, pathlib.Path(folder))
        zipfile.ZipFile(sys.argv[1]).extractall(folder)
        mirror = load(pathlib.Path(folder) / "qsmesh" / "library.py")
        found = in_python(mirror, structs, constants)
        differences = {key: (expected[key], found.get(key)) for key in expected if expected[key] != found.get(key)}
        if differences or not structs or not constants:
            raise SystemExit(f"the header says, and library.py: {differences}")
        check_versions(mirror, pathlib.Path(folder) / "qsmesh")
    print(f"{len(structs)} structs, {len(constants)} constants, {len(expected)} numbers agree")


def in_c(structs, constants, folder):
    """What a C program prints of the header, by name."""
    lines = [f'printf("\\"{name}\\": %zu,\\n", sizeof({name}));' for name in structs]
    for name, fields in structs.items():
        for field in fields:
            lines.append(f'printf("\\"{name}.{field}\\": [%zu, %zu],\\n", offsetof({name}, {field}), '
                         f"sizeof((({name} *)0)->{field}));")
    lines += [f'printf("\\"{name}\\": %llu,\\n", (unsigned long long)QSM_{name});' for name in constants]
    body = "\n".join(lines)
    source = folder / "sizes.c"
    source.write_text(f'#include "qsmesh.h"\n#include <stdio.h>\nint main(void) {{\nputs("{{");\n{body}\n'
                      'puts("\\"end\\": 0}");\nreturn 0; }\n')
    program = folder / "sizes"
    subprocess.run(["cc", "-I", HEADER.parent, source, "-o", program], check=True)
    answer = json.loads(subprocess.run([program], check=True, capture_output=True, text=True).stdout)
    del answer["end"]
    return answer


def in_python(mirror, structs, constants):
    """The same of library.py."""
    found = {}
    for name, fields in structs.items():
        kind = getattr(mirror, name.removeprefix("qsm_").capitalize())
        found[name] = ctypes.sizeof(kind)
        if [field for field, *_ in kind._fields_] != fields:
            raise SystemExit(f"fields of {name}: {fields}; library.py: {[field for field, *_ in kind._fields_]}")
        for field in fields:
            found[f"{name}.{field}"] = [getattr(kind, field).offset, getattr(kind, field).size]
    for name in constants:
        found[name] = getattr(mirror, name, None)
    return found


def check_versions(mirror, addon):
    """Library, manifest and bl_info bear the version of Cargo.toml."""
    version = tomllib.loads((ROOT / "Cargo.toml").read_text())["package"]["version"]
    information = re.search(r'"version": \((\d+), (\d+), (\d+)\)', (addon / "__init__.py").read_text())
    versions = {
        "library": mirror.version(),
        "manifest": tomllib.loads((addon / "blender_manifest.toml").read_text())["version"],
        "bl_info": ".".join(information.groups()),
    }
    if set(versions.values()) != {version}:
        raise SystemExit(f"Cargo.toml says {version}, others {versions}")


def load(path):
    specification = importlib.util.spec_from_file_location("library", path)
    module = importlib.util.module_from_spec(specification)
    sys.modules["library"] = module
    specification.loader.exec_module(module)
    return module


main()
