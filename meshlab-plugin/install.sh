#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the plugin for the MeshLab that is installed on this Debian or Ubuntu machine, and installs it there. MeshLab
# shows it after a restart under Filters, Smoothing, Fairing and Deformation.
#
#   meshlab-plugin/install.sh
#
# With DESTDIR set the plugin goes into that folder instead of the system.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
work=${CARGO_TARGET_DIR:-$here/../target}/meshlab

installed=$(dpkg-query -W -f '${Version}' meshlab 2>/dev/null) || { echo "MeshLab is not installed: apt-get install meshlab" >&2; exit 1; }
version=${installed%%[+~-]*}
missing=()
for package in cmake make g++ qtbase5-dev libqt5opengl5-dev libglew-dev libeigen3-dev xz-utils; do
    [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) == installed ]] || missing+=("$package")
done
if ((${#missing[@]})); then
    echo "Building the plugin needs: apt-get install ${missing[*]}" >&2
    exit 1
fi
command -v cargo >/dev/null || { echo "Building the plugin needs a Rust toolchain" >&2; exit 1; }

source=$work/source-$version
[[ -e $source ]] || "$here/fetch_source.sh" "$version" "$source"
build=$work/build-installed
cmake -S "$here" -B "$build" -DMESHLAB_SOURCE_DIR="$source"
cmake --build "$build"
plugins=$(sed -n 's/^QSMESH_PLUGIN_FOLDER:.*=//p' "$build/CMakeCache.txt")
if [[ -z ${DESTDIR:-} && ! -w $plugins ]]; then
    echo "The plugin is $build/libfilter_qsmesh.so. To install it:"
    echo "    sudo cmake --install $build"
    exit 0
fi
cmake --install "$build"
