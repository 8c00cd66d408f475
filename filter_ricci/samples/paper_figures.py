#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws for any mesh what the paper's Figs 5, 7 and 10 show: paper_figures.py MESH PICTURE.png [TARGET].

The conventional flow above, the generalized one below: a checkerboard and the distortion on the surface (blue
is 1, red the generalized flow's largest), the chart, and how often the distortion has each value. With
pip install ricciflow-*.whl matplotlib. TARGET is 'Flat everywhere', or Disk, Rectangle, ..."""

import sys

import numpy
from matplotlib.figure import Figure

from ricciflow import Refused, flatten

SIZE = 500  # of the picture of a surface
SQUARES = 40  # of the checkerboard, along a side of the texture
VIEW = numpy.linalg.qr([[0.8, -0.3, 0.5], [0.1, 0.9, 0.4], [-0.6, -0.3, 0.7]])[0]


def seen(result):
    """Texture coordinates, quality and shade at each pixel of a picture of the surface."""
    values = numpy.dstack([result.uv, result.quality[result.faces]])
    places = result.vertices @ VIEW
    places -= places.min(axis=0)
    corners = (places / places[:, :2].max() * (SIZE - 1))[result.faces]
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    image = numpy.full((SIZE, SIZE, 3), numpy.nan)
    shades, depths = numpy.ones((SIZE, SIZE)), numpy.full((SIZE, SIZE), -numpy.inf)
    for corner, value, normal in zip(corners, values, normals):
        if normal[2] == 0.0:  # seen from its side
            continue
        columns, rows = (numpy.arange(numpy.ceil(corner[:, k].min()), corner[:, k].max(), dtype=int)
                         for k in (0, 1))
        x, y = (grid.ravel() for grid in numpy.meshgrid(columns, rows))
        sides = (corner[1:, :2] - corner[0, :2]).T
        b, c = numpy.linalg.solve(sides, numpy.array([x - corner[0, 0], y - corner[0, 1]]))
        weights = numpy.array([1.0 - b - c, b, c])
        depth = corner[:, 2] @ weights
        front = (weights.min(axis=0) >= -1e-9) & (depth > depths[y, x])
        x, y = x[front], y[front]
        depths[y, x] = depth[front]
        shades[y, x] = 0.4 + 0.6 * abs(normal[2]) / numpy.linalg.norm(normal)
        image[y, x] = weights.T[front] @ value
    return image[..., :2], image[..., 2], shades


def draw(axes, name, result, top):
    surface, chart, colours, bars = axes
    uv, quality, shades = seen(result)
    dark = numpy.floor(SQUARES * uv).sum(axis=2) % 2 == 1
    surface.imshow(shades * numpy.where(dark, 0.35, 1.0), cmap="gray", vmin=0.0, vmax=1.0, origin="lower")
    surface.set_title(f"{name}: {result.qc_vertex_mean:.4f} on average", fontsize=9)
    points, corners = result.indexed()
    chart.triplot(*points.T, corners, linewidth=0.1, color="black")
    chart.set_aspect("equal")
    scale = colours.imshow(quality, cmap="jet", vmin=1.0, vmax=top, origin="lower")
    colours.figure.colorbar(scale, ax=colours, shrink=0.7)
    bars.hist(numpy.minimum(result.quality, top), bins=60, range=(1.0, top))
    bars.set_title(f"the last bar: {top:.3g} and more", fontsize=9)
    for part in (surface, chart, colours):
        part.axis("off")


def main(mesh, picture, target="Flat everywhere"):
    figure = Figure(figsize=(16, 8), layout="tight")
    axes = figure.subplots(2, 4)
    ours = flatten(mesh, target_curvature=target)
    draw(axes[1], "generalized", ours, ours.quality.max())
    try:
        draw(axes[0], "conventional", flatten(mesh, target_curvature=target, method="Thurston"),
             ours.quality.max())
    except Refused as refusal:
        axes[0, 0].set_title(f"conventional: {refusal}", fontsize=9, loc="left")
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    if not 3 <= len(sys.argv) <= 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
