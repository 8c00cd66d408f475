#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Unpacks the meshes of Debian's package libcgal-demo into FOLDER/data/meshes. Their licences vary,
# so they are not in the repository. Exit status 77 and the reason if they cannot be had.
set -euo pipefail

folder=$(realpath -m "${1:?usage: unpack_cgal_meshes.sh FOLDER}")
[ -d "$folder/data/meshes" ] && exit 0

skip() {
	echo "SKIPPED: $1"
	exit 77
}
for tool in apt-get dpkg tar; do
	command -v "$tool" > /dev/null || skip "there is no $tool on this machine"
done
mkdir -p "$folder"
work=$(mktemp -d "$folder/unpack.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"
timeout 120 apt-get download libcgal-demo > apt.log 2>&1 ||
	skip "apt-get cannot download libcgal-demo: $(tail -n 1 apt.log)"
dpkg -x libcgal-demo_*.deb package
data=$(find package/usr/share/doc -name data.tar.gz | head -n 1)
[ -n "$data" ] || skip "this version of libcgal-demo has no data.tar.gz"
tar -xzf "$data"
[ -d data/meshes ] || skip "this version of libcgal-demo has no data/meshes"
mv data "$folder/"
