# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python package: the wheel in an empty environment, and what a program gets from it.
Usage: test_wheel.py BUILD_DIR [TEST...], with PyMeshLab's Python."""

import ast
import base64
import concurrent.futures
import copy
import glob
import hashlib
import inspect
import multiprocessing
import os
import pickle
import re
import signal
import subprocess
import sys
import sysconfig
import tempfile
import threading
import time
import unittest
import xml.etree.ElementTree
import zipfile

import common
import meshes

try:
    from matplotlib import image
except ImportError:
    image = None
sys.path.insert(0, os.path.join(common.BUILD, "python"))
try:
    import numpy
    import pymeshlab
except ImportError as problem:
    common.skip(f"PyMeshLab cannot be imported here: {problem}")
if not os.path.isdir(os.path.join(common.BUILD, "python")):
    common.skip("the Python package is not built")

import pymeshlab_ricci
import pymeshlab_ricci.xatlas
from pymeshlab_ricci import flatten, uniformize
from pymeshlab_ricci._filters import DESCRIPTIONS

FILTERS = ((common, flatten, DESCRIPTIONS[0]), (common.HYPERBOLIC, uniformize, DESCRIPTIONS[1]))


def read(*path):
    with open(os.path.join(common.REPOSITORY, *path), encoding="utf-8") as source:
        return source.read()


def arrays(mesh):
    return numpy.array(mesh.vertices, dtype=float), numpy.array(mesh.faces)


def wheel_file():
    version = re.search(r"project\(\w+ VERSION ([\d.]+)", read("CMakeLists.txt")).group(1)
    found, = glob.glob(os.path.join(common.BUILD, "release", f"pymeshlab_ricci-{version}-*.whl"))
    return found


class Wheel(unittest.TestCase):
    def test_content(self):
        """Every file has the hash that the wheel states, and the tag is that of the plugin."""
        with zipfile.ZipFile(wheel_file()) as wheel:
            files = {name: wheel.read(name) for name in wheel.namelist()}
        record, = (name for name in files if name.endswith("/RECORD"))
        stated = dict(line.split(",", 1) for line in files[record].decode().splitlines())
        self.assertEqual(set(stated), set(files))
        for name, data in files.items():
            if name != record:
                digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).decode()
                self.assertEqual(stated[name], f"sha256={digest.rstrip('=')},{len(data)}")
        licences = [os.path.basename(name) for name in files if "/licenses/" in name]
        self.assertIn("LICENSE", licences)
        newest = int(re.search(r"-py3-none-manylinux_2_(\d+)_", wheel_file()).group(1))
        plugin = files["pymeshlab_ricci/libfilter_ricci.so"]
        needed = [int(minor) for minor in re.findall(rb"GLIBC_2\.(\d+)", plugin)]
        self.assertLessEqual(max(needed), newest)
        self.assertEqual(newest, 35, "PyMeshLab's own wheels need no newer C library")

    def test_metadata(self):
        """The wheel says of the package what the README says, and names its command."""
        with zipfile.ZipFile(wheel_file()) as wheel:
            text, = (wheel.read(name).decode() for name in wheel.namelist() if name.endswith("/METADATA"))
        said = re.search(r"```\n\n(Two MeshLab filters .*?)\n\n", read("README.md"), re.DOTALL).group(1)
        self.assertIn(said, text)
        self.assertIn(re.search(r"  - name: (.*)", read("CITATION.cff")).group(1), text)

    def test_in_an_empty_environment(self):
        """Installed by pip, which finds its needs fulfilled; then the README's first code runs."""
        code = re.search(r"```python\n(.*?)```", read("README.md"), re.DOTALL).group(1)
        self.assertEqual(read("README.md").index("```"), read("README.md").index("```python"))
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, "-m", "venv", folder], check=True)
            python = os.path.join(folder, "bin", "python")
            place, = glob.glob(os.path.join(folder, "lib", "python3*", "site-packages"))
            # PyMeshLab is that of this Python, so that no package index is needed.
            with open(os.path.join(place, "pymeshlab.pth"), "w", encoding="utf-8") as link:
                link.write(sysconfig.get_path("purelib") + "\n")
            environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}

            def run(*command):
                done = subprocess.run([python, *command], capture_output=True, text=True,
                                      cwd=folder, env=environment)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                return done.stdout
            run("-m", "pip", "install", "-q", "--no-index", "--no-deps", "--force-reinstall",
                wheel_file())
            self.assertIn("pymeshlab>=2025.7,<2025.8", run(
                "-c", "import importlib.metadata as m; print(*m.requires('pymeshlab-ricci'))"))
            problems = subprocess.run([python, "-m", "pip", "check"], env=environment,
                                      capture_output=True, text=True)
            self.assertNotIn("pymeshlab-ricci", problems.stdout)
            run("-c", code)
            self.assertTrue(os.path.exists(os.path.join(folder, "torus.obj")))
            run("-m", "pymeshlab_ricci", "torus.obj", "again.ply", "--output-triangulation", "1")
            self.assertIsNotNone(meshes.read_ply(os.path.join(folder, "again.ply")).wedges)
            command = os.path.join(folder, "bin", "pymeshlab-ricci")
            version = subprocess.run([command, "--version"], capture_output=True, text=True, check=True,
                                     env=environment).stdout
            self.assertEqual(version, f"pymeshlab-ricci {os.path.basename(wheel_file()).split('-')[1]}\n")
            run("-m", "pip", "uninstall", "-q", "-y", "pymeshlab-ricci")
            self.assertEqual(glob.glob(os.path.join(place, "*ricci*")), [])

    def test_found_by_its_words(self):
        """MeshLab's search field takes the first letters, three at least, of a word of name or text."""
        words = re.split(r"\W+", (DESCRIPTIONS[0]["name"] + " " + DESCRIPTIONS[0]["info"]).lower())
        for wanted in ("uv", "unwrap", "flatten", "parametrization", "conformal", "ricci"):
            self.assertTrue([word for word in words if word.startswith(wanted)], wanted)

    def test_documents_are_current(self):
        script = os.path.join(common.REPOSITORY, "filter_ricci", "scripts", "document_filters.py")
        environment = {**os.environ, "PYTHONPATH": os.path.join(common.BUILD, "python")}
        done = subprocess.run([sys.executable, script, "--check"], capture_output=True, text=True,
                              env=environment)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


