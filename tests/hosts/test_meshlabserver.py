# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin in stock meshlabserver 2020.09. Usage: test_meshlabserver.py BUILD_DIR [TEST...]"""

import glob
import math
import os
import re
import struct
import tempfile
import unittest

import common
import meshes
import meshlabserver as server
import textures


def run_on(mesh, before="", **values):
    return server.Run(server.script(before, **values), lambda path: meshes.write_ply(path, mesh))


class Results(unittest.TestCase):
    """Meshes that the filter solves."""

    def check(self, mesh, before="", faces_may_be_flipped=False, **values):
        run = run_on(mesh, before, **values)
        self.assertEqual(run.code, 0, run.text)
        pairs = server.results(run.text)
        self.assertLessEqual(set(common.ALWAYS), set(pairs), run.text)
        self.assertLessEqual(set(pairs), {*common.ALWAYS, *common.INVARIANTS, *common.CHOSEN,
                                          *common.FREE_BOUNDARY})
        self.assertEqual(pairs["converged"], "true", run.text)
        self.assertLess(float(pairs["max_curvature_error"]), 1e-8)
        self.assertTrue(run.saved)
        self.check_geometry(run.mesh, pairs, **values)
        return pairs, run

    def check_geometry(self, mesh, pairs, normalize_uv=True, **_):
        self.assertIsNotNone(mesh.wedges)
        corners = [uv for wedge in mesh.wedges for uv in wedge]
        self.assertTrue(all(math.isfinite(c) for uv in corners for c in uv))
        if normalize_uv:
            self.assertTrue(all(-1e-6 <= c <= 1 + 1e-6 for uv in corners for c in uv))
            self.assertAlmostEqual(max(c for uv in corners for c in uv), 1 - 2 / 2048, delta=1e-6)  # the padding
        areas = [meshes.uv_area(wedge) for wedge in mesh.wedges]
        self.assertEqual(sum(area <= 0 for area in areas), int(pairs["flipped_faces"]))
        own = [meshes.distortion([mesh.vertices[v] for v in face], wedge)
               for face, wedge in zip(mesh.faces, mesh.wedges)]
        self.assertAlmostEqual(sum(own) / len(own), float(pairs["qc_mean"]), delta=1e-3)
        self.assertAlmostEqual(max(own), float(pairs["qc_max"]), delta=1e-2)
        self.assertAlmostEqual(sum(mesh.quality) / len(mesh.quality),
                               float(pairs["qc_vertex_mean"]), delta=1e-4)

    def test_torus_automatic(self):
        pairs, run = self.check(meshes.torus(), cone_distortion=1.0)
        self.assertEqual((pairs["genus"], pairs["euler_characteristic"]), ("1", "0"))
        self.assertIn("torus_tau_im", pairs)
        self.assertGreater(int(pairs["seam_edges"]), 0)
        self.assertEqual(int(pairs["flipped_faces"]), 0, run.text)

    def test_torus_flat_thurston(self):
        inversive, _ = self.check(meshes.torus(), target_curvature=1)
        thurston, _ = self.check(meshes.torus(), target_curvature=1, method=3)
        self.assertGreaterEqual(float(thurston["qc_mean"]), float(inversive["qc_mean"]) - 1e-9)

    def test_annulus_flat(self):
        pairs, _ = self.check(meshes.annulus(), target_curvature=1)
        self.assertEqual(pairs["boundary_loops"], "2")
        self.assertIn("annulus_modulus", pairs)

    def test_disk_automatic(self):
        pairs, _ = self.check(meshes.hill(), cone_distortion=1.0)
        self.assertEqual((pairs["euler_characteristic"], pairs["seam_edges"]), ("1", "0"))

    def test_disk_is_round(self):
        _, run = self.check(meshes.hill(), target_curvature=2)
        boundary = boundary_uvs(run.mesh)
        radii = [math.hypot(u - 0.5, v - 0.5) for u, v in boundary]
        self.assertLess(max(radii) - min(radii), 1e-5)

    def test_rectangle(self):
        pairs, run = self.check(meshes.hill(), target_curvature=3)
        self.assertGreaterEqual(float(pairs["rectangle_aspect"]), 1.0)
        self.check_corners(run.mesh)

    def test_rectangle_with_selected_corners(self):
        corners = "(x==0 || x==1) && (y==0 || y==1)"
        pairs, run = self.check(meshes.hill(), server.selection(corners), target_curvature=3)
        self.assertAlmostEqual(float(pairs["rectangle_aspect"]), 1.0, delta=0.05)
        self.check_corners(run.mesh)

    def check_corners(self, mesh):
        boundary = boundary_uvs(mesh)
        self.assertGreater(len(boundary), 8)
        us, vs = [u for u, _ in boundary], [v for _, v in boundary]
        # The chart may stand in any direction, so measure the area of the hull of its boundary
        # only where it is parallel to the axes.
        area = sum(abs(meshes.uv_area(wedge)) for wedge in mesh.wedges)
        self.assertLessEqual(area, (max(us) - min(us)) * (max(vs) - min(vs)) + 1e-5)

    def test_cones(self):
        pairs, _ = self.check(meshes.sphere(), server.selection("abs(z) > 0.99 || abs(x) > 0.99"),
                              target_curvature=4)
        self.assertEqual((pairs["genus"], pairs["euler_characteristic"]), ("0", "2"))

    def test_from_vertex_quality(self):
        mesh = meshes.torus()
        zeros = meshes.with_quality(mesh, [0.0] * len(mesh.vertices))
        self.check(zeros, target_curvature=5)

    def test_seams_along_creases(self):
        """The slab of 14 plane sides: each is a chart, drawn as it is."""
        creases = (' <filter name="Select Crease Edges">\n'
                   '  <Param type="RichFloat" name="AngleDegNeg" value="-45"/>\n'
                   '  <Param type="RichFloat" name="AngleDegPos" value="45"/>\n'
                   " </filter>\n")
        pairs, _ = self.check(meshes.double_torus(), creases, seams=2)
        self.assertEqual((pairs["components"], pairs["charts"], pairs["cones"]), ("14", "14", "0"))
        self.assertEqual((pairs["seam_edges"], pairs["split_vertices"]), ("0", "0"))
        self.assertAlmostEqual(float(pairs["area_distortion_mean"]), 1, delta=1e-5)
        self.assertAlmostEqual(float(pairs["qc_max"]), 1, delta=1e-4)

    def test_two_components(self):
        one, two = meshes.torus(), meshes.hill()
        shift = len(one.vertices)
        both = meshes.Mesh(one.vertices + [(x + 9, y, z) for x, y, z in two.vertices],
                           one.faces + [tuple(v + shift for v in f) for f in two.faces])
        pairs, _ = self.check(both)
        self.assertEqual(pairs["components"], "2")
        self.assertFalse(set(common.INVARIANTS) & set(pairs))

    def test_finish(self):
        mesh = meshes.swirled(meshes.hill())
        drawn, _ = self.check(mesh, finish=0, cone_distortion=1.0)
        self.assertGreater(int(drawn["flipped_faces"]), 0)
        self.assertEqual(drawn["finish_moved"], "0")
        for values in ({"finish": 1}, {}):
            finished, run = self.check(mesh, cone_distortion=1.0, **values)
            self.assertGreater(int(finished["finish_moved"]), 0)
            self.assertEqual(sum(meshes.uv_area(w) <= 0 for w in run.mesh.wedges), 0)

    def test_own_scale(self):
        self.check(meshes.torus(), normalize_uv=False)

    def test_safe_treatment_is_announced(self):
        for mesh, word in ((meshes.with_flipped_faces(meshes.torus()), "inverted winding"),
                           (meshes.with_unreferenced_vertex(meshes.torus()), "belongs to no face")):
            with self.subTest(word):
                run = run_on(mesh)
                self.assertEqual(run.code, 0, run.text)
                self.assertRegex(run.text, f"(?i){word}")

    def test_texture_coordinates_in_obj(self):
        run = server.Run(server.script(), lambda path: meshes.write_ply(path, meshes.torus()),
                         output="out.obj")
        self.assertEqual(run.code, 0, run.text)
        self.assertRegex(run.saved_text, r"(?m)^vt \d")
        self.assertRegex(run.saved_text, r"(?m)^f \d+/\d+")

    def test_report(self):
        run = run_on(meshes.torus(), report="page.html")
        self.assertEqual(run.code, 0, run.text)
        self.assertEqual(re.findall(r"Report: .*/(.*)$", run.text, re.MULTILINE)[-2:],
                         ["page.html", "page.csv"])

    def test_output_that_cannot_be_written(self):
        """The host's own doing: it says so, and ends with 0."""
        run = server.Run(server.script(), lambda path: meshes.write_ply(path, meshes.torus()),
                         output="nowhere/out.ply")
        self.assertEqual((run.code, run.saved), (0, False), run.text)
        self.assertIn("converged=true", run.text)
        self.assertIn("has NOT been saved", run.text)

    def test_progress_and_layers(self):
        run = run_on(meshes.torus(), colorize=True, layers=1)
        self.assertEqual(run.code, 0, run.text)
        self.assertIn("converged=true", run.text)

    def test_every_line_of_the_log_starts_a_line(self):
        """First what came out, doubts, and where to look, then the details."""
        run = run_on(meshes.torus(), sharp_angle=10.0, report="page.csv")
        self.assertRegex(run.text, r"(?ms)^\d charts? \(UV islands\) fills? .* s\.$\s*^sharp_angle has no effect: "
                         r".*^To see it: .*^Automatic chose .*^Report: .*"
                         r"^Result: converged=true iterations=\d+ .*^Surface: euler_characteristic=0 ")


