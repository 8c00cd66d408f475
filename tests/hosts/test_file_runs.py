# SPDX-License-Identifier: GPL-3.0-or-later
"""What flatten() and the command line make of files that people had trouble with; test_files.py has what is
read and written by itself. Usage: test_file_runs.py BUILD_DIR [TEST...]."""

import os
import struct
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path

import common
import meshes

try:
    import numpy as np
except ImportError as problem:
    common.skip(f"numpy cannot be imported here: {problem}")
if not os.path.isdir(os.path.join(common.BUILD, "python")):
    common.skip("the Python package is not built")
sys.path.insert(0, os.path.join(common.BUILD, "python"))
import file_samples as samples  # noqa: E402
import ricciflow  # noqa: E402
from ricciflow import files, flatten  # noqa: E402

RED, GREEN = (229, 79, 79), (79, 229, 79)  # (200, 20, 20) and (20, 200, 20) of 255 in linear light


def arrays(mesh):
    return np.array(mesh.vertices, float), np.array(mesh.faces)


def obj(vertices, faces, before=None):
    """(bytes) Lines of vertices and faces, polygons too; with x and y as coordinates, if so many vertices
    before these have none."""
    lines = ["v " + " ".join(map(repr, p)) for p in np.asarray(vertices, float).tolist()]
    if before is not None:
        lines += [f"vt {x!r} {y!r}" for x, y in np.asarray(vertices, float)[:, :2].tolist()]
    lines += ["f " + " ".join(str(i + 1) if before is None else f"{i + 1}/{i + 1 - before}" for i in f)
              for f in faces]
    return ("\n".join(lines) + "\n").encode()


def one_colour(*colour, size=4):
    return samples.png(np.full((size, size, 3), colour, np.uint8))


class Runs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        catch = warnings.catch_warnings()
        catch.__enter__()
        self.addCleanup(catch.__exit__, None, None, None)
        warnings.simplefilter("ignore", ricciflow.RicciWarning)

    def file(self, name, content):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
        return path

    def by_command(self, *words, folder=None):
        """Status and what is on standard error."""
        run = subprocess.run(
            [sys.executable, "-m", "ricciflow", *map(str, words)], capture_output=True, text=True, cwd=folder,
            env={**os.environ, "PYTHONPATH": os.path.join(common.BUILD, "python")})
        return run.returncode, run.stderr

    def drawn(self, given, **options):
        """The result, and (F, 4, 3) the new picture's colours in the middle and near the corners of faces."""
        path = self.folder / "new.png"
        result = flatten(given, carry_texture=str(path), texture_size=256, **options)
        picture = files.read_picture(path.read_bytes(), path.name)
        inside = np.array([(1, 1, 1), (4, 1, 1), (1, 4, 1), (1, 1, 4)]) / [[3], [6], [6], [6]]
        at = np.einsum("pk,fkc->fpc", inside, result.uv)
        rows, columns = (1 - at[..., 1]) * len(picture), at[..., 0] * picture.shape[1]
        return result, picture[rows.astype(int), columns.astype(int), :3].astype(int)

    def assert_colours(self, found, wanted):
        np.testing.assert_array_less(np.abs(found - wanted), 2)  # one step of 255


