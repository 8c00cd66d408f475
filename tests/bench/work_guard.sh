#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# bash work_guard.sh RICCI_BENCH: fails if the flow does more work than it should. Counts, no
# seconds: Newton steps, factorisations, solutions and floating-point operations of the linear
# solver; and, by callgrind, the instructions of the flow and of a complete run over those of one analysis,
# factorisation and solution of the flow's last matrix. The bounds are a tenth to a third above what they were when set;
# one is raised only together with the reason why the work is worth it.
set -euo pipefail
bench=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0

# no_more NAME VALUE BOUND
no_more() {
	if awk -v v="$2" -v b="$3" 'BEGIN { exit !(v + 0 == v && v <= b) }'; then
		echo "$1: $2, at most $3"
	else
		echo "$1: $2, more than $3"
		status=1
	fi
}

# column NAME: of the table in $work/table
column() {
	awk -F '\t' -v name="$1" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) c = i }
		NR == 2 { print $c }' "$work/table"
}

# instructions FUNCTION ARGUMENT...: executed in it and in what it calls, by the benchmark with these
# arguments
instructions() {
	local function=$1
	shift
	# On one core, so that all is done in one thread.
	taskset -c 0 valgrind --tool=callgrind "--callgrind-out-file=$work/out" \
		"--toggle-collect=$function" "$bench" "$@" 2>&1 >/dev/null | sed -n 's/.*Collected : //p'
}

# quotient A B
quotient() {
	awk -v a="$1" -v b="$2" 'BEGIN { printf "%.2f", a / b }'
}

mesh=generated:50000
{
	"$bench" --header
	"$bench" --flow-only --cone-distortion=1 "$mesh"
} >"$work/table"
echo "$mesh"
no_more "  Newton steps" "$(column iterations)" 3
no_more "  factorisations" "$(column factorizations)" 1
no_more "  solutions" "$(column solutions)" 7
no_more "  1e9 floating-point operations" "$(column gflop)" 0.22

if ! command -v valgrind >/dev/null || ! command -v taskset >/dev/null; then
	[ "$status" = 0 ] || exit "$status"
	echo "SKIPPED: instructions are not counted, valgrind or taskset is not installed"
	exit 77
fi
# Flow and factorisation run equally often.
flow=$(instructions '*startAndFlow*' --flow-only --cone-distortion=1 generated:6000)
factor=$(instructions '*solveOnce*' --flow-only --cone-distortion=1 generated:6000)
no_more "instructions, flow over one factorisation" "$(quotient "$flow" "$factor")" 2.6
# A complete run with cones, seams, charts and finish, on two sizes. Not one over the other: less work on the
# small one would count as more on the large one.
for bound in 6000:11 24000:8.6; do
	mesh=slab:${bound%:*}
	whole=$(instructions '*measureWholeWay*Row&)' --cone-distortion=0.25 "$mesh")
	factor=$(instructions '*solveOnce*' --flow-only --cone-distortion=0.25 "$mesh")
	no_more "instructions, whole way over one factorisation, $mesh" "$(quotient "$whole" "$factor")" \
		"${bound#*:}"
done
exit $status
