#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the README's pictures with stock MeshLab 2020.09 and the plugin in build/: MeshLab makes a
# surface by marching cubes, meshlabserver runs the filter, and MeshLab's own window shows it on a
# display without a screen. Needs what filter_ricci/demo.sh installs and builds.
set -euo pipefail
# shellcheck source=../filter_ricci/scripts/machine.sh
source "$(dirname "${BASH_SOURCE[0]}")/../filter_ricci/scripts/machine.sh"
# shellcheck source=../filter_ricci/scripts/window.sh
source "$root/filter_ricci/scripts/window.sh"

here=$root/screenshots
work=$build/screenshots
name="Generalized Ricci Flow (Euclidean)"
# The part of the display that shows the mesh and nothing else: left, top, width, height.
canvas=(4 92 972 668)

fail() {
	echo "FAILED: $*"
	exit 1
}

server() {
	(cd "$work" && HOME=$work/home XDG_RUNTIME_DIR=$work/home xvfb-run -a \
		"$stage/bin/meshlabserver" "$@") >>"$work/meshlabserver.log" 2>&1
}

# script FILE PARAMETER=VALUE...: the start of a script, the filter with other values than the sample's.
script() {
	local file=$work/$1 pair edits=()
	shift
	for pair in "$@"; do
		edits+=(-e "s/\\(name=\"${pair%%=*}\" value=\\)\"[^\"]*\"/\\1\"${pair#*=}\"/")
	done
	sed "${edits[@]}" -e '/<\/FilterScript>/d' "$root/filter_ricci/samples/automatic.mlx" >"$file"
}