def large():
    """A mesh on which the filter works for seconds."""
    return arrays(meshes.torus(columns=400, rows=200))


class Progress(unittest.TestCase):
    def test_told(self):
        heard = []
        flatten(*arrays(meshes.torus()), progress=lambda *told: heard.append(told))
        self.assertEqual(heard[-1], (1.0, "Done"))
        for fraction, what in heard:
            self.assertTrue(0.0 <= fraction <= 1.0 and what, (fraction, what))
        self.assertEqual([f for f, _ in heard], sorted(f for f, _ in heard))

    def test_bar(self):
        """On standard error: tqdm's, or a line without it."""
        code = ("import sys, pymeshlab_ricci as r\n{}\n"
                "import meshes; m = meshes.torus(); r.flatten(m.vertices, m.faces, progress=True)")
        environment = {**os.environ, "PYTHONPATH": os.path.join(common.BUILD, "python")}
        for before in ("", "sys.modules['tqdm'] = sys.modules['tqdm.auto'] = None"):
            done = subprocess.run([sys.executable, "-c", code.format(before)], capture_output=True,
                                  text=True, env=environment, check=True,
                                  cwd=os.path.dirname(os.path.abspath(__file__)))
            self.assertEqual(done.stdout, "")
            self.assertIn("100%", done.stderr)

    def ended(self, documents, problem, stop, **parameters):
        """Seconds from a stop at the first sign of life to the end of the call."""
        stopped = []

        def tell(*_):
            if not stopped:
                stopped.append(time.monotonic())
                stop()

        with self.assertRaises(problem):
            flatten(documents, progress=tell, **parameters)
        return time.monotonic() - stopped[0]

    def test_ctrl_c(self):
        """The run ends within a second, and mesh, layers and files are as they were."""
        vertices, faces = large()
        documents = pymeshlab.MeshSet()
        documents.add_mesh(pymeshlab.Mesh(vertices, faces.astype(numpy.int32)))

        def interrupt():
            os.kill(os.getpid(), signal.SIGINT)

        def fail():
            raise ZeroDivisionError

        with tempfile.TemporaryDirectory() as folder:
            for problem, stop in ((KeyboardInterrupt, interrupt), (ZeroDivisionError, fail)):
                seconds = self.ended(documents, problem, stop, flat_layer=True,
                                     report=os.path.join(folder, "run.html"))
                self.assertLess(seconds, 1.0)
            self.assertEqual(os.listdir(folder), [])
        self.assertEqual(documents.mesh_number(), 1)
        self.assertFalse(documents.current_mesh().has_wedge_tex_coord())
        self.assertEqual([t.name for t in threading.enumerate() if "ricci" in t.name], [])
        self.assertEqual(flatten(*arrays(meshes.torus())).flipped_faces, 0)

    def test_ctrl_c_in_a_method(self):
        documents = pymeshlab.MeshSet()
        vertices, faces = large()
        documents.add_mesh(pymeshlab.Mesh(vertices, faces.astype(numpy.int32)))
        threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
        started = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            documents.compute_texcoord_parametrization_ricci_flow_euclidean_per_wedge()
        self.assertLess(time.monotonic() - started, 1.3)


