#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Fetches the source tree of a MeshLab version, vcglib included, from the archive that this Debian or Ubuntu machine
# installs from.
#
#   fetch_source.sh VERSION FOLDER [SUITE...]
#
# VERSION  upstream version, such as 2020.09
# FOLDER   is made and filled; must not be there yet
# SUITE    where to look; default: the machine's own suites
#
# The machine's package lists stay as they are: apt works in a folder of its own.
set -euo pipefail
version=$1 folder=$2
shift 2
[[ ! -e $folder ]] || { echo "$folder is there already" >&2; exit 1; }

private=$(mktemp -d)
trap 'rm -rf "$private"' EXIT
mkdir -p "$private"/{lists/partial,cache/archives/partial,parts}

. /etc/os-release
targets=$(apt-get indextargets --format '$(RELEASE) $(REPO_URI) $(COMPONENT)' 'Created-By: Packages' "Origin: ${ID^}" | sort -u)
[[ -n $targets ]] || { echo "apt knows no archive of ${ID^}: run 'apt-get update' first" >&2; exit 1; }
keyring=/usr/share/keyrings/$ID-archive-keyring.gpg
signed=
[[ ! -e $keyring ]] || signed="[signed-by=$keyring]"
while read -r suite uri component; do
    if (($# == 0)); then
        echo "deb-src $signed $uri $suite $component"
    elif [[ $suite == "$VERSION_CODENAME" ]]; then
        printf "deb-src $signed $uri %s $component\n" "$@"
    fi
done <<<"$targets" >"$private/sources.list"

options=(-o "Dir::Etc::sourcelist=$private/sources.list" -o "Dir::Etc::sourceparts=$private/parts"
    -o "Dir::State::lists=$private/lists" -o "Dir::Cache=$private/cache" -o APT::Sandbox::User=)
apt-get "${options[@]}" -qq update
found=$(apt-cache "${options[@]}" showsrc --only-source meshlab | sed -n 's/^Version: //p' | sort -u |
    grep -E "^${version//./\\.}([+~-]|\$)" | tail -n 1) ||
    { echo "no MeshLab $version in: $(awk '{print $(NF-1)}' "$private/sources.list" | xargs)" >&2; exit 1; }
# The tree alone: newer packagings ask for tools that older machines lack.
(cd "$private" && apt-get "${options[@]}" -qq source --tar-only --only-source "meshlab=$found" >&2)
mkdir -p "$private/tree"
tar -xf "$private"/meshlab_*.orig.tar.* -C "$private/tree" --strip-components=1
mkdir -p "$(dirname "$folder")"
mv "$private/tree" "$folder"
