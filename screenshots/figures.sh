#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# figures.sh [ROCKER_ARM.ply]: the pictures after the paper's figures. PyMeshLab runs the filter on
# MeshLab's own surfaces and on Debian's libcgal-demo meshes, and the window of stock MeshLab 2020.09
# shows the layers on a display without a screen. Needs what tests/run.sh installs and builds.
# RICCI_PICTURES="bunny annulus" makes some of them only.
set -euo pipefail
# shellcheck source=../filter_ricci/scripts/machine.sh
source "$(dirname "${BASH_SOURCE[0]}")/../filter_ricci/scripts/machine.sh"
# shellcheck source=../filter_ricci/scripts/window.sh
source "$root/filter_ricci/scripts/window.sh"

here=$root/screenshots
work=$build/figures
# The part of the display that shows the mesh and nothing else.
canvas=960x650+4+92

fail() {
	echo "FAILED: $*"
	exit 1
}

canvas_sum() {
	import -window root -crop "$canvas" "$work/now.png"
	identify -format '%# %k' "$work/now.png"
}

# Waits until something is drawn and does not change any more.
settle() {
	local before=none now tries
	for ((tries = 0; tries < 120; tries++)); do
		sleep 1
		now=$(canvas_sum)
		[ "$now" != "$before" ] || [ "${now##* }" -lt 20 ] || return 0
		before=$now
	done
	fail "MeshLab drew nothing"
}

# shoot NAME FILE...: one picture of the layers, smoothly shaded, trimmed.
shoot() {
	local name=$1
	shift
	open_meshlab "$stage/bin/meshlab" "$@" || fail "MeshLab's window did not open"
	settle
	xdotool key --window "$main_window" shift+h
	xdotool mousemove 1371 689 click 1 # apply to all visible layers
	sleep 1
	xdotool mousemove 1167 500 click 1 # Shading: Vert
	xdotool mousemove 1167 800
	sleep 2
	settle
	convert "$work/now.png" -trim +repage -bordercolor white -border 10 "$work/$name.png"
	close_meshlab
}

# shoot_map NAME: a surface and its chart.
shoot_map() {
	shoot "$1" "$1.ply"
	shoot "$1_chart" "$1_chart.ply"
}

has() {
	[[ " ${RICCI_PICTURES-kitten bunny mask annulus bust texture seams} " == *" $1 "* ]]
}

# row OUT HEIGHT NAME=TEXT...: pictures side by side on white, at most HEIGHT pixels high, a line of
# text under each.
row() {
	local out=$1 height=$2 pair parts=()
	shift 2
	for pair in "$@"; do
		parts+=('(' "$work/${pair%%=*}.png" -resize "x$height>" -gravity center -background white
			-bordercolor white -border 8 -pointsize 17 "label:${pair#*=}" -append ')')
	done
	convert -background white -font DejaVu-Sans "${parts[@]}" -gravity south +append -strip +dither -colors 255 \
		-define png:compression-level=9 "PNG8:$here/$out.png"
	echo "screenshots/$out.png: $(($(stat -c %s "$here/$out.png") / 1024)) KB"
}

# histogram NAME KIND: bars of one flow, on the scale of both.
histogram() {
	local drawing
	drawing=$(python3 - "$work/$1_qc.json" "$2" <<'PYTHON'
import json
import sys

table = json.load(open(sys.argv[1], encoding="utf-8"))
flow = table[sys.argv[2]]
most = max(flow["counts"])
left, right, top, base = 20, 500, 20, 270
bar = (right - left) / table["bins"]
stops = [(0, 0, 255), (0, 255, 255), (0, 255, 0), (255, 255, 0), (255, 0, 0)]
for i, count in enumerate(flow["counts"]):
    t = 4 * (i + 0.5) / table["bins"]
    a, b = stops[int(t)], stops[min(int(t) + 1, 4)]
    colour = ",".join(str(round(p + (t - int(t)) * (q - p))) for p, q in zip(a, b))
    high = (base - top) * count / most
    if count:
        print(f"fill rgb({colour}) rectangle {left + i * bar:.1f},{base - max(high, 1):.1f} "
              f"{left + (i + 1) * bar - 1:.1f},{base}")
print(f"fill black line {left},{base} {right},{base}")
beyond = 100 * flow["beyond"] / flow["vertices"]
for x, y, text in ((left, 20, "1"), (right - 40, 20, f"{table['top']:.3f}"),
                   (left + 60, 44, f"mean {flow['mean']:.4f}, {beyond:.1f} % beyond, in the last bar")):
    print(f"text {x},{base + y} '{text}'")
PYTHON
	)
	convert -size 520x330 xc:white -font DejaVu-Sans -pointsize 15 -draw "$drawing" \
		"$work/$1_histogram_$2.png"
}

