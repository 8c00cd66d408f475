# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash
# What demo.sh, tests/run.sh and tests/deep.sh share: a machine with everything installed, MeshLab's headers,
# a Python with PyMeshLab, a private copy of MeshLab 2020.09, and the built plugin. Every step can be
# repeated, prints what it does, and says plainly what is missing; only the build itself is vital.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$root/build
export LC_ALL=C.UTF-8

say() { printf '\n== %s\n' "$*"; }
skipped() { printf 'SKIPPED: %s\n' "$*"; }

packages_build=(ca-certificates cmake dpkg-dev file g++ ninja-build xz-utils
	libeigen3-dev libsuitesparse-dev libmetis-dev
	qtbase5-dev libqt5opengl5-dev libglew-dev libgl1-mesa-dev libglu1-mesa-dev)
packages_test=(libgtest-dev clang-format clang-tidy locales valgrind)
packages_meshlab=(meshlab xvfb xauth openbox xdotool imagemagick libgl1-mesa-dri x11-utils)
packages_python=(python3 python3-venv)

missing_packages() {
	local package
	for package in "$@"; do
		dpkg-query -W -f '${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed ||
			printf '%s\n' "$package"
	done
}

# install_packages NAME...: whatever is missing, as root or through a password-less sudo.
install_packages() {
	if ! command -v apt-get >/dev/null; then
		skipped "installing packages: this machine has no apt. Needed: $*"
		return 0
	fi
	local missing as_root=()
	mapfile -t missing < <(missing_packages "$@")
	if [ ${#missing[@]} -eq 0 ]; then
		echo "All packages are installed."
		return 0
	fi
	if [ "$(id -u)" -ne 0 ]; then
		if ! sudo -n true 2>/dev/null; then
			skipped "installing packages: needs root. Please install: ${missing[*]}"
			return 0
		fi
		as_root=(sudo -n)
	fi
	echo "Installing: ${missing[*]}"
	"${as_root[@]}" apt-get update -q >"$build/apt.log" 2>&1 ||
		echo "apt-get update reported a problem; see build/apt.log."
	"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y \
		--no-install-recommends "${missing[@]}" >>"$build/apt.log" 2>&1 ||
		install_one_by_one "${missing[@]}"
}

# One package that cannot be had must not keep the others away, but without a network there are no others.
install_one_by_one() {
	local package said
	for package in "$@"; do
		! said=$("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y \
			--no-install-recommends "$package" 2>&1) || continue
		printf '%s\n' "$said" >>"$build/apt.log"
		case $said in
		*'failure resolving'* | *'ould not resolve'* | *'ould not connect'* | *'nable to connect'*)
			skipped "installing packages: Debian's archive cannot be reached; see build/apt.log. Please install: $(missing_packages "$@" | paste -sd ' ')"
			return 0
			;;
		*'nable to locate package'* | *'no installation candidate'*)
			skipped "package $package: Debian's archive has no such package; see build/apt.log"
			;;
		*) skipped "package $package could not be installed; see build/apt.log" ;;
		esac
	done
}

# What Debian ships without headers, such as MeshLab, its source packages have. The entries live in a
# private list derived from the machine's own mirror, so the system's lists stay as they are.
source_apt_options() {
	local mirror apt=$build/sources/apt suite
	mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Label: Debian' \
		'Component: main' 2>/dev/null | head -n 1)
	[ -n "$mirror" ] || return 1
	mkdir -p "$apt"/{parts,lists/partial,cache/archives/partial}
	for suite in bookworm trixie forky sid; do
		echo "deb-src [check-valid-until=no signed-by=/usr/share/keyrings/debian-archive-keyring.gpg]" \
			"$mirror $suite main"
	done >"$apt/parts/sources.list"
	apt_options=(-o Dir::Etc::sourcelist=/dev/null -o Dir::Etc::sourceparts="$apt/parts"
		-o Dir::State::Lists="$apt/lists" -o Dir::Cache="$apt/cache" -o APT::Sandbox::User=)
}