class Functions(unittest.TestCase):
    def test_every_way_in(self):
        vertices, faces = arrays(meshes.torus())
        expected = flatten((vertices, faces), cone_distortion=1.0)
        documents = pymeshlab.MeshSet()
        documents.add_mesh(pymeshlab.Mesh(vertices, faces.astype(numpy.int32)))
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "torus.ply")
            documents.save_current_mesh(path, binary=True)
            from_path = flatten(path, cone_distortion=1.0)
        mesh = flatten(documents.current_mesh(), cone_distortion=1.0)
        inside = flatten(documents, cone_distortion=1.0)
        self.assertIs(inside.mesh_set, documents)
        apart = flatten(vertices, faces, cone_distortion=1.0)
        lists = flatten(vertices.tolist(), faces=faces.tolist(), cone_distortion=1.0)
        has_both = flatten(meshes.torus(), cone_distortion=1.0)
        for result in (mesh, inside, apart, lists, has_both):
            self.assertTrue(numpy.array_equal(result.uv, expected.uv))
            self.assertEqual(set(result.results), set(expected.results))
            for key, value in expected.results.items():
                self.assertTrue(numpy.array_equal(result.results[key], value), key)
        self.assertAlmostEqual(from_path.torus_tau_im, expected.torus_tau_im, delta=1e-4)
        self.assertEqual((expected.uv.shape, expected.quality.shape, expected.log_radius.shape),
                         ((len(faces), 3, 2), (len(vertices),), (len(vertices),)))
        self.assertTrue(numpy.array_equal(expected.faces, faces))
        self.assertIn("charts=1", repr(expected))

    def test_samples(self):
        """One mesh, then along the seams it got, then along its creases."""
        environment = {**os.environ, "PYTHONPATH": os.path.join(common.BUILD, "python")}
        with tempfile.TemporaryDirectory() as folder:
            path = {name: os.path.join(folder, name) for name in ("in.ply", "one.ply", "two.obj")}
            meshes.write_ply(path["in.ply"], meshes.double_torus())

            def run(sample, *arguments):
                script = os.path.join(common.REPOSITORY, "filter_ricci", "samples", sample)
                return subprocess.run([sys.executable, script, *arguments], text=True, check=True,
                                      stdout=subprocess.PIPE, env=environment).stdout

            self.assertRegex(run("one_mesh.py", path["in.ply"], path["one.ply"]), r"^\d+ charts")
            self.assertRegex(run("chosen_seams.py", path["one.ply"], path["two.obj"]),
                             r"^\d\d+ edges as chosen, 0 more, \d+ charts")
            self.assertRegex(run("chosen_seams.py", path["in.ply"], path["two.obj"], "60"),
                             "edges as chosen, 0 more, 14 charts")
            with open(path["two.obj"], encoding="utf-8") as source:
                self.assertGreater(sum(line.startswith("vt ") for line in source),
                                   len(meshes.double_torus().vertices))

    @unittest.skipIf(image is None, "Matplotlib is not installed")
    def test_paper_figures(self):
        """On thin triangles the conventional flow's half has red where the other has blue."""
        script = os.path.join(common.REPOSITORY, "filter_ricci", "samples", "paper_figures.py")
        environment = {**os.environ, "PYTHONPATH": os.path.join(common.BUILD, "python")}
        with tempfile.TemporaryDirectory() as folder:
            mesh, picture = os.path.join(folder, "thin.ply"), os.path.join(folder, "thin.png")
            meshes.write_ply(mesh, meshes.torus(columns=80, rows=8))
            subprocess.run([sys.executable, script, mesh, picture], check=True, env=environment)
            above, below = numpy.array_split(image.imread(picture)[..., :3], 2)

        def pixels(half, low, high):
            return ((half >= low) & (half <= high)).all(axis=2).sum()
        red, blue = ((0.49, 0.0, 0.0), (0.51, 0.0, 0.0)), ((0.0, 0.3, 0.99), (0.2, 1.0, 1.0))
        self.assertGreater(pixels(above, *red), 2000 + 5 * pixels(below, *red))
        self.assertGreater(pixels(below, *blue), 2000 + 5 * pixels(above, *blue))

    def test_indexed(self):
        result = flatten(arrays(meshes.torus()), cone_distortion=1.0)
        points, index = result.indexed()
        self.assertTrue(numpy.array_equal(points[index], result.uv))
        # Euler: the cut doubles the edges of the seam and makes a disk of the torus.
        self.assertEqual(len(points), len(result.vertices) + result.seam_edges + 1)

    def test_selected_and_curvature(self):
        vertices, faces = arrays(meshes.sphere())
        poles = numpy.flatnonzero((abs(vertices[:, 2]) > 0.99) | (abs(vertices[:, 0]) > 0.99))
        result = flatten((vertices, faces), selected=poles)
        self.assertTrue(numpy.array_equal(numpy.flatnonzero(result.target_curvature), poles))
        mask = numpy.zeros(len(vertices), dtype=bool)
        mask[poles] = True
        for again in (flatten((vertices, faces), selected=mask),
                      flatten((vertices, faces), curvature=result.target_curvature)):
            self.assertTrue(numpy.allclose(again.uv, result.uv, atol=1e-6))

    def test_again_in_one_mesh_set(self):
        vertices, faces = arrays(meshes.sphere())
        documents = pymeshlab.MeshSet()
        documents.add_mesh(pymeshlab.Mesh(vertices, faces.astype(numpy.int32)))
        order = numpy.argsort(vertices[:, 2])
        for cones in (order[[0, 1, -1]], order[[0, 1, -2, -1]]):
            for given in ({"selected": cones}, {"curvature": numpy.where(
                    numpy.isin(range(len(vertices)), cones), 4 * numpy.pi / len(cones), 0.0)}):
                result = flatten(documents, **given)
                self.assertTrue(numpy.allclose(result.target_curvature[cones],
                                               4 * numpy.pi / len(cones)))
                self.assertEqual(numpy.count_nonzero(result.target_curvature), len(cones))

    def test_uniformize(self):
        result = uniformize(arrays(meshes.double_torus()), generator_axes=True)
        self.assertLess(abs(result.disk).max(), 1.0)
        self.assertAlmostEqual(result.hyperbolic_area, 4 * numpy.pi, delta=1e-6)
        self.assertEqual(result.generators.shape, (4, 2, 2))
        self.assertTrue(numpy.allclose(numpy.linalg.det(result.generators), 1.0))
        a1, b1, a2, b2 = result.generators
        inverse = numpy.linalg.inv
        relation = a1 @ b1 @ inverse(a1) @ inverse(b1) @ a2 @ b2 @ inverse(a2) @ inverse(b2)
        self.assertTrue(numpy.allclose(relation, relation[0, 0].real.round() * numpy.eye(2)))
        high, low = result.generators, result.generators_low
        self.assertEqual(high.shape, low.shape)
        for part in (numpy.real, numpy.imag):
            self.assertTrue((abs(part(low)) <= 2.0 ** -53 * abs(part(high))).all())
        self.assertTrue(low.any())
        self.assertLess(result.generators_error, 1e-8)

    def test_refusals(self):
        good = arrays(meshes.hill())
        with self.assertRaisesRegex(pymeshlab_ricci.Refused, "^'Flat everywhere' needs"):
            flatten(good, target_curvature="Flat everywhere")
        with self.assertRaisesRegex(pymeshlab_ricci.Refused, "^The mesh is a point cloud"):
            flatten(pymeshlab.Mesh(good[0]))
        with self.assertRaisesRegex(ValueError, "holds no mesh"):
            flatten(pymeshlab.MeshSet(), selected=[0])
        for mistakes in ([0.5], [-1], [len(good[0])]):
            with self.assertRaisesRegex(ValueError, "^selected must hold indices"):
                flatten(good, selected=mistakes)
        with self.assertRaises(ValueError):
            flatten(good, curvature=[0.0])

    def test_layers(self):
        """By what they are; those of the disk lie in the unit disk, where the corners lie too."""
        result = uniformize(arrays(meshes.double_torus()), flat_layer=True, universal_cover=1,
                            generator_axes=True, canonical_polygon=True)
        layers = result.layers
        self.assertEqual(set(layers), {"disk", "cover", "axes", "polygon"})
        for layer in layers.values():
            self.assertLess(numpy.linalg.norm(layer.vertices, axis=1).max(), 1.0 + 1e-6)
            self.assertTrue(len(layer.faces) or len(layer.edges))
        x, y, _ = layers["disk"].vertices[layers["disk"].faces].transpose(2, 0, 1)
        self.assertTrue(numpy.allclose(x + 1j * y, result.disk, atol=1e-6))
        documents = pymeshlab.MeshSet()
        documents.create_sphere()
        self.assertEqual(set(flatten(documents, flat_layer=True, sphere_layer=True).layers),
                         {"flat", "sphere"})
        again = flatten(documents, sphere_layer=True)  # not those of the first run
        self.assertEqual(set(again.layers), {"sphere"})
        self.assertTrue(numpy.allclose(numpy.linalg.norm(again.layers["sphere"].vertices, axis=1), 1.0))

    def test_gltf(self):
        """By trimesh; PyMeshLab reads the same coordinates back. Of a scene all meshes are taken."""
        try:
            import trimesh
        except ImportError as problem:
            with self.assertRaisesRegex(ImportError, "pip install trimesh"):
                flatten(arrays(meshes.torus())).save("torus.glb")
            self.skipTest(f"trimesh cannot be imported: {problem}")
        try:
            import PIL.Image
        except ImportError as problem:
            self.skipTest(f"Pillow cannot be imported: {problem}")
        vertices, faces = arrays(meshes.double_torus())
        result = flatten(vertices, faces)
        with tempfile.TemporaryDirectory() as folder:
            for ending in (".glb", ".gltf"):
                path = os.path.join(folder, "one" + ending)
                result.save(path)
                again = pymeshlab.MeshSet()
                again.load_new_mesh(path)
                uv = again.current_mesh().wedge_tex_coord_matrix().reshape(-1, 3, 2)
                self.assertLess(abs(uv - result.uv).max(), 1e-6)
                self.assertEqual(again.current_mesh().texture_number(), 0)
            self.assertEqual(sorted(os.listdir(folder)), ["one.glb", "one.gltf"])
            scene = trimesh.Scene([trimesh.Trimesh(vertices, faces),
                                   trimesh.Trimesh(vertices + 9.0, faces)])
            scene.export(os.path.join(folder, "two.glb"))
            for given in (scene, os.path.join(folder, "two.glb")):
                self.assertEqual(len(flatten(given).faces), 2 * len(faces))
            # A texture that is drawn anew goes with the mesh, an old one does not.
            white = trimesh.visual.material.SimpleMaterial(image=PIL.Image.new("RGB", (8, 8), "white"))
            points = result.vertices[:, :2]
            trimesh.Trimesh(result.vertices, result.faces, process=False,
                            visual=trimesh.visual.TextureVisuals(uv=points, material=white)).export(
                                os.path.join(folder, "old.glb"))
            for texture in ("", os.path.join(folder, "new.png")):
                result = flatten(os.path.join(folder, "old.glb"), carry_texture=texture, texture_size=64)
                for name in ("saved.ply", "saved.obj", "saved.glb"):
                    result.save(os.path.join(folder, name))
                saved = trimesh.load(os.path.join(folder, "saved.glb"), force="mesh")
                image = saved.visual.material.baseColorTexture
                self.assertEqual(image and image.size, (64, 64) if texture else None)

    def test_pickled(self):
        """Copies, and results of other processes, have and save the same."""
        vertices, faces = arrays(meshes.double_torus())
        result = flatten(vertices, faces, flat_layer=True)
        with concurrent.futures.ProcessPoolExecutor(
                1, multiprocessing.get_context("fork")) as pool:
            elsewhere = pool.submit(flatten, vertices, faces, flat_layer=True).result()
        with tempfile.TemporaryDirectory() as folder:
            def saved(one):
                path = os.path.join(folder, "one.ply")
                one.save(path)
                mesh = meshes.read_ply(path)
                return mesh.vertices, mesh.faces, mesh.wedges
            expected = saved(result)
            for other in (pickle.loads(pickle.dumps(result)), copy.deepcopy(result), elsewhere):
                self.assertIs(type(other), type(result))
                self.assertEqual(repr(other), repr(result))
                for key in ("vertices", "faces", "uv", "quality", "log_radius", "target_curvature"):
                    self.assertTrue(numpy.array_equal(getattr(other, key), getattr(result, key)), key)
                self.assertEqual(saved(other), expected)
                self.assertEqual([m.label() for m in other.mesh_set][:-1],
                                 [m.label() for m in result.mesh_set][1:])
                self.assertTrue(numpy.array_equal(other.layers["flat"].vertices,
                                                  result.layers["flat"].vertices))

    def test_picture(self):
        """The charts as SVG: the area inside the outlines is that of the faces in the plane."""
        result = flatten(arrays(meshes.double_torus()))
        text = result._repr_html_()
        svg = xml.etree.ElementTree.fromstring(text[:text.index("</svg>") + 6])
        path = svg.find("{http://www.w3.org/2000/svg}path").get("d")
        area = 0.0
        for outline in path.strip("MZ").split("ZM"):
            x, y = numpy.array([point.split() for point in outline.split("L")], dtype=float).T
            area += 0.5 * (x @ numpy.roll(y, -1) - y @ numpy.roll(x, -1))
        (ax, ay), (bx, by) = ((result.uv[:, k] - result.uv[:, 0]).T for k in (1, 2))
        extent = numpy.ptp(result.uv.reshape(-1, 2), axis=0).max()
        scale = (max(map(float, svg.get("viewBox").split()[2:])) - 2) / extent
        self.assertAlmostEqual(-area / scale ** 2, 0.5 * (ax * by - ay * bx).sum(), delta=0.001)

    def test_slips(self):
        """Those of the caller are Python's own errors, and suggest what was meant."""
        good = arrays(meshes.hill())
        for bad in ((good[0][:, :2], good[1]), (good[0], good[1] + 1), (good[0], good[1] + 0.5),
                    (good[0], good[1] - 1), (good[0][:0], good[1][:0]), (good[0], good[1][:0])):
            with self.assertRaises(ValueError):
                flatten(bad)
        for bad in (None, 3, object(), good[0]):
            with self.assertRaisesRegex(TypeError, "^A mesh is a path, vertices and faces"):
                flatten(bad)
        for error, pattern, slip in (
                (TypeError, "'cone_distorsion': did you mean 'cone_distortion'", {"cone_distorsion": 1}),
                (ValueError, "'Disc' is no choice: did you mean 'Disk'", {"target_curvature": "Disc"}),
                (ValueError, "'Torus' is no choice: .*'Flat everywhere'", {"target_curvature": "Torus"}),
                (ValueError, "^target_curvature: 99", {"target_curvature": 99}),
                (TypeError, "^cone_distortion must be of type float", {"cone_distortion": "a"}),
                (TypeError, "^flat_layer must be of type bool", {"flat_layer": "yes"}),
                (TypeError, "^texture_size must be of type int", {"texture_size": 2.5}),
                (TypeError, "^selected must hold numbers, not 'first'", {"selected": "first"}),
                (TypeError, "^selected must hold numbers, not {0: 1}", {"selected": {0: 1}}),
                (TypeError, "^curvature must hold numbers, not .'a'", {"curvature": ["a"]}),
                (TypeError, "^progress must be True or a function, not 'bar'", {"progress": "bar"}),
                (ValueError, "cannot be used", {"cone_distortion": -1.0}),
                (FileNotFoundError, "there is no folder", {"report": "no such folder/report.html"})):
            with self.assertRaisesRegex(error, pattern):
                flatten(good, **slip)
        documents = pymeshlab.MeshSet()
        documents.create_torus()
        with self.assertRaisesRegex(TypeError, "did you mean 'seams'"):
            documents.compute_texcoord_parametrization_ricci_flow_euclidean_per_wedge(seam="Shortest")
        result = flatten(good)
        for path, error, pattern in (("hill.stl", ValueError, "ends in .ply or .obj or .glb"),
                                     ("no such folder/hill.ply", FileNotFoundError, "no such folder")):
            with self.assertRaisesRegex(error, pattern):
                result.save(path)
        flatten(good, target_curvature="disk", flat_layer=numpy.True_, cone_distortion=numpy.float32(1))

    def test_files(self):
        """One that is missing, one that is broken, and relative names."""
        with self.assertRaisesRegex(FileNotFoundError, "no such file.ply"):
            flatten("there is no such file.ply")
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            self.addCleanup(os.chdir, before)
            broken = os.path.join(folder, "broken.ply")
            with open(broken, "w", encoding="utf-8") as target:
                target.write("ply\nformat ascii 1.0\nelement vertex 5\n")
            with self.assertRaisesRegex(OSError, "broken.ply"):
                flatten(broken)
            os.makedirs(os.path.join(folder, "meshes"))
            meshes.write_ply(os.path.join(folder, "meshes", "hill.ply"), meshes.hill())
            os.chdir(folder)
            flatten(os.path.join("meshes", "hill.ply"), report="hill.html")
            self.assertEqual(sorted(os.listdir(folder)),
                             ["broken.ply", "hill.csv", "hill.html", "meshes"])
            os.chdir(before)

    def test_results_are_attributes(self):
        result = flatten(arrays(meshes.torus()))
        self.assertLessEqual(set(common.ALWAYS), set(result.results))
        for key, value in result.results.items():
            self.assertTrue(numpy.array_equal(getattr(result, key), value), key)
            self.assertTrue(getattr(type(result), key).__doc__, key)
        self.assertFalse(hasattr(result, "annulus_modulus"))
        with self.assertRaisesRegex(AttributeError, "annulus_modulus: flat annulus"):
            result.annulus_modulus  # pylint: disable=pointless-statement

    def test_methods_and_signatures(self):
        documents = pymeshlab.MeshSet()
        documents.create_torus()
        for our_filter, function, description in FILTERS:
            method = getattr(pymeshlab.MeshSet, our_filter.PYTHON_NAME)
            names = [name for name, _, _ in our_filter.PARAMETERS]
            self.assertEqual(list(inspect.signature(method).parameters)[1:], names)
            self.assertEqual(list(inspect.signature(function).parameters)[5:], names)
            for parameter in description["parameters"]:
                self.assertIn(parameter["label"], method.__doc__)
                self.assertIn(parameter["label"], function.__doc__)
            self.assertEqual([p["advanced"] for p in description["parameters"]],
                             [i >= common.SHOWN for i in range(len(names))])
        returned = documents.compute_texcoord_parametrization_ricci_flow_euclidean_per_wedge()
        self.assertEqual(returned["genus"], 1)
        values = documents.filter_parameter_values(common.PYTHON_NAME)
        for parameter in DESCRIPTIONS[0]["parameters"]:
            default = parameter["default"]
            if parameter["type"] == "enum":
                default = parameter["choices"].index(default)
            found = values[parameter["name"]]
            if parameter["type"] == "float":
                found = float(f"{found:.7g}")  # single precision in the host
            self.assertEqual(found, default)

    def test_types(self):
        """The stub has what the module has, with the same parameters."""
        stub = ast.parse(read("filter_ricci", "python", "pymeshlab_ricci", "__init__.pyi"))
        named = {node.name: node for node in stub.body if hasattr(node, "name")}
        self.assertLessEqual(set(named) & set(dir(pymeshlab_ricci)),
                             set(pymeshlab_ricci.__all__))
        for name in pymeshlab_ricci.__all__:
            self.assertTrue(name in named or name in ("EUCLIDEAN", "HYPERBOLIC", "Mesh"), name)
        for function in (flatten, uniformize):
            arguments = named[function.__name__].args
            self.assertEqual([a.arg for a in arguments.args + arguments.kwonlyargs],
                             list(inspect.signature(function).parameters))
        try:
            from mypy import api
        except ImportError:
            self.skipTest("mypy is not installed")
        with tempfile.TemporaryDirectory() as folder:
            program = os.path.join(folder, "program.py")
            for line, errors in (("flatten('x.ply', target_curvature='Disk').charts + 1", 0),
                                 ("flatten('x.ply', target_curvature='Square')", 1),
                                 ("flatten('x.ply', rounds=3)", 1),
                                 ("flatten([[0.0, 0, 0]], [[0, 0, 0]], progress=True).layers['flat']", 0),
                                 ("flatten('x.ply', progress=lambda share, what: print(share))", 0),
                                 ("flatten('x.ply', progress=3)", 1),
                                 ("xatlas.parametrize([[0.0, 0, 0]], [[0, 0, 0]])[2].max()", 0),
                                 ("uniformize('x.ply').hyperbolic_area.real", 0)):
                with open(program, "w", encoding="utf-8") as source:
                    source.write(f"from pymeshlab_ricci import flatten, uniformize, xatlas\n{line}\n")
                os.environ["MYPYPATH"] = os.path.join(common.BUILD, "python")
                out, _, code = api.run(["--ignore-missing-imports", "--cache-dir", folder, program])
                self.assertEqual(code, errors, line + "\n" + out)


