#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Fails where a C++ file is not formatted as .clang-format says. Exit 77: no clang-format 14.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

formatter=
for candidate in clang-format-14 clang-format; do
	# Other versions lay out some lines differently.
	if "$candidate" --version 2>/dev/null | grep -q 'version 14\.'; then
		formatter=$candidate
		break
	fi
done
if [ -z "$formatter" ]; then
	echo "SKIPPED: clang-format 14 is not installed"
	exit 77
fi
mapfile -d '' files < <(find filter_ricci vcg_ext tests -name '*.h' -print0 -o -name '*.cpp' -print0)
# All in one process, whose start takes longer than a file.
if ! said=$("$formatter" --dry-run --Werror "${files[@]}" 2>&1); then
	echo "Not formatted; run $formatter -i on them:"
	sed -n 's/:[0-9:]* error: .*//p' <<<"$said" | sort -u
	exit 1
fi
echo "${#files[@]} files are formatted."
