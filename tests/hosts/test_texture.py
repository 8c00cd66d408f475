# SPDX-License-Identifier: GPL-3.0-or-later
"""The parameter carry_texture in PyMeshLab. Usage: test_texture.py BUILD_DIR [TEST...]."""

import os
import resource
import unittest

import common
import meshes
import textures
from pymeshlab_host import BY_ARRAYS, numpy, pymeshlab, load, mesh_set, run


class Texture(textures.TexturedTorus):
    """What the mesh shows stays what it shows."""

    def textured(self, depth=8, alpha=None):
        textures.write_png(self.path("old.png"),
                           textures.painted(self.mesh, self.wedges, self.OLD, depth, alpha))
        textures.write_ply(self.path("in.ply"), self.mesh, self.wedges, ["old.png"])
        return load(self.path("in.ply"))

    def carry(self, documents, our_filter=common, **values):
        values = {"carry_texture": "new.png", "texture_size": self.NEW, **values}
        return run(documents, our_filter, **values)

    def check(self, documents, image, bound=None):
        """The image shows the function at the mesh's present coordinates."""
        current = documents.current_mesh()
        mesh = meshes.Mesh(current.vertex_matrix().tolist(), current.face_matrix().tolist())
        wedges = current.wedge_tex_coord_matrix().reshape(-1, 3, 2).tolist()
        worst, count = textures.largest_difference(mesh, wedges, image)
        self.assertLess(worst, bound or self.BOUND + 1 / image.top)
        self.assertGreater(count, 0.2 * image.width * image.height)

    def test_shattered_atlas(self):
        documents = self.textured()
        with open(self.path("old.png"), "rb") as source:
            old = source.read()
        returned = self.carry(documents)
        image = textures.read_png(self.path("new.png"))
        self.assertEqual((image.width, image.height, image.depth, image.channels),
                         (self.NEW, self.NEW, 8, 3))
        self.check(documents, image)
        self.assertEqual(list(documents.current_mesh().textures()), ["new.png"])
        self.assertGreater(returned["texture_scale"], 0.3)
        self.assertLess(returned["texture_scale"], 2.0)
        with open(self.path("old.png"), "rb") as source:
            self.assertEqual(source.read(), old)
        self.assertEqual(sorted(os.listdir(self.folder)), ["in.ply", "new.png", "old.png"])

    def test_charts_keep_the_gutter_apart(self):
        documents = self.textured()
        self.carry(documents, texture_size=512)
        wedges = documents.current_mesh().wedge_tex_coord_matrix()
        self.assertGreater(wedges.min(), 24 / 512 - 1e-6)
        self.assertLess(wedges.max(), 1 - 24 / 512 + 1e-6)

    def test_saved_files_name_it(self):
        documents = self.textured()
        self.carry(documents)
        out = self.path("out")
        os.mkdir(out)
        documents.save_current_mesh(os.path.join(out, "mesh.ply"))
        documents.save_current_mesh(os.path.join(out, "mesh.obj"))
        for name in ("mesh.ply", "mesh.obj"):
            again = load(os.path.join(out, name))
            self.assertEqual(list(again.current_mesh().textures()), ["new.png"])
            self.check(again, textures.read_png(os.path.join(out, "new.png")))

    def test_in_a_folder_below_the_mesh(self):
        """Saved elsewhere, the image lies beside the mesh."""
        documents = self.textured()
        os.mkdir(self.path("below"))
        self.carry(documents, carry_texture="below/new.png")
        self.assertEqual(list(documents.current_mesh().textures()), ["new.png"])
        out = self.path("out")
        os.mkdir(out)
        documents.save_current_mesh(os.path.join(out, "mesh.ply"))
        self.assertEqual(sorted(os.listdir(out)), ["mesh.ply", "new.png"])
        self.assertEqual(sorted(os.listdir(self.folder)), ["below", "in.ply", "old.png", "out"])
        self.check(load(os.path.join(out, "mesh.ply")),
                   textures.read_png(self.path("below", "new.png")))

    def test_sixteen_bits_and_alpha(self):
        documents = self.textured(depth=16, alpha=0.25)
        self.carry(documents)
        image = textures.read_png(self.path("new.png"))
        self.assertEqual((image.depth, image.channels), (16, 4))
        self.check(documents, image)
        self.assertEqual({texel[3] for row in image.rows for texel in row}, {round(0.25 * 65535)})

    def test_common_refinement(self):
        documents = self.textured()
        self.carry(documents, output_triangulation="Common refinement")
        self.assertGreater(documents.current_mesh().face_number(), len(self.mesh.faces))
        self.check(documents, textures.read_png(self.path("new.png")))

    def test_two_textures_become_one(self):
        count = len(self.mesh.faces)
        for name, faces in (("one.png", range(0, count, 2)), ("two.png", range(1, count, 2))):
            textures.write_png(self.path(name), textures.painted(
                self.mesh, self.wedges, self.OLD, faces=faces))
        textures.write_ply(self.path("in.ply"), self.mesh, self.wedges, ["one.png", "two.png"],
                           [i % 2 for i in range(count)])
        documents = load(self.path("in.ply"))
        self.assertEqual(len(documents.current_mesh().textures()), 2)
        self.carry(documents, layers="Flat mesh")
        self.check(documents, textures.read_png(self.path("new.png")))
        for i in range(2):
            self.assertEqual(list(documents.mesh(i).textures()), ["new.png"])

    def test_colours_of_vertices(self):
        colours = [tuple(round(255 * c) for c in textures.colour(p)) + (255,)
                   for p in self.mesh.vertices]
        textures.write_ply(self.path("in.ply"), self.mesh, colours=colours)
        documents = load(self.path("in.ply"))
        returned = self.carry(documents)
        self.assertNotIn("texture_scale", returned)
        # Linear on edges of at most 0.6: second derivatives are at most twice 0.4.
        self.check(documents, textures.read_png(self.path("new.png")), 0.8 * 0.6 ** 2 / 4 + 1 / 255)

    @unittest.skipIf(BY_ARRAYS, "PyMeshLab gives no program the means to remove them")
    def test_coordinates_of_vertices(self):
        """They show the old texture, and would show the new one wrong."""
        self.mesh = meshes.hill()
        places = [(x, y) for x, y, _ in self.mesh.vertices]
        self.wedges = [[places[v] for v in face] for face in self.mesh.faces]
        textures.write_png(self.path("old.png"), textures.painted(self.mesh, self.wedges, self.OLD))
        textures.write_ply(self.path("in.ply"), self.mesh, names=["old.png"], coordinates=places)
        documents = load(self.path("in.ply"))
        self.carry(documents)
        # The old picture is as wide as the mesh; two texels of it are mixed.
        self.check(documents, textures.read_png(self.path("new.png")),
                   2 / self.OLD * 2 * textures.GRADIENT + 1 / 255)
        self.assertFalse(documents.current_mesh().has_vertex_tex_coord())

    def test_mesh_without_a_file(self):
        documents = self.textured()
        documents.generate_copy_of_current_mesh()
        self.carry(documents, carry_texture=self.path("new.png"))
        self.check(documents, textures.read_png(self.path("new.png")))
        self.assertEqual(list(documents.current_mesh().textures()), ["new.png"])

    def test_hyperbolic(self):
        self.mesh = meshes.double_torus()
        self.wedges = textures.shattered(self.mesh.faces)
        documents = self.textured()
        returned = self.carry(documents, common.HYPERBOLIC)
        self.assertIn("texture_scale", returned)
        # The edges are of length 1 and root 2, in cells of the same width.
        self.BOUND *= 1.5 / 0.6
        self.check(documents, textures.read_png(self.path("new.png")))

    def test_texture_scale(self):
        """Twice the texels per unit of length, from the same map."""
        first = self.carry(self.textured(), texture_size=512)["texture_scale"]
        second = self.carry(self.textured(), texture_size=1024, padding=48)
        self.assertAlmostEqual(second["texture_scale"] / first, 2.0, delta=1e-3)

    def refused(self, words, documents, our_filter=common, **values):
        mesh = documents.current_mesh()
        before = sorted(os.listdir(self.folder)), list(mesh.textures())
        wedges = mesh.has_wedge_tex_coord() and mesh.wedge_tex_coord_matrix()
        with self.assertRaisesRegex(pymeshlab.PyMeshLabException, f"(?is){words}.*\\.$"):
            self.carry(documents, our_filter, **values)
        mesh = documents.current_mesh()
        self.assertEqual((sorted(os.listdir(self.folder)), list(mesh.textures())), before)
        self.assertTrue(numpy.array_equal(
            wedges, mesh.has_wedge_tex_coord() and mesh.wedge_tex_coord_matrix()))

    @unittest.skipIf(BY_ARRAYS, "PyMeshLab tells no program where its pictures lie")
    def test_refusals(self):
        documents = self.textured()
        os.mkdir(self.path("folder.png"))
        os.symlink("old.png", self.path("link.png"))
        for words, values in (
                (r"must end in \.png", {"carry_texture": "new.jpg"}),
                (r"must end in \.png", {"carry_texture": "png"}),
                ("it is a folder", {"carry_texture": "folder.png"}),
                ("cannot be written", {"carry_texture": "nowhere/new.png"}),
                ("cannot hold spaces", {"carry_texture": "my new.png"}),
                ("spaces, } or ~", {"carry_texture": "new~1.png"}),
                ("name of a texture of the mesh", {"carry_texture": "old.png"}),
                ("name of a texture of the mesh", {"carry_texture": "OLD.png"}),
                ("name of a texture of the mesh", {"carry_texture": "folder.png/old.png"}),
                ("name of a texture of the mesh", {"carry_texture": "link.png"}),
                ("texture_size.*16 to 16384", {"texture_size": 15}),
                ("texture_size.*16 to 16384", {"texture_size": 16385}),
                ("choose normalize_uv", {"normalize_uv": False})):
            with self.subTest(words=words, values=values):
                self.refused(words, documents, **values)

    @unittest.skipIf(BY_ARRAYS, "PyMeshLab gives another picture in place of one that it cannot load")
    def test_nothing_to_draw(self):
        textures.write_ply(self.path("in.ply"), self.mesh)
        self.refused("neither a texture nor colours", load(self.path("in.ply")))
        textures.write_ply(self.path("in.ply"), self.mesh, self.wedges, ["missing.png"])
        self.refused("cannot be loaded", load(self.path("in.ply")))
        textures.write_png(self.path("old.png"),
                           textures.painted(self.mesh, self.wedges, self.OLD))
        textures.write_ply(self.path("in.ply"), self.mesh, self.wedges, ["old.png"],
                           [-1] * len(self.mesh.faces))
        self.refused("no face of the mesh has one", load(self.path("in.ply")))

    def test_refused_runs_leave_no_file(self):
        self.refused("time_limit", self.textured(), time_limit=1e-6)
        self.mesh = meshes.double_torus()
        self.wedges = textures.shattered(self.mesh.faces)
        self.refused("universal_cover: 20 rings", self.textured(), common.HYPERBOLIC,
                     universal_cover=20, report="page.html")

    @unittest.skipIf(BY_ARRAYS, "PyMeshLab gives pictures to files only, which have no room either")
    def test_no_room_for_the_file(self):
        documents = self.textured()
        before = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (10000, before[1]))
        self.addCleanup(resource.setrlimit, resource.RLIMIT_FSIZE, before)
        self.refused(r"could not be written \(file too large\)", documents)

    def test_charts_without_room(self):
        documents = self.textured()
        self.refused("raise texture_size, to 16384 at most", documents,
                     seams="Existing texture seams", texture_size=16)


if __name__ == "__main__":
    common.main()
