#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Flattens one mesh along cuts that it brings: chosen_seams.py IN OUT [ANGLE].

The cuts are where the texture coordinates of the mesh jump. With ANGLE, in degrees, they are the
creases: edges whose faces turn by more. It is cut further only where it has to be. With pip install
ricciflow-*.whl."""

import sys

import numpy
from ricciflow import Refused, files, flatten


def creases(vertices, faces, degrees):
    """The edges of two faces whose normals differ by more, as pairs of vertices."""
    corners = vertices[faces]
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= numpy.maximum(numpy.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    sides = numpy.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    order = numpy.lexsort(sides.T)
    sides, face = sides[order], order // 3
    pairs = numpy.flatnonzero((sides[1:] == sides[:-1]).all(axis=1))
    cosines = (normals[face[pairs]] * normals[face[pairs + 1]]).sum(axis=1)
    return sides[pairs[cosines < numpy.cos(numpy.radians(degrees))]]


def main(path, out, angle=None):
    mesh = files.read(path)
    chosen = {"seams": "Existing texture seams"}
    if angle is not None:
        chosen = {"selected_edges": creases(mesh.vertices, mesh.faces, float(angle))}
    try:
        result = flatten(mesh, **chosen)
    except Refused as refusal:
        sys.exit(f"{path}: {refusal}")
    print(f"{result.chosen_seam_edges} chosen edges, {result.seam_edges} more, {result.charts} charts")
    result.save(out)


if __name__ == "__main__":
    if not 3 <= len(sys.argv) <= 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
