# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of meshes: what is read of them, and that all but texture coordinates stays.
Usage: test_files.py BUILD_DIR [TEST...], with a Python that has numpy; uses Pillow and node as well."""

import glob
import io
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path
from unittest import mock

import common

try:
    import numpy as np
except ImportError as problem:
    common.skip(f"numpy cannot be imported here: {problem}")
try:
    from PIL import Image
except ImportError:
    Image = None
sys.path.insert(0, os.path.join(common.REPOSITORY, "filter_ricci", "python", "ricciflow"))
import file_samples as samples  # noqa: E402
import files  # noqa: E402

sys.path.pop(0)  # where a module has PyMeshLab's name

HANDED = Path(common.REPOSITORY).parent / "shared" / "meshes" / "files"


def areas(points, faces):
    """(F, 3) normals of the length of the triangles' areas."""
    a, b, c = (points[faces[:, k]] for k in range(3))
    return np.cross(b - a, c - a) / 2


def by_vertex(mesh, seed=0):
    """Coordinates without a seam that floats hold."""
    table = np.random.default_rng(seed).random((len(mesh.vertices), 2)).astype("f4").astype(float)
    return table[mesh.faces]


def by_corner(mesh, seed=0):
    """Coordinates with a seam at every side of every polygon that floats hold."""
    table = np.random.default_rng(seed).random((int(mesh.starts[-1]), 2)).astype("f4").astype(float)
    return table[mesh.corners]


def centroids(mesh):
    """A refinement: each triangle divided at its middle."""
    count, n = len(mesh.faces), len(mesh.vertices)
    middle = n + np.arange(count)
    faces = np.stack(
        [np.c_[mesh.faces[:, k], mesh.faces[:, (k + 1) % 3], middle] for k in range(3)], 1
    ).reshape(-1, 3)
    weights = np.zeros((count, 3, 3, 3))
    for k in range(3):
        weights[:, k, 0, k] = weights[:, k, 1, (k + 1) % 3] = 1
        weights[:, k, 2] = 1 / 3
    points = np.r_[mesh.vertices, mesh.vertices[mesh.faces].mean(1)]
    return points, faces, np.repeat(np.arange(count), 3), weights.reshape(-1, 3, 3)


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def file(self, name, content):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True, parents=True)
        path.write_bytes(content)
        return path

    def all_samples(self):
        for name, content in samples.every().items():
            self.file(name, content)
        return [self.folder / n for n in samples.every() if os.path.splitext(n)[1] in files.READS]


def bare(line):
    """A line of OBJ without what it says of texture coordinates."""
    return re.sub(rb"(?<=\s)(-?\d+)/-?\d*(/-?\d+)?", lambda m: m[1] + (b"/" + m[2] if m[2] else b""), line) \
        if line.lstrip()[:2] in (b"f ", b"l ") or line[:2] == b"  " else line


def kept_lines(content):
    lines = [bare(l).replace(b"//", b"/") for l in content.split(b"\n") if not l.startswith(b"vt ")]
    return [re.sub(rb"(\d)/(?=\s|$)", rb"\1", l) for l in lines]


class Obj(Folder):
    def setUp(self):
        super().setUp()
        self.file("some.mtl", samples.MTL)
        self.file("a b.png", samples.png(samples.noise(4, 4)))
        self.mesh = files.read(self.file("all.obj", samples.OBJ))

    def test_polygons_are_read_as_they_lie(self):
        mesh = self.mesh
        self.assertEqual(len(mesh.faces), samples.OBJ_TRIANGLES)
        self.assertEqual(mesh.faces[4:6].tolist(), [[0, 4, 5], [0, 5, 1]])  # -8 -4 -3 -7 of eight
        cube, ell = mesh.faces[:12], mesh.faces[12:]
        self.assertAlmostEqual(np.linalg.norm(areas(mesh.vertices, cube), axis=1).sum(), 6)
        np.testing.assert_allclose(areas(mesh.vertices, ell).sum(0), [0, 0, 3])
        self.assertTrue((areas(mesh.vertices, ell)[:, 2] > 0).all())  # it is concave, and fans are wrong
        self.assertEqual(int(mesh.diagonals.sum()), 5 * 2 + 3 * 2)  # of five quads, of the L
        sides = np.stack([mesh.faces, np.roll(mesh.faces, -1, 1)], 2)[mesh.diagonals]
        self.assertEqual(len({tuple(sorted(s)) for s in sides.tolist()}), 5 + 3)

    def test_materials_are_beside_it(self):
        with mock.patch("os.getcwd", side_effect=AssertionError):
            mesh = files.read(self.folder / "all.obj")
        self.assertEqual([p.name for p in mesh.pictures], ["a b.png"])
        self.assertEqual(mesh.pictures[0].read().shape, (4, 4, 4))
        np.testing.assert_allclose(mesh.material_colours[0], [0.8, 0.1, 0.1, 0.5])
        np.testing.assert_allclose(mesh.material_colours[-1], 1)
        self.assertEqual(mesh.uv_picture[:8].tolist(), [-1, -1, -1, -1, -1, -1, 0, 0])
        np.testing.assert_allclose(mesh.uv[6], [[1, 0.5], [0.75, 0.75], [0.75, 0.75]])  # with -o 0.5 0
        self.assertTrue(np.isnan(mesh.uv[2]).all())
        np.testing.assert_allclose(mesh.vertex_colours[:2], [[1, 0, 0, 1], [0, 1, 0, 1]])

    def test_every_other_line_stays(self):
        for make in (by_vertex, by_corner):
            uv = make(self.mesh)
            self.mesh.save(self.folder / "out.obj", uv)
            written = (self.folder / "out.obj").read_bytes()
            self.assertEqual(kept_lines(written), kept_lines(samples.OBJ))
            again = files.read(self.folder / "out.obj")
            np.testing.assert_array_equal(again.faces, self.mesh.faces)
            np.testing.assert_allclose(
                np.nan_to_num(again.uv) - [[[0.5, 0]]] * (again.uv_picture == 0)[:, None, None], uv, atol=1e-9
            )

    def test_only_a_torn_polygon_is_divided(self):
        uv = by_vertex(self.mesh)
        uv[0] += 1  # a seam at the diagonal of the first quad
        self.mesh.save(self.folder / "out.obj", uv)
        before, after = samples.OBJ.count(b"\nf "), (self.folder / "out.obj").read_bytes().count(b"\nf ")
        self.assertEqual(after, before + 1)
        again = files.read(self.folder / "out.obj")
        np.testing.assert_array_equal(again.faces, self.mesh.faces)
        self.assertEqual(again.material_colours.tolist(), self.mesh.material_colours.tolist())

    def test_new_picture(self):
        new = self.file("new.png", samples.png(samples.noise(2, 2)))
        said = self.mesh.save(self.folder / "out.obj", by_vertex(self.mesh), new)
        self.assertEqual(len(said), 1)
        self.assertIn("map_Bump bump.png", said[0])
        written = (self.folder / "out.mtl").read_bytes()
        self.assertEqual(written.count(b"map_Kd new.png"), 2)
        self.assertNotIn(b"bump.png", written)
        self.assertIn(b"mtllib out.mtl", (self.folder / "out.obj").read_bytes())
        again = files.read(self.folder / "out.obj")
        self.assertTrue((again.uv_picture[6:] == 0).all())
        self.assertEqual((self.folder / "some.mtl").read_bytes(), samples.MTL)

    def test_files_go_with_it_to_another_folder(self):
        (self.folder / "there").mkdir()
        said = self.mesh.save(self.folder / "there" / "out.obj", by_vertex(self.mesh))
        self.assertEqual(said, [])
        self.assertEqual((self.folder / "there" / "some.mtl").read_bytes(), samples.MTL)
        self.assertTrue((self.folder / "there" / "a b.png").is_file())
        self.file("there/some.mtl", b"another")
        said = self.mesh.save(self.folder / "there" / "out.obj", by_vertex(self.mesh))
        self.assertIn("another file", said[0])
        self.assertEqual((self.folder / "there" / "some.mtl").read_bytes(), b"another")

    def test_a_missing_picture_stops_nothing(self):
        (self.folder / "a b.png").unlink()
        mesh = files.read(self.folder / "all.obj")
        mesh.save(self.folder / "out.obj", by_vertex(mesh))
        with self.assertRaisesRegex(files.FileError, "a b.png is not beside"):
            mesh.pictures[0].read()

    def test_a_wrong_line_is_named(self):
        for line, what in ((b"f 1 2 x", "line 3 is not a valid face: f 1 2 x"),
                           (b"v 1 2", "line 3 is not a valid vertex: v 1 2"),
                           (b"f 1/2/3/4 2 1", "line 3 is not a valid face"),
                           (b"v 1 2 3z", "line 3 is not a valid vertex")):
            path = self.file("wrong.obj", b"v 0 0 0\nv 1 0 0\n" + line + b"\nf 1 2 1\n")
            with self.assertRaisesRegex(files.FileError, what):
                files.read(path)


