#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Unwraps a sample mesh on a fresh Debian 12 machine: installs what is missing, builds the plugin, has stock
# MeshLab build a torus-like surface with marching cubes, runs the filter on it in stock meshlabserver and in
# PyMeshLab, and leaves a textured OBJ and a picture in build/demo/.
set -euo pipefail
# shellcheck source=scripts/machine.sh
source "$(dirname "${BASH_SOURCE[0]}")/scripts/machine.sh"
# shellcheck source=scripts/window.sh
source "$root/filter_ricci/scripts/window.sh"

files=$root/filter_ricci/demo
demo=$build/demo
name="Generalized Ricci Flow (Euclidean)"
table=()

meshlabserver_in_demo() {
	(cd "$demo" && HOME=$demo/home XDG_RUNTIME_DIR=$demo/home xvfb-run -a "$stage/bin/meshlabserver" "$@")
}

# Sets stage to a private copy of the installed MeshLab with the plugin, or to nothing.
stage_meshlab() {
	stage=
	stage=$(bash "$root/filter_ricci/scripts/stage_meshlab_2020.sh" "$build") || stage=
	if [ -n "$stage" ] && ! command -v xvfb-run >/dev/null; then
		skipped "meshlabserver: it needs a display, and xvfb-run is not installed"
		stage=
	fi
}

make_mesh() {
	if [ -n "$stage" ] && meshlabserver_in_demo -s "$files/torus_like.mlx" -o mesh.ply \
		>"$demo/mesh.log" 2>&1 && [ -f "$demo/mesh.ply" ]; then
		echo "MeshLab made build/demo/mesh.ply (marching cubes, filter Implicit Surface)."
	elif [ -x "$build/venv/bin/python" ] && "$build/venv/bin/python" "$files/make_mesh.py" \
		"$files/torus_like.mlx" "$demo/mesh.ply" >"$demo/mesh.log" 2>&1; then
		echo "PyMeshLab made build/demo/mesh.ply (marching cubes, filter Implicit Surface)."
	else
		skipped "everything: neither MeshLab nor PyMeshLab could make a mesh; see build/demo/mesh.log"
		exit 1
	fi
}

run_in_meshlabserver() {
	[ -n "$stage" ] || return 0
	local log=$demo/meshlabserver.log
	meshlabserver_in_demo -i mesh.ply -o textured.ply -m wt vq vc -s "$files/checkerboard.mlx" \
		>"$log" 2>/dev/null || { echo "FAILED: meshlabserver; see build/demo/meshlabserver.log"; return 1; }
	[ -f "$demo/textured.ply" ] || { echo "FAILED: meshlabserver saved nothing"; return 1; }
	grep -oE '\([0-9]+ vn [0-9]+ fn\)' "$log" | tail -n 1 |
		sed -E 's/\(([0-9]+) vn ([0-9]+) fn\)/V=\1\nF=\2/' >"$demo/meshlabserver.txt"
	grep -E '^(Result|Surface): ' "$log" | tail -n 2 | sed 's/^[^:]*: //' | tr ' ' '\n' \
		>>"$demo/meshlabserver.txt"
	add_to_table "meshlabserver 2020.09" "$demo/meshlabserver.txt"
	meshlabserver_in_demo -i textured.ply -o textured.obj -m wt vc >>"$log" 2>/dev/null &&
		[ -f "$demo/textured.obj" ] || { echo "FAILED: no textured OBJ"; return 1; }
	echo "Textured: build/demo/textured.obj, textured.obj.mtl, checkerboard.png"
}

run_in_pymeshlab() {
	local plugin=$build/pymeshlab-2025.7/libfilter_ricci.so
	if [ ! -f "$plugin" ]; then
		skipped "PyMeshLab: the plugin is not built"
	elif ! "$build/venv/bin/python" -c 'import pymeshlab' 2>/dev/null; then
		skipped "PyMeshLab: it is not in build/venv"
	elif "$build/venv/bin/python" "$files/run_pymeshlab.py" "$plugin" "$demo/mesh.ply" \
		"$demo/pymeshlab.ply" >"$demo/pymeshlab.txt"; then
		add_to_table "PyMeshLab 2025.7" "$demo/pymeshlab.txt"
	else
		echo "FAILED: PyMeshLab"
		return 1
	fi
}

value() {
	sed -n "s/^$1=//p" "$2"
}

add_to_table() {
	local row key
	printf -v row '%-22s' "$1"
	for key in V F iterations max_curvature_error qc_mean qc_vertex_mean qc_max flipped_faces; do
		printf -v row '%s %14.9s' "$row" "$(value "$key" "$2" | short_number)"
	done
	table+=("$row")
}

short_number() {
	local number
	read -r number
	case $number in
	*[.e]*) printf '%.4g\n' "$number" ;;
	*) printf '%s\n' "$number" ;;
	esac
}

# The textured result in the real window, after one more run from the filter's dialog.
make_picture() {
	[ -n "$stage" ] || return 0
	local needed
	needed=$(window_needs) || { skipped "picture: $needed"; return 0; }
	(
		cd "$demo"
		trap close_display EXIT
		open_display "$demo/display" || { skipped "picture: no display could be opened"; exit 0; }
		show_result || { echo "FAILED: $problem; see build/demo/display/meshlab.log"; exit 1; }
	) || return 1
	[ ! -f "$demo/window.png" ] || echo "Picture: build/demo/window.png"
}

show_result() {
	problem="MeshLab's window did not open"
	open_meshlab "$stage/bin/meshlab" textured.ply || return 1
	tilt_and_move_aside
	problem="the filter's dialog did not open"
	open_filter "$name" || return 1
	problem="the filter did not run in the window"
	press_apply "$name"
	wait_until 120 grep -q 'Result: converged=true' "$meshlab_log" || return 1
	sleep 2
	picture "$demo/window.png"
}

mkdir -p "$build/sources"
say "Packages"
install_packages "${packages_build[@]}" "${packages_meshlab[@]}" "${packages_python[@]}"
require_build_tools
say "MeshLab's headers"
fetch_sources meshlab-2020.09 meshlab-2022.02 meshlab-2025.07
say "PyMeshLab"
make_venv
say "Build"
# The tests are not needed, but stay where they have been built.
testing=()
[ -f "$build/CMakeCache.txt" ] || testing=(-DBUILD_TESTING=OFF)
configure_and_build "${testing[@]}"

say "Mesh"
rm -rf "$demo"
mkdir -p "$demo/home"
python3 "$files/checkerboard.py" "$demo/checkerboard.png"
stage_meshlab
make_mesh
say "The filter in meshlabserver"
failures=0
run_in_meshlabserver || failures=$((failures + 1))
say "The filter in PyMeshLab"
run_in_pymeshlab || failures=$((failures + 1))
say "Picture"
make_picture || failures=$((failures + 1))

say "Result"
printf '%-22s' host
printf ' %14s' V F iterations residual qc_mean qc_vertex_mean qc_max flipped
printf '\n'
printf '%s\n' "${table[@]-}"
[ ${#table[@]} -gt 0 ] || { echo "FAILED: the filter ran in no host"; exit 1; }
[ $failures -eq 0 ] || { echo "FAILED: $failures of the steps above"; exit 1; }
echo "Everything is in build/demo/."
