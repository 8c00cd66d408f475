# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws what this filter, Blender's smart project, xatlas and uvunwrap make of meshes by default.

    python peers.py --plugin PLUGIN [--out PICTURE] MESH...

For each mesh: the surface under a checkerboard, and its charts below. The squares of all maps of a mesh have
the same area on average. Seams are red. A line says how many charts there are, how long the seams are over
the square root of the area, the energy, and E = energy + seam / 20. The energy is the symmetric Dirichlet
energy by area at the best scale, 4 at best. The longest side of a mesh's box stands upright.

Needs the packages numpy, pillow and pymeshlab, and bpy, xatlas and uvunwrap for their columns.
"""

import argparse
import math
import multiprocessing
import os
from concurrent.futures import ProcessPoolExecutor
from importlib import metadata

import numpy
from PIL import Image, ImageDraw, ImageFont

CELL, LINE, FINE = (400, 350), 24, 2  # of a picture in pixels, of a line of text, pixels drawn for one across
SQUARES = 26  # along the side of a square with the area of the surface
DARK, VIEW, LIGHT = (45, 50, 60), (-35, 25), (-0.36, 0.48, 0.8)

# Each of these takes points and triangles and returns the places of their corners in the plane. It runs in a
# process of its own, which alone imports its library: Blender's and MeshLab's cannot be loaded together.


def ricci(points, faces, plugin):
    import layers
    import pymeshlab
    pymeshlab.load_plugin(plugin)
    return layers.Surface.flattened(pymeshlab.Mesh(points, faces)).wedges


def smart_project(points, faces, _):
    import bpy
    mesh = bpy.data.meshes.new("mesh")
    # Packed by lengths in metres: what is small comes out in one column.
    mesh.from_pydata((points * 100 / numpy.ptp(points, axis=0).max()).tolist(), [], faces.tolist())
    surface = bpy.data.objects.new("surface", mesh)
    bpy.context.collection.objects.link(surface)
    bpy.context.view_layer.objects.active = surface
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.smart_project()
    bpy.ops.object.mode_set(mode="OBJECT")
    return numpy.array([corner.uv[:] for corner in mesh.uv_layers.active.data]).reshape(-1, 3, 2)


def xatlas(points, faces, _):
    from xatlas import Atlas
    atlas = Atlas()
    atlas.add_mesh(points, faces)
    atlas.generate()
    _, corners, places = atlas[0]
    return places[corners] * (atlas.width, atlas.height)


def uvunwrap(points, faces, _):
    from uvunwrap import Mesh, generate
    atlas = generate([Mesh(positions=points.ravel().tolist(), indices=faces.ravel().tolist())])
    return numpy.reshape(atlas.meshes[0].corner_uvs, (-1, 3, 2)) * (atlas.width, atlas.height)


def unwrapped(unwrap, *arguments):
    """The map, or why there is none."""
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as process:
        try:
            return process.submit(unwrap, *arguments).result()
        except ModuleNotFoundError:
            return "not installed"
        except Exception as error:  # whatever a library raises
            return str(error)[:50]


def double_areas(corners):
    sides = corners[:, 1:] - corners[:, :1]
    return numpy.linalg.norm(numpy.cross(sides[:, 0], sides[:, 1]), axis=1)


def energy(corners, flat):
    area = double_areas(corners)
    counted = area > 1e-12 * area.max()
    sides = [c[counted, 1:] - c[counted, :1] for c in (corners, flat)]
    before, after = (s @ s.swapaxes(1, 2) for s in sides)
    squares = numpy.trace(numpy.linalg.solve(before, after), axis1=1, axis2=2)
    area, stretch = area[counted], double_areas(flat)[counted] / area[counted]
    stretch = numpy.maximum(stretch, 1e-12 * stretch.max())
    return 2 * math.sqrt((area * squares).sum() * (area * squares / stretch ** 2).sum()) / area.sum()


def samples(corners):
    """Points of triangles or segments, so dense that no pixel is missed: the numbers of the shapes, the
    weights of their corners, the points."""
    lengths = numpy.linalg.norm((numpy.roll(corners, -1, axis=1) - corners)[:, :, :2], axis=2)
    steps = numpy.ceil(lengths.max(axis=1) / 0.8).astype(int).clip(1)
    for n in numpy.unique(steps):
        i, j = (grid.ravel() for grid in numpy.meshgrid(numpy.arange(n + 1), numpy.arange(n + 1)))
        weights = numpy.column_stack([n - i - j, i, j])[i + j <= n] / n
        if corners.shape[1] == 2:
            weights = weights[weights[:, 2] == 0, :2]
        shapes = numpy.flatnonzero(steps == n)
        yield (numpy.repeat(shapes, len(weights)), numpy.tile(weights, (len(shapes), 1)),
               (weights @ corners[shapes]).reshape(-1, 3))


def drawn(corners, colours, segments, line):
    """A picture of triangles from the front, and of segments on them. colours makes the colours of points
    from the numbers of their triangles and the weights of the corners."""
    size = FINE * numpy.array(CELL)
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    scale = 0.95 * (size / (high - low)[:2]).min()
    corners, segments = (
        (c - (low + high) / 2) * (scale, -scale, scale) + (*size / 2, 0) for c in (corners, segments))
    pixels, depth = numpy.full((size.prod(), 3), 255.0), numpy.full(size.prod(), -numpy.inf)

    def put(points, colour):
        pixel = points[:, :2].astype(int) @ (1, size[0])
        front = numpy.flatnonzero(points[:, 2] > depth[pixel])
        front = front[numpy.argsort(points[front, 2], kind="stable")]  # the nearest is written last
        depth[pixel[front]], pixels[pixel[front]] = points[front, 2], colour(front)

    for face, weights, points in samples(corners):
        put(points, lambda front: colours(face[front], weights[front]))
    for _, _, points in samples(segments):
        for shift in ((0, 0), (1, 0), (0, 1), (-1, 0), (0, -1)):
            put(points + (*shift, 2 * FINE), lambda front: line)
    picture = Image.fromarray(pixels.reshape(size[1], size[0], 3).astype(numpy.uint8))
    return picture.resize(CELL, Image.Resampling.BOX)


def cell(surface):
    """The surface under a checkerboard, its charts, and what the line says."""
    upright = 1 - int(numpy.argmax(numpy.ptp(surface.points, axis=0)))
    points = layers.turned(numpy.roll(surface.points, upright, axis=1), *VIEW)
    corners, seams = points[surface.faces], points[numpy.array(surface.seams(), dtype=int).reshape(-1, 2)]
    places, faces, _ = surface.places()
    places[:, 2] = 0
    flat, chart = places[faces], surface.chart_numbers()
    sides = numpy.sort(numpy.stack([faces, numpy.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2))
    sides, count = numpy.unique(sides, axis=0, return_counts=True)
    tint, side = layers.tints(chart), math.sqrt(double_areas(corners).sum() / 2)
    normal = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    light = 0.45 + 0.55 * numpy.abs(normal @ LIGHT) / numpy.maximum(double_areas(corners), 1e-30)
    squares = flat * SQUARES / math.sqrt(double_areas(flat).sum() / 2)
    seam = numpy.linalg.norm(seams[:, 1] - seams[:, 0], axis=1).sum() / side

    def checkerboard(face, weights):
        square = numpy.floor((weights[:, :, None] * squares[face]).sum(axis=1)).sum(axis=1)
        return numpy.where(square[:, None] % 2 == 1, layers.INK, tint[face]) * light[face, None]

    charts = f"{chart.max() + 1} charts" if chart.any() else "1 chart"
    bent = energy(corners, flat)
    return (drawn(corners, checkerboard, seams, layers.SEAM),
            drawn(flat, lambda face, _: tint[face], places[sides[count == 1]], DARK),
            f"{charts}, seams {seam:.1f}, energy {bent:.2f}, E {bent + seam / 20:.2f}")


PEERS = {"": ("ricciflow", ricci), "bpy": ("Blender {}, smart project", smart_project),
         "xatlas": ("xatlas {}", xatlas), "uvunwrap": ("uvunwrap {}", uvunwrap)}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--plugin", required=True)
    parser.add_argument("--out", default="peers.png")
    parser.add_argument("meshes", nargs="+", metavar="MESH")
    arguments = parser.parse_args()
    row = 2 * CELL[1] + 3 * LINE
    sheet = Image.new("RGB", (len(PEERS) * CELL[0], LINE + row * len(arguments.meshes)), "white")
    pen = ImageDraw.Draw(sheet)

    def write(column, y, text):
        pen.text((column * CELL[0] + 8, y + 4), text, "black", ImageFont.load_default(15))

    versions = {package.metadata["Name"]: package.version for package in metadata.distributions()}
    for column, (package, (title, _)) in enumerate(PEERS.items()):
        write(column, 0, title.format(versions.get(package, "")))
    for top, path in zip(range(LINE, sheet.height, row), arguments.meshes):
        mesh = layers.load(path).current_mesh()
        points, faces = mesh.vertex_matrix(), mesh.face_matrix()
        name = os.path.splitext(os.path.basename(path))[0]
        write(0, top, f"{name}, {len(faces)} faces")
        for column, (_, unwrap) in enumerate(PEERS.values()):
            places = unwrapped(unwrap, points, faces, os.path.abspath(arguments.plugin))
            line, pictures = places, ()
            if not isinstance(places, str):
                *pictures, line = cell(layers.Surface(pymeshlab.Mesh(
                    points, faces, w_tex_coords_matrix=places.reshape(-1, 2).astype(float))))
            for i, picture in enumerate(pictures):
                sheet.paste(picture, (column * CELL[0], top + LINE + i * CELL[1]))
            write(column, top + LINE + 2 * CELL[1], line)
            print(f"{name}, {unwrap.__name__}: {line}")
    sheet.quantize(255, dither=Image.Dither.NONE).save(arguments.out, optimize=True)


if __name__ == "__main__":
    import layers  # not in the processes of the peers
    import pymeshlab
    main()
