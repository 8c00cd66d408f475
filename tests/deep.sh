#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What takes longer than tests/run.sh and asks the same code harder questions. Needs what tests/run.sh
# installs and builds; a part whose tools are missing is skipped with the names of Debian's packages.
#
#     bash tests/deep.sh                      # all parts, within 40 minutes
#     bash tests/deep.sh --within SECONDS     # all parts, within another time
#     bash tests/deep.sh PART...              # these parts, without a limit
#     bash tests/deep.sh --all [PART...]      # more programs, and clang's path-sensitive checks
#
#     wheels          the wheel for Linux by zig, in an empty environment and on the oldest Debian, and the
#                     source distribution, compiled by pip; with --all the wheels for six platforms, run by
#                     Wine, qemu and musl where these are installed
#     blender         the add-on in bpy, Blender without a window
#     windows         the core built by mingw-w64, run by Wine
#     clang           clang, libc++ and char unsigned, as on ARM
#     long-double     a long double of 64 bits, as with MSVC and on Apple silicon
#     extra-plugins   the plugin, as meshlab-extra-plugins builds it
#     threads         the thread sanitizer
#     valgrind        the fuzz target under valgrind
#     fuzzing         20000 hostile meshes, and a minute of damaged files
#     clang-tidy      the checks of .clang-tidy
#     sanitizers      the address and undefined-behaviour sanitizers
#
# Each part has its share of the time, and what it leaves goes to the parts after it: those that may be
# skipped come first, and last the one that builds the whole library again. The summary has a line for each part. A part at its limit is cut off; what it has
# found until then counts.
#
# JOBS says how many compilers run at the same time (default: all processors).
set -euo pipefail
# shellcheck source=../filter_ricci/scripts/machine.sh
source "$(dirname "${BASH_SOURCE[0]}")/../filter_ricci/scripts/machine.sh"

folder=$build/deep
jobs=${JOBS:-$(nproc)}
googletest=/usr/src/googletest
parts=(blender windows clang long-double extra-plugins threads valgrind fuzzing clang-tidy sanitizers wheels)
# Seconds on two idle cores, rounded up.
declare -A share=([wheels]=480 [blender]=60 [windows]=300 [clang]=240 [long-double]=240
	[extra-plugins]=180 [threads]=60 [valgrind]=100 [fuzzing]=210 [clang-tidy]=420 [sanitizers]=750)
not_run=77

# The programs of the core that read no files of others.
portable=(base_test numerics_test mesh_test metric_test cut_test layout_test measure_test bridge_test)
portable_all=(solver_test flow_test cones_test charts_test optimize_test hyperbolic_test
	public_test)
# The programs that meet hostile input.
hostile=(numerics_test solver_test mesh_test cut_test charts_test layout_test public_test faults_test)
hostile_all=(base_test metric_test flow_test cones_test measure_test)

have() {
	command -v "$1" >/dev/null
}

missing() {
	skipped "$1"
	exit $not_run
}

# The time limit of one program. It stays in the group that the limit of a part ends.
limited() {
	timeout --foreground "$@"
}

compiles() {
	"$@" -x c++ -fsyntax-only - 2>/dev/null
}

# build_core PART OPTION...: the programs of a part. Shows the errors alone.
build_core() {
	local part=$1
	shift
	{
		cmake -S "$root" -B "$folder/$part" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DBUILD_TESTING=ON \
			-DRICCI_BUILD_PLUGINS=OFF -DMESHLAB_2020_SOURCE_DIR="$build/sources/meshlab-2020.09" \
			-DMESHLAB_2025_SOURCE_DIR="$build/sources/meshlab-2025.07" "$@" &&
			cmake --build "$folder/$part" --parallel "$jobs" --target "${programs[@]}"
	} >"$folder/$part.build.log" 2>&1 || {
		grep -E 'error|Error|undefined' "$folder/$part.build.log" | head -n 30
		return 1
	}
}

# run_core PART [LAUNCHER]: from the repository's root, because some tests read files by paths from there.
run_core() {
	local part=$1 launcher=${2:-} program suffix='' status=0
	[ "$part" = windows ] && suffix=.exe
	for program in "${programs[@]}"; do
		[ "$program" != ricci_fuzz ] || continue
		echo "$part: $program"
		# shellcheck disable=SC2086 # no launcher is no word
		(cd "$root" && limited 900 $launcher "$folder/$part/tests/$program$suffix" --gtest_brief=1 |
			tr -d '\r') || status=1
	done
	return $status
}

