#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# test_window.sh BUILD_DIR: the filter in the real MeshLab 2020.09 window: through its search field,
# its dialog and Apply, once on a mesh that it solves and once on one that it refuses, and by scripts. Leaves
# pictures in BUILD_DIR/pictures. Exit 77: the window cannot be opened on this machine.
set -euo pipefail
build=$(cd "$1" && pwd)
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scripts=$here/../../filter_ricci/scripts
name="Generalized Ricci Flow (Euclidean)"
pictures=$build/pictures
folder=$(mktemp -d)

# shellcheck source=../../filter_ricci/scripts/window.sh
source "$scripts/window.sh"

fail() {
	echo "FAILED: $*"
	[ ! -f "${meshlab_log-}" ] || tail -n 30 "$meshlab_log"
	picture "$pictures/failed.png" || true
	exit 1
}

finish() {
	close_display
	rm -rf "$folder"
}

write_meshes() {
	cd "$here"
	python3 -c "import meshes
meshes.write_ply('$folder/torus.ply', meshes.torus())
meshes.name_texture('$folder/torus.ply', 'checkerboard.png')
meshes.write_ply('$folder/line.ply', meshes.line())"
	cd "$folder"
	python3 "$here/../../filter_ricci/demo/checkerboard.py" checkerboard.png
}

solved() {
	open_meshlab "$program" torus.ply || fail "MeshLab did not open the torus"
	open_filter "$name" || fail "the filter's dialog did not open"
	picture "$pictures/dialog.png"
	fits_the_screen || fail "the dialog is larger than the screen"
	local narrow
	narrow=$(dialog_width)
	press_help
	picture "$pictures/help.png"
	fits_the_screen || fail "the dialog with its help is larger than the screen"
	[ "$(dialog_width)" -gt $((narrow + 400)) ] || fail "there is no room for two columns of help"
	press_apply "$name"
	wait_until 60 grep -q 'Result: converged=true' "$meshlab_log" || fail "no result in the log"
	grep -q "'Transfer texture to' bakes" "$meshlab_log" || fail "the log does not name a label"
	sleep 2
	picture "$pictures/result.png"
	kill -0 "$meshlab_pid" || fail "MeshLab has ended"
	close_meshlab
}

# Stored scripts name parameters as before: those that are options now are read, others are answered with the new name.
scripted() {
	write_script options '<Param type="RichInt" name="cone_count" value="5"/><Param type="RichFloat" name="time_limit" value="60"/>'
	write_script renamed '<Param type="RichFloat" name="chart_margin" value="0.004"/>'
	open_meshlab "$program" torus.ply || fail "MeshLab did not open the torus"
	apply_script "$folder/options.mlx" || fail "no script can be opened"
	wait_until 60 grep -q 'Result: converged=true' "$meshlab_log" || fail "the script had no result"
	grep -q ', with 5 cones and no flipped faces' "$meshlab_log" || fail "the script did not say how many cones"
	close_meshlab
	open_meshlab "$program" torus.ply || fail "MeshLab did not open the torus"
	apply_script "$folder/renamed.mlx" || fail "no script can be opened"
	wait_until 60 grep -q "no parameter 'chart_margin': it is 'padding' now" "$meshlab_log" ||
		fail "the old name is not answered with the new one"
	close_meshlab
}

# write_script NAME PARAMETER...
write_script() {
	local path=$folder/$1.mlx
	shift
	printf '<!DOCTYPE FilterScript>\n<FilterScript>\n <filter name="%s">\n  %s\n </filter>\n</FilterScript>\n' \
		"$name" "$*" >"$path"
}

# What its search field finds is for the eye, too: pictures search_WORD.png.
found() {
	local word
	open_meshlab "$program" torus.ply || fail "MeshLab did not open the torus"
	for word in uv unwrap flatten parametrization; do
		search "$word"
		picture "$pictures/search_$word.png"
		xdotool key Escape
		sleep 1
	done
	close_meshlab
}

press_help() {
	local X Y WIDTH HEIGHT SCREEN WINDOW
	eval "$(xdotool getwindowgeometry --shell "$(find_window "$name")")"
	xdotool mousemove $((X + WIDTH * 3 / 4)) $((Y + HEIGHT - 52)) click 1
	sleep 1
}

dialog_width() {
	local X Y WIDTH HEIGHT SCREEN WINDOW
	eval "$(xdotool getwindowgeometry --shell "$(find_window "$name")")"
	echo "$WIDTH"
}

# Its lower right end, where Apply is.
fits_the_screen() {
	local X Y WIDTH HEIGHT SCREEN WINDOW width height
	read -r width height < <(xdotool getdisplaygeometry)
	eval "$(xdotool getwindowgeometry --shell "$(find_window "$name")")"
	echo "The dialog ends at $((X + WIDTH)), $((Y + HEIGHT)) of $width, $height pixels"
	[ $((X + WIDTH)) -le "$width" ] && [ $((Y + HEIGHT)) -le "$height" ]
}

refused() {
	open_meshlab "$program" line.ply || fail "MeshLab did not open the line"
	open_filter "$name" || fail "the filter's dialog did not open"
	press_apply "$name"
	wait_until 60 xdotool search --onlyvisible --name 'Filter Failure' || fail "no message box"
	sleep 1
	picture "$pictures/refused.png"
	xdotool key Return
	sleep 2
	kill -0 "$meshlab_pid" || fail "MeshLab has ended"
	close_meshlab
}

needed=$(window_needs) || { echo "SKIPPED: $needed"; exit 77; }
prefix=$(bash "$scripts/stage_meshlab_2020.sh" "$build") || exit $?
program=$prefix/bin/meshlab
mkdir -p "$pictures"
trap finish EXIT
write_meshes
open_display "$folder/display" || { echo "SKIPPED: no display could be opened"; exit 77; }
found
solved
scripted
refused
echo "The filter ran in the window; pictures are in $pictures"
