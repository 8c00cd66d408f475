#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The part of window_2025.sh that runs inside the newer Debian, in a folder with all it needs.
set -euo pipefail
cd /ricci
source ./window.sh
name="Generalized Ricci Flow (Euclidean)"
hyperbolic="Generalized Ricci Flow (Hyperbolic)"

fail() {
	echo "FAILED: $*"
	tail -n 30 "$meshlab_log" || true
	picture failed_2025.png || true
	exit 1
}

extra=MeshLab_64bit_fp/MeshLabExtraPlugins/2025.07/libfilter_ricci.so

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
	picture plugin_2025.png
	xdotool key Escape # Return would press Load Plugins again
	sleep 3
}

trap close_display EXIT
open_display /ricci/display || { echo "SKIPPED: no display could be opened"; exit 77; }
rm -f "$HOME/.local/share/VCG/$extra"
open_meshlab meshlab torus.ply || fail "MeshLab did not open the torus"
load_plugin || fail "the plugin was not loaded through the menu"
open_filter "$name" || fail "the filter's dialog did not open"
picture dialog_2025.png
press_apply "$name"
wait_until 60 grep -q 'Result: converged=true' "$meshlab_log" || fail "no result in the log"
sleep 2
picture result_2025.png
close_meshlab
open_meshlab meshlab double_torus.ply || fail "MeshLab did not open the double torus"
open_filter "$hyperbolic" || fail "the hyperbolic filter's dialog did not open"
press_apply "$hyperbolic"
wait_until 60 grep -q 'Result: converged=true' "$meshlab_log" || fail "no result in the log"
sleep 2
picture hyperbolic_2025.png
close_meshlab
open_meshlab meshlab moebius.ply || fail "MeshLab did not open the Moebius band"
open_filter "$name" || fail "the filter's dialog did not open"
press_apply "$name"
wait_until 60 xdotool search --onlyvisible --name 'Filter Failure' || fail "no message box"
sleep 1
picture refused_2025.png
xdotool key Return
sleep 2
kill -0 "$meshlab_pid" || fail "MeshLab has ended"
echo "Both filters ran in the window of MeshLab 2025.07, loaded through its menu."