class Xatlas(unittest.TestCase):
    def check(self, vertices, faces, parametrize):
        """What every caller relies on: the same faces, and no texture vertex that is not needed."""
        mapping, corners, uv = parametrize(vertices.astype(numpy.float32), faces.astype(numpy.uint32))
        self.assertEqual((mapping.dtype, corners.dtype, uv.dtype),
                         (numpy.uint32, numpy.uint32, numpy.float32))
        self.assertEqual((mapping.shape, corners.shape), (uv.shape[:1], faces.shape))
        self.assertTrue(numpy.array_equal(mapping[corners], faces))
        self.assertEqual(set(corners.reshape(-1).tolist()), set(range(len(mapping))))
        self.assertTrue((uv >= 0.0).all() and (uv <= 1.0).all())
        self.assertEqual(uv.shape[1:], (2,))
        return self.charts(corners, len(mapping))

    @staticmethod
    def charts(corners, count):
        """The number of sets of texture vertices that faces join."""
        label = numpy.arange(count)
        while True:
            least = label.copy()
            for k in range(3):
                numpy.minimum.at(least, corners[:, k], label[corners].min(axis=1))
            if numpy.array_equal(least, label):
                return len(set(label.tolist()))
            label = least

    surfaces = (meshes.torus, meshes.hill, meshes.sphere, meshes.double_torus, meshes.annulus)

    def test_parametrize(self):
        for surface in self.surfaces:
            vertices, faces = arrays(surface())
            with self.subTest(surface=surface.__name__):
                self.check(vertices, faces, pymeshlab_ricci.xatlas.parametrize)
                alone = numpy.vstack([vertices[:1], vertices])  # a vertex without a face
                self.check(alone, faces + 1, pymeshlab_ricci.xatlas.parametrize)

    def test_beside_xatlas(self):
        """The same signature, and no more charts."""
        try:
            import xatlas
        except ImportError as problem:
            self.skipTest(f"xatlas cannot be imported: {problem}")
        ours = inspect.signature(pymeshlab_ricci.xatlas.parametrize).parameters
        stated = re.search(r"parametrize\((.*)\) ->", xatlas.parametrize.__doc__).group(1)
        self.assertEqual(list(ours), re.findall(r"(\w+): ", stated))
        for surface in self.surfaces:
            vertices, faces = arrays(surface())
            with self.subTest(surface=surface.__name__):
                self.assertLessEqual(
                    self.check(vertices, faces, pymeshlab_ricci.xatlas.parametrize),
                    self.check(vertices, faces, xatlas.parametrize))


if __name__ == "__main__":
    common.main()