class Faces(Runs):
    """No face is lost without a word."""

    def test_a_vertex_that_is_no_number(self):
        vertices, faces = arrays(meshes.hill(10))
        vertices[0] = np.nan
        path = self.file("in.obj", obj(vertices, faces))
        sentence = r"1 vertex has coordinates that are not finite numbers"
        for given in ((path,), (vertices, faces)):
            with self.assertRaisesRegex(ricciflow.Refused, sentence):
                flatten(*given)
        code, said = self.by_command(path, self.folder / "out.obj")
        self.assertEqual((code, (self.folder / "out.obj").exists()), (1, False))
        self.assertRegex(said, sentence)

    def test_a_vertex_twice(self):
        vertices, faces = arrays(meshes.hill(10))
        faces = np.r_[faces, [(0, 0, 1), (5, 6, 5), (9, 9, 9)]]
        path, out = self.file("in.obj", obj(vertices, faces)), self.folder / "out.ply"
        for given in ((path,), (vertices, faces)):
            result = flatten(*given)
            np.testing.assert_array_equal(result.faces, faces)
            self.assertEqual(result.degenerate_faces, 3)
        self.assertEqual(self.by_command(path, out), (0, "in.obj: 3 faces with a vertex twice, first face "
                                                         f"{len(faces) - 3}: kept, without area\n"))
        np.testing.assert_array_equal(files.read(out).faces, faces)

    def test_nothing(self):
        with self.assertRaisesRegex(ValueError, "^The mesh has no vertices$"):
            flatten(np.zeros((0, 3)), np.zeros((0, 3), int))

    def test_quads(self):
        n = 12
        points = np.array([(i, j, np.sin(i / 3) * np.cos(j / 4)) for i in range(n) for j in range(n)])
        quads = [(a, a + n, a + n + 1, a + 1) for a in range(n * n) if a % n < n - 1 and a < n * (n - 1)]
        source = files.read(self.file("in.obj", obj(points, quads)))
        self.file("in.ply", samples.ply("<", quads, points))
        for ending in (".obj", ".ply"):
            out = self.folder / f"out{ending}"
            self.assertEqual(self.by_command(self.folder / f"in{ending}", out)[0], 0)
            written = files.read(out)
            self.assertEqual(np.diff(written.starts).tolist(), [4] * len(quads))
            np.testing.assert_array_equal(written.faces, source.faces)
            self.assertFalse(np.isnan(written.uv).any())

    def test_quads_of_a_closed_surface(self):
        """Seams go round them."""
        n, m = 48, 24
        a, b = np.meshgrid(2 * np.pi * np.arange(n) / n, 2 * np.pi * np.arange(m) / m, indexing="ij")
        wide = 2 + np.cos(b) * (1 + 0.3 * np.sin(3 * a))
        points = np.stack([wide * np.cos(a), wide * np.sin(a), np.sin(b)], -1).reshape(-1, 3)
        quads = [(i * m + j, (i + 1) % n * m + j, (i + 1) % n * m + (j + 1) % m, i * m + (j + 1) % m)
                 for i in range(n) for j in range(m)]
        flatten(self.file("in.obj", obj(points, quads))).save(self.folder / "out.obj")
        corners = np.diff(files.read(self.folder / "out.obj").starts)
        self.assertGreaterEqual((corners == 4).sum(), 0.998 * len(quads))
        self.assertEqual((corners - 2).sum(), 2 * len(quads))

    def test_split_vertices(self):
        """A flat-shaded GLB, whose faces have vertices of their own, gets the charts of the shared mesh."""
        vertices, faces = arrays(meshes.torus())
        out = samples.Gltf()
        out.node(out.mesh({"attributes": {"POSITION": out.accessor(
            vertices[faces.ravel()].astype("f4"), bounds=True)}}))
        path = self.file("flat.glb", out.glb())
        result = flatten(path)
        self.assertEqual(result.charts, flatten(vertices.astype("f4"), faces).charts)
        self.assertEqual((result.genus, result.joined_edges), (1, 3 * len(faces) // 2))
        self.assertEqual(flatten(path, join_vertices="Never").charts, len(faces))


class Scenes(Runs):
    def test_a_mirrored_node(self):
        """A box, and the same through a node that mirrors it: both are right side out, and their maps."""
        out = samples.Gltf()
        points = out.accessor(samples.CUBE.astype("f4"), bounds=True)
        index = out.accessor(samples.TRIANGLES.ravel().astype("u2"))
        out.node(out.mesh({"attributes": {"POSITION": points}, "indices": index}))
        out.node(out.mesh({"attributes": {"POSITION": points}, "indices": index}), scale=[-1, 1, 1])
        result = flatten(self.file("in.glb", out.glb()))
        for part in (slice(0, 12), slice(12, 24)):
            a, b, c = np.moveaxis(result.vertices[result.faces[part]], 1, 0)
            self.assertAlmostEqual(float((np.cross(a, b) * c).sum()) / 6, 1)
            (ux, uy), (vx, vy) = ((result.uv[part, k] - result.uv[part, 0]).T for k in (1, 2))
            self.assertTrue((ux * vy > uy * vx).all())

    def test_attributes_of_glb_stay(self):
        """By the command line: normals, colours, names; with a new picture no bare metal."""
        path = self.file("rich.glb", samples.rich().glb())
        self.assertEqual(self.by_command(path, self.folder / "out.glb")[0], 0)
        old, new = files.read(path), files.read(self.folder / "out.glb")
        for was, now in zip(old._used(), new._used(), strict=True):
            self.assertLessEqual(set(was["attributes"]), set(now["attributes"]))
        self.assertEqual([m["name"] for m in new.json["meshes"][:2]], ["ball", "strips"])
        self.assertEqual(new.json["materials"], old.json["materials"])
        np.testing.assert_array_equal(new.corner_colours(), old.corner_colours())
        vertices, faces = arrays(meshes.torus())
        out = samples.Gltf()
        out.node(out.mesh({
            "attributes": {"POSITION": out.accessor(vertices.astype("f4"), bounds=True),
                           "COLOR_0": out.accessor(np.full((len(vertices), 3), 0.5, "f4"))},
            "indices": out.accessor(faces.ravel().astype("u2"))}))
        result, _ = self.drawn(self.file("colours.glb", out.glb()))
        result.save(self.folder / "shown.glb")
        material, = files.read(self.folder / "shown.glb").json["materials"]
        self.assertEqual(material["pbrMetallicRoughness"]["metallicFactor"], 0)


class Pictures(Runs):
    def balls(self):
        """Four tori in a GLB: a blue picture, a red material, green vertices, a picture again."""
        vertices, faces = arrays(meshes.torus(12, 8))
        out = samples.Gltf()
        image = out.view(one_colour(0, 0, 255))
        red = [200 / 255, 20 / 255, 20 / 255, 1]
        out.json.update(images=[{"bufferView": image, "mimeType": "image/png"}], textures=[{"source": 0}],
                        materials=[{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
                                   {"pbrMetallicRoughness": {"baseColorFactor": red}}])
        green = np.tile(np.array([[20, 200, 20, 255]], "u1"), (len(vertices), 1))
        index = out.accessor(faces.ravel().astype("u2"))
        for k in range(4):
            attributes = {"POSITION": out.accessor((vertices + 9 * k).astype("f4"), bounds=True)}
            primitive = {"attributes": attributes, "indices": index}
            if k in (0, 3):
                attributes["TEXCOORD_0"] = out.accessor(vertices[:, :2].astype("f4"))
            if k == 2:
                attributes["COLOR_0"] = out.accessor(green, normalized=True)
            else:
                primitive["material"] = int(k == 1)
            out.node(out.mesh(primitive))
        return self.file("balls.glb", out.glb()), len(faces)

    def test_primitives_with_and_without_pictures(self):
        """Each shows what it has, and all runs draw the same bits."""
        path, count = self.balls()
        pictures = set()
        for _ in range(3):
            _, colours = self.drawn(path)
            pictures.add((self.folder / "new.png").read_bytes())
            for k, colour in enumerate(((0, 0, 255), RED, GREEN, (0, 0, 255))):
                self.assert_colours(colours[k * count:(k + 1) * count], colour)
        self.assertEqual(len(pictures), 1)

    def test_materials_without_a_picture(self):
        """In one OBJ with others that have one, whether or not their faces have coordinates."""
        vertices, faces = arrays(meshes.torus(12, 8))
        self.file("wood.png", one_colour(10, 200, 30))
        self.file("m.mtl", b"newmtl red\nKd 0.8 0.1 0.1\nnewmtl blue\nKd 0.1 0.1 0.8\n"
                           b"newmtl wood\nKd 1 1 1\nmap_Kd wood.png\n")
        count = len(vertices)
        for before in ((0, 0, 0), (None, None, 2 * count)):
            content = b"mtllib m.mtl\n"
            for k, name in enumerate((b"red", b"blue", b"wood")):
                content += b"usemtl " + name + b"\n" + obj(vertices + 9 * k, faces + k * count, before[k])
            _, colours = self.drawn(self.file("in.obj", content))
            for k, colour in enumerate(((204, 26, 26), (26, 26, 204), (10, 200, 30))):
                self.assert_colours(colours[k * len(faces):(k + 1) * len(faces)], colour)

    def test_the_picture_beside_the_mesh(self):
        """Not that of the same name in the working folder."""
        vertices, faces = arrays(meshes.torus(12, 8))
        for folder, colour in (("A", (255, 0, 0)), ("B", (0, 0, 255))):
            self.file(f"{folder}/texture.png", one_colour(*colour))
            self.file(f"{folder}/q.mtl", b"newmtl q\nmap_Kd texture.png\n")
            self.file(f"{folder}/scan.obj", b"mtllib q.mtl\nusemtl q\n" + obj(vertices, faces, 0))
        code, said = self.by_command("../B/scan.obj", "../B/out.obj", "--carry-texture", "new.png",
                                     folder=self.folder / "A")
        self.assertEqual((code, said), (0, ""))
        mesh = files.read(self.folder / "B" / "out.obj")
        u, v = mesh.uv[0].mean(0)
        picture = mesh.pictures[0].read()
        size = len(picture)
        self.assertEqual(picture[int((1 - v) * size), int(u * size)].tolist(), [0, 0, 255, 255])

    def test_old_pictures_are_files(self):
        """A TGA, and a JPEG that is none: runs that do not draw them copy them, one that does names it."""
        vertices, faces = arrays(meshes.torus(12, 8))
        tga = struct.pack("<BBBHHBHHHHBB", 0, 0, 2, 0, 0, 0, 0, 0, 2, 2, 24, 0) + bytes((30, 200, 10)) * 4
        for name, content in (("t.tga", tga), ("a j.jpg", b"\xff\xd8 no picture")):
            folder = os.path.splitext(name)[0]
            materials = b"newmtl q\nmap_Kd " + name.encode() + b"\n"
            self.file(f"{folder}/q.mtl", materials)
            self.file(f"{folder}/{name}", content)
            path = self.file(f"{folder}/in.obj", b"mtllib q.mtl\nusemtl q\n" + obj(vertices, faces, 0))
            code, said = self.by_command(path, self.folder / "out" / folder / "out.obj")
            self.assertEqual(code, 0, said)
            self.assertEqual((self.folder / "out" / folder / name).read_bytes(), content)
            self.assertEqual((self.folder / "out" / folder / "q.mtl").read_bytes(), materials)
            self.assertTrue((files.read(self.folder / "out" / folder / "out.obj").uv_picture == 0).all())
        code, said = self.by_command(path, self.folder / "out.obj", "--carry-texture",
                                     self.folder / "new.png")
        self.assertEqual((code, (self.folder / "out.obj").exists()), (1, False))
        self.assertIn("the picture a j.jpg", said)
        try:
            import PIL.Image  # noqa: F401
        except ImportError:
            self.skipTest("SKIPPED: Pillow, which reads TGA, is not installed")
        self.assert_colours(self.drawn(self.folder / "t" / "in.obj")[1], (10, 200, 30))

    def test_objects_of_trimesh(self):
        """Their colours, or their picture. Where there is nothing to draw it is refused."""
        vertices, faces = arrays(meshes.torus(12, 8))
        with self.assertRaisesRegex(ricciflow.Refused, "neither a texture nor colours"):
            self.drawn((vertices, faces))
        try:
            import PIL.Image
            import trimesh
        except ImportError as problem:
            self.skipTest(f"SKIPPED: trimesh or Pillow cannot be imported: {problem}")
        mesh = trimesh.Trimesh(vertices, faces, process=False)
        with self.assertRaisesRegex(ricciflow.Refused, "neither a texture nor colours"):
            self.drawn(mesh)
        mesh.visual.vertex_colors = (200, 30, 30, 255)
        self.assert_colours(self.drawn(mesh)[1], (200, 30, 30))
        by_face = np.tile(np.array([(200, 30, 30, 255), (30, 200, 30, 255)], "u1"), (len(faces) // 2, 1))
        mesh.visual = trimesh.visual.ColorVisuals(mesh, face_colors=by_face)
        self.assert_colours(self.drawn(mesh)[1], by_face[:, None, :3])
        image = PIL.Image.new("RGB", (8, 8), (10, 200, 30))
        for material in (trimesh.visual.material.SimpleMaterial(image=image),
                         trimesh.visual.material.PBRMaterial(baseColorTexture=image)):
            mesh.visual = trimesh.visual.TextureVisuals(uv=vertices[:, :2], material=material)
            self.assert_colours(self.drawn(mesh)[1], (10, 200, 30))


class Islands(Runs):
    def test_a_valid_map_is_not_cut_further(self):
        for mesh in (meshes.torus(), meshes.double_torus(), meshes.swirled(meshes.sphere())):
            first = flatten(*arrays(mesh))
            first.save(self.folder / "once.obj")
            second = flatten(self.folder / "once.obj", seams="Existing texture seams")
            self.assertEqual(second.charts, first.charts)
            self.assertLess(second.objective, first.objective + 0.01)

    def test_pack_only(self):
        """Every island keeps its shape, up to the one factor of all."""
        vertices, faces = arrays(meshes.double_torus())
        first = flatten(vertices, faces, cone_count=9)
        old = first.uv * [3, 3] + [[[5, 0]]]
        second = flatten(vertices, faces, uv=old, charts="As they are, only packed")
        self.assertEqual((second.charts, second.flipped_faces), (first.charts, 0))

        def lengths(uv):
            return np.linalg.norm(uv - np.roll(uv, -1, 1), axis=2)
        factors = lengths(second.uv) / lengths(old)
        self.assertLess(np.abs(factors / np.median(factors) - 1).max(), 1e-3)


if __name__ == "__main__":
    common.main()
