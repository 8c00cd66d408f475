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
bad=()
for file in "${files[@]}"; do
	"$formatter" --dry-run --Werror "$file" 2>/dev/null || bad+=("$file")
done
if [ ${#bad[@]} -gt 0 ]; then
	echo "Not formatted; run $formatter -i on them:"
	printf '%s\n' "${bad[@]}"
	exit 1
fi
echo "${#files[@]} files are formatted."