class Concave(unittest.TestCase):
    """Triangles of polygons: counts, area, orientation, in the plane and out of it."""

    def check(self, corners, area):
        n = len(corners)
        points = np.c_[np.array(corners, float), np.zeros(n)]
        turn = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
        for flipped in (False, True):
            order = np.arange(n)[::-1] if flipped else np.arange(n)
            mesh = files._shared.MeshFile("a polygon")
            mesh.vertices = points @ turn
            mesh.set_polygons(order, np.array([0, n]))
            self.assertEqual(len(mesh.faces), n - 2)
            own = areas(mesh.vertices, mesh.faces)
            whole = own.sum(0)
            self.assertAlmostEqual(np.linalg.norm(whole), area, 9)
            self.assertTrue((own @ whole > 0).all())
            self.assertAlmostEqual(np.linalg.norm(own, axis=1).sum(), area, 9)
            self.assertEqual(int(mesh.diagonals.sum()), 2 * (n - 3))

    def test_dart(self):
        for k in range(4):
            self.check(np.roll([(0, 0), (2, -1), (0.5, 0), (2, 1)], k, 0), 0.5)

    def test_ell_from_each_corner(self):
        for k in range(6):
            self.check(np.roll(samples.ELL[:, :2], k, 0), 3)

    def test_comb(self):
        teeth = 20
        top = [
            p for i in reversed(range(teeth)) for p in ((2 * i + 1.5, 1), (2 * i + 1, 5), (2 * i + 0.5, 1))]
        corners = [(0, 0), (2 * teeth, 0), *top]
        self.check(corners, shoelace(corners))

    def test_spiral(self):
        angle = np.linspace(0, 6 * np.pi, 100)
        outer = np.c_[np.cos(angle), np.sin(angle)] * (1 + angle)[:, None]
        inner = (np.c_[np.cos(angle), np.sin(angle)] * (0.2 + angle)[:, None])[::-1]
        corners = np.r_[outer, inner]
        self.check(corners, shoelace(corners))

    def test_corners_on_a_line(self):
        self.check([(0, 0), (1, 0), (2, 0), (3, 0), (3, 1), (2, 1), (1, 1), (0, 1)], 3)

    def test_what_is_no_polygon_still_ends(self):
        for corners in ([(0, 0)] * 7, [(0, 0), (1, 1), (1, 0), (0, 1), (2, 2)],
                        [(i % 3, 0) for i in range(9)]):
            mesh = files._shared.MeshFile("none")
            mesh.vertices = np.c_[np.array(corners, float), np.zeros(len(corners))]
            mesh.set_polygons(np.arange(len(corners)), np.array([0, len(corners)]))
            self.assertEqual(len(mesh.faces), len(corners) - 2)
            self.assertEqual(sorted(set(mesh.faces.ravel().tolist())), list(range(len(corners))))


def shoelace(corners):
    x, y = np.array(corners, float).T
    return abs((x * np.roll(y, -1) - y * np.roll(x, -1)).sum()) / 2


class Ply(Folder):
    def cases(self):
        for order in (None, "<", ">"):
            for polygons in (None, list(samples.TRIANGLES), list(samples.QUADS)):
                yield order, polygons

    def by_polygon(self, mesh, uv):
        """Coordinates of triangles as a list for each polygon."""
        table = np.empty((int(mesh.starts[-1]), 2))
        table[mesh.corners] = uv
        return np.split(table, mesh.starts[1:-1])

    def test_bit_by_bit(self):
        """Polygons stay, and nothing else changes; the coordinates keep their place or come last."""
        for order, polygons in self.cases():
            for place in ("coordinates", "last"):
                with self.subTest(order=order, place=place, polygons=polygons and len(polygons[0])):
                    old = samples.ply(order, polygons, coordinates=True if place == "coordinates" else None)
                    mesh = files.read(self.file("in.ply", old))
                    uv = by_corner(mesh)
                    said = mesh.save(self.folder / "out.ply", uv)
                    self.assertEqual(
                        (self.folder / "out.ply").read_bytes(),
                        samples.ply(order, polygons, **{place: self.by_polygon(mesh, uv)}))
                    self.assertEqual(["MeshLab opens no PLY" in s for s in said],
                                     [] if mesh.all_triangles else [True])

    def test_only_a_torn_polygon_is_divided(self):
        for order, polygons in self.cases():
            for place in ("coordinates", "last"):
                with self.subTest(order=order, place=place, polygons=polygons and len(polygons[0])):
                    given = list(samples.QUADS) + [samples.TRIANGLES[0]] if polygons is None else polygons
                    old = samples.ply(order, given, coordinates=True if place == "coordinates" else None)
                    mesh = files.read(self.file("in.ply", old))
                    uv = by_corner(mesh)
                    first, second = np.flatnonzero(mesh.polygon == 2)[[0, -1]]
                    uv[second] += 0 if first == second else 1  # a seam along the diagonal of the third face
                    mesh.save(self.folder / "out.ply", uv)
                    divided = [mesh.faces[first], mesh.faces[second]] if first != second else [given[2]]
                    coordinates = self.by_polygon(mesh, uv)
                    coordinates[2:3] = [uv[first], uv[second]] if first != second else [uv[first]]
                    self.assertEqual(
                        (self.folder / "out.ply").read_bytes(),
                        samples.ply(order, given[:2] + divided + given[3:],
                                    origins=[0, 1] + [2] * len(divided) + list(range(3, len(given))),
                                    **{place: coordinates}))

    def test_concave_polygons(self):
        """They are covered once, stay as they are, and their diagonals are said."""
        for order in (None, "<", ">"):
            old = samples.ply(order, [np.roll(np.arange(6), k) for k in range(6)], vertices=samples.ELL)
            mesh = files.read(self.file("in.ply", old))
            normals = areas(mesh.vertices, mesh.faces).reshape(6, 4, 3)
            self.assertTrue((normals[..., 2] > 0).all())
            np.testing.assert_allclose(normals.sum(1), [[0, 0, 3]] * 6)
            self.assertEqual(int(mesh.diagonals.sum()), 6 * 2 * 3)
            uv = by_corner(mesh)
            mesh.save(self.folder / "out.ply", uv)
            again = files.read(self.folder / "out.ply")
            np.testing.assert_array_equal(again.starts, mesh.starts)
            np.testing.assert_allclose(again.uv, uv, atol=1e-8)

    def test_lists_of_any_length_and_type(self):
        """A polygon of so many corners that its list needs a wider count; coordinates that were no floats."""
        n = 200
        ring = np.c_[np.cos(np.arange(n) / 32), np.sin(np.arange(n) / 32), np.zeros(n)]
        for form, order in (("ascii", None), ("binary_little_endian", "<")):
            for old, new in (("", "uint float"), ("list uchar int", "uint float"), ("short", "uint float"),
                             ("list uchar double", "uint double"), ("list int float", "int float")):
                with self.subTest(form=form, old=old):
                    head = (f"ply\nformat {form} 1.0\nelement vertex {n}\nproperty double x\n"
                            "property double y\nproperty double z\nelement face 2\n"
                            "property list int int vertex_indices\n" +
                            (f"property {old} texcoord\n" if old else "") + "end_header\n").encode()
                    empty = bytes({"": 0, "short": 2, "list int float": 4}.get(old, 1))
                    body = ring.tobytes() + np.array([n, *range(n)], "<i4").tobytes() + empty + np.array(
                        [3, 0, 1, 2], "<i4").tobytes() + empty
                    if order is None:
                        body = ("".join("%.17g %.17g %.17g\n" % tuple(p) for p in ring) + "".join(
                            f"{len(p)} {' '.join(map(str, p))}{' 0' if old else ''}\n"
                            for p in (range(n), range(3)))).encode()
                    mesh = files.read(self.file("in.ply", head + body))
                    uv = by_corner(mesh)
                    mesh.save(self.folder / "out.ply", uv)
                    again = files.read(self.folder / "out.ply")
                    self.assertEqual([l for l in again._header if "texcoord" in l],
                                     [f"property list {new} texcoord"])
                    self.assertEqual(again.starts.tolist(), [0, n, n + 3])
                    np.testing.assert_allclose(again.uv, uv, atol=1e-9)

    def test_new_picture(self):
        new = self.file("n\u00e4w \u4e00.png", samples.png(samples.noise(2, 2)))
        for order in (None, "<"):
            content = samples.ply(order, list(samples.TRIANGLES), coordinates=True)
            mesh = files.read(self.file("in.ply", content))
            mesh.save(self.folder / "out.ply", by_vertex(mesh), new)
            again = files.read(self.folder / "out.ply")
            self.assertEqual([p.name for p in again.pictures], [new.name])
            self.assertEqual(again.pictures[0].read().shape, (2, 2, 4))
            self.assertTrue((again.uv_picture == 0).all())

    def test_strips(self):
        mesh = files.read(self.file("in.ply", samples.every()["strips.ply"]))
        self.assertEqual(mesh.faces.tolist(), [[0, 1, 2], [2, 1, 3], [0, 2, 1]])
        mesh.save(self.folder / "out.ply", by_vertex(mesh))
        np.testing.assert_allclose(files.read(self.folder / "out.ply").uv, by_vertex(mesh))

    def test_rows_that_are_not_lines(self):
        content = samples.ply(None)
        head, body = content.split(b"end_header\n")
        mesh = files.read(self.file("in.ply", head + b"end_header\n" + b"\n \n".join(body.split())))
        np.testing.assert_array_equal(mesh.faces, files.read(self.file("b.ply", content)).faces)

    def test_spaces_stay(self):
        head = (b"ply\r\nformat ascii 1.0\r\nelement vertex 4\r\nproperty float x\r\nproperty float y\r\n"
                b"property float z\r\nelement face 2\r\nproperty list uchar int vertex_indices\r\n")
        body = b"end_header\r\n0 0 0\r\n1 0 0\r\n1 1 0\r\n0 1 0\r\n%s"
        mesh = files.read(self.file(
            "in.ply", head + body % b"4 0\t1 2  3\t \r\n\r\n 3  0 1 2\r\n \r\n"))
        mesh.save(self.folder / "out.ply", mesh.vertices[mesh.faces][..., :2])
        self.assertEqual(
            (self.folder / "out.ply").read_bytes(),
            head + b"property list uchar float texcoord\r\n" + body % (
                b"4 0\t1 2  3 8 0 0 1 0 1 1 0 1\t \r\n\r\n 3  0 1 2 6 0 0 1 0 1 1\r\n \r\n"))

    def test_coordinates_of_vertices(self):
        text = (
            b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            b"property float s\nproperty float t\nelement face 1\nproperty list uchar int vertex_indices\n"
            b"end_header\n0 0 0 .1 .2\n1 0 0 .3 .4\n0 1 0 .5 .6\n3 0 1 2\n")
        mesh = files.read(self.file("in.ply", text))
        np.testing.assert_allclose(mesh.uv, [[[0.1, 0.2], [0.3, 0.4], [0.5, 0.6]]], atol=1e-7)
        self.assertIn("s and t of the vertices stay", mesh.save(self.folder / "out.ply", by_vertex(mesh))[0])
        np.testing.assert_allclose(files.read(self.folder / "out.ply").uv, by_vertex(mesh), atol=1e-8)

    def test_it_is_cut_off(self):
        for order in (None, "<", ">"):
            content = samples.ply(order)
            for length in range(0, len(content) - (2 if order is None else 0), 37):
                with self.assertRaises(files.FileError):
                    files.read(self.file("in.ply", content[:length]))


