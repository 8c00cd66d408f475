#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# coverage.sh [FOLDER]: how much of filter_ricci/ the tests in meshlabserver and in PyMeshLab run, and
# which lines they do not: the two plugins are built with gcov into FOLDER (build/coverage). After
# tests/run.sh, which brings what the hosts need. Some ten minutes. Exit 77: it cannot run here.
#
# Branches are those of the lines that decide something: gcov counts the clean-up after an exception
# as a branch of every line that has one.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build
folder=${1:-$build/coverage}
plugins=(meshlab-2020.09 pymeshlab-2025.7)

for tool in gcov gcovr ninja; do
	command -v "$tool" >/dev/null || { echo "SKIPPED: $tool is not installed"; exit 77; }
done
[ -x "$build/venv/bin/python" ] || { echo "SKIPPED: there is no Python with PyMeshLab"; exit 77; }

source_of() {
	sed -n "s/^MESHLAB_$1_SOURCE_DIR:PATH=//p" "$build/CMakeCache.txt"
}

cmake -S "$root" -B "$folder" -G Ninja -DBUILD_TESTING=OFF \
	-DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O0 --coverage" \
	-DMESHLAB_2020_SOURCE_DIR="$(source_of 2020)" \
	-DMESHLAB_2025_SOURCE_DIR="$(source_of 2025)" >/dev/null
ninja -C "$folder" --quiet "${plugins[@]/%//libfilter_ricci.so}"
find "$folder" -name '*.gcda' -delete
for name in venv locales; do
	[ ! -e "$build/$name" ] || ln -sfn "$build/$name" "$folder/$name"
done

status=0
cd "$root/tests/hosts"
export PYTHONDONTWRITEBYTECODE=1
python3 test_meshlabserver.py "$folder" 2>"$folder/meshlabserver.log" || status=1
"$folder/venv/bin/python" test_pymeshlab.py "$folder" 2>"$folder/pymeshlab.log" || status=1
tail -qn 1 "$folder/meshlabserver.log" "$folder/pymeshlab.log"

decisions='\b(if|for|while|case)\b|\?|&&|\|\|'
for what in "" --branches; do
	gcovr -r "$root" --object-directory "$folder/filter_ricci" -f "$root/filter_ricci/" $what \
		--exclude-throw-branches --exclude-branches-by-pattern "^(?!.*($decisions)).*$" \
		"$folder/filter_ricci" 2>"$folder/gcovr.log"
done
exit $status