# fetch_sources NAME-VERSION...: trees of Debian's source packages in build/sources/NAME-VERSION.
fetch_sources() {
	local tree wanted=() apt_options=()
	for tree in "$@"; do
		if [ -d "$build/sources/$tree" ]; then
			echo "build/sources/$tree is there."
		else
			wanted+=("$tree")
		fi
	done
	[ ${#wanted[@]} -gt 0 ] || return 0
	if ! command -v apt-get >/dev/null || ! source_apt_options; then
		skipped "sources (${wanted[*]}): this machine has no Debian package archive. Put source trees of these names into build/sources"
		return 0
	fi
	apt-get "${apt_options[@]}" update -q >"$build/sources/apt.log" 2>&1 || true
	for tree in "${wanted[@]}"; do
		fetch_source "${tree%%-*}" "${tree#*-}"
	done
}

# fetch_source NAME VERSION
fetch_source() {
	local name=$1 version=$2 revision reason error target=$build/sources/$1-$2 work=$build/sources/download-$1-$2
	reason="Debian's archive cannot be reached"
	! compgen -G "$build/sources/apt/lists/*Sources*" >/dev/null ||
		reason="Debian's archive has no such source package"
	rm -rf "$work"
	while read -r revision; do
		echo "$name-$version: fetching the source of Debian's $revision"
		rm -rf "$work"
		mkdir -p "$work/tree"
		(cd "$work" && apt-get "${apt_options[@]}" source -q --download-only --tar-only \
			"$name=$revision") >>"$build/sources/apt.log" 2>&1 || true
		if ! compgen -G "$work/${name}_*.orig.tar.*" >/dev/null; then
			reason="Debian's source package cannot be downloaded"
		elif ! error=$(tar -xf "$work/${name}"_*.orig.tar.* -C "$work/tree" --strip-components=1 2>&1); then
			reason="Debian's source package cannot be unpacked: ${error%%$'\n'*}"
		else
			mv "$work/tree" "$target"
			rm -rf "$work"
			return 0
		fi
	done < <(apt-cache "${apt_options[@]}" showsrc "$name" 2>/dev/null |
		sed -n 's/^Version: //p' | grep -F "$version" | sort -ruV)
	rm -rf "$work"
	skipped "$name-$version: $reason; see build/sources/apt.log"
}

# A Python with PyMeshLab in build/venv, where a package index can be reached.
make_venv() {
	if [ -x "$build/venv/bin/python" ] && "$build/venv/bin/python" -c 'import pymeshlab' 2>/dev/null; then
		echo "PyMeshLab: build/venv is there."
		return 0
	fi
	if ! python3 -m venv "$build/venv" >"$build/venv.log" 2>&1; then
		skipped "PyMeshLab: python3 cannot make a virtual environment; see build/venv.log"
		return 0
	fi
	if ! "$build/venv/bin/pip" install -q 'pymeshlab>=2025.7,<2025.8' >>"$build/venv.log" 2>&1; then
		skipped "PyMeshLab: pip could not install it; see build/venv.log"
		return 0
	fi
	"$build/venv/bin/python" -c 'import pymeshlab' 2>>"$build/venv.log" ||
		skipped "PyMeshLab: installed in build/venv, but it cannot be imported; see build/venv.log"
}

# What the Python package works with where it is installed: its tests try them, nothing else needs them.
add_companions() {
	[ -x "$build/venv/bin/pip" ] || return 0
	local name
	for name in 'dask[distributed]' matplotlib pillow tqdm trimesh xatlas; do
		"$build/venv/bin/pip" show -q "${name%%[*}" 2>/dev/null ||
			"$build/venv/bin/pip" install -q "$name" >>"$build/venv.log" 2>&1 ||
			skipped "$name: pip could not install it; see build/venv.log"
	done
}

# Without these whatever else is fetched is of no use.
require_build_tools() {
	local tool missing=()
	for tool in cmake "${CXX:-c++}"; do
		command -v "$tool" >/dev/null || missing+=("$tool")
	done
	[ ${#missing[@]} -eq 0 ] || { echo "Not installed: ${missing[*]}. Nothing can be built."; return 1; }
}

# Several sources at once, for less than half of the compilers' time; who changes files builds in a folder of
# a preset, where each is compiled alone.
configure_and_build() {
	local generator=()
	command -v ninja >/dev/null && [ ! -f "$build/CMakeCache.txt" ] && generator=(-G Ninja)
	cmake -S "$root" -B "$build" "${generator[@]}" -DCMAKE_UNITY_BUILD=ON "$@"
	cmake --build "$build" --parallel "$(nproc)"
}
