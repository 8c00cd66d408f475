#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How much of a texture is lost when it is baked again: redraw_texture.py PLUGIN FACES MESH...

Each mesh gets an atlas of single triangles with a picture of smooth waves that is projected on it, in the
current folder. The filter's `carry_texture` and MeshLab's 'Texture Map Defragmentation' make one with fewer
seams of it. A line for each: errors against the exact projection where a renderer would sample it, in steps
of 255. Not a test: it is run by hand. Needs numpy and Pillow, and Qt and a display for MeshLab's filter:

    export QT_QPA_PLATFORM=offscreen
    export QT_QPA_PLATFORM_PLUGIN_PATH=$(qmake -query QT_INSTALL_PLUGINS)/platforms
    xvfb-run -a build/venv/bin/python tests/hosts/redraw_texture.py PLUGIN 20000 MESH..."""

import os
import sys
import time

import numpy
import pymeshlab
from PIL import Image

SIZE = 2048
SAMPLES = 400000


def projected(points, box):
    """The picture at the points, seen along the z axis."""
    u, v = numpy.moveaxis((points - box.min(axis=0)) / numpy.ptp(box, axis=0).max(), -1, 0)[:2]
    waves = [17 * u + 5 * v, 23 * v - 7 * u, 11 * u + 13 * v]
    return 127.5 + 100 * numpy.sin(2 * numpy.pi * numpy.stack(waves, axis=-1))


def read(path):
    """Positions and texture coordinates [face][corner], number of the image [face], images of an OBJ file."""
    positions, coordinates, faces, materials, names = [], [], [], [], []
    for line in open(path, encoding="utf-8"):
        word, *rest = line.split() or [""]
        if word == "v":
            positions.append(rest[:3])
        elif word == "vt":
            coordinates.append(rest[:2])
        elif word == "usemtl":
            if rest[0] not in names:
                names.append(rest[0])
            material = names.index(rest[0])
        elif word == "f":
            faces.append([corner.split("/")[:2] for corner in rest])
            materials.append(material)
    images = {}
    for line in open(path + ".mtl", encoding="utf-8"):
        word, *rest = line.split() or [""]
        if word == "newmtl":
            name = rest[0]
        elif word == "map_Kd":
            images[name] = rest[0]
    index = numpy.array(faces, dtype=int) - 1
    return (numpy.array(positions, dtype=float)[index[:, :, 0]],
            numpy.array(coordinates, dtype=float)[index[:, :, 1]],
            numpy.array(materials), [images[name] for name in names])


def draw(path, image):
    """The picture in the atlas: texels inside the triangles, then a gutter where none is."""
    positions, coordinates, _, _ = read(path)
    box = positions.reshape(-1, 3)
    colours = numpy.zeros((SIZE, SIZE, 3))
    taken = numpy.zeros((SIZE, SIZE), dtype=bool)
    for reach in (1e-9, 1.6):  # texels
        for p, t in zip(positions, coordinates * SIZE - 0.5):
            edges = numpy.array([t[1] - t[0], t[2] - t[0]]).T
            area = abs(numpy.linalg.det(edges))
            if area == 0.0:
                continue
            low = numpy.clip(numpy.floor(t.min(axis=0) - 1), 0, SIZE - 1).astype(int)
            high = numpy.clip(numpy.ceil(t.max(axis=0) + 1), 0, SIZE - 1).astype(int)
            x, y = (a.ravel() for a in numpy.meshgrid(numpy.arange(low[0], high[0] + 1),
                                                     numpy.arange(low[1], high[1] + 1)))
            share = numpy.linalg.solve(edges, numpy.stack([x - t[0, 0], y - t[0, 1]]))
            weights = numpy.stack([1 - share.sum(axis=0), *share])
            height = area / max(numpy.linalg.norm(t[i] - t[i - 1]) for i in range(3))
            inside = (weights.min(axis=0) * height > -reach) & ~taken[y, x]
            colours[y[inside], x[inside]] = projected(weights.T[inside] @ p, box)
            if reach < 1:
                taken[y[inside], x[inside]] = True
    Image.fromarray(numpy.clip(numpy.rint(colours[::-1]), 0, 255).astype(numpy.uint8)).save(image)


def errors(path):
    positions, coordinates, materials, images = read(path)
    random = numpy.random.default_rng(3)
    first, second, third = numpy.moveaxis(positions, 1, 0)
    areas = numpy.linalg.norm(numpy.cross(second - first, third - first), axis=1)
    face = random.choice(len(areas), SAMPLES, p=areas / areas.sum())
    weights = random.dirichlet([1, 1, 1], SAMPLES)[:, :, None]
    wanted = projected((positions[face] * weights).sum(axis=1), positions.reshape(-1, 3))
    at = (coordinates[face] * weights).sum(axis=1)
    found = numpy.zeros_like(wanted)
    for number, image in enumerate(images):
        texels = numpy.asarray(Image.open(image).convert("RGB")).astype(float)
        height, width = texels.shape[:2]
        here = materials[face] == number
        x, y = at[here, 0] * width - 0.5, (1 - at[here, 1]) * height - 0.5
        left, top = numpy.floor(x).astype(int), numpy.floor(y).astype(int)
        for i, j in ((0, 0), (1, 0), (0, 1), (1, 1)):
            share = numpy.abs(1 - i - (x - left)) * numpy.abs(1 - j - (y - top))
            row, column = numpy.clip(top + j, 0, height - 1), numpy.clip(left + i, 0, width - 1)
            found[here] += share[:, None] * texels[row, column]
    off = numpy.abs(found - wanted).max(axis=1)
    rms = numpy.sqrt(((found - wanted) ** 2).mean())
    return f"rms {rms:.2f}  p99 {numpy.quantile(off, 0.99):.1f}  max {off.max():.0f}"


def main():
    plugin, faces, *meshes = sys.argv[1:]
    pymeshlab.load_plugin(plugin)
    for mesh in meshes:
        name = os.path.splitext(os.path.basename(mesh))[0]
        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(mesh)
        meshes.meshing_remove_duplicate_vertices()
        meshes.meshing_remove_null_faces()
        meshes.meshing_decimation_quadric_edge_collapse(targetfacenum=int(faces))
        meshes.compute_texcoord_parametrization_triangle_trivial_per_wedge(textdim=SIZE, border=2)
        Image.new("RGB", (SIZE, SIZE)).save(f"{name}_old.png")
        meshes.set_texture_per_mesh(textname=f"{name}_old.png")
        meshes.save_current_mesh(f"{name}_old.obj")
        draw(f"{name}_old.obj", f"{name}_old.png")
        print(name, "old:", errors(f"{name}_old.obj"), flush=True)
        for way, filter_name, options in (
                ("redrawn", "compute_texcoord_parametrization_ricci_flow_euclidean_per_wedge",
                 {"carry_texture": os.path.abspath(f"{name}_redrawn.png"), "texture_size": SIZE,
                  "padding": 4}),
                ("defragmented", "apply_texmap_defragmentation", {"timelimit": 120})):
            meshes = pymeshlab.MeshSet()
            meshes.load_new_mesh(f"{name}_old.obj")
            start = time.process_time()
            meshes.apply_filter(filter_name, **options)
            seconds = time.process_time() - start
            meshes.save_current_mesh(f"{name}_{way}.obj")
            print(name, way + ":", errors(f"{name}_{way}.obj"), f"cpu {seconds:.1f} s", flush=True)


if __name__ == "__main__":
    main()
