#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws time and memory over the number of faces from tables of tests/bench.sh.

    bash tests/bench.sh generated:10000 generated:100000 > table.tsv
    python3 tests/bench/plot.py table.tsv > scaling.svg

Both panels have logarithmic axes; the dashed lines are proportional to the number of faces. Rows
without numbers are left out. Needs nothing but Python.
"""
import csv
import math
import sys

WIDTH, HEIGHT, MARGIN = 440, 320, 58
SERIES = [
    [
        ("whole_cpu_s", "mesh to plane", "#7f3c8d"),
        ("solve_cpu_s", "flow", "#11a579"),
        ("one_factor_cpu_s", "one factorisation", "#3969ac"),
    ],
    [("peak_mb", "mesh to plane, at its peak", "#e68310")],
]
TITLES = ["CPU time (s)", "memory (MB)"]


def rows(path):
    with open(path, newline="") as file:
        for row in csv.DictReader(file, delimiter="\t"):
            if row["remark"] == "-":
                yield row


def points(table, column):
    # With --flow-only the peak is not that of a complete run.
    rows = [r for r in table if column != "peak_mb" or float(r["whole_cpu_s"]) > 0]
    pairs = [(float(row["faces"]), float(row[column])) for row in rows]
    return sorted(p for p in pairs if p[1] > 0)


def label(x):
    for limit, unit in ((1e6, "M"), (1e3, "k")):
        if x >= limit:
            return f"{x / limit:g}{unit}"
    return f"{x:g}"


def panel(table, series, title, left):
    curves = [(name, colour, points(table, column)) for column, name, colour in series]
    every = [p for curve in curves for p in curve[2]]
    low = [math.floor(math.log10(min(p[i] for p in every))) for i in (0, 1)]
    high = [max(math.ceil(math.log10(max(p[i] for p in every))), low[i] + 1) for i in (0, 1)]

    def at(p):
        x = (math.log10(p[0]) - low[0]) / (high[0] - low[0])
        y = (math.log10(p[1]) - low[1]) / (high[1] - low[1])
        return left + MARGIN + x * (WIDTH - MARGIN - 14), 34 + (1 - y) * (HEIGHT - MARGIN - 34)

    out = [f'<text x="{left + MARGIN}" y="20" font-weight="bold">{title}</text>']
    for decade in range(low[0], high[0] + 1):
        (x, bottom), (_, top) = at((10.0**decade, 10.0 ** low[1])), at((1, 10.0 ** high[1]))
        out.append(f'<path d="M{x:.1f} {bottom:.1f}V{top:.1f}" stroke="#ddd"/>')
        out.append(
            f'<text x="{x:.1f}" y="{bottom + 18:.1f}" text-anchor="middle">'
            f"{label(10.0 ** decade)}</text>"
        )
    for decade in range(low[1], high[1] + 1):
        (start, y), (end, _) = at((10.0 ** low[0], 10.0**decade)), at((10.0 ** high[0], 1))
        out.append(f'<path d="M{start:.1f} {y:.1f}H{end:.1f}" stroke="#ddd"/>')
        out.append(
            f'<text x="{start - 6:.1f}" y="{y + 4:.1f}" text-anchor="end">{10.0 ** decade:g}</text>'
        )
    middle = left + MARGIN + (WIDTH - MARGIN) / 2
    out.append(f'<text x="{middle:.1f}" y="{HEIGHT - 8}" text-anchor="middle">faces</text>')
    for i, (name, colour, curve) in enumerate(curves):
        if not curve:
            continue
        path = "L".join("{:.1f} {:.1f}".format(*at(p)) for p in curve)
        out.append(f'<path d="M{path}" stroke="{colour}" stroke-width="2" fill="none"/>')
        for p in curve:
            x, y = at(p)
            out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{colour}"/>')
        y = 50 + 18 * i
        x = left + MARGIN + 10
        out.append(f'<path d="M{x} {y - 4}h22" stroke="{colour}" stroke-width="2"/>')
        out.append(f'<text x="{x + 28}" y="{y}">{name}</text>')
        if i == 0:
            ends = [curve[0], (curve[-1][0], curve[0][1] * curve[-1][0] / curve[0][0])]
            path = "L".join("{:.1f} {:.1f}".format(*at(p)) for p in ends)
            out.append(f'<path d="M{path}" stroke="#888" stroke-dasharray="4 3" fill="none"/>')
    return out


def main():
    table = [row for path in sys.argv[1:] for row in rows(path)]
    if not table:
        sys.exit("usage: plot.py TABLE.tsv... > picture.svg (tables of tests/bench.sh)")
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{2 * WIDTH}" height="{HEIGHT}" '
        f'viewBox="0 0 {2 * WIDTH} {HEIGHT}" font-family="sans-serif" font-size="12">',
        f'<rect width="{2 * WIDTH}" height="{HEIGHT}" fill="white"/>',
    ]
    for i, (series, title) in enumerate(zip(SERIES, TITLES)):
        out += panel(table, series, title, i * WIDTH)
    print("\n".join(out + ["</svg>"]))


if __name__ == "__main__":
    main()
