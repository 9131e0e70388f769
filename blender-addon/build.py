#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the add-on's zip for this platform, with the native library inside, and prints its path:
target/blender/qsmesh-<version>-<platform>.zip.

On Linux the library is linked for glibc 2.17 by zig, so that the zip serves every current distribution; elsewhere by
cargo alone.
"""

import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import venv
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
ADDON = ROOT / "blender-addon" / "qsmesh"
WORK = ROOT / "target" / "blender"
TOOLS = ["cargo-zigbuild==0.24.0", "ziglang==0.17.1"]
OLDEST_GLIBC = (2, 17)
# Zip files cannot date from before 1980; a fixed date makes the same zip of the same files.
ZIP_DATE = (1980, 1, 1, 0, 0, 0)


def main():
    library = build_linux() if sys.platform == "linux" else build_elsewhere()
    version = re.search(r'^version = "(.+)"', (ROOT / "Cargo.toml").read_text(), re.M).group(1)
    target = WORK / f"qsmesh-{version}-{platform_name()}.zip"
    write_zip(target, library)
    print(target)


def platform_name():
    """As Blender's extensions call it."""
    system = {"linux": "linux", "darwin": "macos", "win32": "windows"}[sys.platform]
    return f"{system}-{'arm64' if platform.machine().lower() in ('arm64', 'aarch64') else 'x64'}"


def build_linux():
    """The library for an old glibc, checked."""
    tools = tools_environment()
    triple = f"{platform.machine()}-unknown-linux-gnu"
    environment = dict(
        os.environ,
        PATH=f"{tools / 'bin'}{os.pathsep}{os.environ['PATH']}",
        CARGO_TARGET_DIR=str(WORK / "cargo"),
        CARGO_ZIGBUILD_CACHE_DIR=str(WORK / "zig-cache"),
        ZIG_GLOBAL_CACHE_DIR=str(WORK / "zig-cache"),
        ZIG_LOCAL_CACHE_DIR=str(WORK / "zig-cache"),
    )
    glibc = ".".join(map(str, OLDEST_GLIBC))
    command = ["cargo", "zigbuild", "--quiet", "--release", "--lib", "--target", f"{triple}.{glibc}"]
    subprocess.run(command, cwd=ROOT, env=environment, check=True)
    library = WORK / "cargo" / triple / "release" / "libqsmesh.so"
    check_glibc(library)
    return library


def build_elsewhere():
    """The library as cargo makes it."""
    subprocess.run(["cargo", "build", "--quiet", "--release", "--lib"], cwd=ROOT, check=True)
    return ROOT / "target" / "release" / {"darwin": "libqsmesh.dylib", "win32": "qsmesh.dll"}[sys.platform]


def tools_environment():
    """A virtual environment with the tools; made once for each choice of versions."""
    folder = WORK / "tools"
    mark = folder / "installed.txt"
    if not mark.is_file() or mark.read_text() != "\n".join(TOOLS):
        shutil.rmtree(folder, ignore_errors=True)
        venv.create(folder, with_pip=True)
        subprocess.run([folder / "bin" / "pip", "install", "--quiet", *TOOLS], check=True)
        mark.write_text("\n".join(TOOLS))
    return folder


def check_glibc(library):
    """Raises if the library asks for something newer than OLDEST_GLIBC."""
    symbols = subprocess.run(["objdump", "-T", library], check=True, capture_output=True, text=True).stdout
    wanted = {tuple(map(int, text.split("."))) for text in re.findall(r"GLIBC_([0-9.]+)", symbols)}
    if not wanted or max(wanted) > OLDEST_GLIBC:
        raise SystemExit(f"{library} wants glibc {max(wanted, default='?')}, not {OLDEST_GLIBC} or older")


def write_zip(target, library):
    """Everything in one folder, as every version of Blender takes it; written beside its place and renamed."""
    files = {path.relative_to(ADDON): path.read_bytes() for path in sorted(ADDON.rglob("*")) if wanted(path)}
    files[pathlib.PurePath("blender_manifest.toml")] += f'platforms = ["{platform_name()}"]\n'.encode()
    files[pathlib.PurePath("lib") / library.name] = library.read_bytes()
    WORK.mkdir(parents=True, exist_ok=True)
    with tempfile.NamedTemporaryFile(dir=WORK, suffix=".zip", delete=False) as unfinished:
        with zipfile.ZipFile(unfinished, "w", zipfile.ZIP_DEFLATED) as archive:
            for path, content in files.items():
                entry = zipfile.ZipInfo(f"qsmesh/{path.as_posix()}", ZIP_DATE)
                entry.external_attr = 0o644 << 16
                archive.writestr(entry, content, zipfile.ZIP_DEFLATED)
    os.chmod(unfinished.name, 0o644)
    os.replace(unfinished.name, target)


def wanted(path):
    """Sources, licence and manifest; nothing that Python or an earlier build has left."""
    return path.is_file() and path.suffix in {".py", ".toml", ""} and "lib" not in path.relative_to(ADDON).parts


if __name__ == "__main__":
    main()