class Attributes:
    """The attributes of a glTF at its corners, read apart from the package."""

    def __init__(self, path):
        data = path.read_bytes()
        length = struct.unpack("<I", data[12:16])[0]
        self.json, self.body = json.loads(data[20:20 + length]), data[28 + length:]

    def raw(self, number):
        accessor = self.json["accessors"][number]
        width = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}[accessor["componentType"]]
        size = width * {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}[accessor["type"]]

        def rows(view, count, size, offset=0):
            entry = self.json["bufferViews"][view]
            begin, stride = entry.get("byteOffset", 0) + offset, entry.get("byteStride", size)
            return [self.body[begin + i * stride:begin + i * stride + size] for i in range(count)]
        result = rows(accessor["bufferView"], accessor["count"], size, accessor.get("byteOffset", 0))
        sparse = accessor.get("sparse")
        if sparse:
            new = rows(sparse["values"]["bufferView"], sparse["count"], size)
            index = rows(sparse["indices"]["bufferView"], sparse["count"], 1)  # bytes in the samples
            for i, content in zip(index, new):
                result[i[0]] = content
        return result

    def indices(self, primitive):
        if "indices" not in primitive:
            index = list(range(self.json["accessors"][primitive["attributes"]["POSITION"]]["count"]))
        else:
            index = [int.from_bytes(r, "little") for r in self.raw(primitive["indices"])]
        mode = primitive.get("mode", 4)
        if mode == 5:
            return [v for i in range(len(index) - 2) for v in
                    (index[i:i + 3] if i % 2 == 0 else [index[i], index[i + 2], index[i + 1]])]
        if mode == 6:
            return [v for i in range(1, len(index) - 1) for v in (index[i], index[i + 1], index[0])]
        return index

    def corners(self):
        """For each primitive its attributes (and targets) at its corners."""
        for mesh in self.json["meshes"]:
            for primitive in mesh["primitives"]:
                index = self.indices(primitive)
                result = {}
                for n, attributes in enumerate([primitive["attributes"], *primitive.get("targets", [])]):
                    for name, number in attributes.items():
                        raw = self.raw(number)
                        result[n, name] = [raw[i] for i in index]
                yield primitive, result


OTHERS = (
    "nodes",
    "scenes",
    "scene",
    "skins",
    "animations",
    "cameras",
    "images",
    "textures",
    "samplers",
    "asset",
    "extensionsUsed",
    "extensionsRequired",
    "extras",
)


