#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what is missing, builds everything into build/ and runs all tests. Can be repeated.
# tests/deep.sh has the sanitizers and other tools that take longer.
set -euo pipefail
# shellcheck source=../filter_ricci/scripts/machine.sh
source "$(dirname "${BASH_SOURCE[0]}")/../filter_ricci/scripts/machine.sh"

run_tests() {
	cd "$build"
	rm -f tests.xml
	ctest --output-on-failure --output-junit "$build/tests.xml" -j "$(nproc)"
}

# ctest does not show why a test was skipped.
print_summary() {
	local total failed skipped
	total=$(junit_count tests)
	failed=$(junit_count failures)
	skipped=$(($(junit_count skipped) + $(junit_count disabled)))
	echo
	sed -n 's/.*\(SKIPPED: .*\)/\1/p' "$build/tests.xml" | sed 's/&quot;/"/g; s/&apos;/'"'"'/g' | sort -u
	echo "Built in $built s, tested in $((SECONDS - built)) s:" \
		"$((total - failed - skipped)) passed, $failed failed, $skipped skipped"
}

junit_count() {
	grep -o "[[:space:]]$1=\"[0-9]*\"" "$build/tests.xml" | head -n 1 | tr -dc '0-9'
}

mkdir -p "$build/sources"
say "Packages"
install_packages "${packages_build[@]}" "${packages_test[@]}" "${packages_meshlab[@]}" "${packages_python[@]}"
require_build_tools
say "MeshLab's headers"
fetch_sources meshlab-2020.09 meshlab-2022.02 meshlab-2025.07
say "PyMeshLab"
make_venv
add_companions
say "Build"
configure_and_build -DBUILD_TESTING=ON "$@"
built=$SECONDS
say "Tests"
status=0
run_tests || status=$?
print_summary
exit $status
