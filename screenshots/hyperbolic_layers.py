# SPDX-License-Identifier: GPL-3.0-or-later
"""Layers of the hyperbolic filter for hyperbolic.sh, with PyMeshLab and the plugin.

    python hyperbolic_layers.py PLUGIN SURFACE OUT RINGS
"""

import os
import sys

import numpy
import pymeshlab

FILTER = "compute_texcoord_parametrization_ricci_flow_hyperbolic_per_wedge"


def thickened(axes, width=0.0022):
    """Edges as thin strips just above the disk, because the window draws edges one pixel wide."""
    points, edges = axes.vertex_matrix(), axes.edge_matrix()
    vertices, faces = [], []
    for a, b in edges:
        p, q = points[a], points[b]
        along = q - p
        length = numpy.hypot(along[0], along[1])
        if length == 0.0:
            continue
        side = numpy.array([-along[1], along[0], 0.0]) * (width / length)
        up = numpy.array([0.0, 0.0, 0.002])
        base = len(vertices)
        vertices += [p - side + up, q - side + up, q + side + up, p + side + up]
        faces += [(base, base + 1, base + 2), (base, base + 2, base + 3)]
    colour = numpy.tile([0.1, 0.1, 0.1, 1.0], (len(vertices), 1))
    return pymeshlab.Mesh(numpy.array(vertices), numpy.array(faces), v_color_matrix=colour)


def main(plugin, surface, out, rings):
    pymeshlab.load_plugin(plugin)
    layers = pymeshlab.MeshSet(verbose=False)
    layers.load_new_mesh(surface)
    result = layers.apply_filter(
        FILTER, flat_layer=True, universal_cover=int(rings), generator_axes=True)
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
    layers.add_mesh(thickened(layers.mesh(3)))
    layers.save_current_mesh(os.path.join(out, "axes.ply"), save_vertex_color=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
