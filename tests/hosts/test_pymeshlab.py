# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin in PyMeshLab. Usage: test_pymeshlab.py BUILD_DIR [TEST...], with PyMeshLab's Python."""

import ast
import csv
import ctypes
import hashlib
import locale
import math
import os
import platform
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

import common
import meshes
from pymeshlab_host import BY_ARRAYS, numpy, pymeshlab, load, mesh_set, run, select


def loaded(mesh):
    """By way of a file: only then does PyMeshLab know that a mesh has no quality."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "mesh.ply")
        meshes.write_ply(path, mesh)
        return load(path)


def in_a_process(call, environment=None):
    """Prints a call of this module in a process of its own, whose crash would be seen here."""
    program = ("import sys; sys.argv = ['x', sys.argv[1]]\nimport test_pymeshlab\n"
               f"print(ascii(test_pymeshlab.{call}))\n")
    finished = subprocess.run(
        [sys.executable, "-c", program, common.BUILD], capture_output=True, text=True,
        cwd=os.path.dirname(os.path.abspath(__file__)), env={**os.environ, **(environment or {})})
    if finished.returncode != 0:
        raise AssertionError(f"{call} ended with {finished.returncode}:\n{finished.stderr}")
    return ast.literal_eval(finished.stdout.splitlines()[-1])


def state(mesh):
    """Everything that a refused run must leave as it was."""
    arrays = [mesh.vertex_matrix(), mesh.face_matrix(), mesh.vertex_scalar_array(),
              mesh.vertex_color_matrix(), mesh.vertex_normal_matrix(),
              mesh.vertex_selection_array(), mesh.face_selection_array()]
    if mesh.has_wedge_tex_coord():
        arrays.append(mesh.wedge_tex_coord_matrix())
    flags = (mesh.has_wedge_tex_coord(), mesh.has_vertex_scalar(), mesh.has_vertex_color(),
             mesh.vertex_number(), mesh.face_number(), len(mesh.textures()))
    return flags, [numpy.array(a) for a in arrays]


def same(one, two):
    return one[0] == two[0] and len(one[1]) == len(two[1]) and all(
        numpy.array_equal(a, b, equal_nan=True) for a, b in zip(one[1], two[1]))


def flipped_faces(mesh):
    """Faces that the stored texture coordinates turn over, or draw without area."""
    return sum(meshes.uv_area(w) <= 0 for w in mesh.wedge_tex_coord_matrix().reshape(-1, 3, 2))


class Results(unittest.TestCase):
    def check(self, documents, **values):
        returned = run(documents, **values)
        self.assertLessEqual(set(common.ALWAYS), set(returned))
        types = {**common.ALWAYS, **common.INVARIANTS, **common.CHOSEN, **common.FREE_BOUNDARY,
                 **common.SPHERE}
        for key, value in returned.items():
            self.assertIs(type(value), types[key], key)
        self.assertTrue(returned["converged"])
        self.assertLess(returned["max_curvature_error"], 1e-8)
        mesh = documents.current_mesh()
        self.assertTrue(mesh.has_wedge_tex_coord())
        self.assertTrue(mesh.has_vertex_scalar())
        self.check_geometry(mesh, returned)
        return returned

    def check_geometry(self, mesh, returned):
        wedges = mesh.wedge_tex_coord_matrix().reshape(-1, 3, 2)
        self.assertTrue(numpy.isfinite(wedges).all())
        self.assertEqual(flipped_faces(mesh), returned["flipped_faces"])
        corners = mesh.vertex_matrix()[mesh.face_matrix()]
        own = [meshes.distortion(c, w) for c, w in zip(corners, wedges)]
        self.assertAlmostEqual(float(numpy.mean(own)), returned["qc_mean"],
                               delta=1e-4 * returned["qc_mean"])  # rounded to floats
        self.assertAlmostEqual(float(numpy.mean(mesh.vertex_scalar_array())),
                               returned["qc_vertex_mean"], delta=1e-9)

    def test_torus(self):
        documents = mesh_set(meshes.torus())
        before = documents.current_mesh().vertex_matrix()
        returned = self.check(documents, cone_distortion=1.0)
        self.assertEqual(returned["genus"], 1)
        tau = complex(returned["torus_tau_re"], returned["torus_tau_im"])
        self.assertLess(abs(complex(*returned["period_matrix"]) - tau), 0.02 * abs(tau))
        self.assertTrue(numpy.array_equal(before, documents.current_mesh().vertex_matrix()))
        u = documents.current_mesh().vertex_custom_scalar_attribute_array("ricci_u")
        self.assertTrue(numpy.isfinite(u).all())
        self.assertGreater(numpy.ptp(u), 0.0)

    def test_names_of_choices(self):
        documents = mesh_set(meshes.annulus())
        returned = self.check(documents, target_curvature="Flat everywhere",
                              charts="As the flow has them", method="Fixed triangles")
        self.assertIn("annulus_modulus", returned)

    def test_disk_and_rectangle(self):
        documents = mesh_set(meshes.hill())
        self.check(documents)
        self.check(documents, target_curvature="Disk")
        returned = self.check(documents, target_curvature="Rectangle")
        self.assertGreaterEqual(returned["rectangle_aspect"], 1.0)

    def test_cones(self):
        documents = mesh_set(meshes.sphere())
        select(documents, "abs(z) > 0.99 || abs(x) > 0.99")
        self.check(documents, target_curvature="Cones at selected vertices")

    def test_placed_cones_come_back_from_quality(self):
        documents = mesh_set(meshes.sphere())
        returned = self.check(documents, cone_count=5)
        self.assertEqual(returned["cones"], 5)
        placed = documents.current_mesh().vertex_custom_scalar_attribute_array(
            "ricci_target_curvature")
        self.assertEqual(numpy.count_nonzero(placed), 5)
        self.assertAlmostEqual(placed.sum(), 4 * math.pi, delta=1e-10)
        for precision in (numpy.float64, numpy.float32):
            stored = placed.astype(precision).astype(numpy.float64)  # as a file keeps them
            again = mesh_set(meshes.with_quality(meshes.sphere(), stored))
            other = self.check(again, target_curvature="From vertex quality")
            self.assertEqual(other["cones"], 5)
            kept = again.current_mesh().vertex_custom_scalar_attribute_array(
                "ricci_target_curvature")
            self.assertTrue(numpy.allclose(kept, placed, atol=1e-6))
            self.assertAlmostEqual(other["qc_mean"], returned["qc_mean"], delta=1e-5)

    def test_script_edits_placed_cones(self):
        documents = mesh_set(meshes.sphere())
        self.check(documents, cone_count=4, cone_rounding="Multiples of pi/2")
        documents.compute_scalar_by_function_per_vertex(q="ricci_target_curvature")
        quality = documents.current_mesh().vertex_scalar_array()
        quarters = quality / (math.pi / 2)
        self.assertTrue(numpy.allclose(quarters, quarters.round(), atol=1e-9))
        self.assertAlmostEqual(quality.sum(), 4 * math.pi, delta=1e-9)
        returned = self.check(documents, target_curvature="From vertex quality")
        self.assertEqual(returned["cones"], numpy.count_nonzero(quality))

    def test_quality_is_read_before_it_is_overwritten(self):
        mesh = meshes.torus()
        curvature = numpy.zeros(len(mesh.vertices))
        curvature[0], curvature[200] = 0.5, -0.5
        documents = mesh_set(meshes.with_quality(mesh, curvature))
        self.check(documents, target_curvature="From vertex quality")
        current = documents.current_mesh()
        kept = current.vertex_custom_scalar_attribute_array("ricci_target_curvature")
        self.assertTrue(numpy.allclose(kept, curvature, atol=1e-9))
        self.assertGreaterEqual(current.vertex_scalar_array().min(), 1.0 - 1e-9)

    def test_flat_layer(self):
        documents = mesh_set(meshes.torus())
        self.check(documents, layers="Flat mesh")
        self.assertEqual(documents.mesh_number(), 2)
        self.assertEqual(documents.current_mesh_id(), 0)
        flat = documents.mesh(1)
        self.assertEqual(flat.face_number(), documents.mesh(0).face_number())
        self.assertTrue((flat.vertex_matrix()[:, 2] == 0).all())
        self.assertTrue(flat.has_wedge_tex_coord())
        corners = flat.vertex_matrix()[flat.face_matrix()][:, :, :2]
        wedges = flat.wedge_tex_coord_matrix().reshape(-1, 3, 2)
        self.assertLess(numpy.abs(corners - wedges).max(), 1e-6)
        # Where it is seen: beside the mesh, upright, and as large.
        seen = flat.transformed_vertex_matrix()
        mesh = documents.mesh(0).vertex_matrix()
        size = (mesh.max(axis=0) - mesh.min(axis=0)).max()
        self.assertAlmostEqual((seen.max(axis=0) - seen.min(axis=0)).max() / size, 1.0, delta=1e-3)
        self.assertGreater(seen[:, 0].min(), mesh[:, 0].max())
        self.assertLess(seen[:, 0].min(), mesh[:, 0].max() + 0.2 * size)
        self.assertEqual(flat.has_vertex_color(), BY_ARRAYS)  # all that programs make are white

    @unittest.skipIf(BY_ARRAYS, "PyMeshLab gives no program the means to remove colours")
    def test_colours_of_an_earlier_run_go(self):
        documents = mesh_set(meshes.torus())
        self.check(documents, colorize=True, layers="Flat mesh")
        mesh, flat = documents.mesh(0), documents.mesh(1)
        self.assertTrue(mesh.has_vertex_color() and flat.has_vertex_color())
        self.assertGreater(len(numpy.unique(flat.vertex_color_matrix(), axis=0)), 9)
        self.check(documents)
        self.assertFalse(documents.mesh(0).has_vertex_color())
        # Those that others give stay.
        self.check(documents, colorize=True)
        documents.apply_filter("set_color_per_vertex", color1=pymeshlab.Color(9, 8, 7, 255))
        self.check(documents)
        self.assertTrue(documents.mesh(0).has_vertex_color())
        self.assertEqual(len(numpy.unique(documents.mesh(0).vertex_color_matrix(), axis=0)), 1)

    def test_capped_holes(self):
        documents = mesh_set(meshes.annulus())
        returned = self.check(documents, holes="Capped", cone_distortion=10)
        self.assertEqual((returned["boundary_loops"], returned["capped_holes"]), (2, 1))
        self.assertEqual((returned["seam_edges"], returned["charts"]), (0, 1))
        open_ring = self.check(mesh_set(meshes.annulus())) # its hole is not a short one
        self.assertEqual(open_ring["capped_holes"], 0)
        self.assertGreater(open_ring["seam_edges"], 0)

    def test_overlap(self):
        counted = self.check(mesh_set(meshes.screw()), charts="As the flow has them")
        self.assertEqual(counted["overlapping_charts"], 1)
        self.assertGreater(counted["overlapping_faces"], 0)
        documents = mesh_set(meshes.screw())
        resolved = self.check(documents)
        self.assertEqual((resolved["overlapping_charts"], resolved["charts"]), (0, 2))
        self.assertGreater(resolved["overlap_cuts"], 0)
        # No point of the square is covered twice.
        wedges = documents.current_mesh().wedge_tex_coord_matrix().reshape(-1, 3, 2)
        random = numpy.random.default_rng(1)
        for point in random.random((300, 2)):
            sides = [[numpy.linalg.det([w[(k + 1) % 3] - w[k], point - w[k]]) > 0
                      for k in range(3)] for w in wedges]
            self.assertLessEqual(sum(all(s) for s in sides), 1)

    def test_finish(self):
        hill, slab = meshes.swirled(meshes.hill()), meshes.swirled(meshes.double_torus(), 4.0, 1.5)
        for mesh, values in ((hill, {"cone_distortion": 1.0}), (hill, {"target_curvature": "Rectangle"}),
                             (slab, {"cone_count": 6})):
            with self.subTest(vertices=len(mesh.vertices), **values):
                self.check_finish(mesh, values)

    def test_least_distortion(self):
        for mesh in (meshes.hill(), meshes.torus(), meshes.sphere(), meshes.swirled(meshes.hill())):
            repaired, least = (self.check(mesh_set(mesh), finish=finish, cone_distortion=0.25)
                               for finish in ("Repair", "Least distortion"))
            for key in ("qc_mean", "qc_vertex_mean", "qc_area_mean"):
                self.assertLess(least[key], repaired[key])
            self.assertEqual(least["max_curvature_error"], repaired["max_curvature_error"])
            self.assertEqual(least["cones"], repaired["cones"])

    def check_finish(self, mesh, values):
        returned, flipped = {}, {}
        for finish in common.CHOICES["finish"]:
            documents = mesh_set(mesh)
            returned[finish] = self.check(documents, finish=finish, **values)
            flipped[finish] = flipped_faces(documents.current_mesh())
        drawn, repaired, least, even = (returned[finish] for finish in common.CHOICES["finish"])
        self.assertGreater(flipped["None"], 0)
        for finish in ("Repair", "Least distortion", "Least stretch"):
            self.assertEqual(flipped[finish], 0)
            self.assertEqual(returned[finish]["flipped_by_rounding"], 0)
        self.assertEqual(drawn["finish_moved"], 0)
        self.assertGreater(repaired["finish_moved"], 0)
        self.assertGreater(least["finish_moved"], 0)
        for key in (*common.INVARIANTS, *common.CHOSEN):
            self.assertEqual(drawn.get(key), least.get(key))
            self.assertEqual(drawn.get(key), even.get(key))
        self.assertEqual(run(mesh_set(mesh), **values), least)  # the default

    def test_finish_is_for_flips(self):
        for method in common.METHOD[1:]:
            documents = [mesh_set(meshes.torus()) for _ in range(2)]
            self.assertEqual(run(documents[0], method=method),
                             run(documents[1], finish="None", method=method))
            self.assertTrue(numpy.array_equal(*(d.current_mesh().wedge_tex_coord_matrix()
                                                for d in documents)))

    @unittest.skipIf(BY_ARRAYS, "PyMeshLab gives no program the means, as a warning says")
    def test_flat_layer_has_the_textures(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "torus.ply")
            meshes.write_ply(path, meshes.torus())
            meshes.name_texture(path, "checks.png")
            script = os.path.join(common.REPOSITORY, "filter_ricci", "demo", "checkerboard.py")
            subprocess.run([sys.executable, script, os.path.join(folder, "checks.png")], check=True)
            documents = load(path)
        self.assertEqual(list(documents.mesh(0).textures()), ["checks.png"])
        self.check(documents, layers="Flat mesh")
        self.assertEqual(list(documents.mesh(1).textures()), ["checks.png"])

    def test_sphere_layer(self):
        documents = mesh_set(meshes.sphere())
        select(documents, "abs(z) > 0.99 || abs(x) > 0.99")
        returned = self.check(documents, target_curvature="Cones at selected vertices",
                              layers="Sphere")
        self.assertEqual(returned["sphere_flipped_faces"], 0)
        self.assertLess(returned["sphere_qc_area_mean"], 1.2)
        self.assertEqual(documents.mesh_number(), 2)
        self.assertEqual(documents.current_mesh_id(), 0)
        sphere = documents.mesh(1)
        self.assertTrue(numpy.array_equal(sphere.face_matrix(), documents.mesh(0).face_matrix()))
        lengths = numpy.linalg.norm(sphere.vertex_matrix(), axis=1)
        self.assertLess(numpy.abs(lengths - 1).max(), 1e-12)

    def test_compare_shapes(self):
        script = os.path.join(common.REPOSITORY, "filter_ricci", "samples", "compare_shapes.py")
        environment = {**os.environ, "PYTHONPATH": os.path.join(common.BUILD, "python")}
        with tempfile.TemporaryDirectory() as folder:
            paths = [os.path.join(folder, name) for name in ("one.ply", "two.ply", "three.ply")]
            meshes.write_ply(paths[0], meshes.torus(40, 40, 2, 1))
            meshes.write_ply(paths[1], meshes.torus(40, 40, 6, 3))
            meshes.write_ply(paths[2], meshes.torus(40, 40, 3, 1))
            double = meshes.double_torus()
            moved = meshes.Mesh([(3 * z, 3 * x, 3 * y) for x, y, z in double.vertices[::-1]],
                                [tuple(len(double.vertices) - 1 - v for v in face)
                                 for face in double.faces[::-1]])
            pairs = [paths[:2], paths[::2], [os.path.join(folder, name) for name in ("4.ply", "5.ply")]]
            meshes.write_ply(pairs[2][0], double)
            meshes.write_ply(pairs[2][1], moved)
            distances = []
            for pair in pairs:
                done = subprocess.run([sys.executable, script, *pair],
                                      capture_output=True, text=True, check=True, env=environment)
                distances.append(float(done.stdout.split("distance ")[1].split(",")[0]))
        self.assertLess(distances[0], 1e-5)
        self.assertLess(distances[2], 1e-4)
        # Rectangles i sqrt(3) and i sqrt(8): their distance is the logarithm of the quotient.
        self.assertAlmostEqual(distances[1], 0.5 * math.log(8 / 3), delta=5e-3)

    def test_colorize(self):
        documents = mesh_set(meshes.hill())
        self.check(documents, colorize=True)
        colors = documents.current_mesh().vertex_color_matrix()
        self.assertGreater(len(numpy.unique(colors.round(3), axis=0)), 5)
        # Blue where angles are kept, red where the distortion is largest (the paper's 5.1).
        distortion = documents.current_mesh().vertex_scalar_array()
        least, largest = colors[distortion.argmin()], colors[distortion.argmax()]
        self.assertGreater(least[2], 0.9)
        self.assertLess(least[0], 0.1)
        self.assertGreater(largest[0], 0.5)
        self.assertEqual(largest[2], 0)

    def test_repeatable(self):
        documents = mesh_set(meshes.torus())
        self.check(documents)
        first = documents.current_mesh().wedge_tex_coord_matrix()
        self.check(documents)
        self.assertTrue(numpy.array_equal(first, documents.current_mesh().wedge_tex_coord_matrix()))

    def test_saved_obj_has_texture_coordinates(self):
        documents = mesh_set(meshes.torus())
        self.check(documents)
        path = os.path.join(common.BUILD, "test_pymeshlab_out.obj")
        documents.save_current_mesh(path, save_wedge_texcoord=True)
        with open(path, encoding="utf-8") as source:
            text = source.read()
        os.remove(path)
        self.assertRegex(text, r"(?m)^vt \d")

    def test_parameters_and_defaults(self):
        documents = mesh_set(meshes.torus())
        run(documents)
        values = documents.filter_parameter_values(common.PYTHON_NAME)
        parameters = common.PARAMETERS + common.RARE
        self.assertEqual(list(values), [name for name, _, _ in parameters])
        for name, kind, default in parameters:
            if kind == "Float":
                self.assertAlmostEqual(values[name], default, delta=1e-6 * default)
            else:
                self.assertEqual(values[name], default, name)


class Report(unittest.TestCase):
    """The files of the parameter report."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        meshes.write_ply(self.path("torus <1>.ply"), meshes.torus())
        self.documents = load(self.path("torus <1>.ply"))

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def rows(self, name):
        with open(self.path(name), encoding="utf-8", newline="") as source:
            return list(csv.DictReader(source))

    def test_page_and_data_beside_the_mesh(self):
        returned = run(self.documents, report="page.html", target_curvature="Flat everywhere")
        self.assertEqual(sorted(os.listdir(self.folder.name)),
                         ["page.csv", "page.html", "torus <1>.ply"])
        rows = self.rows("page.csv")
        results = {row["key"]: row["value"] for row in rows if row["table"] == "result"}
        self.assertEqual(set(results), set(returned))
        for key, value in returned.items():
            if isinstance(value, bool):
                self.assertEqual(results[key], str(value).lower())
            else:
                written = numpy.array(results[key].split(), dtype=float)
                self.assertTrue(numpy.allclose(written, value, rtol=1e-8, atol=0.0))
        settings = {row["key"]: row["value"] for row in rows if row["table"] == "setting"}
        self.assertEqual(settings["target_curvature"], "Flat everywhere")
        self.assertEqual(settings["mesh"], "torus <1>.ply")
        counts = [int(row["value"]) for row in rows if row["table"] == "qc_histogram"]
        self.assertEqual(sum(counts), self.documents.current_mesh().vertex_number())
        counts = [int(row["value"]) for row in rows if row["table"] == "area_histogram"]
        self.assertEqual(sum(counts), self.documents.current_mesh().face_number())
        steps = [float(row["value"]) for row in rows if row["table"] == "newton"]
        self.assertAlmostEqual(steps[-1], returned["max_curvature_error"], delta=1e-14)
        self.check_page(returned)

    def check_page(self, returned):
        with open(self.path("page.html"), encoding="utf-8") as source:
            text = source.read()
        self.assertNotRegex(text, r"(?:src|href)=")  # needs no other file
        page = xml.etree.ElementTree.fromstring(
            re.sub(r"&(?!lt;|gt;|amp;|quot;)#?\w+;", "", text.replace("<!DOCTYPE html>", "")
                   .replace('<meta charset="utf-8">', "")))
        labels = {row[1].find("code").text: row[0].text for row in page.iter("tr")}
        self.assertLessEqual(set(returned), set(labels))
        self.assertTrue(all(labels.values()))
        self.assertEqual(len(set(labels.values())), len(labels))
        said = [p.text for p in page.iter("p")]
        mesh = self.documents.current_mesh()
        self.assertIn("torus <1>.ply", said)
        self.assertTrue([line for line in said if line.startswith(
            f"{mesh.vertex_number()} vertices, {mesh.face_number()} faces, ")], said)
        self.assertEqual(len([e for e in page.iter() if e.tag.endswith("}svg")]), 4)

    def test_data_alone_and_in_another_folder(self):
        os.mkdir(self.path("out"))
        run(self.documents, report=self.path("out/data.CSV"))
        self.assertEqual(os.listdir(self.path("out")), ["data.CSV"])

    def test_repeatable(self):
        run(self.documents, report="first.html")
        run(self.documents, report="second.html")
        texts = []
        for name in ("first", "second"):
            with open(self.path(name + ".csv"), encoding="utf-8") as source:
                texts.append(source.read().replace(name, ""))
        self.assertEqual(*texts)

    def test_unwritable(self):
        os.mkdir(self.path("folder.html"))
        before = state(self.documents.current_mesh())
        present = sorted(os.listdir(self.folder.name))
        for name, words in (("nowhere/page.html", "cannot be written.*(choose another place|no folder)"),
                            ("folder.html", "is a folder"),
                            ("page.pdf", "must end in .html"), ("page", "must end in .html")):
            with self.subTest(name):
                with self.assertRaisesRegex((pymeshlab.PyMeshLabException, FileNotFoundError),
                                            f"(?s){words}"):
                    run(self.documents, report=name)
                self.assertTrue(same(before, state(self.documents.current_mesh())))
                self.assertEqual(sorted(os.listdir(self.folder.name)), present)

    def test_names_are_quoted(self):
        name = 'a, "b" & <c>.ply'
        os.rename(self.path("torus <1>.ply"), self.path(name))
        run(load(self.path(name)), report="page.html")
        settings = {row["key"]: row["value"] for row in self.rows("page.csv")}
        self.assertEqual(settings["mesh"], name)
        with open(self.path("page.html"), encoding="utf-8") as source:
            self.assertIn("<p>a, &quot;b&quot; &amp; &lt;c&gt;.ply</p>", source.read())

    def test_what_was_repaired_is_told(self):
        mesh = meshes.with_unreferenced_vertex(meshes.with_flipped_faces(meshes.torus()))
        meshes.write_ply(self.path("mended.ply"), mesh)
        run(load(self.path("mended.ply")), report="page.html")
        with open(self.path("page.html"), encoding="utf-8") as source:
            notes = re.findall(r"^<p>(.*)</p>$", source.read(), re.MULTILINE)
        self.assertTrue([n for n in notes if "inverted winding" in n and n.endswith(".")], notes)
        self.assertTrue([n for n in notes if "belongs to no face" in n], notes)

    def test_hyperbolic(self):
        meshes.write_ply(self.path("slab.ply"), meshes.double_torus(1))
        returned = run(load(self.path("slab.ply")), common.HYPERBOLIC, report="page.html",
                       generator_axes=True)
        rows = {row["key"]: row["value"] for row in self.rows("page.csv")}
        for key in ("generators", "generators_low"):  # every digit
            written = [float(number) for number in rows[key].split()]
            self.assertTrue(numpy.array_equal(written, returned[key]))
        with open(self.path("page.html"), encoding="utf-8") as source:
            self.assertIn(f"<td>{rows['generators']}</td>", source.read())

    def test_many_components(self):
        one = meshes.hill(3)
        many = meshes.Mesh([], [])
        for i in range(25):
            many.faces += [tuple(v + len(many.vertices) for v in face) for face in one.faces]
            many.vertices += [((1 + i / 100) * x + 2 * i, y, z) for x, y, z in one.vertices]  # no copies
        meshes.write_ply(self.path("many.ply"), many)
        run(load(self.path("many.ply")), report="page.html")
        groups = {row["group"] for row in self.rows("page.csv") if row["table"] == "newton"}
        self.assertEqual(groups, {str(i) for i in range(25)})
        with open(self.path("page.html"), encoding="utf-8") as source:
            text = source.read()
        self.assertIn("a line for each solve of each component, the first 20.", text)
        self.assertEqual(text.count("<polyline"), 20)

    def test_every_face_is_in_the_histogram(self):
        """The few on a spike, too, which come out much smaller than the others."""
        meshes.write_ply(self.path("spike.ply"), meshes.grid(
            40, 40, lambda s, t: (s, t, math.exp(-2e3 * ((s - 0.5) ** 2 + (t - 0.5) ** 2)))))
        run(load(self.path("spike.ply")), report="data.csv")
        areas = [row for row in self.rows("data.csv") if row["table"] == "area_histogram"]
        self.assertEqual(sum(int(row["value"]) for row in areas), 40 * 40 * 2)
        self.assertEqual(areas[0]["key"], "-inf")
        self.assertGreater(int(areas[0]["value"]), 0)

    @staticmethod
    def on_a_full_disk(folder, room):
        """No file can be longer than `room`, as where the disk is full."""
        documents = load(os.path.join(folder, "torus <1>.ply"))
        before = state(documents.current_mesh())
        limits = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (room, limits[1]))
        try:
            run(documents, report="page.html")
        except pymeshlab.PyMeshLabException as refusal:
            return str(refusal), same(before, state(documents.current_mesh()))
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        return "written", False

    def test_full_disk(self):
        run(self.documents, report="page.html")
        sizes = {ending: os.path.getsize(self.path("page." + ending)) for ending in ("html", "csv")}
        self.assertLess(sizes["csv"], sizes["html"])
        os.remove(self.path("page.html"))
        os.remove(self.path("page.csv"))
        for room in (0, 1024, sizes["csv"], sizes["html"] - 1):
            call = f"Report.on_a_full_disk({self.folder.name!r}, {room})"
            sentence, untouched = in_a_process(call)
            self.assertRegex(sentence, "page.html could not be written .File too large.: choose")
            self.assertTrue(untouched)
            self.assertEqual(os.listdir(self.folder.name), ["torus <1>.ply"])
        self.assertEqual(in_a_process(
            f"Report.on_a_full_disk({self.folder.name!r}, {sizes['html']})"), ("written", False))

    def test_refused_mesh_leaves_no_report(self):
        with self.assertRaises(pymeshlab.PyMeshLabException):
            run(self.documents, report="page.html", target_curvature="Disk")
        self.assertEqual(os.listdir(self.folder.name), ["torus <1>.ply"])