class Gltf(Folder):
    def check_kept(self, before, after, other_sets=()):
        old, new = Attributes(before), Attributes(after)
        for key in OTHERS:
            if key == "images":
                continue
            self.assertEqual(old.json.get(key), new.json.get(key), key)
        self.assertEqual(
            [m.get("name") for m in old.json["meshes"]], [m.get("name") for m in new.json["meshes"]])
        for (p, was), (q, now) in zip(old.corners(), new.corners(), strict=True):
            for key, rows in was.items():
                self.assertEqual(rows, now[key], key)
            for member in ("material", "extras"):
                self.assertEqual(p.get(member), q.get(member))
            self.assertLessEqual(len(now) - len(was), 1)
        images = [[self.bytes_of(a, i) for i in a.json.get("images", [])] for a in (old, new)]
        self.assertEqual(*images)

    @staticmethod
    def bytes_of(file, image):
        view = file.json["bufferViews"][image["bufferView"]]
        return file.body[view.get("byteOffset", 0):view.get("byteOffset", 0) + view["byteLength"]]

    def read_back(self, path, mesh):
        """(F, 3, 2) of the set that was written: the only new one."""
        found = []
        for primitive, rows in Attributes(path).corners():
            if primitive.get("mode", 4) != 4:
                continue
            last = max(int(n[9:]) for k, n in rows if n.startswith("TEXCOORD_"))
            uv = np.array([struct.unpack("<2f", r) for r in rows[0, f"TEXCOORD_{last}"]])
            found.append(np.c_[uv[:, 0], 1 - uv[:, 1]].reshape(-1, 3, 2))
        for part in mesh.parts:
            if part.mirrored:
                done = np.concatenate(found)
                done[part.faces] = done[part.faces][:, [0, 2, 1]]
                found = [done]
        return np.concatenate(found)

    def test_rich(self):
        path = self.file("rich.glb", samples.rich().glb())
        mesh = files.read(path)
        self.assertEqual(len(mesh.faces), samples.RICH_TRIANGLES)
        self.assertEqual([p.name for p in mesh.parts], ["ball", "strips", "mesh 2"])
        self.assertEqual([p.scale for p in mesh.parts], [1, 2, 1])
        self.assertEqual([p.mirrored for p in mesh.parts], [False, False, True])
        self.assertTrue((mesh.vertices == 2).any())  # the sparse accessor's
        for make in (by_vertex, by_corner):
            uv = make(mesh)
            self.assertEqual(mesh.save(self.folder / "out.glb", uv), [])
            self.check_kept(path, self.folder / "out.glb")
            np.testing.assert_allclose(self.read_back(self.folder / "out.glb", mesh), uv, atol=1e-7)

    def test_a_gltf_keeps_its_data(self):
        text, data = samples.rich().gltf("rich.bin")
        path = self.file("rich.gltf", text)
        self.file("rich.bin", data)
        mesh = files.read(path)
        (self.folder / "there").mkdir()
        uv = by_corner(mesh)
        for out in (self.folder / "there" / "out.gltf", self.folder / "there" / "out.glb", path):
            mesh.save(out, uv)
            again = files.read(out)
            np.testing.assert_array_equal(again.vertices[again.faces], mesh.vertices[mesh.faces])
        self.assertEqual((self.folder / "there" / "rich.bin").read_bytes(), data)
        self.assertEqual((self.folder / "rich.bin").read_bytes(), data)

    def test_a_mirrored_mesh_is_mapped_as_it_is_seen(self):
        mesh = files.read(self.file("rich.glb", samples.rich().glb()))
        part = mesh.parts[2]
        own = mesh.vertices[mesh.faces[part.faces]]
        normals = np.cross(own[:, 1] - own[:, 0], own[:, 2] - own[:, 0])
        outwards = own.mean(1) - [-0.5, 0.5, 0.5]  # the cube with -x
        self.assertEqual(
            np.sign((normals * outwards).sum(1)).tolist(),
            np.sign(
                [
                    n @ (m - 0.5)
                    for n, m in zip(
                        areas(samples.CUBE, samples.TRIANGLES), samples.CUBE[samples.TRIANGLES].mean(1))]
            ).tolist(),
        )
        np.testing.assert_array_equal(mesh.sized_vertices()[mesh.parts[1].vertices],
                                      2 * mesh.vertices[mesh.parts[1].vertices])

    def test_new_picture(self):
        path = self.file("rich.glb", samples.rich().glb())
        new = self.file("new.png", samples.png(samples.noise(2, 2)))
        mesh = files.read(path)
        mesh.save(self.folder / "out.glb", by_vertex(mesh), new)
        out = Attributes(self.folder / "out.glb")
        self.assertEqual(self.bytes_of(out, out.json["images"][-1]), new.read_bytes())
        cloth, plain = (out.json["materials"][out.json["meshes"][m]["primitives"][p]["material"]]
                        for m, p in ((0, 0), (1, 1)))
        shown = len(out.json["textures"]) - 1
        self.assertEqual(cloth["pbrMetallicRoughness"], {
            "roughnessFactor": 0.3, "baseColorFactor": [0.5, 1, 1, 0.75], "metallicFactor": 0,
            "baseColorTexture": {"index": shown}})
        for key, value in (("name", "cloth"), ("doubleSided", True), ("alphaMode", "MASK"),
                           ("extras", {"a": 1})):
            self.assertEqual(cloth[key], value)
        # The normal map keeps the old set, which makes room.
        self.assertEqual(cloth["normalTexture"], {"index": 0, "scale": 0.5, "texCoord": 1})
        old = next(Attributes(path).corners())[1]
        now = next(out.corners())[1]
        self.assertEqual(now[0, "TEXCOORD_1"], old[0, "TEXCOORD_0"])
        self.assertEqual(now[0, "COLOR_0"], old[0, "COLOR_0"])  # it multiplies the picture, as before
        self.assertEqual(
            plain["pbrMetallicRoughness"], {"metallicFactor": 0, "baseColorTexture": {"index": shown}})
        self.assertEqual(out.json["materials"][:2], Attributes(path).json["materials"])
        for mesh in out.json["meshes"]:
            for primitive in mesh["primitives"]:
                if primitive.get("mode", 4) != 4:
                    continue
                material = out.json["materials"][primitive["material"]]
                self.assertEqual(material["pbrMetallicRoughness"]["metallicFactor"], 0)

    def test_set(self):
        path = self.file("rich.glb", samples.rich().glb())
        mesh = files.read(path)
        mesh.save(self.folder / "out.glb", by_vertex(mesh), uv_set=0)
        for primitive, _ in Attributes(self.folder / "out.glb").corners():
            if primitive.get("mode", 4) == 4:
                self.assertEqual([n for n in primitive["attributes"] if n.startswith("TEX")], ["TEXCOORD_0"])
        with self.assertRaisesRegex(files.FileError, "TEXCOORD_2 cannot be written"):
            mesh.save(self.folder / "out.glb", by_vertex(mesh), uv_set=2)

    def test_colours_are_linear(self):
        mesh = files.read(self.file("rich.glb", samples.rich().glb()))
        np.testing.assert_array_equal(
            np.rint(255 * mesh.corner_colours()[12:24]), np.tile([79, 229, 79, 255], (12, 3, 1)))
        self.assertEqual(np.rint(255 * mesh.material_colours[0]).tolist()[:3], [188, 255, 255])

    def test_compression_is_named(self):
        """With what to do, whether the file says that it is required or has nothing else."""
        def refused(out, sentence):
            with self.assertRaisesRegex(files.FileError, sentence):
                files.read(self.file("in.glb", out.glb()))
        for name, word in (("KHR_draco_mesh_compression", "Draco"), ("EXT_meshopt_compression", "meshopt")):
            sentence = rf"in\.glb is compressed with {word} \({name}\).*: export it without compression"
            out = samples.rich()
            out.json["extensionsRequired"] = [name]
            refused(out, sentence)
            out = samples.rich()
            primitive = out.json["meshes"][0]["primitives"][0]
            primitive["extensions"] = {name: {"bufferView": 0, "attributes": {"POSITION": 0}}}
            self.assertEqual(len(files.read(self.file("in.glb", out.glb())).faces), samples.RICH_TRIANGLES)
            del out.json["accessors"][primitive["attributes"]["POSITION"]]["bufferView"]
            refused(out, sentence)
        out = samples.rich()
        out.json["extensionsRequired"] = ["NONE_such"]
        refused(out, "needs the glTF extension NONE_such, which is not known")

    def test_transform_of_a_texture(self):
        for change, uv in (({"offset": [0.5, 0.25]}, [0.75, 0.75]), ({"scale": [2, 3]}, [0.5, 1.5]),
                           ({"rotation": np.pi / 2}, [0.5, -0.25])):  # counterclockwise as one sees it
            out = samples.Gltf(materials=[{"pbrMetallicRoughness": {"baseColorTexture": {
                "index": 0, "extensions": {"KHR_texture_transform": change}}}}], textures=[{"source": 0}],
                images=[{"uri": "none.png"}], extensionsUsed=["KHR_texture_transform"],
                extensionsRequired=["KHR_texture_transform"])
            triangle = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0)], "f4")
            out.node(out.mesh({"material": 0, "attributes": {
                "POSITION": out.accessor(triangle, bounds=True),
                "TEXCOORD_0": out.accessor(np.full((3, 2), [0.25, 0.5], "f4"))}}))
            mesh = files.read(self.file("in.glb", out.glb()))
            np.testing.assert_allclose(mesh.uv, np.tile([uv[0], 1 - uv[1]], (1, 3, 1)), atol=1e-12)

    def test_quantized(self):
        out = samples.Gltf(
            extensionsUsed=["KHR_mesh_quantization"], extensionsRequired=["KHR_mesh_quantization"])
        out.node(out.mesh({"attributes": {"POSITION": out.accessor(
            np.array([(0, 0, 0), (127, 0, 0), (0, -127, 0)], "i1"), padding=1, normalized=True)}}))
        mesh = files.read(self.file("in.glb", out.glb()))
        np.testing.assert_array_equal(mesh.vertices, [(0, 0, 0), (1, 0, 0), (0, -1, 0)])


