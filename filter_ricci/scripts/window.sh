# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash
# Drives the real MeshLab 2020.09 window on a private display without a screen. Source it, then call
# open_display FOLDER, open_meshlab PROGRAM FILE..., run_filter NAME, picture FILE, close_display.

window_needs() {
	local tool missing=()
	for tool in Xvfb openbox xdotool import; do
		command -v "$tool" >/dev/null || missing+=("$tool")
	done
	[ ${#missing[@]} -eq 0 ] || { echo "not installed: ${missing[*]}"; return 1; }
}

# A display of its own, a window manager, and settings that keep MeshLab quiet and its canvas white.
# As large as a small laptop's; window_screen=WxH asks for another.
open_display() {
	window_folder=$1
	mkdir -p "$window_folder/home/.config/VCG" "$window_folder/home/runtime"
	chmod 700 "$window_folder/home/runtime"
	rm -f "$window_folder/display" # that of an earlier run
	Xvfb -displayfd 3 -screen 0 "${window_screen:-1366x768}x24" -nolisten tcp 3>"$window_folder/display" \
		>"$window_folder/xvfb.log" 2>&1 &
	xvfb_pid=$!
	wait_until 20 test -s "$window_folder/display" || return 1
	DISPLAY=:$(cat "$window_folder/display")
	HOME=$window_folder/home
	XDG_CONFIG_HOME=$HOME/.config
	XDG_RUNTIME_DIR=$HOME/runtime
	export DISPLAY HOME XDG_CONFIG_HOME XDG_RUNTIME_DIR LIBGL_ALWAYS_SOFTWARE=1
	write_settings >"$XDG_CONFIG_HOME/VCG/MeshLab_64bit_fp.conf"
	openbox >"$window_folder/openbox.log" 2>&1 &
	openbox_pid=$!
	sleep 1
}

close_display() {
	local pid
	for pid in "${meshlab_pid-}" "${openbox_pid-}" "${xvfb_pid-}"; do
		[ -z "$pid" ] || kill "$pid" 2>/dev/null || true
	done
	wait 2>/dev/null || true
}

write_settings() {
	printf '[General]\n'
	color_setting backgroundTopColor 255 255 255
	color_setting backgroundBotColor 255 255 255
	color_setting logAreaColor 90 90 90
}

color_setting() {
	printf 'MeshLab%%3A%%3AAppearance%%3A%%3A%s=' "$1"
	printf '"<Param name=\\"MeshLab::Appearance::%s\\" type=\\"RichColor\\" r=\\"%s\\" g=\\"%s\\" b=\\"%s\\" a=\\"255\\"/>"\n' "$@"
}

# wait_until SECONDS COMMAND...
wait_until() {
	local tries=$(($1 * 4))
	shift
	while ! "$@" >/dev/null 2>&1; do
		tries=$((tries - 1))
		[ $tries -gt 0 ] || return 1
		sleep 0.25
	done
}

# open_meshlab PROGRAM FILE...: from the folder of the files, where textures are looked for.
open_meshlab() {
	meshlab_log=$window_folder/meshlab.log
	: >"$meshlab_log" # here, or the wait below may still read the last run's log
	"$@" >>"$meshlab_log" 2>&1 &
	meshlab_pid=$!
	wait_until 240 grep -q 'All files opened' "$meshlab_log" || return 1
	main_window=$(xdotool search --onlyvisible --name 'MeshLab 20[0-9][0-9]' | head -n 1)
	[ -n "$main_window" ] || return 1
	sleep 1
	xdotool windowactivate --sync "$main_window"
}

close_meshlab() {
	kill "$meshlab_pid" 2>/dev/null || true
	wait "$meshlab_pid" 2>/dev/null || true
	meshlab_pid=
}

search() {
	xdotool key --window "$main_window" ctrl+f
	sleep 1
	xdotool type --delay 20 "$1"
	sleep 1
}

# open_filter NAME: through the search field, as a user would.
open_filter() {
	search "$1"
	xdotool key Down
	sleep 0.5
	xdotool key Return
	wait_until 10 find_window "$1" || return 1
	sleep 1
}

# xdotool searches for a regular expression.
find_window() {
	xdotool search --onlyvisible --name "^${1//[()]/.}\$" | grep . | tail -n 1
}

picture() {
	import -window root "$1"
}

# press_apply NAME: the filter's dialog has Apply as its lower right button, above the frame.
press_apply() {
	local dialog X Y WIDTH HEIGHT SCREEN WINDOW
	dialog=$(find_window "$1")
	eval "$(xdotool getwindowgeometry --shell "$dialog")"
	xdotool mousemove $((X + WIDTH * 3 / 4)) $((Y + HEIGHT - 21)) click 1
}

# apply_script FILE: Filters > Show current filter script, with that one.
apply_script() {
	xdotool mousemove 116 28 click 1
	sleep 2
	xdotool key Down Return
	sleep 3
	xdotool mousemove 446 527 click 1 # Open Script
	wait_until 20 xdotool search --onlyvisible --name 'Open Filter Script' || return 1
	sleep 1
	xdotool type --delay 40 "$1"
	sleep 1
	xdotool key Return
	sleep 1
	# The first Return may only have closed the list of names that the field proposes.
	! xdotool search --onlyvisible --name 'Open Filter Script' >/dev/null || xdotool key Return
	sleep 1
	xdotool mousemove 788 527 click 1 # Apply Script
}

# run_filter NAME SECONDS: the filter with its defaults on the open mesh. Sets verdict to solved,
# refused (the box with the reason is open then), ended (MeshLab is no more), or to what did not come.
run_filter() {
	verdict="no dialog"
	# A busy machine may miss keys.
	if open_filter "$1" || { xdotool key Escape && open_filter "$1"; }; then
		press_apply "$1"
		wait_until "$2" has_verdict || verdict="no answer"
	fi
	meshlab_lives || verdict=ended
}

has_verdict() {
	if ! meshlab_lives; then
		verdict=ended
	elif grep -q 'Result: converged=true' "$meshlab_log"; then
		verdict=solved
	elif xdotool search --onlyvisible --name 'Filter Failure'; then
		verdict=refused
	else
		return 1
	fi
}

meshlab_lives() {
	kill -0 "$meshlab_pid" 2>/dev/null
}

# Turns the mesh away from the straight view from above, moves it out from under the place where
# dialogs open, and hides the trackball.
tilt_and_move_aside() {
	xdotool key --window "$main_window" shift+h
	drag 1 480 400 480 300
	xdotool keydown ctrl
	drag 1 480 480 740 480
	xdotool keyup ctrl
	sleep 1
}

# drag BUTTON X Y X Y
drag() {
	local step
	xdotool mousemove "$2" "$3" mousedown "$1"
	for step in 1 2 3 4 5 6 7 8; do
		xdotool mousemove $(($2 + ($4 - $2) * step / 8)) $(($3 + ($5 - $3) * step / 8))
		sleep 0.1
	done
	xdotool mouseup "$1"
	sleep 0.5
}
