#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes a private MeshLab 2020.09 with the plugin in <build>/stage/meshlab-2020.09, and prints that
# folder. MeshLab looks for plugins beside its own program only and has no setting for another
# place: so the two programs are copied and the rest of the installation is linked.
# Exit 77: this machine has no MeshLab 2020.09, or the plugin is not built.
set -euo pipefail

build=$(cd "${1:?usage: stage_meshlab_2020.sh BUILD_DIR}" && pwd)
plugin=$build/meshlab-2020.09/libfilter_ricci.so
prefix=$build/stage/meshlab-2020.09

give_up() {
	echo "SKIPPED: $*" >&2
	exit 77
}

installed_libraries() {
	dpkg-query -L meshlab 2>/dev/null | grep '/libmeshlab-common\.so$' | head -n 1 | xargs -r dirname
}

version=$(dpkg-query -W -f '${Version}' meshlab 2>/dev/null) || version=
case $version in
2020.09*) ;;
'') give_up "MeshLab is not installed as a package" ;;
*) give_up "MeshLab 2020.09 is needed, the installed package is $version" ;;
esac
[ -f "$plugin" ] || give_up "the plugin for MeshLab 2020.09 is not built"
libraries=$(installed_libraries)
[ -d "$libraries/plugins" ] || give_up "the installed MeshLab has no plugin folder"

rm -rf "$prefix"
staged=$prefix/${libraries#/usr/}
mkdir -p "$prefix/bin" "$staged/plugins"
cp /usr/bin/meshlab /usr/bin/meshlabserver "$prefix/bin/"
ln -s "$libraries"/plugins/* "$staged/plugins/"
ln -s "$libraries/libmeshlab-common.so" "$staged/"
ln -s "$plugin" "$staged/plugins/"
[ ! -d /usr/share/meshlab ] || { mkdir -p "$prefix/share" && ln -s /usr/share/meshlab "$prefix/share/"; }
echo "$prefix"