class Validator(Folder):
    """The Khronos glTF validator finds no error in what is written."""

    def test_no_error(self):
        node, npm = shutil.which("node"), shutil.which("npm")
        if node is None or npm is None:
            self.skipTest("SKIPPED: node and npm are not installed")
        place = os.path.join(common.BUILD or tempfile.gettempdir(), "gltf-validator")
        if not os.path.isdir(os.path.join(place, "node_modules", "gltf-validator")):
            os.makedirs(place, exist_ok=True)
            run = subprocess.run(
                [npm, "install", "--no-audit", "--no-fund", "--prefix", place, "gltf-validator"],
                capture_output=True,
                text=True,
                timeout=300,
            )
            if run.returncode:
                self.skipTest("SKIPPED: npm cannot install gltf-validator")
        new = self.file("new.png", samples.png(samples.noise(2, 2)))
        written = []
        sources = self.all_samples() + sorted(HANDED.glob("*.glb"))
        for path in sources:
            mesh = files.read(path)
            for name, texture in (("", None), ("shown_", new)):
                out = self.folder / "out" / f"{name}{path.name}.glb"
                out.parent.mkdir(exist_ok=True)
                mesh.save(out, by_corner(mesh), texture)
                written.append(out)
            if path.name == "rich.glb":
                mesh.save(
                    self.folder / "out" / "refined.glb",
                    by_corner(mesh)[centroids(mesh)[2]],
                    refined=centroids(mesh),
                )
                written.append(self.folder / "out" / "refined.glb")
        script = (
            "const v=require('gltf-validator'),fs=require('fs');(async()=>{"
            "for(const f of process.argv.slice(1)){"
            "const r=await v.validateBytes(new Uint8Array(fs.readFileSync(f)));"
            "for(const m of r.issues.messages)if(m.severity==0)console.log(f,m.code,m.pointer)}})()")
        run = subprocess.run(
            [node, "-e", script, "--", *map(str, written)],
            capture_output=True,
            text=True,
            env={**os.environ, "NODE_PATH": os.path.join(place, "node_modules")},
            timeout=300,
        )
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "", ""))


class ThreeMf(Folder):
    def test_read(self):
        mesh = files.read(self.file("in.3mf", samples.threemf()))
        self.assertEqual(len(mesh.faces), 24)
        self.assertEqual(
            [(p.name, p.scale, p.mirrored) for p in mesh.parts], [("one", 1, False), ("two", 2, True)])
        colours = np.rint(255 * mesh.corner_colours())
        self.assertEqual(colours[0].tolist(), [[255, 0, 0, 255], [0, 255, 0, 128], [255, 0, 0, 255]])
        self.assertEqual(colours[5].tolist(), [[255] * 4] * 3)

    def test_all_else_stays(self):
        content = samples.threemf(colours=False)
        mesh = files.read(self.file("in.3mf", content))
        self.assertEqual(mesh.save(self.folder / "out.3mf", by_corner(mesh)), [])
        with zipfile.ZipFile(io.BytesIO(content)) as old, zipfile.ZipFile(self.folder / "out.3mf") as new:
            self.assertEqual(new.read("Metadata/thumbnail.png"), old.read("Metadata/thumbnail.png"))
            self.assertEqual(new.read("_rels/.rels"), old.read("_rels/.rels"))
            text = re.sub(rb'<m:texture2d .*</m:texture2dgroup>', b'', new.read("3D/3dmodel.model"))
            text = re.sub(rb' pid="\d+" p1="\d+" p2="\d+" p3="\d+"/>', b' />', text)
            self.assertEqual(text, old.read("3D/3dmodel.model"))
            self.assertIn("3D/_rels/3dmodel.model.rels", new.namelist())
        again = files.read(self.folder / "out.3mf")
        np.testing.assert_allclose(again.uv, by_corner(mesh), atol=1e-8)
        self.assertTrue((again.uv_picture == 0).all())

    def test_colours_that_go_are_said(self):
        mesh = files.read(self.file("in.3mf", samples.threemf()))
        self.assertIn("colours", mesh.save(self.folder / "out.3mf", by_corner(mesh))[0])

    def test_mixtures_are_named(self):
        """Multiproperties and composite materials, of triangles and of whole objects."""
        for kind, inner in (("multiproperties", '<m:multi pindices="0 0"/><m:multi pindices="0 1"/>'),
                            ("compositematerials", '<m:composite values="0.5 0.5"/>' * 2)):
            for where, count in ((b'object id="5"', 12 - 3), (b'triangle v1="0" v2="1" v3="3"', 2)):
                group = (f'<m:{kind} id="9" pids="1 1" matid="1" matindices="0 1">{inner}</m:{kind}>'
                         '<object id="5"')
                with zipfile.ZipFile(io.BytesIO(samples.threemf())) as old:
                    parts = {name: old.read(name) for name in old.namelist()}
                model = parts["3D/3dmodel.model"].replace(b'<object id="5"', group.encode())
                if where.startswith(b"triangle"):
                    model = model.replace(where + b' pid="1"', where + b' pid="9"')
                else:
                    model = model.replace(where, where + b' pid="9" pindex="1"')
                parts["3D/3dmodel.model"] = model
                out = io.BytesIO()
                with zipfile.ZipFile(out, "w") as package:
                    for name, content in parts.items():
                        package.writestr(name, content)
                mesh = files.read(self.file("in.3mf", out.getvalue()))
                self.assertEqual(mesh.messages,
                                 [f"{count} faces with {kind}: their colours and pictures are not read"])
                self.assertIn("give way", mesh.save(self.folder / "out.3mf", by_corner(mesh))[0])
                again = files.read(self.folder / "out.3mf")
                self.assertEqual(again.messages, [])
                np.testing.assert_allclose(again.uv, by_corner(mesh), atol=1e-8)


