# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run says of itself, in results, report and refusals, in PyMeshLab. Usage: test_told.py BUILD_DIR
[TEST...], with PyMeshLab's Python."""

import html
import math
import os
import re
import time

import common
import meshes
import textures
from pymeshlab_host import numpy, pymeshlab, load, mesh_set, run


class Told(textures.TexturedTorus):
    def told(self, documents, our_filter=common, **values):
        """Results, and the sentences of the report's page."""
        returned = run(documents, our_filter, report=self.path("page.html"), **values)
        with open(self.path("page.html"), encoding="utf-8") as source:
            return returned, html.unescape("\n".join(re.findall("<p>(.*?)</p>", source.read())))


class WhatWasChosen(Told):
    def test_automatic(self):
        for mesh, used, words in (
                (meshes.torus(small=0.1), 1, "no cones"), (meshes.plane(), 7, "no cones"),
                (meshes.sphere(), 6, "cones, because a closed surface"),
                (meshes.plate(12, 0.1), 9, "cut along creases and unfolded")):
            with self.subTest(words):
                returned, page = self.told(mesh_set(mesh))
                self.assertEqual(returned["target_used"], used)
                self.assertIn(f"Automatic chose {words}", page)
                self.assertTrue(page.split("\n")[2].startswith(f"{returned['charts']} chart"), page)
                self.assertIn(f", with {returned['cones'] or 'no'} cone", page)
                self.assertIn("the mean area distortion", page)

    def test_the_target_that_was_asked_for(self):
        returned, page = self.told(mesh_set(meshes.hill()), target_curvature="Disk")
        self.assertEqual(returned["target_used"], 2)
        self.assertNotIn("Automatic chose", page)

    def test_components_that_differ(self):
        one, two = meshes.plane(), meshes.sphere()
        both = meshes.Mesh(one.vertices + [(x + 5, y, z) for x, y, z in two.vertices],
                           one.faces + [tuple(v + len(one.vertices) for v in f) for f in two.faces])
        self.assertEqual(run(mesh_set(both))["target_used"], 0)

    def test_placed_cones(self):
        documents = mesh_set(meshes.sphere())
        returned = run(documents, target_curvature="Placed cones", cone_distortion=0.3)
        curvature = documents.current_mesh().vertex_custom_scalar_attribute_array(
            "ricci_target_curvature")
        vertices = [int(v) for v in returned["cone_vertices"]]
        self.assertEqual(len(vertices), returned["cones"])
        self.assertEqual(sorted(vertices), list(numpy.flatnonzero(curvature)))
        self.assertTrue(numpy.allclose(returned["cone_curvatures"], curvature[vertices], atol=1e-12))
        self.assertAlmostEqual(sum(returned["cone_curvatures"]), 4 * math.pi, delta=1e-9)
        self.assertLessEqual(returned["expected_spread"], 0.3 * 1.1)

    def test_free_boundary_is_named_in_the_report(self):
        self.assertIn("Free boundary", self.told(mesh_set(meshes.plane()))[1])


class FreeBoundary(Told):
    """By how much the boundary's edges are longer in the map, at its own scale, than on the mesh."""

    def ratios(self, documents):
        current = documents.current_mesh()
        faces = current.face_matrix()
        wedges = current.wedge_tex_coord_matrix().reshape(-1, 3, 2)
        sides = {}
        for face, wedge in zip(faces, wedges):
            for k in range(3):
                side = frozenset((face[k], face[(k + 1) % 3]))
                sides.setdefault(side, []).append(numpy.linalg.norm(wedge[k] - wedge[(k + 1) % 3]))
        places = current.vertex_matrix()
        return [drawn[0] / numpy.linalg.norm(numpy.subtract(*places[list(side)]))
                for side, drawn in sides.items() if len(drawn) == 1]

    def test_kept_without_a_finish(self):
        documents = mesh_set(meshes.hill())
        returned = run(documents, finish="None", normalize_uv=False, padding=0)
        # Both ends of an edge of a fourteenth are floats, half a step of 2^-23 below 2 off in each coordinate.
        self.assertLess(numpy.abs(documents.current_mesh().wedge_tex_coord_matrix()).max(), 2.0)
        rounding = 14 * math.sqrt(2) * 2.0 ** -23
        for key, extreme in (("boundary_ratio_min", min), ("boundary_ratio_max", max)):
            self.assertAlmostEqual(returned[key], 1.0, delta=rounding)
            self.assertAlmostEqual(extreme(self.ratios(documents)), 1.0, delta=rounding)

    def test_told_after_the_finish(self):
        documents = mesh_set(meshes.hill(8))
        returned, page = self.told(documents, normalize_uv=False)
        own = self.ratios(documents)
        self.assertAlmostEqual(returned["boundary_ratio_min"], min(own), delta=1e-5)
        self.assertAlmostEqual(returned["boundary_ratio_max"], max(own), delta=1e-5)
        self.assertGreater(returned["boundary_ratio_max"], 1.001)
        self.assertNotIn("the boundary keeps its metric", page)

    def test_not_where_it_is_prescribed(self):
        self.assertNotIn("boundary_ratio_min",
                         run(mesh_set(meshes.hill()), target_curvature="Disk"))


