#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# run_in_venv.sh BUILD_DIR SCRIPT ARGUMENT...: SCRIPT BUILD_DIR ARGUMENT... with the Python that has numpy, and
# PyMeshLab where it is to be had.
set -euo pipefail
build=$1 script=$2
shift 2
python=$build/venv/bin/python
[ -x "$python" ] || { echo "SKIPPED: there is no Python in build/venv"; exit 77; }
exec "$python" "$script" "$build" "$@"