class Others(Folder):
    def test_stl(self):
        for content in (samples.stl(), samples.stl_text(),
                        samples.stl_text().upper().replace(b"SOLID", b"solid"),
                        b"solid" + samples.stl()[5:]):
            mesh = files.read(self.file("in.stl", content))
            np.testing.assert_array_equal(mesh.vertices[mesh.faces], samples.CUBE[samples.TRIANGLES])
            self.assertTrue(mesh.split)

    def test_off(self):
        for content in (samples.off(), samples.off(False), samples.off().replace(b"COFF\n", b"COFF "),
                        b"\n".join(re.sub(rb"# a comment|  0.2 0.4 0.6", b"", samples.off(False)).split())):
            mesh = files.read(self.file("in.off", content))
            np.testing.assert_array_equal(mesh.faces, samples.TRIANGLES)
            np.testing.assert_array_equal(mesh.vertices, samples.CUBE)
        mesh = files.read(self.file("in.off", samples.off()))
        np.testing.assert_allclose(mesh.vertex_colours[3], [1, 0, 0.2, 1])
        np.testing.assert_allclose(mesh.face_colours[3], [0.2, 0.4, 0.6, 1])

    def test_what_is_not_read_says_who_could(self):
        with self.assertRaisesRegex(files.FileError, "trimesh or PyMeshLab"):
            files.read(self.file("in.dae", b""))
        with self.assertRaisesRegex(files.FileError, "does not exist"):
            files.read(self.folder / "none.obj")

    def test_every_format_in_every_other(self):
        new = self.file("new.png", samples.png(samples.noise(2, 2)))
        for path in self.all_samples():
            mesh = files.read(path)
            uv = by_corner(mesh)
            for ending in files.WRITES:
                for texture in (None, new):
                    with self.subTest(path=path.name, ending=ending, texture=bool(texture)):
                        out = self.folder / f"out{ending}"
                        mesh.save(out, uv, texture)
                        again = files.read(out)
                        self.assertEqual(len(again.faces), len(mesh.faces))
                        if texture:
                            np.testing.assert_allclose(again.uv, uv, atol=1e-6)
                            self.assertTrue((again.uv_picture >= 0).all())
                        if ending not in (".glb", ".gltf") and path.suffix in (".glb", ".gltf"):
                            continue
                        if path.suffix != ".3mf" or ending == ".3mf":  # 3MF places its objects
                            np.testing.assert_allclose(
                                again.vertices[again.faces], mesh.vertices[mesh.faces], atol=1e-6)

    def test_colours_that_go_are_said(self):
        mesh = files.read(self.file("in.off", samples.off(False)))
        mesh.face_colours[::4, 0] = 1
        said = {e: mesh.save(self.folder / f"out{e}", by_vertex(mesh)) for e in files.WRITES}
        self.assertTrue(all("colours of faces" in said[e][0] for e in (".obj", ".ply", ".3mf")))
        self.assertFalse(any("colours" in sentence for sentence in said[".glb"]))
        np.testing.assert_allclose(files.read(self.folder / "out.glb").corner_colours(), mesh.corner_colours(),
                                   atol=1e-6)

    def test_a_scene_is_placed(self):
        mesh = files.read(self.file("rich.glb", samples.rich().glb()))
        mesh.save(self.folder / "out.obj", by_corner(mesh))
        again = files.read(self.folder / "out.obj")
        mirrored = again.vertices[again.faces[mesh.parts[2].faces]]
        np.testing.assert_allclose(np.r_[mirrored.min((0, 1)), mirrored.max((0, 1))], [4, 0, 0, 5, 1, 1])
        strips = again.vertices[again.faces[mesh.parts[1].faces]]
        np.testing.assert_allclose(strips.max((0, 1)), [4, 4, 4])  # twice the sparse (2, 2, 2)
        np.testing.assert_allclose(again.uv, by_corner(mesh), atol=1e-8)

    def test_quads_stay_quads(self):
        """In OBJ, which all programs read with coordinates; others get triangles, and that is said."""
        mesh = files.read(self.file("in.off", samples.off(False)))
        for ending in files.WRITES:
            said = mesh.save(self.folder / f"out{ending}", by_vertex(mesh))
            corners = np.diff(files.read(self.folder / f"out{ending}").starts).tolist()
            self.assertEqual(corners, [4] * 6 if ending == ".obj" else [3] * 12)
            self.assertEqual(any("6 faces with more than 3 corners" in s for s in said), ending != ".obj")

    def test_normals_and_colours_are_carried(self):
        mesh = files.read(self.file("in.ply", samples.ply("<", list(samples.TRIANGLES))))
        mesh._by_name["vertex"].types.update(ny=("f4", None), nz=("f4", None))
        mesh._by_name["vertex"].columns.update(
            nx=np.ones(8, "f4"), ny=np.zeros(8, "f4"), nz=np.zeros(8, "f4"))
        mesh.save(self.folder / "out.glb", by_vertex(mesh))
        out = next(Attributes(self.folder / "out.glb").corners())[1]
        self.assertEqual(set(out[0, "NORMAL"]), {struct.pack("<3f", 1, 0, 0)})
        colours = files.read(self.folder / "out.glb").corner_colours()
        np.testing.assert_allclose(colours, mesh.corner_colours(), atol=1e-6)
        self.assertEqual(Attributes(self.folder / "out.glb").json["materials"],
                         [{"pbrMetallicRoughness": {"metallicFactor": 0}}])

    def test_arrays(self):
        mesh = files.plain(samples.CUBE, samples.TRIANGLES)
        for ending in files.WRITES:
            mesh.save(self.folder / f"out{ending}", by_vertex(mesh))
            np.testing.assert_allclose(
                files.read(self.folder / f"out{ending}").uv, by_vertex(mesh), atol=1e-6)


class Refined(Folder):
    def test_new_vertices_and_what_they_have(self):
        for path in self.all_samples():
            mesh = files.read(path)
            vertices, faces, origin, weights = centroids(mesh)
            uv = np.einsum("nij,njk->nik", weights, by_vertex(mesh)[origin])
            for ending in {path.suffix, ".obj", ".glb", ".ply", ".3mf"} & set(files.WRITES):
                with self.subTest(path=path.name, ending=ending):
                    new = self.file("new.png", samples.png(samples.noise(2, 2)))
                    mesh.save(
                        self.folder / f"out{ending}", uv, new, refined=(vertices, faces, origin, weights))
                    again = files.read(self.folder / f"out{ending}")
                    self.assertEqual(len(again.faces), len(faces))
                    np.testing.assert_allclose(again.uv, uv, atol=1e-6)
                    if path.suffix not in (".glb", ".gltf", ".3mf") or path.suffix == ending:
                        np.testing.assert_allclose(again.vertices[again.faces], vertices[faces], atol=1e-6)

    def test_colours_are_mixed(self):
        mesh = files.read(self.file("in.ply", samples.ply(">", list(samples.TRIANGLES))))
        refined = centroids(mesh)
        mesh.save(self.folder / "out.ply", by_corner(mesh)[refined[2]], refined=refined)
        again = files.read(self.folder / "out.ply")
        self.assertEqual(len(again.vertices), 8 + 12)
        np.testing.assert_array_equal(again.vertices[:8], mesh.vertices)
        exact = np.array([[255, i, 3] for i in range(8)])[mesh.faces].mean(1)
        np.testing.assert_array_equal(np.rint(255 * again.vertex_colours[8:, :3]), np.rint(exact))

    def test_untouched_polygons_stay(self):
        mesh = files.read(self.file("in.obj", samples.OBJ))
        count = len(mesh.faces)
        weights = np.tile(np.eye(3), (count, 1, 1))
        mesh.save(self.folder / "out.obj", by_vertex(mesh),
                  refined=(mesh.vertices, mesh.faces, np.arange(count), weights))
        self.assertEqual(kept_lines((self.folder / "out.obj").read_bytes()), kept_lines(samples.OBJ))

    def test_attributes_of_gltf(self):
        path = self.file("rich.glb", samples.rich().glb())
        mesh = files.read(path)
        refined = centroids(mesh)
        mesh.save(self.folder / "out.glb", by_corner(mesh)[refined[2]], refined=refined)
        old, new = next(Attributes(path).corners())[1], next(Attributes(self.folder / "out.glb").corners())[1]
        for name in ("POSITION", "NORMAL", "TANGENT", "COLOR_0", "JOINTS_0", "_TEMP"):
            was, now = old[0, name], new[0, name]
            for t in range(12):
                for k in range(3):
                    self.assertEqual(now[9 * t + 3 * k], was[3 * t + k])  # bit by bit at the old corners
        normals = np.array([struct.unpack("<3f", r) for r in new[0, "NORMAL"]])
        np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-6)
        joints = np.array([list(r) for r in new[0, "JOINTS_0"]])
        self.assertEqual(joints.tolist(), [[0, 0, 0, 0]] * 108)