class Steps(Told):
    def test_every_newton_step_counts(self):
        """The report's table has one row more than there are steps, for each solve."""
        for our_filter, mesh in ((common, meshes.torus()), (common.HYPERBOLIC, meshes.double_torus())):
            returned, _ = self.told(mesh_set(mesh), our_filter, epsilon=0.1)
            with open(self.path("page.csv"), encoding="utf-8") as source:
                rows = [line.split(",") for line in source if line.startswith("newton,")]
            steps = [int(row[2]) for row in rows]
            self.assertEqual(max(steps), returned["iterations"])
            changes = sum(a[3] != b[3] for a, b in zip(rows, rows[1:]))
            self.assertGreaterEqual(returned["iterations"], changes)
            self.assertGreater(changes, 0)


class Doubts(Told):
    def doubtful(self, mesh, **values):
        return re.findall("This map is probably not usable: .*", self.told(mesh_set(mesh), **values)[1])

    def test_none_for_a_good_map(self):
        self.assertEqual(self.doubtful(meshes.hill()), [])

    def test_areas(self):
        ball = meshes.sphere(24, 24)
        faces = [face for face in ball.faces if 0 not in face]  # a disk, nearly the whole sphere
        lines = self.doubtful(meshes.Mesh(ball.vertices, faces), target_curvature="Disk",
                              holes="Boundaries")
        self.assertEqual(len([line for line in lines if "areas change" in line]), 1)
        self.assertIn("'Automatic'", lines[0])

    def test_overlap(self):
        """A long spiral in a rectangle: floats cannot keep its ends apart, and a rectangle is not cut."""
        spiral = meshes.grid(100, 3, lambda s, t: (
            math.cos(40 * s) * (1 + s), math.sin(40 * s) * (1 + s), 3 * t + 8 * s))
        returned, page = self.told(mesh_set(spiral), target_curvature="Rectangle")
        self.assertGreater(returned["overlapping_faces"], 0)
        self.assertIn(f"usable: {returned['overlapping_faces']} faces overlap", page)
        self.assertFalse([line for line in self.doubtful(spiral) if "faces overlap" in line])

    def test_room(self):
        long = meshes.grid(200, 1, lambda s, t: (s, t / 200, 0.0))
        lines = self.doubtful(long, target_curvature="Rectangle")
        self.assertTrue(any("of the square" in line for line in lines), lines)

    def test_angles(self):
        needles = meshes.swirled(meshes.hill(), 6 * math.pi, 0.3)
        lines = self.doubtful(needles, method="Thurston", finish="None")
        self.assertTrue(any("angles" in line and "Intrinsic flips" in line for line in lines), lines)