# portable_core PART OPTION...: GoogleTest is built from its sources, with the same options.
portable_core() {
	local part=$1
	shift
	[ -e "$googletest/CMakeLists.txt" ] || missing "$part: GoogleTest's sources (Debian: googletest)"
	programs=("${portable[@]}")
	[ -z "$all" ] || programs+=("${portable_all[@]}")
	# Without MeshLab's trees: vcglib is not what these parts are about.
	build_core "$part" -DCMAKE_CXX_FLAGS_DEBUG=-O1 -DRICCI_GTEST_SOURCE_DIR="$googletest" \
		-DMESHLAB_2020_SOURCE_DIR= -DMESHLAB_2025_SOURCE_DIR= "$@"
}

# debian_system NAME SUITE OPTION...: a Debian's files in $folder/systems/NAME, with Python.
debian_system() {
	local name=$1 suite=$2 mirror
	shift 2
	[ ! -d "$folder/systems/$name" ] || return 0
	if ! have debootstrap || [ "$(id -u)" -ne 0 ]; then
		skipped "wheels: the system $name needs root and debootstrap (Debian: debootstrap)"
		return 1
	fi
	mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Label: Debian' | head -n 1)
	mkdir -p "$folder/systems"
	rm -rf "$folder/systems/$name.part"
	debootstrap --variant=minbase "$@" "$suite" "$folder/systems/$name.part" "$mirror" \
		>"$folder/systems/$name.log" 2>&1 || {
		skipped "wheels: debootstrap cannot make the system $name; see build/deep/systems/$name.log"
		return 1
	}
}

