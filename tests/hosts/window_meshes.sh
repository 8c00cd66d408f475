#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# window_meshes.sh BUILD_DIR [MESH.ply...]: what a person meets who applies the Euclidean filter to
# these meshes in the real MeshLab 2020.09 window. A line for each mesh: solved or refused, whether
# MeshLab then exports it with the same bytes as before, and the sentence. Pictures of every answer
# in BUILD_DIR/pictures/meshes. It fails where MeshLab ends, gives no answer, or a refusal changed a
# mesh.
# Without MESH: small dirty meshes of its own, with the answers that they must get.
# Exit 77: the window cannot be opened on this machine.
set -euo pipefail
build=$(cd "$1" && pwd)
shift
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scripts=$here/../../filter_ricci/scripts
name="Generalized Ricci Flow (Euclidean)"
pictures=$build/pictures/meshes
folder=$(mktemp -d)
failures=0

# shellcheck source=../../filter_ricci/scripts/window.sh
source "$scripts/window.sh"

finish() {
	close_display
	rm -rf "$folder"
}

fail() {
	echo "FAILED: $*"
	failures=$((failures + 1))
}

# Exports the mesh over its own file, with everything that it has.
export_mesh() {
	rm -f "$folder/mesh.ply"
	wait_until 60 saved_by_keys || return 1
	mv "$folder/mesh.ply" "$1"
	xdotool windowactivate --sync "$main_window"
	sleep 1
}

# press KEY WINDOW
press() {
	xdotool windowactivate --sync "$2"
	sleep 0.5
	xdotool key "$1"
	sleep 1
}

# A window that has just come to the front may miss a key: so each is pressed until it has an effect.
saved_by_keys() {
	local options
	tail -n 1 "$meshlab_log" | grep -q 'Saved Mesh' && [ -s "$folder/mesh.ply" ] && return 0
	if options=$(find_window 'Choose Saving Options for: .*'); then
		press Return "$options"
	else
		press ctrl+e "$main_window"
	fi
	return 1
}

# The box with the reason, where there is one.
box_is_closed() {
	local box
	box=$(xdotool search --onlyvisible --name 'Filter Failure' | head -n 1)
	[ -n "$box" ] || return 0
	press Return "$box"
	return 1
}

# Sets unchanged to yes or no: the mesh, exported again.
compare_exports() {
	wait_until 10 box_is_closed || return 1
	export_mesh "$folder/after.ply" || return 1
	unchanged=no
	! cmp -s "$folder/before.ply" "$folder/after.ply" || unchanged=yes
}

# The last line of the log that the user reads: the reason, or the sentence with the result.
sentence() {
	case $verdict in
	solved) grep -o '[0-9]* charts\? (UV islands) .*' "$meshlab_log" | tail -n 1 ;;
	*) sed -n 's/^LOG: [0-9]* //p' "$meshlab_log" | tail -n 1 ;;
	esac
}

# try_mesh FILE [VERDICT WORDS]: one line, and the two things that the answer must be.
try_mesh() {
	local title said
	title=$(basename "$1" .ply)
	verdict="not opened" unchanged=-
	cp "$1" "$folder/mesh.ply"
	chmod u+w "$folder/mesh.ply"
	if open_meshlab "$program" mesh.ply && export_mesh "$folder/before.ply"; then
		run_filter "$name" 300
		sleep 1
		picture "$pictures/$title.png"
		said=$(sentence)
		compare_exports || verdict="not exported"
		meshlab_lives || verdict=ended
	else
		picture "$pictures/$title.png"
		said=$(tail -n 1 "$meshlab_log")
	fi
	printf '%s | %s | %s | %s\n' "$title" "$verdict" "$unchanged" "$said"
	case $verdict in
	solved) [ $unchanged = no ] || fail "$title: solved, and the mesh is what it was" ;;
	refused) [ $unchanged = yes ] || fail "$title: the refusal changed the mesh" ;;
	*) fail "$title: $verdict" ;;
	esac
	[ $# -lt 2 ] || [ "$verdict" = "$2" ] || fail "$title: must be $2"
	[ $# -lt 3 ] || grep -q -- "$3" <<<"$said" || fail "$title: nothing is said of '$3'"
	close_meshlab
}

own_meshes() {
	(cd "$here" && python3 -c "import meshes
meshes.write_ply('$folder/fin.ply', meshes.with_fin(meshes.torus()))
meshes.write_ply('$folder/bow_tie.ply', meshes.bow_tie())
meshes.write_ply('$folder/line.ply', meshes.line())
meshes.write_ply('$folder/crumbs.ply',
    meshes.with_unreferenced_vertex(meshes.with_flipped_faces(meshes.torus())))")
	try_mesh "$folder/line.ply" refused "but no area"
	try_mesh "$folder/fin.ply" solved "(UV islands)"
	try_mesh "$folder/bow_tie.ply" solved "(UV islands)"
	try_mesh "$folder/crumbs.ply" solved "(UV islands)"
}

needed=$(window_needs) || { echo "SKIPPED: $needed"; exit 77; }
prefix=$(bash "$scripts/stage_meshlab_2020.sh" "$build") || exit $?
program=$prefix/bin/meshlab
files=()
[ $# -eq 0 ] || mapfile -t files < <(realpath "$@")
mkdir -p "$pictures"
trap finish EXIT
open_display "$folder/display" || { echo "SKIPPED: no display could be opened"; exit 77; }
cd "$folder"
echo "mesh | answer | unchanged | sentence"
if [ ${#files[@]} -eq 0 ]; then
	own_meshes
else
	for file in "${files[@]}"; do
		try_mesh "$file"
	done
fi
[ $failures -eq 0 ]
