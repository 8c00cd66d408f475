#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# bash tests/bench.sh [--geometry=euclidean|hyperbolic] [--flow-only]
#                     [--method=intrinsic_flips|fixed_triangles|edge_swaps|thurston] [MESH|generated:FACES...]
# Builds the benchmark and prints a table, with tabulators between the columns and a row for each
# mesh; without meshes, for a generated one. Speed is compared by the column `ratio`: CPU time of the
# flow over that of one analysis, factorisation and solution of the same matrix by CHOLMOD with AMD.
# tests/bench/plot.py draws such a table. BUILD_DIR=... builds somewhere else than in build/.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=${BUILD_DIR:-$root/build}

options=() meshes=()
for word in "$@"; do
	case $word in
	--*) options+=("$word") ;;
	*) meshes+=("$word") ;;
	esac
done
[ ${#meshes[@]} -gt 0 ] || meshes=(generated)

{
	cmake -S "$root" -B "$build" -DBUILD_TESTING=ON
	cmake --build "$build" --target ricci_bench
} >&2

bench=$build/tests/ricci_bench
# One thread: CPU seconds of several would add up to more than the work.
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 OMP_THREAD_LIMIT=1
"$bench" --header
status=0
for mesh in "${meshes[@]}"; do
	"$bench" "${options[@]}" "$mesh" || status=$?
done
exit $status
