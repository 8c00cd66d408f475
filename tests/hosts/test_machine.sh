#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What filter_ricci/scripts/machine.sh says where something is missing is the reason: with an archive in
# the place of Debian's that cannot be reached, lacks the package, or breaks off; and without a compiler.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# shellcheck source=../../filter_ricci/scripts/machine.sh
source "$here/../../filter_ricci/scripts/machine.sh"
mkdir -p "$folder/bin" "$folder/tree/meshlab"
PATH=$folder/bin:$PATH
export archive

# program NAME: its text comes from the standard input.
program() {
	{ echo '#!/bin/bash'; cat; } >"$folder/bin/$1"
	chmod +x "$folder/bin/$1"
}

# $archive: unreachable, without, breaking, torn or whole.
program apt-get <<'END'
case "$* " in
*indextargets*) echo archive ;;
*" update "*) [ "$archive" = unreachable ] || touch "$SOURCES/apt/lists/archive_Sources" ;;
"install "*)
	case $archive in
	unreachable) echo "Err:1 archive one. Temporary failure resolving 'archive'" ;;
	without) echo 'E: Unable to locate package' ;;
	esac
	[ "$archive" = whole ]
	exit
	;;
*" source "*)
	case $archive in
	torn) echo torn >meshlab_2020.09.orig.tar.xz ;;
	whole) tar -czf meshlab_2020.09.orig.tar.gz -C "$SOURCES/../../tree" meshlab ;;
	esac
	;;
esac
[ "$archive" != unreachable ]
END
program apt-cache <<'END'
[ "$archive" = unreachable ] || [ "$archive" = without ] || echo 'Version: 2020.09+dfsg1-2'
END

program dpkg-query </dev/null
program sudo <<'END'
while [ "$1" = -n ]; do shift; done
exec "$@"
END

# installed ARCHIVE TEXT...: what is said of two packages, a line each.
installed() {
	archive=$1
	build=$folder/$archive
	mkdir -p "$build"
	shift
	diff <(install_packages one two) <(printf '%s\n' 'Installing: one two' "$@") ||
		{ echo "FAILED: $archive: another reason is given"; exit 1; }
}

installed unreachable 'apt-get update reported a problem; see build/apt.log.' \
	"SKIPPED: installing packages: Debian's archive cannot be reached; see build/apt.log. Please install: one two"
installed without "SKIPPED: package one: Debian's archive has no such package; see build/apt.log" \
	"SKIPPED: package two: Debian's archive has no such package; see build/apt.log"
installed breaking "SKIPPED: package one could not be installed; see build/apt.log" \
	"SKIPPED: package two could not be installed; see build/apt.log"
installed whole

# fetched ARCHIVE TEXT
fetched() {
	archive=$1
	build=$folder/$archive
	export SOURCES=$build/sources
	mkdir -p "$SOURCES"
	fetch_sources meshlab-2020.09 >"$folder/said"
	grep -q "$2" "$folder/said" || { echo "FAILED: $archive: $(cat "$folder/said")"; exit 1; }
}

fetched unreachable "SKIPPED: meshlab-2020.09: Debian's archive cannot be reached"
fetched without "SKIPPED: meshlab-2020.09: Debian's archive has no such source package"
fetched breaking "SKIPPED: meshlab-2020.09: Debian's source package cannot be downloaded"
fetched torn "SKIPPED: meshlab-2020.09: Debian's source package cannot be unpacked: tar: "
fetched whole "meshlab-2020.09: fetching"
[ -d "$SOURCES/meshlab-2020.09" ] || { echo "FAILED: nothing was unpacked"; exit 1; }

# The demonstration, elsewhere, with an archive from which nothing comes.
archive=unreachable
cp -r "$here/../../filter_ricci" "$folder/"
if CXX=no-such-compiler bash "$folder/filter_ricci/demo.sh" >"$folder/said" 2>&1; then
	echo "FAILED: the demonstration goes on without a compiler"
	exit 1
fi
grep -q 'Not installed: no-such-compiler' "$folder/said" || { cat "$folder/said"; exit 1; }
! grep -q "MeshLab's headers" "$folder/said" || { echo "FAILED: it fetches sources before it says so"; exit 1; }
echo "Every reason is the true one"
