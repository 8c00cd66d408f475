#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the filter on one mesh in PyMeshLab and saves it with its texture coordinates.

    python one_mesh.py libfilter_ricci.so mesh.ply out.ply
    python one_mesh.py libfilter_ricci.so mesh.ply out.obj target_curvature=Disk report=report.html

Parameters are given as id=value, choices by their names or numbers. Prints every result. Exit 1: the
filter refuses the mesh, and says why.
"""

import sys

FILTER = "compute_texcoord_parametrization_ricci_flow_euclidean_per_wedge"


def value(text):
    """A parameter's value as Python has it: bool, int, float or str."""
    if text in ("true", "false"):
        return text == "true"
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text


def parameters_of(pairs):
    """The parameters that texts like id=value name, batch.py's too."""
    return {name: value(text) for name, _, text in (pair.partition("=") for pair in pairs)}


def main(arguments):
    if len(arguments) < 3:
        sys.exit(__doc__)
    import pymeshlab
    plugin, mesh, out, *pairs = arguments
    parameters = parameters_of(pairs)
    pymeshlab.load_plugin(plugin)
    documents = pymeshlab.MeshSet(verbose=False)
    documents.load_new_mesh(mesh)
    name = parameters.pop("filter", FILTER)
    try:
        results = documents.apply_filter(name, **parameters)
    except pymeshlab.PyMeshLabException as refusal:
        print(refusal, file=sys.stderr)
        return 1
    for key, result in results.items():
        print(f"{key} = {result}")
    keep = {"save_wedge_texcoord": True}
    if not out.endswith(".obj"):  # OBJ has no place for it
        keep["save_vertex_quality"] = True
    documents.save_current_mesh(out, **keep)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
