#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The core and its tests under the rules of other platforms. A part whose tools are missing is skipped.
#
#     bash tests/portability.sh                       # all parts, the small programs
#     bash tests/portability.sh windows               # one part, of those below
#     bash tests/portability.sh --all [part]          # all programs that need no other files
#
#     clang         clang, libc++ and char unsigned, as on ARM
#     long-double   a long double of 64 bits, as with MSVC and on Apple silicon
#     windows       mingw-w64, run by Wine
#     extra-plugins the plugin, as meshlab-extra-plugins builds it
#
# JOBS says how many compilers run at the same time (default: all processors).
set -euo pipefail
# shellcheck source=../filter_ricci/scripts/machine.sh
source "$(dirname "${BASH_SOURCE[0]}")/../filter_ricci/scripts/machine.sh"

folder=$build/portability
googletest=/usr/src/googletest
programs=(math_test surface_test metric_test cut_test layout_test verify_test error_sentences_test)
parts=(clang long-double windows extra-plugins)

for argument in "$@"; do
	case $argument in
	--all) programs+=(flow_test curvature_test seamless_test charts_test finish_test fuchsian_test measure_test
		pipeline_test conformal_invariants_test free_memory_test) ;;
	*) parts=("$argument") ;;
	esac
done

have() {
	command -v "$1" >/dev/null
}

# build_part NAME OPTION...: GoogleTest is built from its sources, with the same options.
build_part() {
	local part=$1
	shift
	if [ ! -e "$googletest/CMakeLists.txt" ]; then
		skipped "GoogleTest's sources (Debian: googletest)"
		return 2
	fi
	mkdir -p "$folder"
	{
		cmake -S "$root" -B "$folder/$part" -G Ninja -DCMAKE_BUILD_TYPE=Debug \
			-DCMAKE_CXX_FLAGS_DEBUG=-O1 -DBUILD_TESTING=ON -DRICCI_BUILD_PLUGINS=OFF \
			-DRICCI_GTEST_SOURCE_DIR="$googletest" "$@" &&
			cmake --build "$folder/$part" --parallel "${JOBS:-$(nproc)}" --target "${programs[@]}"
	} >"$folder/$part.log" 2>&1 || {
		grep -E 'error|Error|undefined' "$folder/$part.log" | head -n 30
		return 1
	}
}

# run_part NAME [LAUNCHER]
run_part() {
	local part=$1 launcher=${2:-} program suffix='' status=0
	[ "$part" = windows ] && suffix=.exe
	for program in "${programs[@]}"; do
		echo "$part: $program"
		# Some tests read files by paths from the repository's root.
		(cd "$root" && timeout 900 $launcher "$folder/$part/tests/$program$suffix" --gtest_brief=1 |
			tr -d '\r') || status=1
	done
	return $status
}

check_clang() {
	if ! have clang++ || ! echo '#include <vector>' |
		clang++ -stdlib=libc++ -x c++ -fsyntax-only - 2>/dev/null; then
		skipped "clang with libc++ (Debian: clang, libc++-dev, libc++abi-dev)"
		return 0
	fi
	build_part clang -DCMAKE_CXX_COMPILER=clang++ \
		-DCMAKE_CXX_FLAGS="-stdlib=libc++ -funsigned-char" || return
	run_part clang
}

check_long_double() {
	if ! echo 'static_assert(sizeof(long double) == 8);' |
		c++ -std=c++17 -mlong-double-64 -x c++ -fsyntax-only - 2>/dev/null; then
		skipped "a long double of 64 bits: this compiler has no -mlong-double-64"
		return 0
	fi
	build_part long-double -DCMAKE_CXX_FLAGS=-mlong-double-64 || return
	run_part long-double
}

check_windows() {
	local wine
	if ! have x86_64-w64-mingw32-g++-posix; then
		skipped "Windows (Debian: g++-mingw-w64-x86-64-posix)"
		return 0
	fi
	build_part windows -DCMAKE_TOOLCHAIN_FILE="$root/tests/mingw-w64.cmake" || return
	wine=$(command -v wine64 || command -v wine || ls /usr/lib/wine/wine64 2>/dev/null) || {
		skipped "running what was built for Windows (Debian: wine64)"
		return 0
	}
	export WINEPREFIX=$folder/wine WINEDEBUG=-all
	run_part windows "$wine"
}

# MeshLab's own library is not built: what is linked against it stays open, as in every plugin here.
check_extra_plugins() {
	local meshlab=${MESHLAB_2025_SOURCE_DIR:-$build/sources/meshlab-2025.07}
	if [ ! -e "$meshlab/src/cmake/meshlab_tools.cmake" ]; then
		skipped "a folder of meshlab-extra-plugins: MeshLab 2025.07's source tree"
		return 0
	fi
	mkdir -p "$folder"
	{
		cmake -S "$root/tests/hosts/extra_plugins" -B "$folder/extra-plugins" -G Ninja \
			-DCMAKE_BUILD_TYPE=Release -DMESHLAB_DIR="$meshlab" &&
			cmake --build "$folder/extra-plugins" --parallel "${JOBS:-$(nproc)}" &&
			test -e "$folder/extra-plugins/plugins/libfilter_ricci.so"
	} >"$folder/extra-plugins.log" 2>&1 || {
		tail -n 30 "$folder/extra-plugins.log"
		return 1
	}
}

status=0
for part in "${parts[@]}"; do
	say "Portability: $part"
	SECONDS=0
	code=0
	"check_${part//-/_}" || code=$?
	[ $code -eq 0 ] || [ $code -eq 2 ] || status=1 # 2: skipped
	echo "$part: $SECONDS s"
done
exit $status