class Layer(Told):
    """The matrix of the layer, which the host applies where it draws."""

    def test_stretched_layer_is_flattened_as_it_is_seen(self):
        frozen, seen = mesh_set(meshes.hill()), mesh_set(meshes.hill())
        for documents, freeze in ((frozen, True), (seen, False)):
            documents.compute_matrix_from_translation_rotation_scale(
                scalex=3.0, rotationz=30.0, translationy=7.0, freeze=freeze)
        wanted = run(frozen, target_curvature="Disk")
        returned, page = self.told(seen, target_curvature="Disk")
        for key in ("qc_mean", "area_distortion_mean"):
            self.assertAlmostEqual(returned[key], wanted[key], delta=1e-5 * wanted[key])
        self.assertIn("matrix of the layer", page)

    def test_turned_layer_is_the_same(self):
        # Without symmetry, whose equal places for a cone rounding would choose from.
        mesh = meshes.grid(14, 14, lambda s, t: (
            s, 1.2 * t, 0.3 * math.sin(math.pi * s ** 1.3) * math.sin(math.pi * t ** 0.7)))
        plain, turned = mesh_set(mesh), mesh_set(mesh)
        turned.compute_matrix_from_translation_rotation_scale(rotationx=40.0, freeze=False)
        returned, page = self.told(turned)
        self.assertAlmostEqual(returned["qc_mean"], run(plain)["qc_mean"], delta=1e-6)
        self.assertNotIn("matrix of the layer", page)


class Curvature(Told):
    def refused(self, words, documents, **values):
        with self.assertRaisesRegex(pymeshlab.PyMeshLabException, f"(?s){words}"):
            run(documents, target_curvature="From vertex quality", **values)

    def test_own_distortion_is_no_curvature(self):
        documents = mesh_set(meshes.hill())
        run(documents)
        self.refused("is the distortion that this filter has written", documents)

    def test_own_target_is(self):
        documents = mesh_set(meshes.hill())
        wanted = run(documents, finish="None")["qc_mean"]  # a finish ends at some step
        documents.compute_scalar_by_function_per_vertex(q="ricci_target_curvature")
        self.assertAlmostEqual(
            run(documents, finish="None", target_curvature="From vertex quality")["qc_mean"], wanted, delta=1e-7)

    def test_too_much_for_a_free_boundary_is_told_at_once(self):
        mesh = meshes.hill(100)
        start = time.process_time()
        self.refused("times as large as others", mesh_set(meshes.with_quality(
            mesh, [1.0] * len(mesh.vertices))))
        self.assertLess(time.process_time() - start, 2.0)


