#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Needs what tests/run.sh installs and builds. Takes longer than all of its tests together.
set -euo pipefail
# shellcheck source=../filter_ricci/scripts/machine.sh
source "$(dirname "${BASH_SOURCE[0]}")/../filter_ricci/scripts/machine.sh"

# The parts of the core that meet hostile input first, with the address and undefined-behaviour
# sanitizers, and the fuzz target under valgrind, which also sees what was never set.
run_sanitized() {
	local folder=$build/sanitize status=0
	if ! echo 'int main() {}' | c++ -fsanitize=address,undefined -x c++ -o /dev/null - 2>/dev/null; then
		skipped "the sanitizers: this compiler has none"
		return 0
	fi
	cmake -S "$root" -B "$folder" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g1" \
		-DRICCI_SANITIZE=ON -DMESHLAB_2020_SOURCE_DIR="$build/sources/meshlab-2020.09" \
		-DMESHLAB_2025_SOURCE_DIR="$build/sources/meshlab-2025.07" >"$build/sanitize.log" &&
		cmake --build "$folder" --parallel "$(nproc)" --target \
			surface_test layout_test facade_test faults_test ricci_fuzz >>"$build/sanitize.log" ||
		{ tail -n 30 "$build/sanitize.log"; return 1; }
	local program
	for program in surface_test layout_test facade_test faults_test; do
		"$folder/tests/$program" --gtest_brief=1 || status=1
	done
	"$folder/tests/ricci_fuzz" --runs 20000 "$root/tests/fuzz/corpus" || status=1
	if command -v valgrind >/dev/null; then
		valgrind --quiet --error-exitcode=1 "$build/tests/ricci_fuzz" --runs 300 \
			"$root/tests/fuzz/corpus" || status=1
	else
		skipped "valgrind: it is not installed"
	fi
	return $status
}

say "Sanitizers"
run_sanitized