class NothingIsLost(Folder):
    """No face goes without a word."""

    def test_numbers_that_are_none(self):
        text = b"v nan 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n"
        mesh = files.read(self.file("in.obj", text))
        sentence = "1 vertex with coordinates that are not finite numbers, first vertex 0, used by 1 face"
        self.assertEqual(mesh.messages, [sentence])
        self.assertEqual(len(mesh.faces), 2)
        self.assertEqual(files.plain(mesh.vertices, mesh.faces).messages, [sentence])
        mesh.save(self.folder / "out.obj", by_vertex(mesh))
        self.assertEqual(kept_lines((self.folder / "out.obj").read_bytes()), kept_lines(text))

    def test_a_vertex_twice(self):
        mesh = files.read(self.file("in.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 1 2\nf 3 3 3\n"))
        self.assertEqual(mesh.messages, ["2 faces with a vertex twice, first face 1: kept, without area"])
        self.assertEqual(len(mesh.faces), 3)

    def test_too_few_corners(self):
        text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2\n"
        mesh = files.read(self.file("in.obj", text))
        self.assertEqual(mesh.messages, ["1 face with less than 3 corners, first face 2: not mapped"])
        mesh.save(self.folder / "out.obj", by_vertex(mesh))
        self.assertEqual(kept_lines((self.folder / "out.obj").read_bytes()), kept_lines(text))

    def test_too_few_corners_in_another_format(self):
        """The faces that stay have their corners, polygons too."""
        text = (b"ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
                b"element face 4\nproperty list uchar int vertex_indices\nend_header\n"
                b"0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n2 1 0\n2 0 4\n4 0 1 2 3\n1 3\n4 1 4 5 2\n")
        mesh = files.read(self.file("in.ply", text))
        mesh.save(self.folder / "out.obj", by_vertex(mesh))
        saved = files.read(self.folder / "out.obj")
        self.assertEqual(saved.starts.tolist(), [0, 4, 8])
        self.assertEqual(saved.faces.tolist(), mesh.faces.tolist())

    def test_beyond_the_end(self):
        cases = {
            "a.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 9\n",
            "b.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 -4\n",
            "c.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 0\n",
            "d.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 99999999999999999999\n",
            "e.off": b"OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 3\n",
            "f.ply": samples.ply("<", [(0, 1, 2), (0, 1, 8)]),
            "g.ply": samples.ply(None, [(0, 1, 2), (0, 1, -1)]),
        }
        for name, content in cases.items():
            with self.subTest(name=name), self.assertRaisesRegex(
                    files.FileError, "1 corner of faces, first of face 2, name a vertex beyond the [38] of"):
                files.read(self.file(name, content))
        with self.assertRaisesRegex(files.FileError, "first of face 2"):
            files.plain(samples.CUBE, np.array([(0, 1, 2), (0, 1, 8)]))

    def test_the_file_is_replaced_whole_or_not_at_all(self):
        for path in self.all_samples():
            if path.suffix not in files.WRITES:
                continue
            before, mesh = path.read_bytes(), files.read(path)
            there = sorted(os.listdir(self.folder))
            with mock.patch("os.replace", side_effect=OSError(28, "No space left on device")):
                with self.assertRaisesRegex(files.FileError, "No space left"):
                    mesh.save(path, by_corner(mesh))
            self.assertEqual(path.read_bytes(), before)
            self.assertEqual(sorted(os.listdir(self.folder)), there)
            mesh.save(path, by_corner(mesh))
            again = files.read(path)
            self.assertEqual(len(again.faces), len(mesh.faces))
            self.assertEqual(sorted(os.listdir(self.folder)), there)

    def test_the_same_bits_each_time(self):
        for path in self.all_samples():
            mesh, out = files.read(path), self.folder / ("out" + path.suffix)
            if path.suffix not in files.WRITES:
                continue
            mesh.save(out, by_corner(mesh))
            first = out.read_bytes()
            files.read(path).save(out, by_corner(mesh))
            self.assertEqual(out.read_bytes(), first)


class Pictures(Folder):
    def test_png_without_pillow(self):
        for kind in (np.uint8, np.uint16):
            for channels in (1, 2, 3, 4):
                picture = samples.noise(13, 11, channels, kind)
                with mock.patch.dict(sys.modules, {"PIL": None}):
                    read = files.read_picture(samples.png(picture), "a.png")
                self.assertEqual(read.dtype, kind)
                rgb = picture[..., :3] if channels > 2 else np.repeat(picture[..., :1], 3, 2)
                np.testing.assert_array_equal(read[..., :3], rgb)
                alpha = picture[..., -1] if channels in (2, 4) else np.iinfo(kind).max
                np.testing.assert_array_equal(read[..., 3], np.broadcast_to(alpha, (13, 11)))

    def test_sixteen_bits_are_not_lost(self):
        picture = samples.noise(5, 7, 3, np.uint16)
        files.write_picture(self.folder / "a.png", picture)
        read = files.read_picture((self.folder / "a.png").read_bytes(), "a.png")
        self.assertEqual(read.dtype, np.uint16)
        np.testing.assert_array_equal(read[..., :3], picture)
        with self.assertRaisesRegex(files.FileError, "PNG only"):
            files.write_picture(self.folder / "a.jpg", picture)

    def test_without_pillow_it_is_named(self):
        with mock.patch.dict(sys.modules, {"PIL": None}):
            with self.assertRaisesRegex(files.FileError, r"picture scan.jpg is not a PNG.*pip install Pillow"):
                files.read_picture(b"\xff\xd8\xff\xe0 and so on", "scan.jpg")
            with self.assertRaisesRegex(files.FileError, "pip install Pillow"):
                files.write_picture(self.folder / "a.jpg", samples.noise(2, 2))
            files.write_picture(self.folder / "a.png", samples.noise(2, 2))

    def test_what_cannot_be_read_is_named(self):
        for content in (b"", b"no picture", samples.png(samples.noise(4, 4))[:60]):
            with self.assertRaisesRegex(files.FileError, "some name.png"):
                files.read_picture(content, "some name.png")

    @unittest.skipIf(Image is None, "SKIPPED: Pillow is not installed")
    def test_formats(self):
        ramp = np.arange(0, 256, 4, dtype=np.uint8)
        picture = np.stack([*np.meshgrid(ramp, ramp), np.full((64, 64), 99, np.uint8)], 2)
        for ending, error in ((".png", 0), (".tga", 0), (".bmp", 0), (".tiff", 0), (".webp", 2), (".jpg", 1)):
            path = self.folder / f"a{ending}"
            files.write_picture(path, picture, quality=95)
            read = files.read_picture(path.read_bytes(), path.name).astype(int)
            self.assertLessEqual(abs(read[..., :3] - picture).mean(), error, ending)
        for quality in (10, 95):
            files.write_picture(self.folder / f"{quality}.jpg", samples.noise(64, 64), quality=quality)
        self.assertLess((self.folder / "10.jpg").stat().st_size, (self.folder / "95.jpg").stat().st_size)

    @unittest.skipIf(Image is None, "SKIPPED: Pillow is not installed")
    def test_a_jpeg_of_an_obj(self):
        Image.fromarray(np.full((8, 8, 3), (10, 200, 30), np.uint8)).save(self.folder / "j.jpg")
        self.file("m.mtl", b"newmtl a\nmap_Kd j.jpg\n")
        mesh = files.read(
            self.file("in.obj", b"mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n")
        )
        self.assertEqual(mesh.pictures[0].name, "j.jpg")
        self.assertLess(abs(mesh.pictures[0].read()[..., :3].astype(int) - (10, 200, 30)).max(), 4)


