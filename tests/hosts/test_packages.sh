#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# test_packages.sh BUILD_DIR: what a person installs is complete, needs only what its host brings, and
# can be taken back; packed twice it is the same, byte for byte. Exit 77: CPack is missing.
set -euo pipefail
build=$(cd "${1:?usage: test_packages.sh BUILD_DIR}" && pwd)
folder=$(mktemp -d)
name=meshlab-filter-ricci

fail() {
	echo "FAILED: $*"
	exit 1
}

# An installation that the user made from this build folder must stay known to "uninstall".
put_manifests_away() {
	mkdir "$folder/manifests"
	mv "$build"/install_manifest*.txt "$folder/manifests/" 2>/dev/null || true
}

finish() {
	rm -f "$build"/install_manifest*.txt
	mv "$folder"/manifests/* "$build/" 2>/dev/null || true
	rm -rf "$folder"
}

hosts() {
	local host
	for host in meshlab-2020.09 meshlab-2022.02 meshlab-2025.07 pymeshlab-2025.7; do
		[ ! -f "$build/$host/libfilter_ricci.so" ] || echo "$host"
	done
}

check_folder() {
	local file kind=mlx
	[[ $2 != pymeshlab* ]] || kind=py
	for file in libfilter_ricci.so INSTALL.txt LICENSE copyright; do
		[ -s "$1/$2/$file" ] || fail "$1/$2 has no $file"
	done
	compgen -G "$1/$2/samples/*.$kind" >/dev/null || fail "$1/$2 has no samples"
	check_needs "$1/$2/libfilter_ricci.so"
	check_symbols "$1/$2/libfilter_ricci.so"
}

check_needs() {
	local allowed='lib(meshlab-common|Qt5(Widgets|Gui|Core|Xml|OpenGL|Network)|stdc\+\+|m|gcc_s|c|gomp)\.so'
	readelf -d "$1" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' | grep -Ev "^$allowed|^ld-linux" &&
		fail "$1 needs a library that its host may not have"
	readelf -d "$1" | grep -E 'RPATH|RUNPATH' && fail "$1 looks for libraries in a folder of this machine"
	return 0
}

# A solver inside the plugin must not meet another one in the host's process: none of its names may be
# defined for others or asked from them. Nor may its C library be newer than that of Ubuntu 22.04.
check_symbols() {
	nm -D "$1" >"$folder/symbols"
	grep -E ' ((cholmod|amd|colamd|SuiteSparse|METIS|GOMP|omp|openblas)_|[dz][a-z]+_$)' \
		"$folder/symbols" && fail "$1 shares the names of a solver with its host"
	nm -D --defined-only "$1" |
		grep -vE ' [WVu] | (qt_plugin_instance|qt_plugin_query_metadata|filter_ricci_description|filter_ricci_listen|__bss_start|_edata|_end)$' &&
		fail "$1 defines names for its host"
	local newest
	newest=$(sed -n 's/.*@GLIBC_\([0-9.]*\)$/\1/p' "$folder/symbols" | sort -uV | tail -n 1)
	[ "$(printf '%s\n' "$newest" 2.35 | sort -V | tail -n 1)" = 2.35 ] || fail "$1 needs glibc $newest"
}

check_install() {
	cmake --install "$build" --prefix "$folder/prefix" >"$folder/log" || fail "cmake --install"
	local host
	for host in $(hosts); do check_folder "$folder/prefix" "$host"; done
	uninstall
	nothing_left "$folder/prefix"
}

check_system_install() {
	[ -f "$build/meshlab-2020.09/libfilter_ricci.so" ] || return 0
	export DESTDIR=$folder/root
	cmake --install "$build" --prefix /usr --component system >"$folder/log" || fail "cmake --install"
	compgen -G "$DESTDIR/usr/lib/*/meshlab/plugins/libfilter_ricci.so" >/dev/null ||
		fail "the plugin is not in MeshLab's folder"
	uninstall
	nothing_left "$DESTDIR"
	unset DESTDIR
}

# No file, and no folder of ours; MeshLab's own stay.
nothing_left() {
	local left
	left=$(find "$1" -type f -o -name 'meshlab-*' -o -name 'pymeshlab-*' -o -name ricci -o -name vcg)
	[ -z "$left" ] || fail "uninstall leaves $left"
}

uninstall() {
	cmake "-DBUILD_DIR=$build" -P "$here/../../filter_ricci/packaging/uninstall.cmake" >"$folder/log" ||
		fail "uninstall"
}

pack() {
	(cd "$folder" && cpack --config "$build/CPackConfig.cmake" -B "$folder/$1" >"$folder/log" 2>&1) ||
		{ tail -n 20 "$folder/log"; fail "cpack"; }
}

check_packages() {
	local host archive
	pack packages
	sleep 2 # the time is not in them
	pack again
	for archive in "$folder"/packages/*.*; do
		[ -d "$archive" ] || cmp "$archive" "$folder/again/${archive##*/}" || fail "packing is not reproducible"
	done
	for host in $(hosts); do
		archive=$(compgen -G "$folder/packages/$name-*-$host-*.tar.gz") || fail "no archive for $host"
		tar -xzf "$archive" -C "$folder"
		check_folder "$folder" "$host"
	done
	grep -q 'CPACK_GENERATOR "TGZ;DEB"' "$build/CPackConfig.cmake" || return 0
	check_deb "$(compgen -G "$folder/packages/$name"_*.deb)"
}

check_deb() {
	dpkg-deb -f "$1" Depends | tee "$folder/depends"
	local wanted
	for wanted in 'meshlab (>= 2020.09)' 'meshlab (<< 2020.10)' libqt5widgets5 libstdc++6; do
		grep -qF "$wanted" "$folder/depends" || fail "the .deb does not depend on $wanted"
	done
	[[ $(dpkg-deb -f "$1" Description) == *'Flattens triangle meshes'* ]] ||
		fail "the .deb does not say what it is"
	dpkg-deb -c "$1" >"$folder/content"
	grep -q '/usr/lib/[^/]*/meshlab/plugins/libfilter_ricci.so$' "$folder/content" || fail "the .deb has no plugin"
	for wanted in CHANGELOG.md README.md copyright; do
		grep -q "/usr/share/doc/$name/$wanted\$" "$folder/content" || fail "the .deb has no $wanted"
	done
	dpkg-deb --fsys-tarfile "$1" | tar -xO "./usr/share/doc/$name/copyright" >"$folder/copyright"
	for wanted in 'Copyright: .*generalized_ricci_flow authors' 'Copyright: .*Eigen' 'Comment: vcglib' 'GPL-3+' 'MPL-2.0'; do
		grep -q "$wanted" "$folder/copyright" || fail "the copyright file does not name $wanted"
	done
}

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
command -v cpack >/dev/null || { echo "SKIPPED: cpack is not installed"; exit 77; }
[ -n "$(hosts)" ] || { echo "SKIPPED: no plugin is built"; exit 77; }
trap finish EXIT
put_manifests_away
check_install
check_system_install
check_packages
echo "Installed, packed and removed again: $(hosts | tr '\n' ' ')"