class AnyTriangles(unittest.TestCase):
    """Meshes that are not oriented manifolds are cut open for the map, and stay as they are."""

    def test_every_face_is_mapped(self):
        for name, mesh, counts, components in meshes.any_triangles():
            with self.subTest(name):
                run = run_on(mesh)
                self.assertEqual(run.code, 0, run.text)
                pairs = server.results(run.text)
                self.assertEqual(pairs["converged"], "true", run.text)
                self.assertEqual((pairs["flipped_faces"], pairs["flipped_by_rounding"]), ("0", "0"))
                self.assertEqual(pairs["components"], str(components))
                for key in meshes.CUTS:
                    if key in counts or key != "split_vertices":  # of a one-sided loop, too
                        self.assertEqual(pairs[key], str(counts.get(key, 0)), key)
                self.assertEqual([tuple(face) for face in run.mesh.faces],
                                 [tuple(face) for face in mesh.faces])
                self.assertEqual([struct.pack("<3f", *p) for p in run.mesh.vertices],
                                 [struct.pack("<3f", *p) for p in mesh.vertices])
                self.assertTrue(all(meshes.uv_area(wedge) > 0 for wedge in run.mesh.wedges))
                self.assertTrue(all(math.isfinite(q) for q in run.mesh.quality))


def boundary_uvs(mesh):
    """The UVs of boundary vertices of the mesh in space."""
    owner = {}
    for face, wedge in zip(mesh.faces, mesh.wedges):
        for k in range(3):
            owner[(face[k], face[(k + 1) % 3])] = wedge[k]
    return [uv for (a, b), uv in owner.items() if (b, a) not in owner]


