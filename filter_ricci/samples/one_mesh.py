#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Flattens one mesh and saves it with its texture coordinates: one_mesh.py IN OUT [Disk, ...].

With pip install ricciflow-*.whl. The command "python -m ricciflow IN OUT" does the
same, with every parameter, and whole folders."""

import sys

from ricciflow import Refused, flatten

if not 3 <= len(sys.argv) <= 4:
    sys.exit(__doc__)
mesh, out, target = (sys.argv[1:] + ["Automatic"])[:3]
try:
    result = flatten(mesh, target_curvature=target)
except Refused as refusal:
    sys.exit(f"{mesh}: {refusal}")
print(f"{result.charts} charts, {result.cones} cones, mean distortion {result.qc_area_mean:.3f}")
result.save(out)
