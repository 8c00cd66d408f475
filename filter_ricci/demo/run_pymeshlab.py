# SPDX-License-Identifier: GPL-3.0-or-later
"""The filter in PyMeshLab: run_pymeshlab.py PLUGIN IN OUT. Prints the returned map."""

import sys

import pymeshlab

plugin, source, target = sys.argv[1:]
pymeshlab.load_plugin(plugin)
documents = pymeshlab.MeshSet(verbose=False)
documents.load_new_mesh(source)
results = documents.apply_filter(
    "compute_texcoord_parametrization_ricci_flow_euclidean_per_wedge", target_curvature="Automatic")
mesh = documents.current_mesh()
print(f"V={mesh.vertex_number()}")
print(f"F={mesh.face_number()}")
for key, value in results.items():
    print(f"{key}={value}")
documents.save_current_mesh(target, save_wedge_texcoord=True, save_vertex_quality=True)