class BadInput(unittest.TestCase):
    """A clear sentence, exit code 255, nothing saved, and no crash."""

    def check(self, words, mesh, before="", **values):
        run = run_on(mesh, before, **values)
        self.refused(run, words)

    def refused(self, run, words):
        self.assertEqual(run.code, 255, run.text)
        self.assertFalse(run.saved, run.text)
        self.assertRegex(run.text, rf"(?i)(?m)^.*(?:{words}).*\.$")
        self.assertIn("Problem with filter: " + common.NAME, run.text)

    def test_no_mesh(self):
        self.refused(server.Run(server.script()), "no mesh")

    def test_point_cloud(self):
        self.check("point cloud|no faces", meshes.point_cloud())

    def test_empty_mesh(self):
        everything = (' <filter name="Select All">\n'
                      '  <Param type="RichBool" name="allFaces" value="true"/>\n'
                      '  <Param type="RichBool" name="allVerts" value="true"/>\n </filter>\n'
                      ' <filter name="Delete Selected Faces and Vertices"/>\n')
        self.check("mesh is empty", meshes.torus(), everything)

    def test_report_that_cannot_be_written(self):
        for words, name in (("cannot be written .*choose another place", "nowhere/page.html"),
                            ("must end in .html", "page.pdf")):
            with self.subTest(name):
                self.check(words, meshes.torus(), report=name)

    def test_zero_area_face(self):
        self.check("area", meshes.with_zero_area_face(meshes.plane()), method=1)
        self.assertIn("converged=true", run_on(meshes.with_zero_area_face(meshes.plane())).text)

    def test_zero_length_edge(self):
        self.check("length|area", meshes.with_zero_length_edge(meshes.torus()), method=1)
        self.assertIn("converged=true", run_on(meshes.with_zero_length_edge(meshes.torus())).text)

    def test_refinement_without_flips(self):
        self.check("Intrinsic flips", meshes.torus(), method=1, output_triangulation=1)

    def test_not_finite(self):
        self.check("finite|NaN|not a number", meshes.with_nan(meshes.torus()))

    def test_too_few_placed_cones(self):
        self.check("at least 3", meshes.sphere(), cone_count=2)

    def test_seams_of_nothing(self):
        for seams, words in ((1, "no texture coordinates"), (2, "no edge"), (3, "no edge lies")):
            self.check(words, meshes.sphere(), seams=seams)

    def test_flat_disk(self):
        self.check("Euler|flat", meshes.hill(), target_curvature=1)

    def test_disk_of_a_torus(self):
        self.check("disk", meshes.torus(), target_curvature=2)

    def test_rectangle_with_three_corners(self):
        self.check("four|corner", meshes.hill(),
                   server.selection("(x==0 || x==1) && (y==0 || y==1) && (x+y < 1.5)"),
                   target_curvature=3)

    def test_rectangle_with_corner_inside(self):
        self.check("boundary|loop|corner", meshes.hill(),
                   server.selection("(x==0 || x==1) && (y==0 || y==1) && (x+y < 1.5) || "
                                    "abs(x-0.5) < 0.01 && abs(y-0.5) < 0.01"),
                   target_curvature=3)

    def test_no_cone_selected(self):
        self.check("select", meshes.sphere(), target_curvature=4)

    def test_too_few_cones_for_a_sphere(self):
        for condition in ("z > 0.99", "abs(z) > 0.99"):
            self.check("2 ?pi.*cones", meshes.sphere(), server.selection(condition),
                       target_curvature=4)

    def test_no_quality(self):
        self.check("quality", meshes.torus(), target_curvature=5)

    def test_gauss_bonnet(self):
        mesh = meshes.torus()
        self.check("Gauss|Euler|sum", meshes.with_quality(mesh, [0.01] * len(mesh.vertices)),
                   target_curvature=5)

    def test_inadmissible_curvature(self):
        mesh = meshes.torus()
        values = [-7.0 / (len(mesh.vertices) - 1)] * len(mesh.vertices)
        values[0] = 7.0
        self.check("2 ?pi|curvature", meshes.with_quality(mesh, values), target_curvature=5)

    def test_numbers_out_of_range(self):
        for words, values in (
                (r"epsilon.*greater than 0", {"epsilon": 0.0}),
                (r"epsilon.*greater than 0", {"epsilon": -1e-8}),
                (r"time_limit.*number of seconds", {"time_limit": -1.0}),
                (r"time_limit.*mesh is unchanged", {"time_limit": 1e-6}),
                (r"target_curvature.*6 \(Placed cones\)", {"target_curvature": 7}),
                (r"cone_count.*0", {"cone_count": -1}),
                (r"cone_distortion.*greater than 0", {"cone_distortion": -0.1}),
                (r"cone_rounding.*1 \(Multiples of pi/2\)", {"cone_rounding": 2}),
                (r"seam_hiding.*from 0 to 1", {"seam_hiding": 1.5}),
                (r"padding.*0 to 512 pixels", {"padding": -1}),
                (r"no parameter 'cone_cout': it is one of .*'cone_count'", {"options": "cone_cout=3"}),
                (r"no parameter 'chart_margin': it is 'padding' now", {"options": "chart_margin=0.1"}),
                (r"time_limit must be a number, not 'soon'", {"options": "colorize=true; time_limit=soon"}),
                (r"time_limit has no value", {"options": "time_limit"}),
                (r"padding is a parameter of its own", {"options": "padding=3"}),
                (r"target_curvature.*0 \(Automatic\)", {"target_curvature": -1}),
                (r"finish.*3 \(Least stretch\)", {"finish": 4}),
                (r"charts.*1 \(Without overlap\)", {"charts": 4}),
                (r"method.*3 \(Thurston\)", {"method": 7})):
            with self.subTest(values):
                self.check(words, meshes.torus(), **values)


