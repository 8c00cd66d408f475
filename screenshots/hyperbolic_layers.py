# SPDX-License-Identifier: GPL-3.0-or-later
"""Layers of the hyperbolic filter for hyperbolic.sh, with PyMeshLab and the plugin.

    python hyperbolic_layers.py PLUGIN SURFACE OUT RINGS
"""

import os
import sys

import pymeshlab

FILTER = "compute_texcoord_parametrization_ricci_flow_hyperbolic_per_wedge"


def main(plugin, surface, out, rings):
    pymeshlab.load_plugin(plugin)
    layers = pymeshlab.MeshSet(verbose=False)
    layers.load_new_mesh(surface)
    result = layers.apply_filter(
        FILTER, output_triangulation="Common refinement", flat_layer=True,
        universal_cover=int(rings))
    for key in ("genus", "max_curvature_error", "hyperbolic_area", "relation_error", "qc_area_mean",
                "flipped_faces"):
        print(f"{key} = {result[key]}")
    for layer, file in enumerate(("surface.ply", "disk.ply")):
        layers.set_current_mesh(layer)
        layers.set_color_per_vertex(color1=pymeshlab.Color(255, 255, 255))
        layers.set_texture_per_mesh(textname=os.path.join(out, "checkerboard.png"))
        layers.save_current_mesh(
            os.path.join(out, file), save_wedge_texcoord=True, save_vertex_color=True)
    layers.set_current_mesh(2)
    layers.save_current_mesh(os.path.join(out, "cover.ply"), save_vertex_color=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
