# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface of torus_like.mlx, made by PyMeshLab: make_mesh.py SCRIPT OUT."""

import re
import sys

import pymeshlab

with open(sys.argv[1], encoding="utf-8") as source:
    values = dict(re.findall(r'name="(\w+)" value="([^"]*)"', source.read()))
documents = pymeshlab.MeshSet(verbose=False)
documents.create_implicit_surface(**{
    name.lower(): value if name == "expr" else float(value) for name, value in values.items()})
documents.save_current_mesh(sys.argv[2])
