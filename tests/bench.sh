#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# bash tests/bench.sh [--geometry=euclidean|hyperbolic] [--flow-only]
#                     [--method=intrinsic_flips|fixed_triangles|edge_swaps|thurston] [MESH|generated:FACES...]
# bash tests/bench.sh --growth [CASE...]
# Builds the benchmark and prints a table, with tabs between the columns and a row for each
# mesh; without meshes, for a generated one. Speed is compared by the column `ratio`: CPU time of the
# flow over that of one analysis, factorisation and solution of the same matrix by CHOLMOD with AMD.
# tests/bench/plot.py draws such a table. --growth prints how processor time grows with the size of
# generated cases (tests/bench/growth.cpp). BUILD_DIR=... builds somewhere else than in build/.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=${BUILD_DIR:-$root/build}

options=() meshes=() target=ricci_bench
for word in "$@"; do
	case $word in
	--growth) target=ricci_growth ;;
	--*) options+=("$word") ;;
	*) meshes+=("$word") ;;
	esac
done
{
	cmake -S "$root" -B "$build" -DBUILD_TESTING=ON
	cmake --build "$build" --target $target
} >&2

# One thread: CPU seconds of several would add up to more than the work.
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 OMP_THREAD_LIMIT=1
bench=$build/tests/$target
[ $target = ricci_bench ] || exec "$bench" "${meshes[@]}"
[ ${#meshes[@]} -gt 0 ] || meshes=(generated)
"$bench" --header
status=0
for mesh in "${meshes[@]}"; do
	"$bench" "${options[@]}" "$mesh" || status=$?
done
exit $status