# The C libraries and Pythons that the wheels for Linux are tried with: of the oldest Debian to be had, and of
# arm64, whose packages are unpacked and not set up.
other_systems() {
	local package systems=$folder/systems
	if debian_system oldest bullseye --include=python3-venv && [ -d "$systems/oldest.part" ]; then
		mv "$systems/oldest.part" "$systems/oldest"
	fi
	[ -n "$all" ] || return 0
	if debian_system arm64 bookworm --arch=arm64 --foreign --include=python3 &&
		[ -d "$systems/arm64.part" ]; then
		for package in "$systems"/arm64.part/var/cache/apt/archives/*.deb; do
			dpkg-deb --fsys-tarfile "$package" | tar -x -C "$systems/arm64.part" --keep-directory-symlink
		done
		mv "$systems/arm64.part" "$systems/arm64"
	fi
}

# python_with NAME PACKAGE...: an environment of its own in $folder/NAME.
python_with() {
	local name=$1
	shift
	{ [ -x "$folder/$name/bin/pip" ] || python3 -m venv "$folder/$name"; } >"$folder/$name.log" 2>&1 &&
		"$folder/$name/bin/pip" install -q "$@" >>"$folder/$name.log" 2>&1
}

part_wheels() {
	local code=0 platforms=(sdist manylinux_2_17_x86_64)
	[ -z "$all" ] || platforms+=(manylinux_2_17_aarch64 musllinux_1_2_x86_64 win_amd64 macosx_11_0_arm64
		macosx_10_15_x86_64)
	python_with wheels.venv lief numpy || missing "wheels: pip cannot install lief, which reads libraries"
	[ -e "$build/library/libricciflow.so" ] || missing "wheels: the library to compare with is not built"
	JOBS=$jobs bash "$root/filter_ricci/wheels.sh" "${platforms[@]}" || code=$?
	[ $code -ne $not_run ] || missing "wheels: the line above says what they need"
	[ $code -eq 0 ] || return 1
	other_systems
	(cd "$root/tests/hosts" &&
		"$folder/wheels.venv/bin/python" -B test_wheels.py "$build" "${platforms[@]}") 2>&1 |
		sed "s/skipped '\(.*\)'$/\nSKIPPED: wheels: \1/"
}

# The newest Blender that this Python has; 400 MB.
part_blender() {
	python_with blender.venv bpy || missing "blender: pip has no bpy for this Python; see deep/blender.venv.log"
	(cd "$root/tests/hosts" && "$folder/blender.venv/bin/python" -B test_blender.py "$build")
}

part_windows() {
	local wine
	have x86_64-w64-mingw32-g++-posix || missing "windows (Debian: g++-mingw-w64-x86-64-posix)"
	portable_core windows -DCMAKE_TOOLCHAIN_FILE="$root/tests/mingw-w64.cmake"
	wine=$(command -v wine64 || command -v wine || ls /usr/lib/wine/wine64 2>/dev/null) ||
		missing "windows: running what was built (Debian: wine64)"
	export WINEPREFIX=$folder/wine WINEDEBUG=-all
	run_core windows "$wine"
}

part_clang() {
	if ! have clang++ || ! echo '#include <vector>' | compiles clang++ -stdlib=libc++; then
		missing "clang with libc++ (Debian: clang, libc++-dev, libc++abi-dev)"
	fi
	portable_core clang -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_CXX_FLAGS="-stdlib=libc++ -funsigned-char"
	run_core clang
}

part_long_double() {
	echo 'static_assert(sizeof(long double) == 8);' | compiles c++ -std=c++17 -mlong-double-64 ||
		missing "long-double: this compiler has no -mlong-double-64"
	portable_core long-double -DCMAKE_CXX_FLAGS=-mlong-double-64
	run_core long-double
}

# MeshLab's own library is not built: what is linked against it stays open, as in every plugin here.
part_extra_plugins() {
	local meshlab=${MESHLAB_2025_SOURCE_DIR:-$build/sources/meshlab-2025.07}
	[ -e "$meshlab/src/cmake/meshlab_tools.cmake" ] ||
		missing "extra-plugins: there is no source tree of MeshLab 2025.07"
	{
		cmake -S "$root/tests/hosts/extra_plugins" -B "$folder/extra-plugins" -G Ninja \
			-DCMAKE_BUILD_TYPE=Release -DMESHLAB_DIR="$meshlab" &&
			cmake --build "$folder/extra-plugins" --parallel "$jobs" &&
			test -e "$folder/extra-plugins/plugins/libfilter_ricci.so"
	} >"$folder/extra-plugins.build.log" 2>&1 || {
		tail -n 30 "$folder/extra-plugins.build.log"
		return 1
	}
}

# Data races, in the functions that start threads or that several threads meet in. That of the whole core
# takes minutes to compile, and OpenMP in the system's CHOLMOD is reported where there is no race.
part_threads() {
	local test program
	echo 'int main() {}' | c++ -fsanitize=thread -x c++ -o /dev/null - 2>/dev/null ||
		missing "threads: this compiler has no thread sanitizer"
	for test in base/parallel_test numerics/one_thread_test; do
		program=$folder/${test##*/}
		c++ -std=c++17 -O1 -g -fsanitize=thread -I"$root/vcg_ext" "$root/tests/$test.cpp" \
			"$root"/vcg_ext/ricci/base/{task,error,crew}.cpp \
			-lgtest_main -lgtest -lpthread -o "$program"
		limited 20 "$program" --gtest_brief=1 || return 1
	done
}

# Sees also what was never set, and what the solver's library does: memory faults, crashes and hangs are
# what counts here.
part_valgrind() {
	local status=0
	have valgrind || missing "valgrind (Debian: valgrind)"
	limited 600 valgrind --quiet --error-exitcode=99 --exit-on-first-error=yes \
		"$build/tests/ricci_fuzz" --go-on --patience 300 --runs 100 "$root/tests/fuzz/corpus" || status=$?
	[ $status -ne 99 ] && [ $status -lt 124 ]
}

# A process for each processor, each with a seed of its own. An input that shows a defect is left in its
# folder.
part_fuzzing() {
	local seed count=$jobs processes=() status=0
	for ((seed = 1; seed <= count; ++seed)); do
		mkdir -p "$folder/fuzzing/$seed"
		(cd "$folder/fuzzing/$seed" && exec "$build/tests/ricci_fuzz" --runs $((20000 / count)) \
			--seed "$seed" "$root/tests/fuzz/corpus") &
		processes+=($!)
	done
	for seed in "${processes[@]}"; do
		wait "$seed" || status=1
	done
	(cd "$folder/fuzzing" && "$build/venv/bin/python" "$root/tests/fuzz/fuzz_files.py" 60) || status=1
	return $status
}