class Hyperbolic(unittest.TestCase):
    """The second filter of the plugin."""

    def run_on(self, mesh, before="", **values):
        return server.Run(server.script(before, common.HYPERBOLIC, **values),
                          lambda path: meshes.write_ply(path, mesh))

    def test_double_torus(self):
        run = self.run_on(meshes.double_torus(), generator_axes=True)
        self.assertEqual(run.code, 0, run.text)
        pairs = server.results(run.text)
        self.assertEqual((pairs["converged"], pairs["genus"]), ("true", "2"))
        self.assertAlmostEqual(float(pairs["hyperbolic_area"]), 4 * math.pi, delta=1e-7)
        self.assertLess(float(pairs["relation_error"]), 1e-8)
        self.assertEqual(len(pairs["generators"].strip("[]").split(",")), 16)
        corners = [uv for wedge in run.mesh.wedges for uv in wedge]
        self.assertLess(max(math.hypot(2 * u - 1, 2 * v - 1) for u, v in corners), 1.0)
        self.assertAlmostEqual(sum(run.mesh.quality) / len(run.mesh.quality),
                               float(pairs["qc_vertex_mean"]), delta=1e-4)

    def test_cones_on_a_torus(self):
        # Two cones of 60 degrees: sum K = 20 pi / 6 > 0.
        run = self.run_on(meshes.torus(), server.selection("vi == 0 || vi == 200"),
                          target_curvature=1, cone_angle=60)
        self.assertEqual(run.code, 0, run.text)
        area = float(server.results(run.text)["hyperbolic_area"])
        self.assertAlmostEqual(area, 2 * (2 * math.pi - math.pi / 3), delta=1e-6)

    def test_refusals(self):
        for words, mesh, values in (
                ("Euler characteristic.*Euclidean", meshes.torus(), {}),
                ("Euler characteristic.*Euclidean", meshes.hill(), {}),
                ("needs selected vertices", meshes.double_torus(), {"target_curvature": 1}),
                ("no vertex quality", meshes.double_torus(), {"target_curvature": 2}),
                ("universal_cover", meshes.double_torus(), {"universal_cover": -1}),
                (r"finish.*1 \(Repair\)", meshes.double_torus(), {"finish": 2}),
                ("universal_cover: 20 rings", meshes.double_torus(),
                 {"universal_cover": 20, "flat_layer": True}),
                ("Intrinsic flips", meshes.double_torus(),
                 {"method": 1, "output_triangulation": 1})):
            with self.subTest(words):
                run = self.run_on(mesh, **values)
                self.assertNotEqual(run.code, 0, run.text)
                self.assertRegex(run.text, words)
                self.assertIn("Problem with filter: " + common.HYPERBOLIC.NAME, run.text)


