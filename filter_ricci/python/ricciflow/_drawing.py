# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of maps for notebooks."""

import numpy

WIDTH = 360  # pixels


def outlines(corners):
    """The borders of triangles with the given indices, as lists of indices, each a closed walk."""
    sides = numpy.stack([corners, numpy.roll(corners, -1, axis=1)], axis=-1).reshape(-1, 2)
    _, index, count = numpy.unique(numpy.sort(sides, axis=1), axis=0, return_inverse=True,
                                   return_counts=True)
    after = {}
    for start, end in sides[count[index.reshape(-1)] == 1].tolist():
        after.setdefault(start, []).append(end)
    while after:
        start, ends = after.popitem()
        walk = [start]
        while ends:
            walk.append(ends.pop())
            if ends:
                after[start] = ends
            start = walk[-1]
            ends = after.pop(start, [])
        yield walk


def charts(points, corners):
    """SVG of the charts: texture vertices (T, 2), and their indices at the corners of faces."""
    least = points.min(axis=0)
    width, height = numpy.maximum(points.max(axis=0) - least, 1e-30)
    scale = WIDTH / max(width, height)
    at = (points - least) * scale
    at[:, 1] = height * scale - at[:, 1]
    path = "".join("M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in at[walk].tolist()) + "Z"
                   for walk in outlines(corners))
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width * scale + 2:.0f}" '
            f'height="{height * scale + 2:.0f}" viewBox="-1 -1 {width * scale + 2:.1f} '
            f'{height * scale + 2:.1f}"><path d="{path}" fill="#bcd3ea" fill-rule="evenodd" '
            'stroke="#244a73" stroke-width="0.7"/></svg>')