@unittest.skipUnless(HANDED.is_dir(), "SKIPPED: the meshes beside the repository are not there")
class Handed(Gltf):
    """Files of people who wrote bug reports."""

    def colour_at(self, mesh, face):
        """Of the picture at the middle of a face."""
        picture = mesh.pictures[mesh.uv_picture[face]].read()
        height, width = picture.shape[:2]
        u, v = mesh.uv[face].mean(0) % 1
        return picture[int((1 - v) * height) % height, int(u * width)].tolist()[:3]

    def test_appearance_of_gltf(self):
        blue, red = [0, 0, 255], [255, 0, 0]
        for name, colour in (("tt1", blue), ("tt2", blue), ("tt3", red), ("tt4", red)):
            mesh = files.read(HANDED / f"{name}.glb")
            for face in range(12):
                self.assertEqual(self.colour_at(mesh, face), colour, name)
            np.testing.assert_allclose(np.ptp(mesh.vertices, 0), 1, atol=1e-4)

    def test_what_has_no_picture_has_its_colour(self):
        for _ in range(4):
            mesh = files.read(HANDED / "mix_all.glb")
            balls = [mesh.uv_picture[p.faces] for p in mesh.parts]
            self.assertEqual([(b.min(), b.max()) for b in balls], [(0, 0), (-1, -1), (-1, -1), (1, 1)])
            colours = np.rint(255 * mesh.corner_colours())
            for ball, colour in ((1, [229, 79, 79]), (2, [79, 229, 79])):
                self.assertTrue((colours[mesh.parts[ball].faces][..., :3] == colour).all())
        mesh = files.read(HANDED / "mixed.obj")
        colours = np.rint(255 * mesh.corner_colours()[..., :3])[mesh.uv_picture < 0]
        self.assertEqual({tuple(c) for c in colours.reshape(-1, 3).tolist()}, {(204, 26, 26), (26, 204, 26)})

    def test_triangles_and_nothing_else(self):
        self.assertEqual(len(files.read(HANDED / "ii2.glb").faces), 12)
        self.assertEqual(len(files.read(HANDED / "ii3.glb").faces), 34)

    def test_the_picture_beside_the_mesh(self):
        there = os.getcwd()
        os.chdir(HANDED / "cwd" / "A")
        try:
            mesh = files.read("../B/scan.obj")
            self.assertEqual(mesh.pictures[0].read()[32, 32].tolist(), [0, 0, 255, 255])
        finally:
            os.chdir(there)

    def test_tga(self):
        mesh = files.read(HANDED / "tga" / "tga.obj")
        mesh.save(self.folder / "out.obj", by_corner(mesh))
        self.assertEqual((self.folder / "t.tga").read_bytes(), (HANDED / "tga" / "t.tga").read_bytes())
        if Image is not None:
            self.assertEqual(mesh.pictures[0].read().shape[2], 4)

    def test_round_trip(self):
        for path in map(Path, sorted(glob.glob(str(HANDED / "**" / "*"), recursive=True))):
            if path.suffix not in files.WRITES:
                continue
            with self.subTest(path=path.name):
                mesh = files.read(path)
                uv = by_corner(mesh)
                out = self.folder / path.name
                mesh.save(out, uv)
                again = files.read(out)
                np.testing.assert_array_equal(again.vertices[again.faces], mesh.vertices[mesh.faces])
                if path.suffix == ".glb":
                    self.check_kept(path, out)
                    np.testing.assert_allclose(self.read_back(out, mesh), uv, atol=1e-7)
                    continue
                np.testing.assert_allclose(again.uv, uv, atol=1e-8)
                if path.suffix == ".obj":
                    self.assertEqual(kept_lines(out.read_bytes()), kept_lines(path.read_bytes()))
                else:
                    self.check_ply(mesh, again)

    def check_ply(self, mesh, again):
        for old, new in zip(mesh._elements, again._elements, strict=True):
            self.assertEqual(old.count, new.count)
            for name, column in old.columns.items():
                if name != "texcoord":
                    columns = [c if isinstance(c, tuple) else (c,) for c in (column, new.columns[name])]
                    for a, b in zip(*columns, strict=True):
                        np.testing.assert_array_equal(a, b)
        self.assertEqual([l for l in mesh._header if "texcoord" not in l],
                         [l for l in again._header if "texcoord" not in l])

    test_rich = test_a_gltf_keeps_its_data = test_a_mirrored_mesh_is_mapped_as_it_is_seen = None
    test_new_picture = test_set = test_colours_are_linear = test_compression_is_named = None
    test_transform_of_a_texture = test_quantized = None


class OtherReaders(Folder):
    """PyMeshLab, trimesh and Blender find the same faces and coordinates in what is written."""

    def test_pymeshlab(self):
        try:
            import pymeshlab
        except ImportError:
            self.skipTest("SKIPPED: PyMeshLab is not installed")
        for path in self.all_samples():
            if path.suffix == ".ply" and b"extra" in path.read_bytes() or path.name == "all.obj":
                continue  # PyMeshLab reads no lists of vertices, and ends at faces of six corners
            mesh = files.read(path)
            for ending in (".obj", ".ply"):
                out = self.folder / f"out_{path.stem}{path.suffix[1:]}{ending}"
                uv, new = by_corner(mesh), self.folder / "a b.png"
                mesh.save(out, uv, shutil.copy(new, self.folder / "shown.png"))
                host = pymeshlab.MeshSet()
                host.load_new_mesh(str(out))
                host.meshing_poly_to_tri()
                read = host.current_mesh()
                self.assertEqual(read.face_number(), len(mesh.faces), out.name)
                found = read.wedge_tex_coord_matrix().reshape(-1, 3, 2)
                own = files.read(out)
                points = read.vertex_matrix()[read.face_matrix()]
                self.assertEqual(rows(points, found), rows(own.vertices[own.faces], uv), out.name)

    def test_pymeshlab_opens_polygons_as_obj_only(self):
        """As the message about such a PLY says."""
        try:
            import pymeshlab
        except ImportError:
            self.skipTest("SKIPPED: PyMeshLab is not installed")
        text = (b"ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                b"property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                b"0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n")
        mesh, host = files.read(self.file("in.ply", text)), pymeshlab.MeshSet()
        said, = mesh.save(self.folder / "out.ply", by_vertex(mesh))
        self.assertIn("1 face with more than 3 corners: MeshLab opens no PLY of such faces", said)
        with self.assertRaises(pymeshlab.PyMeshLabException):
            host.load_new_mesh(str(self.folder / "out.ply"))
        mesh.save(self.folder / "out.obj", by_vertex(mesh))
        host.load_new_mesh(str(self.folder / "out.obj"))
        host.meshing_poly_to_tri()
        read = host.current_mesh()
        self.assertEqual(rows(read.vertex_matrix()[read.face_matrix()],
                              read.wedge_tex_coord_matrix().reshape(-1, 3, 2)),
                         rows(mesh.vertices[mesh.faces], by_vertex(mesh)))

    def test_trimesh(self):
        try:
            import trimesh
        except ImportError:
            self.skipTest("SKIPPED: trimesh is not installed")
        for path in self.all_samples():
            mesh = files.read(path)
            out, uv = self.folder / "out.glb", by_corner(mesh)
            mesh.save(out, uv, self.folder / "a b.png")
            scene = trimesh.load_scene(out, process=False)
            found, points = [], []
            for part in scene.geometry.values():
                if hasattr(part, "faces"):
                    found.append(part.visual.uv[part.faces])
                    points.append(part.vertices[part.faces])
            again = files.read(out)
            np.testing.assert_allclose(again.uv, uv, atol=1e-6)
            own = np.concatenate([self.of_file(again, uv, p) for p in again.parts])
            self.assertEqual(rows(np.concatenate(points), np.concatenate(found), 4),
                             rows(own[..., :3], own[..., 3:], 4), path.name)

    def test_blender(self):
        try:
            import bpy
        except ImportError:
            self.skipTest("SKIPPED: Blender (bpy) is not installed")
        self.all_samples()
        for name in ("even.ply", "cube.stl", "cube.off", "cube.3mf"):
            mesh = files.read(self.folder / name)
            for ending in (".obj", ".glb"):
                out, uv = self.folder / f"out{ending}", by_corner(mesh)
                mesh.save(out, uv, self.folder / "a b.png")
                bpy.ops.wm.read_factory_settings(use_empty=True)
                if ending == ".obj":
                    bpy.ops.wm.obj_import(filepath=str(out), forward_axis="Y", up_axis="Z")
                else:
                    bpy.ops.import_scene.gltf(filepath=str(out))
                read, = (o.data for o in bpy.data.objects if o.type == "MESH")
                read.calc_loop_triangles()
                loops = np.array([t.loops for t in read.loop_triangles])
                points = np.array([read.vertices[i.vertex_index].co for i in read.loops])[loops]
                found = np.array([d.uv for d in read.uv_layers[0].data])[loops]
                if ending == ".glb":  # y is up in glTF
                    points = points[..., [0, 2, 1]] * [1, 1, -1]
                own = files.read(out)
                self.assertEqual(len(read.polygons), len(own.starts) - 1)
                self.assertEqual(rows(points, found, 3), rows(own.vertices[own.faces], uv, 3), out.name)

    @staticmethod
    def of_file(mesh, uv, part):
        """(f, 3, 5) A part as its file has it, where mirrored ones are not turned."""
        corners = np.concatenate([mesh.vertices[mesh.faces[part.faces]], uv[part.faces]], 2)
        return corners[:, [0, 2, 1]] * [-1, 1, 1, 1, 1] if part.mirrored else corners


def rows(points, uv, digits=5):
    """Triangles without their order: corners rounded, the smallest first."""
    corners = np.round(np.concatenate([points, uv], 2).astype(float), digits) + 0.0
    found = []
    for triangle in corners.tolist():
        first = triangle.index(min(triangle))
        found.append(triangle[first:] + triangle[:first])
    return sorted(found)


if __name__ == "__main__":
    common.main()