class Texture(textures.TexturedTorus):
    """The parameter carry_texture: what the mesh shows stays what it shows."""

    def setUp(self):
        super().setUp()
        os.mkdir(self.path("mesh"))

    def write(self, *names, **more):
        for i, name in enumerate(names):
            faces = range(i, len(self.mesh.faces), len(names))
            textures.write_png(self.path("mesh", name), textures.painted(
                self.mesh, self.wedges, self.OLD, faces=faces, **more))
        textures.write_ply(self.path("mesh", "in.ply"), self.mesh, self.wedges, names,
                           [i % max(len(names), 1) for i in range(len(self.mesh.faces))])

    def carry(self, output="mesh/out.ply", **values):
        values = {"carry_texture": "new.png", "texture_size": self.NEW, **values}
        with open(self.path("script.mlx"), "w", encoding="utf-8") as out:
            out.write(server.script(**values))
        finished = server.run(["-i", "mesh/in.ply", "-o", output, "-m", "wt", "-s", "script.mlx"],
                              self.folder)
        return finished.returncode, finished.stdout.decode("utf-8", "replace")

    def check(self):
        """The image beside the mesh shows the function at the saved coordinates."""
        mesh = meshes.read_ply(self.path("mesh", "out.ply"))
        image = textures.read_png(self.path("mesh", "new.png"))
        self.assertEqual((image.width, image.height), (self.NEW, self.NEW))
        worst, count = textures.largest_difference(mesh, mesh.wedges, image)
        self.assertLess(worst, self.BOUND + 1 / image.top)
        self.assertGreater(count, 0.2 * self.NEW ** 2)
        return image

    def test_shattered_atlas(self):
        self.write("old.png")
        code, text = self.carry()
        self.assertEqual(code, 0, text)
        self.check()
        self.assertGreater(float(server.results(text)["texture_scale"]), 0.3)
        # How often depends on which thread draws what.
        for step in ("Drawing the texture", "Writing the texture"):
            self.assertRegex(text, f"(?m)^{step}$")
        self.assertRegex(text, r"Texture: .*mesh/new\.png, 300 x 300 texels, from 1 image\.")
        with open(self.path("mesh", "out.ply"), "rb") as source:
            header = source.read(2000).split(b"end_header")[0].decode()
        self.assertEqual(re.findall("TextureFile (.*)", header), ["new.png"])

    def test_saved_obj_names_it(self):
        self.write("old.png")
        code, text = self.carry("mesh/out.obj")
        self.assertEqual(code, 0, text)
        with open(self.path("mesh", "out.obj.mtl"), encoding="utf-8") as source:
            self.assertEqual(re.findall("map_Kd (.*)", source.read()), ["new.png"])

    def test_sixteen_bits_and_two_textures(self):
        self.write("one.png", "two.png", depth=16, alpha=0.5)
        code, text = self.carry()
        self.assertEqual(code, 0, text)
        image = self.check()
        self.assertEqual((image.depth, image.channels), (16, 4))
        self.assertEqual({texel[3] for row in image.rows for texel in row}, {round(0.5 * 65535)})

    def test_refusals(self):
        self.write("old.png")
        for words, values in (
                (r"must end in \.png", {"carry_texture": "new.jpg"}),
                ("name of a texture of the mesh", {"carry_texture": "old.png"}),
                ("cannot be written", {"carry_texture": "nowhere/new.png"}),
                ("texture_size.*16 to 16384", {"texture_size": 15}),
                ("choose normalize_uv", {"normalize_uv": False})):
            with self.subTest(words):
                code, text = self.carry(**values)
                self.assertEqual(code, 255, text)
                self.assertRegex(text, words)
                self.assertNotIn("converged=", text)
        os.remove(self.path("mesh", "old.png"))
        code, text = self.carry()
        self.assertEqual(code, 255, text)
        self.assertIn("The texture old.png of the mesh cannot be loaded", text)
        self.write()
        code, text = self.carry()
        self.assertEqual(code, 255, text)
        self.assertRegex(text, "carry_texture needs")
        self.assertEqual(os.listdir(self.path("mesh")), ["in.ply"])