class Textured(Told):
    def written(self, wedges):
        textures.write_png(self.path("old.png"), textures.painted(self.mesh, self.wedges, 64))
        textures.write_ply(self.path("in.ply"), self.mesh, wedges, ["old.png"])
        return load(self.path("in.ply"))

    def test_noise_of_floats_is_no_seam(self):
        random = numpy.random.default_rng(1)
        self.mesh = meshes.hill()
        drawn = [[self.mesh.vertices[v][:2] for v in face] for face in self.mesh.faces]
        halves = [[(u + 1, v) for u, v in wedge] if sum(u for u, _ in wedge) > 1.5 else wedge
                  for wedge in drawn]
        self.wedges = drawn
        for wedges, components in ((drawn, 1), (halves, 2)):
            noisy = (numpy.array(wedges) + 1e-7 * random.random((len(wedges), 3, 2))).tolist()
            counts = [run(self.written(w), seams="Existing texture seams")["components"]
                      for w in (wedges, noisy)]
            self.assertEqual(counts, [components, components])

    def test_shattered_seams_are_told(self):
        apart = [[(u + 0.01 * (i % 2), v) for u, v in wedge] for i, wedge in enumerate(self.wedges)]
        documents = self.written(apart)
        self.assertIn("many charts are single faces", self.told(documents, seams="Existing texture seams")[1])

    def test_the_old_image_no_longer_fits(self):
        documents = self.written(self.wedges)
        self.assertIn("no longer fits", self.told(documents)[1])
        documents = self.written(self.wedges)
        self.assertNotIn("no longer fits", self.told(documents, carry_texture="new.png")[1])

    def test_as_fine_as_the_old_one(self):
        documents = self.written(self.wedges)
        returned = run(documents, carry_texture="new.png", texture_size=0)
        self.assertGreater(returned["texture_scale"], 0.999)
        self.assertLess(returned["texture_scale"], 1.1)

    def test_coarser_ones_are_told(self):
        documents = self.written(self.wedges)
        returned, page = self.told(documents, carry_texture="new.png", texture_size=32)
        self.assertLess(returned["texture_scale"], 0.9)
        self.assertIn("texture_size 0 keeps", page)

    def saved_materials(self, material, **values):
        """Colours and textures of the materials, red and blue before, after the run."""
        with open(self.path("in.mtl"), "w", encoding="utf-8") as out:
            out.write(f"newmtl red\nKd 1 0 0\n{material}newmtl blue\nKd 0 0 1\n{material}")
        with open(self.path("in.obj"), "w", encoding="utf-8") as out:
            out.write("mtllib in.mtl\n")
            for vertex in self.mesh.vertices:
                out.write("v %r %r %r\n" % tuple(vertex))
            for wedge in self.wedges:
                for uv in wedge:
                    out.write("vt %r %r\n" % tuple(uv))
            for i, face in enumerate(self.mesh.faces):
                out.write({0: "usemtl red\n", 5: "usemtl blue\n"}.get(i, ""))
                out.write("f " + " ".join(f"{v + 1}/{3 * i + k + 1}" for k, v in enumerate(face)) + "\n")
        documents = load(self.path("in.obj"))
        run(documents, carry_texture="new.png", texture_size=64, **values)
        os.makedirs(self.path("out"), exist_ok=True)
        documents.save_current_mesh(self.path("out/out.obj"), save_polygonal=False)
        with open(self.path("out/out.obj.mtl"), encoding="utf-8") as source:
            text = source.read()
        return [sorted(set(re.findall(rf"(?m)^\s*{key}\s+(.*?)\s*$", text))) for key in ("Kd", "map_Kd")]

    def test_tints_of_materials_are_kept(self):
        """Programs multiply the texture by the diffuse colour Kd. MeshLab has it as the colour of the face."""
        textures.write_png(self.path("old.png"), textures.Image([[(200, 200, 200)] * 8] * 8, 8))
        for output in common.CHOICES["output_triangulation"]:
            colours, names = self.saved_materials("map_Kd old.png\n", output_triangulation=output)
            self.assertEqual([tuple(map(float, colour.split())) for colour in colours], [(0, 0, 1), (1, 0, 0)])
            self.assertEqual(names, ["new.png"])
            rows = textures.read_png(self.path("new.png")).rows
            self.assertEqual({tuple(texel[:3]) for row in rows for texel in row}, {(200, 200, 200)})

    def test_colours_that_the_texture_shows_are_no_tints(self):
        colours, names = self.saved_materials("")
        self.assertEqual([tuple(map(float, colour.split())) for colour in colours], [(1, 1, 1)])
        self.assertEqual(names, ["new.png"])


class Input(Told):
    def test_polygon_soup(self):
        torus = meshes.torus()
        vertices = [torus.vertices[v] for face in torus.faces for v in face]
        soup = meshes.Mesh(vertices, [(3 * i, 3 * i + 1, 3 * i + 2) for i in range(len(torus.faces))])
        results, log = self.told(mesh_set(soup))
        self.assertEqual((results["components"], results["genus"]), (1, 1))
        self.assertIn("did not share vertices were joined", log)
        self.assertNotIn("joined", self.told(mesh_set(torus))[1])

    def test_pieces_that_could_be_joined(self):
        """Faces of a torus in rings that share no vertices: most sides are shared, and the cuts may be meant."""
        torus = meshes.torus()
        half = len(torus.faces) // 2
        count = len(torus.vertices)
        faces = [tuple(v + count * (i >= half) for v in face) for i, face in enumerate(torus.faces)]
        torn = meshes.Mesh(list(torus.vertices) * 2, faces)
        log = self.told(mesh_set(torn))[1]
        self.assertIn("1 piece touches others along edges without sharing vertices and could be joined", log)
        self.assertIn("'Always' joins pieces", log)

    def test_sphere_layer_of_thin_shells(self):
        for thickness in (0.1, 0.01, 0.001):
            coarse, fine = (run(mesh_set(meshes.plate(size, thickness)), layers="Sphere")
                            for size in (24, 48))
            self.assertEqual(fine["sphere_flipped_faces"], 0)
            # The map of straight triangles converges to a conformal one.
            self.assertLess(fine["sphere_qc_area_mean"] - 1,
                            0.75 * (coarse["sphere_qc_area_mean"] - 1))


if __name__ == "__main__":
    common.main()