compare() {
	shoot "$1_qc_generalized" "$1_qc_generalized.ply"
	shoot "$1_qc_conventional" "$1_qc_conventional.ply"
	histogram "$1" generalized
	histogram "$1" conventional
	row "$2" 460 "$1_qc_conventional=conventional flow" "$1_histogram_conventional=its vertices" \
		"$1_qc_generalized=generalized flow" "$1_histogram_generalized=its vertices"
}

make_pictures() {
	cd "$work"
	if has kitten; then
		shoot kitten_conventional kitten_conventional.ply
		shoot kitten_generalized kitten_generalized.ply
		row kitten 540 "kitten_conventional=conventional flow (Fig. 5)" \
			"kitten_generalized=generalized flow (Fig. 7)"
		compare kitten kitten_distortion
	fi
	if has bunny; then
		shoot bunny_circles bunny_circles.ply
		shoot bunny_seams bunny_checkerboard.ply bunny_seams.ply
		row bunny 480 "bunny_circles=circles of the plane on the surface (Fig. 1)" \
			"bunny_seams=seams and cones"
	fi
	if has mask; then
		local outline
		for outline in disk rectangle free; do
			shoot_map mask_$outline
		done
		row outlines 460 "mask_disk=Disk" "mask_disk_chart=its chart" \
			"mask_rectangle=Rectangle" "mask_rectangle_chart=its chart (Fig. 11)"
		row free_boundary 500 "mask_free=free boundary (Fig. 12)" "mask_free_chart=its chart"
	fi
	if has annulus; then
		shoot_map annulus
		row annulus 500 "annulus=$(cat annulus.txt)" "annulus_chart=its chart"
	fi
	if has bust; then
		local map
		for map in plain default; do
			shoot_map bust_$map
		done
		row bust 420 "bust_plain=$(cat bust_plain.txt)" "bust_plain_chart=its chart" \
			"bust_default=$(cat bust_default.txt)" "bust_default_chart=its charts"
	fi
	if has texture; then
		shoot texture_bunny_before texture_before.ply
		shoot texture_bunny_after texture_after.ply
		shoot texture_drawn texture_chart.ply
		row texture 380 "texture_old=texture of single triangles" "texture_bunny_before=the mesh with it" \
			"texture_drawn=carry_texture, in its charts" "texture_bunny_after=the mesh with this one"
	fi
	if has seams; then
		local map
		for map in creases atlas again; do
			shoot_map seams_$map
		done
		row seams 420 "seams_creases=Selected edges: the creases" "seams_creases_chart=its charts"
		row seams_again 420 "seams_atlas=MeshLab's Voronoi atlas" "seams_atlas_chart=its charts" \
			"seams_again=unwrapped again: Existing texture seams" "seams_again_chart=its charts"
	fi
	[ $# -eq 0 ] || compare rocker_arm rocker_arm_distortion
}

mkdir -p "$work"
rocker_arm=()
[ $# -eq 0 ] || rocker_arm=("$(realpath "$1")")
stage=$(bash "$root/filter_ricci/scripts/stage_meshlab_2020.sh" "$build") || exit $?
needed=$(window_needs) || fail "$needed"
python=$build/venv/bin/python
[ -x "$python" ] || fail "there is no Python with PyMeshLab in build/venv"
bash "$root/tests/unpack_cgal_meshes.sh" "$build/cgal_meshes" || fail "libcgal-demo cannot be had"
"$python" "$here/layers.py" "$build/pymeshlab-2025.7/libfilter_ricci.so" "$build/cgal_meshes/data" \
	"$work" "${rocker_arm[@]}"
trap close_display EXIT
window_screen=1400x900
open_display "$work/display" || fail "no display could be opened"
make_pictures "${rocker_arm[@]}"
