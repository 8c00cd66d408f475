#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Flattens one mesh along cuts that it brings: chosen_seams.py IN OUT [ANGLE].

The cuts are where the texture coordinates of the mesh jump. With ANGLE, in degrees, they are the
creases: edges whose faces turn by more. It is cut further only where it has to be. With pip install
pymeshlab_ricci-*.whl."""

import sys

from pymeshlab import MeshSet
from pymeshlab_ricci import Refused, flatten

mesh, out = sys.argv[1:3]
documents = MeshSet()
documents.load_new_mesh(mesh)
seams = "Existing texture seams"
if len(sys.argv) > 3:
    angle = float(sys.argv[3])
    documents.compute_selection_crease_per_edge(angledegneg=-angle, angledegpos=angle)
    seams = "Selected edges"
try:
    result = flatten(documents, seams=seams)
except Refused as refusal:
    sys.exit(f"{mesh}: {refusal}")
print(f"{result.chosen_seam_edges} edges as chosen, {result.seam_edges} more, {result.charts} charts")
result.save(out)
