#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# VERSION: the part of window_newer.sh that runs inside the newer Debian, in a folder with all it needs.
set -euo pipefail
version=$1
year=${version%.*}
cd /ricci
source ./window.sh
name="Generalized Ricci Flow (Euclidean)"
hyperbolic="Generalized Ricci Flow (Hyperbolic)"

fail() {
	echo "FAILED: $*"
	tail -n 30 "$meshlab_log" || true
	picture "failed_$year.png" || true
	exit 1
}

extra=MeshLab_64bit_fp/MeshLabExtraPlugins/$version/libfilter_ricci.so

open_mesh() {
	open_meshlab meshlab "$1" || fail "MeshLab did not open $1"
}

# apply FILTER PICTURE: the filter in its dialog, on the open mesh.
apply() {
	open_filter "$1" || fail "the dialog of $1 did not open"
	press_apply "$1"
	wait_until 60 grep -q 'Result: converged=true' "$meshlab_log" || fail "no result of $1 in the log"
	sleep 2
	picture "$2_$year.png"
	close_meshlab
}

# carry_texture in the filter's dialog: its advanced parameters are unfolded and scrolled to the end,
# where the field lies at a place of its own.
redraw_texture() {
	local X Y WIDTH HEIGHT SCREEN WINDOW turn
	rm -f redrawn.png
	open_filter "$name" || fail "the dialog of $name did not open"
	eval "$(xdotool getwindowgeometry --shell "$(find_window "$name")")"
	xdotool mousemove $((X + WIDTH / 2)) $((Y + 337)) click 1
	sleep 2
	xdotool mousemove $((X + 40)) $((Y + 425))
	for turn in {1..12}; do
		xdotool click 5
		sleep 0.3
	done
	xdotool mousemove $((X + 262)) $((Y + 265)) click 1
	xdotool type --delay 40 "$PWD/redrawn.png"
	sleep 1
	press_apply "$name"
	wait_until 60 grep -q 'texture_scale=' "$meshlab_log" || fail "no texture in the log"
	sleep 2
	[ -s redrawn.png ] || fail "no texture was written"
	picture "texture_$year.png"
	close_meshlab
}

# Help > Plugin Info > Load Plugins, as a person would.
load_plugin() {
	local dialog X Y WIDTH HEIGHT SCREEN WINDOW
	xdotool mousemove 375 28 click 1
	sleep 2
	xdotool mousemove 416 73
	sleep 1
	xdotool click 1
	wait_until 60 find_window 'Plugin Information' || return 1
	sleep 3
	dialog=$(find_window 'Plugin Information')
	eval "$(xdotool getwindowgeometry --shell "$dialog")"
	xdotool mousemove --window "$dialog" 52 $((HEIGHT - 24))
	sleep 1
	xdotool click 1
	wait_until 60 find_window 'Load Plugins' || return 1
	sleep 2
	xdotool type --delay 60 "$PWD/libfilter_ricci.so"
	sleep 2
	xdotool key Return
	# The first Return may only have closed the list of names that the field proposes.
	wait_until 10 test -f "$HOME/.local/share/VCG/$extra" || xdotool key Return
	wait_until 60 test -f "$HOME/.local/share/VCG/$extra" || return 1
	sleep 6
	# The list finds a name that is typed, and shows its row.
	xdotool mousemove --window "$dialog" 150 100 click 1
	xdotool type --delay 20 FilterRicci
	sleep 1
	picture "plugin_$year.png"
	xdotool key Escape # Return would press Load Plugins again
	sleep 3
}

trap close_display EXIT
open_display /ricci/display || { echo "SKIPPED: no display could be opened"; exit 77; }
rm -f "$HOME/.local/share/VCG/$extra"
open_mesh torus.ply
load_plugin || fail "the plugin was not loaded through the menu"
apply "$name" result
open_mesh double_torus.ply
apply "$hyperbolic" hyperbolic
open_mesh textured.ply
redraw_texture
open_mesh torus.ply
apply_script "$PWD/automatic.mlx" || fail "no script can be opened"
wait_until 60 grep -q 'Result: converged=true' "$meshlab_log" || fail "the script had no result"
close_meshlab
open_mesh line.ply
open_filter "$name" || fail "the filter's dialog did not open"
press_apply "$name"
wait_until 60 xdotool search --onlyvisible --name 'Filter Failure' || fail "no message box"
sleep 1
picture "refused_$year.png"
xdotool key Return
sleep 2
kill -0 "$meshlab_pid" || fail "MeshLab has ended"
montage "plugin_$year.png" "result_$year.png" "hyperbolic_$year.png" "texture_$year.png" -tile 2x2 \
	-geometry 1000x+4+4 miff:- |
	convert - -strip +dither -colors 255 -define png:compression-level=9 "PNG8:window_$year.png"
echo "Both filters and a script ran in the window of MeshLab $version, loaded through its menu."
