#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The address, undefined-behaviour and thread sanitizers, valgrind and clang-tidy. Bounded: about ten
# minutes on two cores. Needs what tests/run.sh installs and builds, and is run by it.
#
#     bash tests/sanitize.sh          # what tests/run.sh runs
#     bash tests/sanitize.sh --all    # clang's path-sensitive checks and all core tests, too
set -euo pipefail
# shellcheck source=../filter_ricci/scripts/machine.sh
source "$(dirname "${BASH_SOURCE[0]}")/../filter_ricci/scripts/machine.sh"

all=${1:-}
folder=$build/sanitize

# The programs that meet hostile input first: the rest of the core's tests takes as long again.
programs=(math_test surface_test cut_test charts_test layout_test facade_test faults_test)
[ "$all" = --all ] && programs+=(
	metric_test flow_test curvature_test seamless_test verify_test pipeline_test)

build_sanitized() {
	if ! echo 'int main() {}' | c++ -fsanitize=address,undefined -x c++ -o /dev/null - 2>/dev/null; then
		skipped "the sanitizers: this compiler has none"
		return 1
	fi
	{
		cmake -S "$root" -B "$folder" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g1" \
			-DRICCI_SANITIZE=ON -DMESHLAB_2020_SOURCE_DIR="$build/sources/meshlab-2020.09" \
			-DMESHLAB_2025_SOURCE_DIR="$build/sources/meshlab-2025.07" &&
			cmake --build "$folder" --parallel "$(nproc)" --target "${programs[@]}" ricci_fuzz
	} >"$build/sanitize.log" 2>&1 || {
		tail -n 30 "$build/sanitize.log"
		exit 1
	}
}

run_sanitized() {
	local program status=0
	for program in "${programs[@]}"; do
		timeout 300 "$folder/tests/$program" --gtest_brief=1 || status=1
	done
	# From a folder of its own: an input that shows a defect is left there.
	(cd "$folder" && timeout 300 tests/ricci_fuzz --runs 1500 "$root/tests/fuzz/corpus") || status=1
	return $status
}

# Data races, in the functions that start threads or that several threads meet in. That of the whole core
# takes minutes to compile, and OpenMP in the system's CHOLMOD is reported where there is no race.
run_thread_sanitizer() {
	if ! echo 'int main() {}' | c++ -fsanitize=thread -x c++ -o /dev/null - 2>/dev/null; then
		skipped "the thread sanitizer: this compiler has none"
		return 0
	fi
	mkdir -p "$folder"
	local test program
	for test in base/parallel_test math/one_thread_test; do
		program=$folder/${test##*/}
		c++ -std=c++17 -O1 -g -fsanitize=thread -I"$root/vcg_ext" "$root/tests/$test.cpp" \
			"$root"/vcg_ext/ricci/base/{task,error}.cpp \
			-lgtest_main -lgtest -lpthread -o "$program" || return 1
		timeout 300 "$program" --gtest_brief=1 || return 1
	done
}

# Also sees what was never set, and what the solver's library does: only memory faults, crashes and
# hangs count here.
run_valgrind() {
	local status=0
	if ! command -v valgrind >/dev/null; then
		skipped "valgrind: it is not installed"
		return 0
	fi
	(cd "$build" && timeout 600 valgrind --quiet --error-exitcode=99 --exit-on-first-error=yes \
		tests/ricci_fuzz --go-on --patience 300 --runs 100 "$root/tests/fuzz/corpus") || status=$?
	[ $status -ne 99 ] && [ $status -lt 124 ]
}

run_clang_tidy() {
	local checks=() status=0
	if ! command -v clang-tidy >/dev/null; then
		skipped "clang-tidy: it is not installed"
		return 0
	fi
	# It cannot read the headers that gcc has precompiled.
	cmake -S "$root" -B "$build/clang-tidy" -DRICCI_PRECOMPILE=OFF -DRICCI_BUILD_PLUGINS=OFF \
		-DBUILD_TESTING=OFF >"$build/clang-tidy.log" || return 1
	[ "$all" = --all ] || checks=(--checks='-clang-analyzer-*')
	find "$root/vcg_ext/ricci" -name '*.cpp' -print0 | sort -z |
		xargs -0 -n 4 -P "$(nproc)" clang-tidy -p "$build/clang-tidy" --quiet "${checks[@]}" \
			>"$build/clang-tidy.log" 2>&1 || status=1
	grep -E '(error|warning):' "$build/clang-tidy.log" | sort -u || true
	return $status
}

status=0
say "Sanitizers"
if build_sanitized; then
	run_sanitized || status=1
fi
run_thread_sanitizer || status=1
say "Valgrind"
run_valgrind || status=1
say "clang-tidy"
run_clang_tidy || status=1
exit $status
