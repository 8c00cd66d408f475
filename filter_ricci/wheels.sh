#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the Python package for other people's machines: a wheel for each platform and the source
# distribution, in build/release/wheels/. From Linux, by zig, which the package index has, and from the
# sources of CHOLMOD in Debian's archive. The same sources give the same wheels, bit by bit.
#
#     bash filter_ricci/wheels.sh                        # all platforms, five minutes of a processor each
#     bash filter_ricci/wheels.sh win_amd64 ...          # these
#     bash filter_ricci/wheels.sh sdist                  # the source distribution alone
#
# What is compiled stays in build/wheels/. JOBS says how many compilers run at the same time (default: all
# processors).
set -euo pipefail
# shellcheck source=scripts/machine.sh
source "$(dirname "${BASH_SOURCE[0]}")/scripts/machine.sh"

zig_version=0.17.1 # another one makes other bits
suitesparse="suitesparse-5.12.0"
meshlab="meshlab-2025.07" # has vcglib inside
eigen=/usr/include/eigen3
folder=$build/wheels
wheels=$build/release/wheels

platforms=(manylinux_2_17_x86_64 manylinux_2_17_aarch64 musllinux_1_2_x86_64 win_amd64 macosx_11_0_arm64
	macosx_10_15_x86_64)
declare -A zig_target=(
	[manylinux_2_17_x86_64]=x86_64-linux-gnu.2.17
	[manylinux_2_17_aarch64]=aarch64-linux-gnu.2.17
	[musllinux_1_2_x86_64]=x86_64-linux-musl
	[win_amd64]=x86_64-windows-gnu
	[macosx_11_0_arm64]=aarch64-macos.11.0
	[macosx_10_15_x86_64]=x86_64-macos.10.15)
# What an installer of 2020 calls the same platform.
declare -A also=(
	[manylinux_2_17_x86_64]=.manylinux2014_x86_64
	[manylinux_2_17_aarch64]=.manylinux2014_aarch64)

# The code says that nothing is wrong but what is missing.
need() {
	echo "The wheels need $1."
	exit 77
}

# zig in an environment of its own, and its parts as programs of their own, as CMake wants them.
get_zig() {
	local tool
	[[ $("$folder/zig/bin/python" -m pip show ziglang 2>/dev/null) == *"Version: $zig_version"* ]] || {
		python3 -m venv "$folder/zig" && "$folder/zig/bin/pip" install -q "ziglang==$zig_version"
	} >"$folder/zig.log" 2>&1 || need "zig $zig_version, which pip could not install; see build/wheels/zig.log"
	zig=$("$folder/zig/bin/python" -c 'import os, ziglang; print(os.path.dirname(ziglang.__file__))')
	mkdir -p "$folder/bin"
	ln -sf "$zig/zig" "$folder/bin/zig"
	for tool in ar ranlib rc; do
		printf '#!/bin/sh\nexec "%s/zig" %s "$@"\n' "$zig" $tool >"$folder/bin/zig-$tool"
		chmod +x "$folder/bin/zig-$tool"
	done
	export ZIG_GLOBAL_CACHE_DIR=$folder/cache ZIG_LOCAL_CACHE_DIR=$folder/cache
}