class OneProcess(unittest.TestCase):
    """Two meshes in one process, as layers of its one document (there is no second): -i takes both,
    a stock filter changes the current one, scripts run in turn, and -l names what is saved."""

    EUCLIDEAN = server.step()
    REFINED = server.step(output_triangulation=1)
    HYPERBOLIC = server.step(common.HYPERBOLIC)
    MASK = ["-m", "wt", "vq", "vc", "vn"]

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        meshes.write_ply(self.path("torus.ply"), meshes.torus())
        meshes.write_ply(self.path("slab.ply"), meshes.double_torus())

    def path(self, name):
        return os.path.join(self.folder, name)

    def run_scripts(self, inputs, *scripts):
        """The exit code, the output, and what is saved of each layer."""
        arguments = ["-i", *inputs]
        for number, text in enumerate(scripts):
            with open(self.path(f"{number}.mlx"), "w", encoding="utf-8") as out:
                out.write(text)
            arguments += ["-s", f"{number}.mlx"]
        for number in range(len(inputs)):
            arguments += ["-o", f"out{number}.ply", "-l", str(number), *self.MASK]
        finished = server.run(arguments, self.folder)
        saved = []
        for number in range(len(inputs)):
            if os.path.exists(self.path(f"out{number}.ply")):
                with open(self.path(f"out{number}.ply"), "rb") as source:
                    saved.append(source.read())
                os.remove(self.path(f"out{number}.ply"))
        return finished.returncode, finished.stdout.decode("utf-8", "replace"), saved

    def alone(self, mesh, step):
        code, text, saved = self.run_scripts([mesh], server.script_of(step))
        self.assertEqual(code, 0, text)
        return server.results(text), saved[0]

    def test_two_meshes(self):
        code, text, saved = self.run_scripts(
            ["torus.ply", "slab.ply"],
            server.script_of(server.layer(0), self.EUCLIDEAN, server.layer(1), self.HYPERBOLIC))
        self.assertEqual(code, 0, text)
        torus, torus_file = self.alone("torus.ply", self.EUCLIDEAN)
        slab, slab_file = self.alone("slab.ply", self.HYPERBOLIC)
        # After every filter the host prints all of the script's log again, so the last two count.
        runs = re.findall(r"^(Result: .*)$\s*^(Surface: .*)$", text, re.MULTILINE)[-2:]
        self.assertEqual([server.results("\n".join(lines)) for lines in runs], [torus, slab])
        self.assertEqual(saved, [torus_file, slab_file])
        self.assertNotEqual(torus_file, slab_file)

    def test_in_turn_by_several_scripts(self):
        code, text, saved = self.run_scripts(
            ["torus.ply", "slab.ply"],
            server.script_of(server.layer(1), self.HYPERBOLIC),
            server.script_of(server.layer(0), self.EUCLIDEAN),
            server.script_of(server.layer(1), self.EUCLIDEAN, server.layer(0), self.REFINED,
                             server.layer(1), self.HYPERBOLIC))
        self.assertEqual(code, 0, text)
        self.assertEqual(saved, [self.alone("torus.ply", self.REFINED)[1],
                                 self.alone("slab.ply", self.HYPERBOLIC)[1]])

    def test_a_refusal_ends_the_process(self):
        code, text, saved = self.run_scripts(
            ["torus.ply", "slab.ply"],
            server.script_of(server.layer(1), self.HYPERBOLIC, server.layer(0), self.HYPERBOLIC),
            server.script_of(self.EUCLIDEAN))
        self.assertEqual((code, saved), (255, []), text)
        self.assertEqual(text.count("Apply FilterScript"), 1)
        self.assertRegex(text, "converged=true(?s:.*)Euler characteristic.*Euclidean")