# then_filter FILE FILTER [PARAMETER...]: one more filter for the script.
then_filter() {
	printf ' <filter name="%s">\n' "$2" >>"$work/$1"
	[ $# -eq 2 ] || printf '  <Param %s/>\n' "${@:3}" >>"$work/$1"
	printf ' </filter>\n' >>"$work/$1"
}

run_script() {
	local file=$1
	shift
	echo '</FilterScript>' >>"$work/$file"
	server "$@" -s "$file" || fail "meshlabserver with $file; see build/screenshots/meshlabserver.log"
}

white() {
	then_filter "$1" "Vertex Color Filling" 'type="RichColor" name="color1" r="255" g="255" b="255" a="255"' \
		'type="RichBool" name="onSelected" value="false"'
}

textured() {
	then_filter "$1" "Set Texture" 'type="RichString" name="textName" value="checkerboard.png"' \
		'type="RichInt" name="textDim" value="1024"'
}

make_meshes() {
	convert -size 64x64 pattern:gray50 -scale 1024x1024 +level-colors '#7c8fa6,white' \
		-type TrueColor "$work/checkerboard.png"
	server -s "$root/filter_ricci/demo/torus_like.mlx" -o mesh.ply || fail "meshlabserver made no mesh"
	script generalized.mlx options=
	white generalized.mlx
	textured generalized.mlx
	run_script generalized.mlx -i mesh.ply -o generalized.ply -m wt vc vn
	script thurston.mlx options= method=3
	white thurston.mlx
	textured thurston.mlx
	run_script thurston.mlx -i mesh.ply -o thurston.ply -m wt vc vn
	script distortion.mlx
	run_script distortion.mlx -i mesh.ply -o distortion.ply -m vc vq vn
	# Only the current layer is saved, and that is the flat one once the other has gone.
	script flat.mlx options= layers=1
	then_filter flat.mlx "Delete Current Mesh"
	white flat.mlx
	run_script flat.mlx -i generalized.ply -o flat.ply -m wt vc vn
	make_statue
}

# fill FILE RED GREEN BLUE: colours the selected vertices.
fill() {
	then_filter "$1" "Vertex Color Filling" "type=\"RichColor\" name=\"color1\" r=\"$2\" g=\"$3\" b=\"$4\" a=\"255\"" \
		'type="RichBool" name="onSelected" value="true"'
}

# enlarge FILE: selects the neighbours of the selected vertices, too.
enlarge() {
	then_filter "$1" "Select Faces from Vertices" 'type="RichBool" name="Inclusive" value="false"'
	then_filter "$1" "Select Vertices from Faces" 'type="RichBool" name="Inclusive" value="false"'
}

# The condition that holds at the cones which the log's last run has placed: MeshLab 2020.09 cannot read
# attributes there, so it is a product over the vertices' numbers.
at_cones() {
	local product=1 vertex
	for vertex in $(grep 'cones placed' "$work/meshlabserver.log" | tail -n 1 |
		grep -oE '[0-9]+ \(-?[0-9]' | cut -d ' ' -f 1); do
		product="$product*(vi-$vertex)"
	done
	echo "$product==0"
}

# A closed statue with the cones that the filter places. Where the texture is cut, vertices are split,
# and the border that appears is coloured. The cones are coloured before that, because vertices get
# other numbers, and made larger at last.
make_statue() {
	bash "$root/tests/unpack_cgal_meshes.sh" "$build/cgal_meshes" || fail "no statue without libcgal-demo"
	cp "$build/cgal_meshes/data/meshes/armadillo.off" "$work/statue.off"
	script cones.mlx options= output_triangulation=1
	run_script cones.mlx -i statue.off -o cones.ply
	script statue.mlx options= output_triangulation=1
	white statue.mlx
	textured statue.mlx
	then_filter statue.mlx "Conditional Vertex Selection" \
		"type=\"RichString\" name=\"condSelect\" value=\"$(at_cones)\""
	enlarge statue.mlx
	fill statue.mlx 0 70 255
	then_filter statue.mlx "Convert PerWedge UV into PerVertex UV"
	then_filter statue.mlx "Select Border"
	fill statue.mlx 190 30 20
	then_filter statue.mlx "Conditional Vertex Selection" \
		'type="RichString" name="condSelect" value="(b-r)==255"'
	enlarge statue.mlx
	fill statue.mlx 0 70 255
	run_script statue.mlx -i statue.off -o statue.ply -m wt vc vn
}

# show FILE: opens it in the window, always from the same side, smoothly shaded.
show() {
	open_meshlab "$stage/bin/meshlab" "$1" || fail "MeshLab's window did not open"
	xdotool key --window "$main_window" shift+h
	xdotool mousemove 1167 500 click 1 # Shading: Vert
	sleep 0.5
}

tilt() {
	drag 1 480 400 480 310
}

# shift_by X Y: moves the mesh on the canvas.
shift_by() {
	xdotool keydown ctrl
	drag 1 480 480 $((480 + $1)) $((480 + $2))
	xdotool keyup ctrl
}

# zoom STEPS: brings the mesh nearer.
zoom() {
	local step
	xdotool mousemove 480 400
	for ((step = 0; step < $1; step++)); do
		xdotool click 5
		sleep 0.2
	done
}

shoot() {
	picture "$work/pictures/$1.png"
}

publish() {
	convert "$work/pictures/$1.png" -strip -define png:compression-level=9 "$here/$1.png"
	echo "screenshots/$1.png: $(($(stat -c %s "$here/$1.png") / 1024)) KB"
}

mesh_only() {
	convert "$work/pictures/$1.png" -crop "${canvas[2]}x${canvas[3]}+${canvas[0]}+${canvas[1]}" +repage \
		-trim +repage -bordercolor white -border 12 "$work/pictures/$1_mesh.png"
}

# around FILE PICTURE: the whole surface, the same view for every file.
around() {
	show "$1"
	tilt
	zoom 1
	shift_by 0 -50
	shoot "$2"
	close_meshlab
}

dialog() {
	show generalized.ply
	tilt
	shift_by 200 -30
	open_filter "$name" || fail "the filter's dialog did not open"
	xdotool windowmove "$(find_window "$name")" 0 92
	sleep 1
	press_apply "$name"
	wait_until 60 grep -q 'Result: converged=true' "$meshlab_log" || fail "the filter did not run"
	sleep 2
	shoot dialog
	close_meshlab
}

flat() {
	show flat.ply
	shoot flat
	close_meshlab
}

statue() {
	show statue.ply
	drag 1 300 400 660 400
	drag 1 300 400 560 400
	drag 1 300 400 500 400
	zoom 1
	shift_by 0 -20
	shoot statue
	close_meshlab
}

make_pictures() {
	cd "$work"
	around generalized.ply checkerboard
	around thurston.ply thurston
	around distortion.ply distortion
	dialog
	flat
	statue
}

rm -rf "$work"
mkdir -p "$work"/{home,pictures}
stage=$(bash "$root/filter_ricci/scripts/stage_meshlab_2020.sh" "$build") || exit $?
needed=$(window_needs) || fail "$needed"
make_meshes
trap close_display EXIT
window_screen=1400x900
open_display "$work/display" || fail "no display could be opened"
make_pictures
mesh_only checkerboard
mesh_only thurston
mesh_only statue
mv "$work/pictures/statue_mesh.png" "$work/pictures/statue.png"
cd "$work/pictures"
convert thurston_mesh.png checkerboard_mesh.png +append before_after.png
for file in before_after checkerboard distortion dialog flat statue; do
	publish "$file"
done