# The source distribution as a tree: what the library and the package are made of, and beside it, in
# sources/, what they need of others.
gather() {
	local new=$tree.new sources=$tree.new/sources file
	rm -rf "$new"
	mkdir -p "$sources"/{SuiteSparse,vcglib/wrap,Eigen/include/eigen3,Eigen/share/eigen3}
	(cd "$root" && find CMakeLists.txt {LICENSE,README.md,CITATION.cff,vcg_ext,filter_ricci} -type f \
		-not -path '*/__pycache__/*' -not -path 'filter_ricci/demo/*' -print0 |
		xargs -0 cp --parents -t "$new")
	mv "$new/filter_ricci/python/pyproject.toml" "$new/" # where pip looks for it
	cp -r "$build/sources/$meshlab/src/vcglib/vcg" "$sources/vcglib/"
	cp "$build/sources/$meshlab/src/vcglib/LICENSE.txt" "$sources/vcglib/LICENSE"
	cp "$build/sources/$meshlab/src/vcglib/wrap/callback.h" "$sources/vcglib/wrap/"
	cp -r "$eigen/Eigen" "$sources/Eigen/include/eigen3/"
	cp -r /usr/share/eigen3/cmake "$sources/Eigen/share/eigen3/"
	cp /usr/share/doc/libeigen3-dev/copyright "$sources/Eigen/LICENSE"
	if [ -d "$build/sources/$suitesparse" ]; then
		(cd "$build/sources/$suitesparse" && cp -r --parents SuiteSparse_config/*.[ch] \
			CHOLMOD/{Include,Core,Cholesky,Supernodal} {AMD,COLAMD}/{Include,Source} "$sources/SuiteSparse/")
		for file in CHOLMOD AMD COLAMD; do
			cat "$build/sources/$suitesparse/$file/Doc/License.txt"
		done >"$sources/SuiteSparse/LICENSE"
	else
		rmdir "$sources/SuiteSparse"
		echo "Without the sources of CHOLMOD the wheels have Eigen's solver, slower on large meshes."
	fi
	# A file that has not changed keeps its time, so that only what changes is compiled again.
	mkdir -p "$tree"
	while IFS= read -r -d '' file; do
		[ -e "$new/$file" ] || rm "$tree/$file"
	done < <(cd "$tree" && find . -type f -print0)
	while IFS= read -r -d '' file; do
		cmp -s "$new/$file" "$tree/$file" || install -D -m 644 "$new/$file" "$tree/$file"
	done < <(cd "$new" && find . -type f -print0)
	rm -rf "$new"
}

# compiled_in PLATFORM: in $expression and $licences, what zig puts into the library.
compiled_in() {
	local library=$zig/lib
	expression="Apache-2.0 WITH LLVM-exception AND MIT"
	licences=("$library/libcxx/LICENSE.TXT=LICENSE.libcxx" "$library/libcxxabi/LICENSE.TXT=LICENSE.libcxxabi"
		"$library/libunwind/LICENSE.TXT=LICENSE.libunwind" "$zig/LICENSE=LICENSE.zig")
	case $1 in
	manylinux*) licences+=("$library/libc/glibc/LICENSES=LICENSES.glibc") ;;
	win*)
		expression+=" AND ZPL-2.1"
		licences+=("$library/libc/mingw/COPYING=LICENSE.mingw-w64")
		;;
	esac
}

# make_wheel PLATFORM
make_wheel() {
	local platform=$1 suitesparse_tree='' library
	say "$platform"
	[ ! -d "$tree/sources/SuiteSparse" ] || suitesparse_tree=$tree/sources/SuiteSparse
	{
		cmake -S "$tree" -B "$folder/$platform" -G Ninja --toolchain "$tree/filter_ricci/scripts/zig.cmake" \
			-DRICCI_ZIG="$folder/bin" -DRICCI_ZIG_TARGET="${zig_target[$platform]}" -DBUILD_TESTING=OFF \
			-DCMAKE_DISABLE_FIND_PACKAGE_Qt5=ON -DCCACHE= -DEigen3_DIR="$tree/sources/Eigen/share/eigen3/cmake" \
			-DVCGLIB_DIR="$tree/sources/vcglib" -DSUITESPARSE_SOURCE_DIR="$suitesparse_tree" &&
			cmake --build "$folder/$platform" --parallel "${JOBS:-$(nproc)}" --target ricciflow
	} >"$folder/$platform.log" 2>&1 || {
		grep -E 'error:|Error |FAILED' "$folder/$platform.log" | head -n 20
		echo "FAILED: $platform; see build/wheels/$platform.log"
		return 1
	}
	library=$(find "$folder/$platform/library" -name '*ricciflow.so' -o -name '*.dylib' -o -name '*.dll')
	[[ $platform != macosx* ]] || python3 -B "$root/filter_ricci/python/keep_inside.py" "$library" _ricci_ ||
		return 1
	compiled_in "$platform"
	python3 -B "$tree/filter_ricci/python/build_backend.py" "$library" "$platform${also[$platform]:-}" \
		"$wheels" "$expression" "${licences[@]}"
}

chosen=("$@")
[ $# -gt 0 ] || chosen=(sdist "${platforms[@]}")
for platform in "${chosen[@]}"; do
	[ "$platform" = sdist ] || [ -n "${zig_target[$platform]:-}" ] ||
		{ echo "There is no platform $platform: sdist ${platforms[*]}"; exit 2; }
done
mkdir -p "$folder" "$build/sources" "$wheels"
for tool in cmake ninja python3; do
	command -v $tool >/dev/null || need "$tool"
done
tree=$folder/tree # one place for all versions: what is compiled names it
say "Sources"
fetch_sources $meshlab $suitesparse
[ -d "$build/sources/$meshlab" ] || need "vcglib, in build/sources/$meshlab"
[ -d $eigen ] || need "Eigen in $eigen (Debian: libeigen3-dev)"
gather
status=0
for platform in "${chosen[@]}"; do
	if [ "$platform" = sdist ]; then
		(cd "$tree/filter_ricci/python" &&
			python3 -B -c 'import sys, build_backend; print(build_backend.build_sdist(sys.argv[1]))' "$wheels")
		continue
	fi
	[ -n "${zig:-}" ] || get_zig
	make_wheel "$platform" || status=1
done
exit $status
