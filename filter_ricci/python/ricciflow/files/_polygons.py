# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons as triangles."""

import heapq

import numpy as np


def triangulate(points, corner_vertices, starts):
    """Triangles of polygons, concave ones too, in their order and with their orientation.

    Returns: corners (F, 3) as indices of `corner_vertices`; polygon (F,); diagonals (F, 3) bool.
    """
    count = np.diff(starts)
    per = np.maximum(count - 2, 0)
    polygon = np.repeat(np.arange(len(count), dtype=np.int32), per)
    first = np.cumsum(per) - per
    local = np.zeros((len(polygon), 3), np.int64)  # corners, counted in their polygon
    local[:, 1] = np.arange(len(polygon)) - first[polygon] + 1
    local[:, 2] = local[:, 1] + 1
    if (count > 3).any():
        doubles = points.astype(np.float64)

        def areas(corner_triples):
            a, b, c = (doubles[corner_vertices[corner_triples[..., k]]] for k in range(3))
            return np.cross(b - a, c - a)

        with np.errstate(all='ignore'):
            quads = np.flatnonzero(count == 4)
            corner = starts[quads, None]
            usual, other = np.array([[0, 1, 2], [0, 2, 3]]), np.array([[1, 2, 3], [1, 3, 0]])
            halves = areas(corner[:, None] + usual)
            whole = halves.sum(1)[:, None]
            turn = ((halves * whole).sum(2) <= 0).any(1)
            turn[turn] = ((areas(corner[turn][:, None] + other) * whole[turn]).sum(2) > 0).all(1)
            local[first[quads[turn], None] + [0, 1]] = other
            large = np.flatnonzero(np.isin(polygon, np.flatnonzero(count > 4)))
            if len(large):
                area = areas(starts[polygon[large], None] + local[large])
                begin = np.flatnonzero(np.r_[True, np.diff(polygon[large]) > 0])
                whole = np.repeat(np.add.reduceat(area, begin), np.diff(np.r_[begin, len(large)]), 0)
                bad = (area * whole).sum(1) <= 1e-9 * (whole * whole).sum(1) / count[polygon[large]]
                for p in np.unique(polygon[large][bad]):
                    corners = doubles[corner_vertices[starts[p]:starts[p + 1]]]
                    local[first[p]:first[p] + per[p]] = _clip_ears(_flattened(corners))
    size = count[polygon][:, None]
    diagonals = (local + 1) % np.maximum(size, 1) != np.roll(local, -1, 1)
    return starts[polygon, None] + local, polygon, diagonals


def _flattened(points):
    """(n, 2) the corners of a polygon seen along its normal, counterclockwise."""
    points = points - points.mean(0)
    normal = np.cross(points, np.roll(points, -1, 0)).sum(0)
    length = np.linalg.norm(normal)
    if not np.isfinite(points).all() or not length > 0:
        return np.zeros((len(points), 2))
    normal /= length
    x = np.zeros(3)
    x[np.abs(normal).argmin()] = 1
    x -= normal * (normal @ x)
    x /= np.linalg.norm(x)
    flat = points @ np.c_[x, np.cross(normal, x)]
    return flat / np.abs(flat).max()


_FLAT = 1e-12
"""Of corners in a square of side 2: what rounding makes of three on a line."""


def _clip_ears(points):
    """(n - 2, 3) corners of the triangles of one polygon; the roundest ear is cut first."""
    xy = points.tolist()
    n = len(xy)
    before, after = [(i - 1) % n for i in range(n)], [(i + 1) % n for i in range(n)]

    def shape(i):  # of the triangle at corner i: signed, 0 without area
        (ax, ay), (bx, by), (cx, cy) = xy[before[i]], xy[i], xy[after[i]]
        area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        sides = (
            (bx - ax) ** 2
            + (by - ay) ** 2
            + (cx - bx) ** 2
            + (cy - by) ** 2
            + (ax - cx) ** 2
            + (ay - cy) ** 2)
        return area / sides if sides > 0 else 0.0

    shapes = np.array([shape(i) for i in range(n)])
    reflex = shapes <= _FLAT
    alive = [True] * n

    def is_ear(i):  # no corner that is not convex lies in it
        inside = np.flatnonzero(reflex)
        a, b, c = points[before[i]], points[i], points[after[i]]
        q = points[inside]
        within = np.ones(len(q), bool)
        for s, t in ((a, b), (b, c), (c, a)):
            within &= (t[0] - s[0]) * (q[:, 1] - s[1]) - (t[1] - s[1]) * (q[:, 0] - s[0]) >= -_FLAT
            within &= (q != s).any(1)
        return not within.any()

    queue = [(-shapes[i], i) for i in range(n) if shapes[i] > _FLAT]
    heapq.heapify(queue)
    waiting, triangles, moved = [], [], True
    while len(triangles) < n - 2:
        if queue:
            value, i = heapq.heappop(queue)
            if not alive[i] or -value != shapes[i]:
                continue
            if not is_ear(i):
                waiting.append((value, i))
                continue
        elif waiting and moved:
            queue, waiting, moved = waiting, [], False
            heapq.heapify(queue)
            continue
        else:  # it crosses itself or has no area: the largest that is left
            left = [k for k in range(n) if alive[k]]
            i = max(left, key=lambda k: shapes[k])
        triangles.append((before[i], i, after[i]))
        alive[i], reflex[i], moved = False, False, True
        after[before[i]], before[after[i]] = after[i], before[i]
        for k in (before[i], after[i]):
            shapes[k] = shape(k)
            reflex[k] = shapes[k] <= _FLAT
            if shapes[k] > _FLAT:
                heapq.heappush(queue, (-shapes[k], k))
    return triangles