class Hyperbolic(unittest.TestCase):
    """The second filter of the plugin."""

    def check(self, documents, **values):
        returned = run(documents, common.HYPERBOLIC, **values)
        self.assertTrue(returned["converged"])
        self.assertLess(returned["max_curvature_error"], 1e-8)
        self.assertLess(returned["relation_error"], 1e-8)
        disk = 2 * documents.current_mesh().wedge_tex_coord_matrix() - 1
        self.assertLess(numpy.hypot(disk[:, 0], disk[:, 1]).max(), 1.0)
        return returned

    def motions(self, returned):
        """2 x 2 matrices of SU(1,1)."""
        for re_a, im_a, re_b, im_b in numpy.array(returned["generators"]).reshape(-1, 4):
            a, b = re_a + 1j * im_a, re_b + 1j * im_b
            self.assertAlmostEqual(abs(a) ** 2 - abs(b) ** 2, 1.0, delta=1e-6)
            yield numpy.array([[a, b], [b.conjugate(), a.conjugate()]])

    def test_double_torus(self):
        documents = mesh_set(meshes.double_torus())
        returned = self.check(documents, output_triangulation="Common refinement",
                              generator_axes=True)
        self.assertAlmostEqual(returned["hyperbolic_area"], 4 * numpy.pi, delta=1e-9)
        self.assertEqual(returned["flipped_faces"], 0)
        a, b, c, d = self.motions(returned)
        inverse = numpy.linalg.inv
        relation = a @ b @ inverse(a) @ inverse(b) @ c @ d @ inverse(c) @ inverse(d)
        self.assertLess(numpy.abs(relation - numpy.sign(relation[0, 0].real) * numpy.eye(2)).max(),
                        1e-8)
        for motion in (a, b, c, d):
            self.assertGreater(abs(numpy.trace(motion).real), 2.0)

    def test_sides_of_a_seam_differ_by_a_motion(self):
        documents = mesh_set(meshes.double_torus())
        self.check(documents)
        mesh = documents.current_mesh()
        wedges = (2 * mesh.wedge_tex_coord_matrix() - 1).reshape(-1, 3, 2)
        disk = wedges[:, :, 0] + 1j * wedges[:, :, 1]
        sides = {}
        for face, z in zip(mesh.face_matrix(), disk):
            for k in range(3):
                p, q = z[k], z[(k + 1) % 3]
                length = abs(p - q) / numpy.sqrt((1 - abs(p) ** 2) * (1 - abs(q) ** 2))
                sides.setdefault(frozenset((face[k], face[(k + 1) % 3])), []).append(length)
        for one, two in sides.values():
            self.assertAlmostEqual(one / two, 1.0, delta=1e-3)  # wedges are floats

    def test_finish(self):
        mesh = meshes.swirled(meshes.double_torus(3), 4.0, 1.5)
        drawn = mesh_set(mesh)
        self.assertEqual(self.check(drawn, finish="None")["finish_moved"], 0)
        self.assertGreater(flipped_faces(drawn.current_mesh()), 0)
        for values in ({}, {"output_triangulation": "Common refinement"}):
            documents = mesh_set(mesh)
            returned = self.check(documents, **values)
            self.assertEqual(flipped_faces(documents.current_mesh()), 0)
            self.assertEqual((returned["flipped_faces"], returned["flipped_by_rounding"]), (0, 0))
            self.assertGreater(returned["finish_moved"], 0)
            self.assertAlmostEqual(numpy.mean(documents.current_mesh().vertex_scalar_array()),
                                   returned["qc_vertex_mean"], delta=1e-9)

    def test_layers(self):
        documents = mesh_set(meshes.double_torus(1))
        faces = documents.current_mesh().face_number()
        self.check(documents, flat_layer=True, universal_cover=1, generator_axes=True)
        self.assertEqual(documents.mesh_number(), 4)
        cover, axes = documents.mesh(2), documents.mesh(3)
        self.assertEqual(cover.face_number() % faces, 0)
        self.assertGreaterEqual(cover.face_number() // faces, 9)  # 8 neighbours across 8 sides
        points = 2 * cover.vertex_matrix()[:, :2] - 1
        self.assertLess(numpy.hypot(points[:, 0], points[:, 1]).max(), 1.0)
        self.assertEqual(axes.edge_number(), 4 * 200)

    def test_canonical_polygon(self):
        documents = mesh_set(meshes.double_torus())
        self.check(documents, canonical_polygon=True)
        self.assertEqual(documents.mesh_number(), 2)
        self.assertEqual(documents.current_mesh_id(), 0)
        polygon = documents.mesh(1)
        self.assertEqual(polygon.edge_number(), 8 * 200)  # 4 sides for each handle
        points = 2 * polygon.vertex_matrix()[:, :2] - 1
        self.assertLess(numpy.hypot(points[:, 0], points[:, 1]).max(), 1.0)
        # Its sides are chained: except for the ends of sides, every point is the end of two edges.
        ends = numpy.bincount(polygon.edge_matrix().ravel(), minlength=len(points))
        self.assertEqual(set(ends) - {1, 2}, set())
        self.assertLessEqual(numpy.count_nonzero(ends == 1), 2 * 8)

    def test_too_many_rings_leave_the_mesh_alone(self):
        documents = mesh_set(meshes.double_torus())
        before = state(documents.current_mesh())
        with self.assertRaisesRegex(pymeshlab.PyMeshLabException, "universal_cover: 20 rings"):
            run(documents, common.HYPERBOLIC, universal_cover=20)
        self.assertEqual(documents.mesh_number(), 1)
        self.assertTrue(same(before, state(documents.current_mesh())))

    def test_two_surfaces(self):
        """Each has a group of its own, and a map of numbers has room for one."""
        one, both = meshes.double_torus(1), meshes.double_torus(1)
        both.faces += [tuple(v + len(one.vertices) for v in face) for face in one.faces]
        both.vertices += [(x + 9, y, z) for x, y, z in one.vertices]
        documents = mesh_set(both)
        returned = run(documents, common.HYPERBOLIC, canonical_polygon=True, generator_axes=True)
        self.assertTrue(returned["converged"])
        self.assertNotIn("generators", returned)
        self.assertAlmostEqual(returned["hyperbolic_area"], 8 * math.pi, delta=1e-9)
        self.assertEqual([documents.mesh(i).edge_number() for i in (1, 2)],
                         [2 * 4 * 200, 2 * 8 * 200])

    def test_numbers_out_of_range(self):
        for words, values in (
                ("epsilon.*greater than 0", {"epsilon": math.nan}),
                ("universal_cover.*0 to 20 rings", {"universal_cover": 21}),
                ("universal_cover.*0 to 20 rings", {"universal_cover": -1}),
                ("cone_angle", {"target_curvature": 1, "cone_angle": math.nan}),
                ("cone_angle", {"target_curvature": 1, "cone_angle": -math.inf}),
                ("time_limit.*number of seconds", {"time_limit": math.nan})):
            with self.subTest(values):
                documents = mesh_set(meshes.double_torus(1))
                select(documents, "vi == 0")
                before = state(documents.current_mesh())
                with self.assertRaisesRegex(pymeshlab.PyMeshLabException, words):
                    run(documents, common.HYPERBOLIC, **values)
                self.assertTrue(same(before, state(documents.current_mesh())))

    def test_refusals(self):
        for words, mesh, values in (
                ("Euler characteristic.*Euclidean", meshes.torus(), {}),
                ("2 pi chi", meshes.torus(),
                 {"target_curvature": "Cones at selected vertices", "cone_angle": 400.0}),
                ("cone_angle", meshes.torus(),
                 {"target_curvature": "Cones at selected vertices", "cone_angle": 0.0})):
            with self.subTest(words):
                documents = mesh_set(mesh)
                select(documents, "vi == 0")
                before = state(documents.current_mesh())
                with self.assertRaisesRegex(pymeshlab.PyMeshLabException, words):
                    run(documents, common.HYPERBOLIC, **values)
                self.assertTrue(same(before, state(documents.current_mesh())))

    def test_parameters_and_defaults(self):
        documents = mesh_set(meshes.double_torus(1))
        values = documents.filter_parameter_values(common.HYPERBOLIC.PYTHON_NAME)
        self.assertEqual(list(values), [name for name, _, _ in (
            common.HYPERBOLIC.PARAMETERS + common.HYPERBOLIC.RARE)])


class AnyTriangles(unittest.TestCase):
    """Meshes that are not oriented manifolds are cut open for the map, and stay as they are."""

    def check(self, mesh, counts, components, **values):
        documents = mesh_set(mesh)
        before = state(documents.current_mesh())[1][:2]
        returned = run(documents, **values)
        self.assertTrue(returned["converged"])
        self.assertEqual((returned["flipped_faces"], returned["flipped_by_rounding"]), (0, 0))
        self.assertEqual(returned["components"], components)
        for key in meshes.CUTS:
            if key in counts or key != "split_vertices":  # the vertices of a one-sided loop, too
                self.assertEqual(returned[key], counts.get(key, 0), key)
        after = documents.current_mesh()
        self.assertTrue(numpy.isfinite(after.wedge_tex_coord_matrix()).all())
        self.assertTrue(numpy.isfinite(after.vertex_scalar_array()).all())
        self.assertTrue(numpy.isfinite(after.vertex_custom_scalar_attribute_array("ricci_u")).all())
        return before, after, returned

    def test_keep_the_mesh(self):
        for name, mesh, counts, components in meshes.any_triangles():
            with self.subTest(name):
                before, after, _ = self.check(mesh, counts, components)
                self.assertTrue(numpy.array_equal(before[0], after.vertex_matrix()))
                self.assertTrue(numpy.array_equal(before[1], after.face_matrix()))
                self.assertEqual(flipped_faces(after), 0)

    def test_common_refinement(self):
        for name, mesh, counts, components in meshes.any_triangles():
            with self.subTest(name):
                before, after, returned = self.check(
                    mesh, counts, components, output_triangulation="Common refinement")
                count = len(before[0])
                self.assertEqual(after.vertex_number(), count + returned["refinement_points"])
                self.assertTrue(numpy.array_equal(before[0], after.vertex_matrix()[:count]))
                self.assertEqual(flipped_faces(after), 0)

    def test_faces_without_area_are_lines(self):
        mesh = meshes.plane(4)
        a, b, _ = mesh.faces[5]
        mesh = meshes.Mesh(mesh.vertices, [(a, a, b)] + mesh.faces + [(b, b, b)])
        before, after, _ = self.check(mesh, {"degenerate_faces": 2}, 1)
        self.assertTrue(numpy.array_equal(before[1], after.face_matrix()))
        areas = [meshes.uv_area(w) for w in after.wedge_tex_coord_matrix().reshape(-1, 3, 2)]
        self.assertEqual((areas[0], areas[-1]), (0, 0))
        self.assertTrue(all(area > 0 for area in areas[1:-1]))


class Seams(unittest.TestCase):
    """The surface is opened where the user wants it, and nowhere else but where it has to be."""

    @staticmethod
    def jumps(documents):
        """The edges, by their vertices, at which the texture coordinates jump."""
        mesh = documents.current_mesh()
        corners, jumps = {}, set()
        for face, uv in zip(mesh.face_matrix().tolist(),
                            mesh.wedge_tex_coord_matrix().reshape(-1, 3, 2).tolist()):
            for k in range(3):
                ends = sorted(((face[k], uv[k]), (face[(k + 1) % 3], uv[(k + 1) % 3])))
                edge = ends[0][0], ends[1][0]
                if corners.setdefault(edge, ends) != ends:
                    jumps.add(edge)
        return jumps

    def test_of_the_texture_stay(self):
        for make in (meshes.sphere, meshes.torus, meshes.double_torus):
            with self.subTest(make.__name__):
                documents = mesh_set(make())
                run(documents)
                before = self.jumps(documents)
                self.assertTrue(before)
                with tempfile.TemporaryDirectory() as folder:
                    path = os.path.join(folder, "mesh.ply")
                    documents.save_current_mesh(path)
                    documents = load(path)
                returned = run(documents, seams="Existing texture seams")
                self.assertEqual(returned["chosen_seam_edges"], len(before))
                self.assertEqual(returned["split_vertices"], 0)
                self.assertLessEqual(before, self.jumps(documents))

    def test_texture_without_seams(self):
        documents = mesh_set(meshes.hill())
        run(documents, cone_distortion=1.0)
        returned = run(documents, seams="Existing texture seams", cone_distortion=1.0)
        self.assertEqual((returned["chosen_seam_edges"], returned["charts"]), (0, 1))

    def test_along_creases(self):
        """The sides of a slab are plane."""
        documents = mesh_set(meshes.double_torus())
        documents.compute_selection_crease_per_edge()
        for output in ("Keep the mesh", "Common refinement"):
            returned = run(documents, seams="Selected edges", output_triangulation=output)
            self.assertEqual((returned["components"], returned["charts"]), (14, 14))
            self.assertEqual((returned["cones"], returned["seam_edges"]), (0, 0))
            self.assertAlmostEqual(returned["area_distortion_mean"], 1, delta=1e-5)
            self.assertAlmostEqual(returned["qc_max"], 1, delta=1e-4)
            self.assertEqual(returned["refinement_points"], 0)

    def test_round_selected_faces(self):
        documents = mesh_set(meshes.sphere())
        documents.compute_selection_by_condition_per_face(condselect="z0 + z1 + z2 > 0")
        returned = run(documents, seams="Border of selected faces", cone_distortion=1.0)
        self.assertEqual((returned["components"], returned["boundary_loops"]), (2, 2))
        self.assertEqual(returned["chosen_seam_edges"], 16)
        self.assertEqual((returned["cones"], returned["split_vertices"]), (0, 0))

    def test_hyperbolic(self):
        documents = mesh_set(meshes.double_torus())
        documents.compute_selection_by_condition_per_face(condselect="x0 + x1 + x2 > 7.5")
        returned = run(documents, common.HYPERBOLIC, seams="Border of selected faces")
        self.assertEqual((returned["components"], returned["genus"]), (2, 2))
        self.assertAlmostEqual(returned["hyperbolic_area"], 4 * math.pi, delta=1e-6)

    def test_nothing_chosen(self):
        for seams, words in (("Existing texture seams", "no texture coordinates"),
                             ("Selected edges", "no edge of a face is selected"),
                             ("Border of selected faces", "no edge lies between")):
            for our_filter in (common, common.HYPERBOLIC):
                documents = mesh_set(meshes.double_torus())
                before = state(documents.current_mesh())
                with self.assertRaisesRegex(pymeshlab.PyMeshLabException, words):
                    run(documents, our_filter, seams=seams)
                self.assertTrue(same(before, state(documents.current_mesh())))
        documents = mesh_set(meshes.sphere())
        documents.set_selection_all()
        with self.assertRaisesRegex(pymeshlab.PyMeshLabException, "no edge lies between"):
            run(documents, seams="Border of selected faces")


class BadInput(unittest.TestCase):
    """A clear sentence as PyMeshLabException, and the mesh untouched."""

    def check(self, words, mesh, condition=None, **values):
        documents = mesh if isinstance(mesh, pymeshlab.MeshSet) else mesh_set(mesh)
        if condition is not None:
            select(documents, condition)
        before = state(documents.current_mesh())
        with self.assertRaisesRegex(pymeshlab.PyMeshLabException, f"(?is)(?:{words}).*\\.$") as caught:
            run(documents, **values)
        self.assertEqual("Details: " in str(caught.exception), not BY_ARRAYS)
        self.assertTrue(same(before, state(documents.current_mesh())))
        self.assertEqual(documents.mesh_number(), 1)

    def test_no_mesh(self):
        error, words = ((ValueError, "holds no mesh") if BY_ARRAYS else
                        (pymeshlab.PyMeshLabException, "at least one mesh"))
        with self.assertRaisesRegex(error, words):
            run(mesh_set(None))

    def test_no_faces(self):
        empty = mesh_set(meshes.hill())
        empty.set_selection_all()
        empty.meshing_remove_selected_vertices_and_faces()
        for documents in (mesh_set(meshes.point_cloud()), empty):
            with self.assertRaisesRegex(pymeshlab.PyMeshLabException, "Any Faces|a point cloud"):
                run(documents)

    def test_degenerate(self):
        self.check("area", meshes.with_zero_area_face(meshes.plane()), method="Fixed triangles")
        self.check("length|area", meshes.with_zero_length_edge(meshes.torus()), method="Fixed triangles")
        for mesh, lengthened in ((meshes.with_zero_area_face(meshes.plane()), 1e-5),
                                 (meshes.with_zero_length_edge(meshes.torus()), 1.0)):
            returned = run(mesh_set(mesh), output_triangulation="Common refinement")
            self.assertTrue(returned["converged"])
            self.assertEqual(returned["flipped_faces"], 0)
            self.assertGreater(returned["lengthened"], 0)
            self.assertLessEqual(returned["lengthened"], lengthened)

    def test_refinement_without_flips(self):
        self.check("Intrinsic flips", meshes.torus(), method="Fixed triangles",
                   output_triangulation="Common refinement")

    def test_capped_without_flips(self):
        self.check("Intrinsic flips", meshes.annulus(), method="Fixed triangles", holes="Capped")

    def test_not_finite(self):
        self.check("finite|NaN|not a number", meshes.with_nan(meshes.torus()))

    def test_sphere_without_cones(self):
        self.check("at least 3", meshes.sphere(), cone_count=2)
        self.check("select", meshes.sphere(), target_curvature="Cones at selected vertices")
        self.check("2 ?pi.*cones", meshes.sphere(), "abs(z) > 0.99",
                   target_curvature="Cones at selected vertices")

    def test_topology_does_not_fit(self):
        self.check("Euler|flat", meshes.hill(), target_curvature="Flat everywhere")
        self.check("disk", meshes.torus(), target_curvature="Disk")
        self.check("four|corner|disk", meshes.annulus(), target_curvature="Rectangle")

    def test_corners(self):
        self.check("four|corner", meshes.hill(),
                   "(x==0 || x==1) && (y==0 || y==1) && (x+y < 1.5)", target_curvature="Rectangle")

    def test_quality(self):
        mesh = meshes.torus()
        self.check("quality", loaded(mesh), target_curvature="From vertex quality")
        self.check("Gauss|Euler|sum", meshes.with_quality(mesh, [0.01] * len(mesh.vertices)),
                   target_curvature="From vertex quality")
        self.check("finite|NaN|not a number",
                   meshes.with_quality(mesh, [float("nan")] * len(mesh.vertices)),
                   target_curvature="From vertex quality")

    def test_numbers_out_of_range(self):
        for words, values in (
                ("epsilon.*greater than 0", {"epsilon": 0.0}),
                ("epsilon.*greater than 0", {"epsilon": -1.0}),
                ("epsilon.*greater than 0", {"epsilon": float("nan")}),
                ("epsilon.*greater than 0", {"epsilon": math.inf}),
                ("cone_count.*0", {"cone_count": -1}),
                ("cone_distortion.*greater than 0", {"cone_distortion": -0.1}),
                ("cone_distortion.*greater than 0", {"cone_distortion": math.nan}),
                ("cone_distortion.*greater than 0", {"cone_distortion": math.inf}),
                ("seam_hiding.*from 0 to 1", {"seam_hiding": -0.1}),
                ("seam_hiding.*from 0 to 1", {"seam_hiding": math.nan}),
                ("padding.*0 to 512 pixels", {"padding": 513}),
                ("padding.*0 to 4 pixels", {"padding": 5, "texture_size": 16}),
                ("sharp_angle.*at most 180", {"seams": "Sharp edges", "sharp_angle": 0.0}),
                ("time_limit.*number of seconds", {"time_limit": math.nan}),
                ("time_limit.*number of seconds", {"time_limit": -1.0}),
                ("time_limit.*mesh is unchanged", {"time_limit": 1e-6})):
            with self.subTest(values):
                self.check(words, meshes.torus(), **values)

    def test_choices_out_of_range(self):
        """PyMeshLab itself refuses what is not a choice."""
        for values in ({"target_curvature": 7}, {"target_curvature": -1}, {"method": "Nonsense"}):
            documents = mesh_set(meshes.torus())
            before = state(documents.current_mesh())
            with self.assertRaisesRegex(Exception, "^Enum .* not (valid|found)|is not a choice"):
                run(documents, **values)
            self.assertTrue(same(before, state(documents.current_mesh())))

    @unittest.skipIf(BY_ARRAYS, "the sentences do not go through the host")
    def test_sentences_survive_the_host(self):
        """The host turns messages into the local 8-bit encoding, which may be plain ASCII."""
        # Below a folder whose name such a locale cannot express, Qt never stops searching for its own folder.
        environment = os.path.realpath(sys.prefix)
        if not environment.isascii():
            self.skipTest("PyMeshLab lies in a folder whose name is not ASCII: Qt hangs there in an ASCII locale")
        program = (
            "import sys; sys.argv = ['x', sys.argv[1]]\n"
            "import meshes, pymeshlab\n"
            "import pymeshlab_host as t\n"
            "try:\n"
            "    mesh = meshes.torus()\n"
            "    t.run(t.mesh_set(meshes.with_quality(mesh, [0.01] * len(mesh.vertices))),"
            " target_curvature=5)\n"
            "except pymeshlab.PyMeshLabException as e:\n"
            "    print(ascii(str(e)))\n")
        with tempfile.TemporaryDirectory() as folder:
            # In such a locale the host finds no plugin in a folder whose name is not ASCII, and
            # it follows links: so a copy.
            plugin = os.path.join("pymeshlab-2025.7", "libfilter_ricci.so")
            build = os.path.join(folder, "build")
            os.makedirs(os.path.dirname(os.path.join(build, plugin)))
            shutil.copy(os.path.join(common.BUILD, plugin), os.path.join(build, plugin))
            finished = subprocess.run(
                [os.path.join(environment, "bin", "python"), "-c", program, build], capture_output=True, text=True,
                cwd=os.path.dirname(os.path.abspath(__file__)), env={**os.environ, "LC_ALL": "C"})
        self.assertEqual(finished.returncode, 0, finished.stderr)
        self.assertNotIn("?", finished.stdout)
        self.assertIn("Details: ", finished.stdout)


class Faults(unittest.TestCase):
    """Whatever the host's process is like: a result as always, or a sentence and the old mesh."""

    @staticmethod
    def short_of_memory():
        """[sentence or result, whether the mesh is untouched] for less and less scarce memory."""
        expected = outcome(mesh_set(meshes.torus(90, 60)))
        answers = []
        for megabytes in [0, 1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 128, 256]:
            documents = mesh_set(meshes.torus(90, 60))
            before = state(documents.current_mesh())
            with open("/proc/self/statm", encoding="ascii") as source:
                used = int(source.read().split()[0]) * resource.getpagesize()
            limits = resource.getrlimit(resource.RLIMIT_AS)
            resource.setrlimit(resource.RLIMIT_AS, (used + (megabytes << 20), limits[1]))
            try:
                run(documents)
                answer = "solved"
            except pymeshlab.PyMeshLabException as refusal:
                answer = str(refusal)
            finally:
                resource.setrlimit(resource.RLIMIT_AS, limits)
            answers.append([answer, same(before, state(documents.current_mesh())),
                            outcome(documents) == expected])
        return answers

    @unittest.skipIf(BY_ARRAYS, "Python and the host have errors of their own where the library has none")
    def test_short_of_memory(self):
        answers = in_a_process("Faults.short_of_memory()")
        self.assertEqual((answers[0][0] == "solved", answers[-1][0]), (False, "solved"))
        for answer, untouched, goes_on in answers:
            self.assertTrue(goes_on)
            if answer != "solved":
                self.assertRegex(answer, "There is not enough memory for this mesh.|GB are free")
                self.assertTrue(untouched)

    @staticmethod
    def with_traps(name):
        libm = ctypes.CDLL("libm.so.6")
        mesh, our_filter, values = OneProcess.RUNS[name]
        documents = mesh_set(mesh())
        traps = 1 | 4 | 8  # invalid, division by zero, overflow on x86
        libm.feclearexcept(61)
        libm.feenableexcept(traps)
        returned = run(documents, our_filter, **values)
        left = libm.fegetexcept()
        libm.fedisableexcept(traps)
        return [left == traps, described(documents, returned)]

    @unittest.skipIf(BY_ARRAYS, "PyMeshLab's own filter for attributes computes with memory that nobody has set")
    def test_host_that_traps_floating_point_exceptions(self):
        if platform.machine() != "x86_64":
            self.skipTest("the numbers of the traps are those of x86-64")
        for name in OneProcess.RUNS:
            with self.subTest(name):
                kept, found = in_a_process(f"Faults.with_traps({name!r})")
                self.assertTrue(kept)
                self.assertEqual(found, in_a_process(f"OneProcess.alone({name!r})"))

    @staticmethod
    def with_commas(folder):
        locale.setlocale(locale.LC_ALL, "de_DE.UTF-8")
        documents = load(os.path.join(folder, "torus.ply"))
        found = outcome(documents, report="data.csv")
        with open(os.path.join(folder, "data.csv"), encoding="utf-8") as source:
            report = source.read()
        try:
            run(documents, epsilon=-0.5)
        except pymeshlab.PyMeshLabException as refusal:
            return [locale.str(0.5), found, report, str(refusal)]

    def test_host_with_decimal_commas(self):
        places = os.path.join(common.BUILD, "locales")
        environment = {"LOCPATH": places} if os.path.isdir(places) else {}
        with tempfile.TemporaryDirectory() as folder:
            meshes.write_ply(os.path.join(folder, "torus.ply"), meshes.torus())
            expected = outcome(load(os.path.join(folder, "torus.ply")), report="data.csv")
            with open(os.path.join(folder, "data.csv"), encoding="utf-8") as source:
                report = source.read()
            try:
                found = in_a_process(f"Faults.with_commas({folder!r})", environment)
            except AssertionError as problem:
                if "unsupported locale" not in str(problem):
                    raise
                self.skipTest("this machine has no locale with decimal commas")
        self.assertEqual(found[:3], ["0,5", expected, report])
        self.assertIn("The value -0.5 of epsilon", found[3])

    @unittest.skipIf(BY_ARRAYS, "PyMeshLab has one attribute of a name")
    def test_attributes_of_the_same_name(self):
        straight = mesh_set(meshes.torus())
        run(straight, cone_distortion=1.0)
        u = straight.current_mesh().vertex_custom_scalar_attribute_array("ricci_u")
        documents = mesh_set(meshes.torus())
        mesh = documents.current_mesh()
        mesh.add_vertex_custom_point_attribute(mesh.vertex_matrix(), "ricci_u")
        mesh.add_vertex_custom_scalar_attribute(numpy.full(mesh.vertex_number(), 7.0),
                                                "ricci_target_curvature")
        mesh.add_face_custom_scalar_attribute(numpy.full(mesh.face_number(), 3.0), "ricci_u")
        with self.assertRaises(pymeshlab.PyMeshLabException):
            run(documents, target_curvature="Disk")
        self.assertTrue(numpy.array_equal(
            mesh.vertex_custom_point_attribute_matrix("ricci_u"), mesh.vertex_matrix()))
        run(documents, cone_distortion=1.0)
        self.assertTrue(numpy.array_equal(
            mesh.vertex_custom_scalar_attribute_array("ricci_u"), u))
        self.assertEqual(
            numpy.ptp(mesh.vertex_custom_scalar_attribute_array("ricci_target_curvature")), 0.0)
        self.assertTrue((mesh.face_custom_scalar_attribute_array("ricci_u") == 3.0).all())


class Treatment(unittest.TestCase):
    """What the filter repairs for the run by itself."""

    def test_orientation(self):
        straight = run(mesh_set(meshes.torus()), cone_distortion=1.0)
        documents = mesh_set(meshes.with_flipped_faces(meshes.torus()))
        faces = documents.current_mesh().face_matrix()
        returned = run(documents, cone_distortion=1.0)
        self.assertAlmostEqual(returned["qc_mean"], straight["qc_mean"], delta=1e-6)
        self.assertTrue(numpy.array_equal(faces, documents.current_mesh().face_matrix()))

    def test_unreferenced_vertex(self):
        documents = mesh_set(meshes.with_unreferenced_vertex(meshes.torus()))
        self.assertTrue(run(documents)["converged"])
        self.assertTrue(numpy.isfinite(documents.current_mesh().vertex_scalar_array()).all())

    def test_quads(self):
        documents = mesh_set(None)
        grid = meshes.hill(4)
        quads = [[i * 5 + j, (i + 1) * 5 + j, (i + 1) * 5 + j + 1, i * 5 + j + 1]
                 for i in range(4) for j in range(4)]
        documents.add_mesh(pymeshlab.Mesh(vertex_matrix=numpy.array(grid.vertices),
                                          face_list_of_indices=quads))
        self.assertTrue(run(documents)["converged"])


def outcome(documents, our_filter=common, **values):
    """All that a run returns and leaves behind, bit for bit."""
    return described(documents, run(documents, our_filter, **values))


def described(documents, returned):
    returned = {key: numpy.asarray(value).tobytes().hex() for key, value in returned.items()}
    flags, arrays = state(documents.current_mesh())
    mesh = documents.current_mesh()
    arrays += [mesh.vertex_custom_scalar_attribute_array(name)
               for name in ("ricci_u", "ricci_target_curvature")]
    digest = hashlib.sha256(b"".join(numpy.ascontiguousarray(a).tobytes() for a in arrays))
    return repr((sorted(returned.items()), flags, digest.hexdigest()))


class OneProcess(unittest.TestCase):
    """Runs that share a process know nothing of each other: each gives what it gives alone."""

    RUNS = {"flat torus": (meshes.torus, common, {}),
            "hyperbolic slab": (meshes.double_torus, common.HYPERBOLIC, {}),
            "slab with cones": (meshes.double_torus, common, {"cone_count": 4}),
            "round disk": (meshes.hill, common, {"target_curvature": 2, "colorize": True}),
            "refined torus": (meshes.torus, common, {"output_triangulation": 1})}

    @staticmethod
    def alone(name):
        mesh, our_filter, values = OneProcess.RUNS[name]
        return outcome(mesh_set(mesh()), our_filter, **values)

    def same_as_alone(self, documents, name):
        _, our_filter, values = self.RUNS[name]
        self.assertEqual(outcome(documents, our_filter, **values),
                         in_a_process(f"OneProcess.alone({name!r})"), name)

    def refused(self, documents, our_filter=common, **values):
        before = state(documents.current_mesh())
        with self.assertRaises(pymeshlab.PyMeshLabException):
            run(documents, our_filter, **values)
        self.assertTrue(same(before, state(documents.current_mesh())))

    def test_two_documents(self):
        torus, slab = mesh_set(meshes.torus()), mesh_set(meshes.double_torus())
        untouched = state(slab.current_mesh())
        self.same_as_alone(torus, "flat torus")
        self.assertTrue(same(untouched, state(slab.current_mesh())))
        done = state(torus.current_mesh())
        self.same_as_alone(slab, "hyperbolic slab")
        self.assertTrue(same(done, state(torus.current_mesh())))
        self.same_as_alone(torus, "flat torus")
        self.refused(slab, common.HYPERBOLIC, universal_cover=20)
        self.refused(slab, target_curvature="Disk")
        self.same_as_alone(torus, "flat torus")
        self.same_as_alone(slab, "slab with cones")
        self.refused(torus, common.HYPERBOLIC)
        self.same_as_alone(torus, "refined torus")
        self.same_as_alone(slab, "hyperbolic slab")

    def test_layers_of_one_document(self):
        documents = mesh_set(meshes.torus())
        for mesh in (meshes.double_torus(), meshes.hill()):
            documents.add_mesh(pymeshlab.Mesh(
                vertex_matrix=numpy.array(mesh.vertices),
                face_matrix=numpy.array(mesh.faces, dtype=numpy.int32)))
        for layer, name in ((0, "flat torus"), (1, "hyperbolic slab"), (2, "round disk"),
                            (0, "flat torus"), (1, "slab with cones"), (0, "refined torus")):
            documents.set_current_mesh(layer)
            others = [state(documents.mesh(i)) for i in range(3) if i != layer]
            self.same_as_alone(documents, name)
            if not BY_ARRAYS or name != "refined torus":  # a new layer
                self.assertEqual(documents.current_mesh_id(), layer)
            for before, i in zip(others, [i for i in range(3) if i != layer]):
                self.assertTrue(same(before, state(documents.mesh(i))))

    def test_one_after_the_other(self):
        documents = mesh_set(meshes.torus())
        first = run(documents)
        after = state(documents.current_mesh())
        self.assertEqual(run(documents), first)
        self.assertTrue(same(after, state(documents.current_mesh())))


if __name__ == "__main__":
    common.main()
