#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# window_newer.sh BUILD_DIR FOLDER [VERSION]: the filter in the real window of MeshLab 2025.07 (the
# default) or 2022.02, which Debian 12 does not have: a newer Debian is unpacked into FOLDER (1 GB,
# some minutes; kept for the next time, one folder for each version) and MeshLab runs inside. For a
# person to start, as root; it is not a part of tests/run.sh. Leaves pictures in BUILD_DIR/pictures;
# window_2022.png and window_2025.png of them are those in screenshots/. Exit 77: it cannot run on this machine.
set -euo pipefail
build=$(cd "${1:?usage: window_newer.sh BUILD_DIR FOLDER [VERSION]}" && pwd)
mkdir -p "${2:?usage: window_newer.sh BUILD_DIR FOLDER [VERSION]}"
folder=$(cd "$2" && pwd)
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
version=${3:-2025.07}
case $version in
2022.02) suite=trixie needs=(libmpfr6 libxerces-c3.2t64) ;;
2025.07) suite=forky needs=() ;;
*) echo "VERSION is 2022.02 or 2025.07"; exit 2 ;;
esac
plugin=$build/meshlab-$version/libfilter_ricci.so
# The second line and what the version needs: a plugin of MeshLab's own that cannot be loaded stops
# the start with a box.
packages=(meshlab xvfb openbox xdotool libgl1-mesa-dri imagemagick fonts-dejavu-core
	lib3ds-1-3 libgomp1 libmuparser2v5 libopenctm1 libqhull-r8.0 "${needs[@]}")

give_up() {
	echo "SKIPPED: $*"
	exit 77
}

inside() {
	chroot "$folder/debian" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
		DEBIAN_FRONTEND=noninteractive "$@"
}

mount_all() {
	mount -t proc proc "$folder/debian/proc"
	mount -t tmpfs tmpfs "$folder/debian/dev/shm"
}

unmount_all() {
	umount "$folder/debian/proc" "$folder/debian/dev/shm" 2>/dev/null || true
}

unpack_debian() {
	local mirror
	mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Label: Debian' \
		'Component: main' | head -n 1)
	[ -n "$mirror" ] || give_up "this machine names no Debian archive"
	echo "Unpacking a newer Debian into $folder/debian"
	debootstrap --variant=minbase "$suite" "$folder/debian" "$mirror" sid >"$folder/debootstrap.log" 2>&1 ||
		give_up "debootstrap failed; see $folder/debootstrap.log"
	echo "deb [check-valid-until=no] $mirror $suite main" >"$folder/debian/etc/apt/sources.list"
	cp /etc/resolv.conf /etc/hosts "$folder/debian/etc/"
}

install_meshlab() {
	{ inside apt-get update -q && inside apt-get install -q -y --no-install-recommends "${packages[@]}"; } \
		>"$folder/apt.log" 2>&1 || give_up "MeshLab could not be installed; see $folder/apt.log"
}

stage() {
	local work=$folder/debian/ricci
	rm -rf "$work"
	mkdir -p "$work"
	cp "$here/../../filter_ricci/scripts/window.sh" "$here/window_newer_inside.sh" \
		"$here/../../filter_ricci/samples/automatic.mlx" "$plugin" "$work/"
	python3 "$here/../../filter_ricci/demo/checkerboard.py" "$work/checkerboard.png"
	(cd "$here" && python3 -c "import meshes, textures
torus = meshes.torus()
wedges = textures.shattered(torus.faces)
textures.write_png('$work/old.png', textures.painted(torus, wedges, 256))
textures.write_ply('$work/textured.ply', torus, wedges, ['old.png'])
meshes.write_ply('$work/torus.ply', meshes.torus())
meshes.name_texture('$work/torus.ply', 'checkerboard.png')
meshes.write_ply('$work/line.ply', meshes.line())
meshes.write_ply('$work/double_torus.ply', meshes.double_torus())
meshes.name_texture('$work/double_torus.ply', 'checkerboard.png')")
}

[ "$(id -u)" -eq 0 ] || give_up "root is needed to enter another system"
command -v debootstrap >/dev/null || give_up "debootstrap is not installed"
[ -f "$plugin" ] || give_up "the plugin for MeshLab $version is not built"
[ -d "$folder/debian/usr" ] || unpack_debian
trap unmount_all EXIT
unmount_all
mount_all
inside dpkg-query -W meshlab 2>/dev/null | grep -q "$version" || install_meshlab
inside dpkg-query -W meshlab | grep -q "$version" || give_up "that Debian has another MeshLab by now"
stage
status=0
inside bash /ricci/window_newer_inside.sh "$version" || status=$?
mkdir -p "$build/pictures"
cp "$folder"/debian/ricci/*.png "$build/pictures/" 2>/dev/null || true
exit $status