class Samples(unittest.TestCase):
    """The scripts that users start from list every parameter, and run."""

    MESHES = {"disk": meshes.hill, "rectangle": meshes.hill, "holes": meshes.annulus,
              "cones": meshes.sphere, "hyperbolic": meshes.double_torus,
              "seams": meshes.double_torus}

    def test_every_sample(self):
        paths = sorted(glob.glob(os.path.join(common.REPOSITORY, "filter_ricci", "samples", "*.mlx")))
        self.assertGreaterEqual(len(paths), 4)
        for path in paths:
            name = os.path.splitext(os.path.basename(path))[0]
            with self.subTest(name):
                with open(path, encoding="utf-8") as source:
                    text = source.read()
                self.check_parameters(text)
                mesh = self.MESHES.get(name, meshes.torus)()
                run = server.Run(text, lambda target: meshes.write_ply(target, mesh))
                self.assertEqual(run.code, 0, run.text)
                self.assertIn("converged=true", run.text)

    def check_parameters(self, text):
        our_filter = common.HYPERBOLIC if common.HYPERBOLIC.NAME in text else common
        text = text.split(f'<filter name="{our_filter.NAME}">')[1]
        listed = re.findall(r'<Param type="Rich(\w+)" name="(\w+)"', text)
        self.assertEqual(listed, [(kind, name) for name, kind, _ in our_filter.PARAMETERS])
        for name, choices in our_filter.CHOICES.items():
            line = re.search(f'<Param[^>]*name="{name}"[^>]*>', text).group()
            self.assertIn(f'enum_cardinality="{len(choices)}"', line)
            self.assertEqual(re.findall(r'enum_val\d+="([^"]*)"', line), choices)

    def test_plugin_has_these_parameters(self):
        """The host's own list of the loaded plugin: types and order."""
        with tempfile.TemporaryDirectory() as folder:
            server.run(["-d", "dump.txt"], folder)
            with open(os.path.join(folder, "dump.txt"), encoding="utf-8") as source:
                dump = source.read()
        for our_filter in (common, common.HYPERBOLIC):
            section = dump.split(our_filter.NAME, 1)[1].split("</TABLE>", 1)[0]
            kinds = re.findall(r"<TR><TD> \\c (\w+)", section)
            self.assertEqual(kinds, [kind for _, kind, _ in our_filter.PARAMETERS])

    def test_scripts_of_any_order(self):
        """Stored scripts have another order, and those that the window saves another type of file."""
        head, *lines, tail = re.split(r"(?m)^(?=  <Param)|^(?= </filter>)", server.script_of(
            server.step(report="page.html")))
        text = head + "".join(reversed(lines)) + tail
        for kind in ("String", "SaveFile"):
            run = server.Run(re.sub('RichString" name="carry_texture"', f'Rich{kind}" name="carry_texture" ext=""', text),
                             lambda target: meshes.write_ply(target, meshes.torus()))
            self.assertEqual(run.code, 0, run.text)
            self.assertIn("page.csv", run.text)

    def test_scripts_of_2(self):
        """Refused as they are; they run once the lines of the changelog are in the place of those it names."""
        with open(os.path.join(common.REPOSITORY, "CHANGELOG.md"), encoding="utf-8") as source:
            section = re.search(r"(?s)\n## \[3\.0\.0\].*?(?=\n## \[2)", source.read()).group()
        rows = re.findall(r"(?m)^  \| .*?, (E|E, H) \| `(<Param .*/>)` \|$", section)
        both = [("colorize", "Bool", True), ("report", "String", ""), ("time_limit", "Float", 0.0)]
        plane = [("chart_margin", "Float", 0.004), ("flat_layer", "Bool", False), ("sphere_layer", "Bool", False),
                 ("cone_count", "Int", 0), ("cone_rounding", "Enum", 0), ("seam_hiding", "Float", 0.0)]
        for our_filter, mark, mesh, former in ((common, "E", meshes.torus, plane + both),
                                               (common.HYPERBOLIC, "H", meshes.double_torus, both)):
            choices = {**our_filter.CHOICES, **our_filter.RARE_CHOICES, "seams": common.SEAMS[:4],
                       "charts": common.CHOICES["charts"][:3]}
            new = [line for filters, line in rows if mark in filters]
            added = set(re.findall('name="(\\w+)"', "".join(new)))
            old = {name: server.parameter_xml(name, kind, value, choices)
                   for name, kind, value in our_filter.PARAMETERS + former if name not in added}
            gone = {name for name, _, _ in former}
            self.assertLessEqual(gone, set(re.findall("`(\\w+)`", section)))
            kept = [line for name, line in old.items() if name not in gone]
            for lines, code in ((list(old.values()), 255), (kept + new, 0)):
                run = server.Run(server.script_of(f' <filter name="{our_filter.NAME}">\n{"".join(lines)} </filter>\n'),
                                 lambda path, mesh=mesh: meshes.write_ply(path, mesh()))
                self.assertEqual(run.code, code, run.text)
            self.assertIn("The colours show the distortion", run.text)


if __name__ == "__main__":
    common.main()