part_clang_tidy() {
	local checks=() status=0
	have clang-tidy || missing "clang-tidy (Debian: clang-tidy)"
	# It cannot read the headers that gcc has precompiled.
	cmake -S "$root" -B "$folder/clang-tidy" -DRICCI_PRECOMPILE=OFF -DRICCI_BUILD_PLUGINS=OFF \
		-DBUILD_TESTING=OFF >"$folder/clang-tidy.build.log"
	[ -n "$all" ] || checks=(--checks='-clang-analyzer-*')
	find "$root/vcg_ext/ricci" -name '*.cpp' -print0 | sort -z |
		xargs -0 -n 4 -P "$jobs" clang-tidy -p "$folder/clang-tidy" --quiet "${checks[@]}" \
			2>>"$folder/clang-tidy.build.log" || status=1
	[ $status -eq 0 ] || tail -n 5 "$folder/clang-tidy.build.log"
	return $status
}

# Allocations that fail cannot be tested here: the sanitizers bring an allocator of their own.
part_sanitizers() {
	local status=0
	echo 'int main() {}' | c++ -fsanitize=address,undefined -x c++ -o /dev/null - 2>/dev/null ||
		missing "sanitizers: this compiler has none"
	programs=("${hostile[@]}" ricci_fuzz)
	[ -z "$all" ] || programs+=("${hostile_all[@]}")
	build_core sanitizers -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g1" -DRICCI_SANITIZE=ON
	run_core sanitizers || status=1
	(cd "$folder/sanitizers" && limited 300 tests/ricci_fuzz --runs 1500 "$root/tests/fuzz/corpus") ||
		status=1
	return $status
}

# What a part that was cut off has found until then.
found_something() {
	grep -qE ': (error|warning):|runtime error:|Sanitizer:|\[ *FAILED *\]|^DEFECT' "$1"
}

# run_all SECONDS
run_all() {
	local deadline=$((SECONDS + $1)) part later sum limit start code word summary=() failed=0
	for part in "${parts[@]}"; do
		say "$part"
		sum=0
		for later in "${parts[@]:${#summary[@]}}"; do
			sum=$((sum + share[$later]))
		done
		limit=$(((deadline - SECONDS) * share[$part] / sum))
		[ $limit -ge 1 ] || limit=1
		start=$SECONDS
		code=0
		# Not through a pipe: a server that a part leaves behind would keep it open.
		timeout -k 10 "$limit" bash "${BASH_SOURCE[0]}" ${all:+--all} "$part" \
			>"$folder/$part.log" 2>&1 || code=$?
		cat "$folder/$part.log"
		case $code in
		0) word=passed ;;
		"$not_run") word=skipped ;;
		124 | 137) word="cut off" && ! found_something "$folder/$part.log" || word="failed, cut off" ;;
		*) word=failed ;;
		esac
		[[ $word != failed* ]] || failed=1
		summary+=("$(printf '%-14s %-16s %5d s of %5d s' "$part" "$word" $((SECONDS - start)) "$limit")")
	done
	say "Summary of the deep tests"
	printf '%s\n' "${summary[@]}"
	return $failed
}

all=
within=2400
chosen=()
while [ $# -gt 0 ]; do
	case $1 in
	--all) all=yes ;;
	--within) within=$2 && shift ;;
	*) [ -n "${share[$1]:-}" ] || { echo "There is no part $1: ${parts[*]}"; exit 2; }
		chosen+=("$1") ;;
	esac
	shift
done
mkdir -p "$folder"
if [ ${#chosen[@]} -eq 0 ]; then
	run_all "$within"
elif [ ${#chosen[@]} -eq 1 ]; then
	"part_${chosen[0]//-/_}"
else
	status=0
	for part in "${chosen[@]}"; do
		say "$part"
		code=0
		bash "${BASH_SOURCE[0]}" ${all:+--all} "$part" || code=$?
		[ $code -eq 0 ] || [ $code -eq $not_run ] || status=1
	done
	exit $status
fi
