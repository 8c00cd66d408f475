#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The pictures of the hyperbolic filter, after the paper's Figs 8 and 9: MeshLab makes a surface of
# genus 2 by marching cubes, PyMeshLab runs the filter, and the window of stock MeshLab 2020.09 shows
# the layers on a display without a screen. Needs what tests/run.sh installs and builds.
set -euo pipefail
# shellcheck source=../filter_ricci/scripts/machine.sh
source "$(dirname "${BASH_SOURCE[0]}")/../filter_ricci/scripts/machine.sh"
# shellcheck source=../filter_ricci/scripts/window.sh
source "$root/filter_ricci/scripts/window.sh"

here=$root/screenshots
work=$build/hyperbolic
# The part of the display that shows the mesh and nothing else.
canvas=960x650+4+92
rings=2

fail() {
	echo "FAILED: $*"
	exit 1
}

# still: whether something is drawn and does not change any more.
still() {
	local before=$work/before.png now=$work/now.png
	sleep 2
	import -window root -crop "$canvas" "$before"
	sleep 2
	import -window root -crop "$canvas" "$now"
	[ "$(identify -format '%#' "$before")" = "$(identify -format '%#' "$now")" ] &&
		[ "$(identify -format '%k' "$now")" -gt 20 ]
}

# shoot NAME TILT ZOOM FILE...: one picture of the layers, smoothly shaded, trimmed.
shoot() {
	local name=$1 tilt=$2 zoom=$3
	shift 3
	open_meshlab "$stage/bin/meshlab" "$@" || fail "MeshLab's window did not open"
	wait_until 120 still || fail "MeshLab drew nothing"
	xdotool key --window "$main_window" shift+h
	xdotool mousemove 1371 689 click 1 # apply to all visible layers
	sleep 1
	xdotool mousemove 1167 500 click 1 # Shading: Vert
	[ "$tilt" = 0 ] || drag 1 480 400 480 $((400 - tilt))
	xdotool mousemove 480 400
	for ((; zoom > 0; zoom--)); do
		xdotool click 5
		sleep 0.3
	done
	xdotool mousemove 1167 800
	wait_until 120 still || fail "MeshLab drew nothing"
	convert "$work/now.png" -trim +repage -bordercolor white -border 10 "$work/$name.png"
	close_meshlab
}

publish() {
	convert "$work/$1.png" -strip -define png:compression-level=9 "$here/$1.png"
	echo "screenshots/$1.png: $(($(stat -c %s "$here/$1.png") / 1024)) KB"
}

rm -rf "$work"
mkdir -p "$work/home"
stage=$(bash "$root/filter_ricci/scripts/stage_meshlab_2020.sh" "$build") || exit $?
needed=$(window_needs) || fail "$needed"
cd "$work"
convert -size 64x64 pattern:gray50 -scale 1024x1024 +level-colors '#7c8fa6,white' \
	-type TrueColor checkerboard.png
HOME=$work/home XDG_RUNTIME_DIR=$work/home xvfb-run -a "$stage/bin/meshlabserver" \
	-s "$here/double_torus.mlx" -o double_torus.ply >meshlabserver.log 2>&1 ||
	fail "meshlabserver made no mesh"
"$build/venv/bin/python" "$here/hyperbolic_layers.py" "$build/pymeshlab-2025.7/libfilter_ricci.so" \
	double_torus.ply . "$rings"
trap close_display EXIT
window_screen=1400x900
open_display "$work/display" || fail "no display could be opened"
shoot surface 60 0 surface.ply
shoot disk 0 1 disk.ply
shoot universal_cover 0 0 cover.ply
convert surface.png disk.png -gravity center +append hyperbolic.png
publish hyperbolic
publish universal_cover
