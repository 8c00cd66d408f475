# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python package: the wheel in an empty environment, and what a program gets from it.
Usage: test_wheel.py BUILD_DIR [TEST...], with a Python that has numpy; some tests need PyMeshLab."""

import ast
import base64
import concurrent.futures
import copy
import gc
import glob
import hashlib
import inspect
import math
import multiprocessing
import os
import pickle
import pydoc
import re
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time
import tracemalloc
import unittest
import warnings
import xml.etree.ElementTree
import zipfile

import common
import meshes
import textures

try:
    from matplotlib import image
except ImportError:
    image = None
sys.path.insert(0, os.path.join(common.BUILD, "python"))
try:
    import numpy
except ImportError as problem:
    common.skip(f"numpy cannot be imported here: {problem}")
if not os.path.isdir(os.path.join(common.BUILD, "python")):
    common.skip("the Python package is not built")
try:
    import pymeshlab
    needs_pymeshlab = unittest.skipIf(False, "")
except ImportError as problem:
    pymeshlab = None
    needs_pymeshlab = unittest.skip(f"PyMeshLab cannot be imported here: {problem}")

import ricciflow
import ricciflow.xatlas
from ricciflow import flatten, uniformize
from ricciflow._filters import DESCRIPTIONS
if pymeshlab is not None:
    import ricciflow.pymeshlab

FILTERS = ((common, flatten, DESCRIPTIONS[0]), (common.HYPERBOLIC, uniformize, DESCRIPTIONS[1]))


def read(*path):
    with open(os.path.join(common.REPOSITORY, *path), encoding="utf-8") as source:
        return source.read()


def arrays(mesh):
    return numpy.array(mesh.vertices, dtype=float), numpy.array(mesh.faces)


def write_stl(path, vertices, faces):
    rows = numpy.zeros(len(faces), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
    rows["corners"] = vertices[faces]
    with open(path, "wb") as target:
        target.write(b" " * 80 + numpy.uint32(len(faces)).tobytes() + rows.tobytes())


def wheel_file():
    version = re.search(r"project\(\w+ VERSION ([\d.]+)", read("CMakeLists.txt")).group(1)
    found, = glob.glob(os.path.join(common.BUILD, "release", f"ricciflow-{version}-*.whl"))
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
        needed = [int(minor) for minor in re.findall(rb"GLIBC_2\.(\d+)",
                                                     files["ricciflow/libricciflow.so"])]
        self.assertEqual(newest, max(17, *needed))

    def test_names_and_tags(self):
        """Installers take the names apart, those of wheels for other systems too."""
        try:
            from packaging.utils import parse_wheel_filename
        except ImportError as problem:
            self.skipTest(f"packaging cannot be imported: {problem}")
        wheels = glob.glob(os.path.join(common.BUILD, "release", "**",
                                        f"ricciflow-{ricciflow.__version__}-*.whl"), recursive=True)
        for wheel in wheels:
            name, version, build, tags = parse_wheel_filename(os.path.basename(wheel))
            self.assertEqual((name, build), ("ricciflow", ()))
            self.assertEqual(str(version), ricciflow.__version__)
            with zipfile.ZipFile(wheel) as archive:
                stated, = (archive.read(n).decode() for n in archive.namelist() if n.endswith("/WHEEL"))
            self.assertEqual(set(re.findall(r"(?m)^Tag: (.*)$", stated)), {str(tag) for tag in tags})

    def test_made_twice(self):
        """The same bits, for any platform; names that the licences have stand in METADATA."""
        maker = os.path.join(common.REPOSITORY, "filter_ricci", "python", "make_wheel.py")
        with tempfile.TemporaryDirectory() as folder:
            library = os.path.join(folder, "any.dll")
            with open(library, "wb") as target:
                target.write(b"MZ")
            made = []
            for place in ("one", "two"):
                done = subprocess.run(
                    [sys.executable, maker, "--library", library, "--tag", "win_amd64", "--version",
                     "1.2", "--readme", os.path.join(common.REPOSITORY, "README.md"), "--author", "X",
                     "--expression", "GPL-3.0-or-later AND MIT", "--wheels",
                     os.path.join(folder, place), "--licences", f"{maker}=LICENSE.other"],
                    capture_output=True, text=True, check=True)
                with open(done.stdout.strip(), "rb") as source:
                    made.append(source.read())
            self.assertEqual(*made)
            with zipfile.ZipFile(done.stdout.strip()) as wheel:
                self.assertIn("ricciflow/ricciflow.dll", wheel.namelist())
                text = wheel.read("ricciflow-1.2.dist-info/METADATA").decode()
                self.assertIn("ricciflow-1.2.dist-info/licenses/LICENSE.other", wheel.namelist())
        self.assertIn("License-Expression: GPL-3.0-or-later AND MIT\nLicense-File: LICENSE.other\n", text)
        self.assertIn("Operating System :: Microsoft", text)
        self.assertEqual(re.findall(r"(?m)^Requires-Dist: (\w+)$", text), ["numpy"])

    def test_metadata(self):
        """The wheel says of the package what the README says, and names its command."""
        with zipfile.ZipFile(wheel_file()) as wheel:
            text, = (wheel.read(name).decode() for name in wheel.namelist() if name.endswith("/METADATA"))
        said = re.search(r"```python\n.*?```\n\n(.*?)\n\n", read("README.md"), re.DOTALL).group(1)
        self.assertIn(said, text)
        self.assertIn(re.search(r"  - name: (.*)", read("CITATION.cff")).group(1), text)

    def test_in_an_empty_environment(self):
        """Installed by pip, which finds its needs fulfilled; then the README's first code runs."""
        code = re.search(r"```python\n(.*?)```", read("README.md"), re.DOTALL).group(1)
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, "-m", "venv", folder], check=True)
            python = os.path.join(folder, "bin", "python")
            place, = glob.glob(os.path.join(folder, "lib", "python3*", "site-packages"))
            # numpy is that of this Python, so that no package index is needed; it has no metadata there.
            for found in glob.glob(os.path.join(os.path.dirname(os.path.dirname(numpy.__file__)),
                                                "numpy*")):
                os.symlink(found, os.path.join(place, os.path.basename(found)))
            environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}

            def run(*command):
                done = subprocess.run([python, *command], capture_output=True, text=True,
                                      cwd=folder, env=environment)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                return done.stdout
            run("-m", "pip", "install", "-q", "--no-index", "--no-deps", "--force-reinstall",
                wheel_file())
            problems = subprocess.run([python, "-m", "pip", "check"], env=environment,
                                      capture_output=True, text=True)
            self.assertNotIn("ricciflow", problems.stdout)
            meshes.write_ply(os.path.join(folder, "mesh.ply"), meshes.torus())
            run("-c", code)
            run("-m", "ricciflow", "mesh.ply", "again.ply", "--output-triangulation", "1")
            self.assertIsNotNone(meshes.read_ply(os.path.join(folder, "again.ply")).wedges)
            command = os.path.join(folder, "bin", "ricciflow")
            version = subprocess.run([command, "--version"], capture_output=True, text=True, check=True,
                                     env=environment).stdout
            self.assertEqual(version, f"ricciflow {os.path.basename(wheel_file()).split('-')[1]}\n")
            self.former_name(run)
            run("-m", "pip", "uninstall", "-q", "-y", "ricciflow")
            self.assertEqual(glob.glob(os.path.join(place, "*ricci*")), [])

    def former_name(self, run):
        """In this version it leads to the new one, and says so."""
        code = ("import warnings\n"
                "with warnings.catch_warnings(record=True) as said:\n"
                "    warnings.simplefilter('always')\n"
                "    import pymeshlab_ricci\n"
                "    from pymeshlab_ricci import flatten, xatlas\n"
                "assert 'ricciflow' in str(said[0].message), said\n"
                "assert issubclass(said[0].category, DeprecationWarning)\n"
                "import ricciflow, ricciflow.xatlas\n"
                "assert flatten is ricciflow.flatten\n"
                "assert xatlas.parametrize is ricciflow.xatlas.parametrize\n")
        run("-c", code)
        run("-m", "pymeshlab_ricci", "mesh.ply", "former.ply")

    def test_import_is_light(self):
        """Nothing but numpy and modules of Python, in hardly more than its memory."""
        environment = {**os.environ, "PYTHONPATH": os.path.join(common.BUILD, "python")}
        code = ("import resource, sys\nimport {}\n"
                "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss,\n"
                "      *sorted(name for name in sys.modules if '.' not in name))\n")
        measured = {"numpy": [], "ricciflow": []}
        for name in [*measured] * 5:
            done = subprocess.run([sys.executable, "-c", code.format(name)], capture_output=True,
                                  text=True, env=environment, check=True)
            measured[name].append(done.stdout.split())
        kilobytes = [min(int(line[0]) for line in lines) for lines in measured.values()]
        self.assertLess(kilobytes[1] - kilobytes[0], 8 << 10)
        loaded = set(measured["ricciflow"][0][1:]) - set(measured["numpy"][0][1:])
        self.assertLessEqual(loaded, {"ricciflow", *sys.stdlib_module_names})

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


def mesh_set(vertices, faces):
    documents = pymeshlab.MeshSet()
    documents.add_mesh(pymeshlab.Mesh(vertices, faces.astype(numpy.int32)))
    return documents


def roads():
    """Sets, one after the other, how a MeshSet is treated."""
    uses_plugin = ricciflow.pymeshlab.USES_PLUGIN
    try:
        for ricciflow.pymeshlab.USES_PLUGIN in ((True, False) if uses_plugin else (False,)):
            yield "plugin" if ricciflow.pymeshlab.USES_PLUGIN else "library"
    finally:
        ricciflow.pymeshlab.USES_PLUGIN = uses_plugin


class Progress(unittest.TestCase):
    def test_told(self):
        updates = []
        flatten(*arrays(meshes.torus()), progress=lambda *told: updates.append(told))
        self.assertEqual(updates[-1], (1.0, "Done"))
        for fraction, what in updates:
            self.assertTrue(0.0 <= fraction <= 1.0 and what, (fraction, what))
        self.assertEqual([f for f, _ in updates], sorted(f for f, _ in updates))

    def test_bar(self):
        """On standard error: tqdm's, or a line without it."""
        code = ("import sys, ricciflow as r\n{}\n"
                "import meshes; m = meshes.torus(); r.flatten(m.vertices, m.faces, progress=True)")
        environment = {**os.environ, "PYTHONPATH": os.path.join(common.BUILD, "python")}
        for before in ("", "sys.modules['tqdm'] = sys.modules['tqdm.auto'] = None"):
            done = subprocess.run([sys.executable, "-c", code.format(before)], capture_output=True,
                                  text=True, env=environment, check=True,
                                  cwd=os.path.dirname(os.path.abspath(__file__)))
            self.assertEqual(done.stdout, "")
            self.assertIn("100%", done.stderr)

    def ended(self, mesh, problem, stop, **parameters):
        """Seconds from a stop at the first sign of life to the end of the call."""
        stopped = []

        def tell(*_):
            if not stopped:
                stopped.append(time.monotonic())
                stop()

        with self.assertRaises(problem):
            flatten(mesh, progress=tell, **parameters)
        return time.monotonic() - stopped[0]

    def check_ends(self, mesh):
        """The run ends within a second, and files are as they were."""
        def interrupt():
            os.kill(os.getpid(), signal.SIGINT)

        def fail():
            raise ZeroDivisionError

        with tempfile.TemporaryDirectory() as folder:
            for problem, stop in ((KeyboardInterrupt, interrupt), (ZeroDivisionError, fail)):
                seconds = self.ended(mesh, problem, stop, layers="Flat mesh",
                                     report=os.path.join(folder, "run.html"))
                self.assertLess(seconds, 1.0)
            self.assertEqual(os.listdir(folder), [])
        self.assertEqual(flatten(*arrays(meshes.torus())).flipped_faces, 0)

    def test_ctrl_c(self):
        self.check_ends(large())

    @needs_pymeshlab
    def test_ctrl_c_in_a_mesh_set(self):
        """Mesh and layers, too, are as they were."""
        vertices, faces = large()
        for road in roads():
            with self.subTest(road):
                documents = mesh_set(vertices, faces)
                self.check_ends(documents)
                threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
                started = time.monotonic()
                with self.assertRaises(KeyboardInterrupt):
                    documents.compute_texcoord_parametrization_ricci_flow_euclidean_per_wedge()
                self.assertLess(time.monotonic() - started, 1.3)
                self.assertEqual(documents.mesh_number(), 1)
                self.assertFalse(documents.current_mesh().has_wedge_tex_coord())

    def test_two_at_once(self):
        """The same bits as one after the other."""
        given = [arrays(meshes.torus()), arrays(meshes.double_torus()), arrays(meshes.sphere())] * 2
        alone = [flatten(*mesh) for mesh in given]
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            together = list(pool.map(lambda mesh: flatten(*mesh), given))
        for one, other in zip(alone, together):
            for key in ("uv", "quality", "log_radius"):
                self.assertEqual(getattr(one, key).tobytes(), getattr(other, key).tobytes())
            self.assertEqual(repr(one.results), repr(other.results))

    def test_nothing_leaks(self):
        """300 calls, refused ones and cancelled ones among them, leave no object of Python behind, and
        no memory of the process."""
        mesh = arrays(meshes.hill(8))

        def stop(*_):
            raise ZeroDivisionError

        def call(number):
            flatten(*mesh, layers="Flat mesh", progress=lambda *_: None)
            if number % 3 == 0:
                with self.assertRaises(ricciflow.Refused):
                    flatten(*mesh, target_curvature="Flat everywhere")
            if number % 3 == 1:
                with self.assertRaises(ZeroDivisionError):
                    flatten(*mesh, progress=stop)

        def resident():
            gc.collect()
            with open("/proc/self/statm", encoding="ascii") as source:
                return int(source.read().split()[1]) * resource.getpagesize()

        for number in range(60):
            call(number)
        if not os.path.exists("/proc/self/statm"):
            self.skipTest("the system does not say how much memory a process has")
        tracemalloc.start()
        self.addCleanup(tracemalloc.stop)
        call(0)
        before, blocks = resident(), len(tracemalloc.take_snapshot().traces)
        for number in range(300):
            call(number)
        self.assertLess(resident() - before, 3 << 20)
        self.assertLess(len(tracemalloc.take_snapshot().traces) - blocks, 100)


class Functions(unittest.TestCase):
    def test_every_way_in(self):
        vertices, faces = arrays(meshes.torus())
        expected = flatten((vertices, faces), cone_distortion=1.0)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "torus.ply")
            meshes.write_ply(path, meshes.torus())
            from_path = flatten(path, cone_distortion=1.0)
        apart = flatten(vertices, faces, cone_distortion=1.0)
        lists = flatten(vertices.tolist(), faces=faces.tolist(), cone_distortion=1.0)
        has_both = flatten(meshes.torus(), cone_distortion=1.0)
        for result in (apart, lists, has_both):
            self.assert_same(result, expected)
        self.assertAlmostEqual(from_path.torus_tau_im, expected.torus_tau_im, delta=1e-4)
        self.assertEqual((expected.uv.shape, expected.quality.shape, expected.log_radius.shape),
                         ((len(faces), 3, 2), (len(vertices),), (len(vertices),)))
        self.assertTrue(numpy.array_equal(expected.faces, faces))
        self.assertIn("charts=1", repr(expected))

    def assert_same(self, result, expected, layers=()):
        """Bit by bit."""
        for key in ("vertices", "faces", "uv", "quality", "log_radius", "target_curvature"):
            self.assertTrue(numpy.array_equal(getattr(result, key), getattr(expected, key)), key)
        self.assertEqual(set(result.results), set(expected.results))
        for key, value in expected.results.items():
            self.assertIs(type(result.results[key]), type(value))
            self.assertTrue(numpy.array_equal(result.results[key], value), key)
        self.assertEqual(set(result.layers), set(layers))
        for kind in layers:
            for ours, theirs in zip(result.layers[kind], expected.layers[kind]):
                self.assertTrue(numpy.array_equal(ours, theirs), kind)
        self.assertEqual(result.messages, expected.messages)

    @needs_pymeshlab
    def test_the_same_in_pymeshlab(self):
        """By the plugin, by the arrays of a MeshSet, and without PyMeshLab: the same floats."""
        mirror = arrays(meshes.swirled(meshes.double_torus(), 4.0, 1.5))
        for function, mesh, parameters, layers in (
                (flatten, arrays(meshes.torus()), {"cone_distortion": 1.0}, ()),
                (flatten, arrays(meshes.double_torus()), {"output_triangulation": 1}, ()),
                (flatten, arrays(meshes.sphere()), {"layers": "Flat mesh and sphere"},
                 ("flat", "sphere")),
                (flatten, mirror, {"finish": "Least stretch", "colorize": True}, ()),
                (flatten, arrays(meshes.bow_tie()), {}, ()),
                (flatten, arrays(meshes.with_fin(meshes.moebius())), {}, ()),
                (uniformize, arrays(meshes.double_torus()), {
                    "flat_layer": True, "universal_cover": 1, "generator_axes": True},
                 ("disk", "cover", "axes"))):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", ricciflow.RicciWarning)
                expected = function(*mesh, **parameters)
                for road in roads():
                    with self.subTest(road, function=function.__name__, **parameters):
                        documents = mesh_set(*mesh)
                        inside = function(documents, **parameters)
                        self.assertIs(inside.mesh_set, documents)
                        self.assertEqual(documents.mesh_number(), 1 + len(layers))
                        current = documents.current_mesh()
                        for found, key in ((current.vertex_matrix(), "vertices"),
                                           (current.face_matrix(), "faces"),
                                           (current.vertex_scalar_array(), "quality"),
                                           (current.wedge_tex_coord_matrix().reshape(-1, 3, 2), "uv")):
                            self.assertTrue(numpy.array_equal(found, getattr(expected, key)), key)
                        inside.messages = [m for m in inside.messages if "new mesh is the layer" not in m]
                        self.assert_same(inside, expected, layers)
                        documents = mesh_set(*mesh)  # which its Mesh does not keep alive
                        outside = function(documents.current_mesh(), **parameters)
                        self.assertTrue(numpy.array_equal(outside.uv, expected.uv))
                        method = getattr(pymeshlab.MeshSet, {flatten: ricciflow.EUCLIDEAN}.get(
                            function, ricciflow.HYPERBOLIC))
                        returned = method(mesh_set(*mesh), **parameters)
                        for key, value in expected.results.items():
                            self.assertTrue(numpy.array_equal(returned[key], value), key)

    @needs_pymeshlab
    def test_what_a_mesh_set_keeps(self):
        """Where the library runs on its arrays: names, places, colours, selections, attributes."""
        for _ in (road for road in roads() if road == "library"):
            documents = mesh_set(*arrays(meshes.torus()))
            mesh = documents.current_mesh()
            mesh.set_label("a name")
            documents.compute_selection_by_condition_per_face(condselect="x0 > 0")
            mesh.add_vertex_custom_scalar_attribute(numpy.arange(mesh.vertex_number(), dtype=float), "own")
            matrix = numpy.diag([2.0, 2.0, 2.0, 1.0])
            documents.set_matrix(transformmatrix=matrix, freeze=False)
            documents.set_color_per_vertex(color1=pymeshlab.Color(9, 8, 7, 255))
            kept = [mesh.face_selection_array(), mesh.vertex_color_matrix(), mesh.vertex_normal_matrix(),
                    mesh.transform_matrix(), mesh.vertex_matrix()]
            for times in range(2):
                documents.compute_texcoord_parametrization_ricci_flow_euclidean_per_wedge()
            self.assertEqual((mesh.id(), mesh.label()), (0, "a name"))
            for before, after in zip(kept, [
                    mesh.face_selection_array(), mesh.vertex_color_matrix(),
                    mesh.vertex_normal_matrix(), mesh.transform_matrix(), mesh.vertex_matrix()]):
                self.assertTrue(numpy.array_equal(before, after))
            self.assertEqual(mesh.vertex_custom_scalar_attribute_array("own")[7], 7.0)
            with self.assertWarnsRegex(ricciflow.RicciWarning, "new mesh is the layer 1"):
                flatten(documents, output_triangulation="Common refinement")
            self.assertEqual(documents.current_mesh().label(), "a name")
            self.assertTrue(numpy.array_equal(documents.current_mesh().transform_matrix(), matrix))

    def test_seams_of_a_program(self):
        """By edges, by faces, and by texture coordinates, in place of a selection."""
        vertices, faces = arrays(meshes.double_torus())
        normals = numpy.cross(*(vertices[faces][:, k] - vertices[faces][:, 0] for k in (1, 2)))
        normals /= numpy.linalg.norm(normals, axis=1)[:, None]
        sides = {}
        for face, corners in enumerate(faces.tolist()):
            for k in range(3):
                sides.setdefault(frozenset((corners[k], corners[k - 2])), []).append((face, k))
        creases = [pair for pair, (one, two) in sides.items()
                   if normals[one[0]] @ normals[two[0]] < 0.5]
        marks = numpy.zeros(faces.shape, dtype=bool)
        for pair in creases:
            marks[sides[pair][0]] = True
        for edges in ([sorted(pair) for pair in creases], marks):
            result = flatten(vertices, faces, selected_edges=edges)
            self.assertEqual((result.charts, result.chosen_seam_edges), (14, len(creases)))
        sharp = flatten(vertices, faces, seams="Sharp edges", sharp_angle=60.0)
        self.assertTrue(numpy.array_equal(sharp.uv, result.uv))
        again = flatten(vertices, faces, uv=result.uv)
        self.assertEqual((again.charts, again.chosen_seam_edges), (14, len(creases)))
        half = vertices[faces].mean(axis=1)[:, 0] > 2.5
        for chosen in (half, numpy.flatnonzero(half)):
            self.assertEqual(flatten(vertices, faces, selected_faces=chosen).components, 2)
        for wrong, words in (({"selected_edges": [[0, 0]]}, "no face has the side"),
                             ({"selected_edges": [0, 1]}, "pairs of vertices"),
                             ({"diagonals": [[0, 0]]}, "diagonals: no face has the side"),
                             ({"selected_faces": [len(faces)]}, "indices of faces"),
                             ({"uv": result.uv[1:]}, "two numbers for each corner")):
            with self.assertRaisesRegex(ValueError, words):
                flatten(vertices, faces, **wrong)

    def test_what_has_no_effect_is_said(self):
        """Once, and only that."""
        torus, hill, slab = (arrays(mesh()) for mesh in (meshes.torus, meshes.hill, meshes.double_torus))
        given = {"charts": "As they are, only packed", "uv": hill[0][hill[1]][:, :, :2]}
        for function, mesh, values, ignored in (
                (flatten, torus, {"target_curvature": "Flat everywhere", "cone_count": 4,
                                  "cone_rounding": "Multiples of pi/2", "cone_distortion": 0.3},
                 {"cone_count", "cone_rounding", "cone_distortion"}),
                (flatten, hill, {"target_curvature": "Disk", "cone_rounding": "Multiples of pi/2"},
                 {"cone_rounding"}),
                (flatten, torus, {"cone_count": 4, "cone_distortion": 0.3}, {"cone_distortion"}),
                (flatten, torus, {"method": "Fixed triangles", "finish": "Repair"}, {"finish"}),
                (flatten, torus, {"method": "Fixed triangles", "cone_count": 4}, {"cone_count"}),
                (flatten, torus, {"method": "Fixed triangles", "cone_distortion": 0.3},
                 {"cone_distortion"}),
                (flatten, torus, {"texture_size": 512, "padding": 0, "free_boundary": False},
                 {"texture_size", "free_boundary"}),
                (flatten, torus, {"texture_size": 0}, {"texture_size"}),
                (flatten, torus, {"texture_size": 512}, set()),
                (flatten, torus, {"sharp_angle": 10.0}, {"sharp_angle"}),
                (flatten, hill, {"seams": "Sharp edges", "sharp_angle": 180.0}, {"seams"}),
                (flatten, hill, {**given, "finish": "Repair", "cone_count": 3, "method": "Fixed triangles"},
                 {"finish", "cone_count", "method"}),
                (flatten, hill, {"holes": "Capped"}, {"holes"}),
                (flatten, hill, {"free_boundary": False}, set()),
                (flatten, hill, {"target_curvature": "Rectangle", "chart_rotation": "None"},
                 {"chart_rotation"}),
                (flatten, torus, {"cone_distortion": 0.3}, set()),
                (uniformize, slab, {"method": "Fixed triangles", "finish": "None"}, {"finish"}),
                (uniformize, slab, {"free_boundary": True, "cone_angle": 90.0, "texture_size": 512,
                                    "sharp_angle": 10.0},
                 {"free_boundary", "cone_angle", "texture_size", "sharp_angle"}),
                (uniformize, slab, {"cone_angle": 90.0, "selected": [0]}, set())):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                told = function(*mesh, **values).messages
            self.assertEqual(sorted(line.split()[0] for line in told if "has no effect" in line),
                             sorted(ignored), values)

    def test_the_log_ends_with_what_came_out(self):
        """First that, then the doubts, then the details."""
        for function, mesh, what in (
                (flatten, meshes.torus(), r"\(UV islands\) fills? {fill} % of the square"),
                (uniformize, meshes.double_torus(), "in the unit disk")):
            result = function(*arrays(mesh), sharp_angle=10.0)
            start = len(result.log) - len(result.messages) - 4
            charts, cones = (f"{n or 'no'} {of}{'s' if n != 1 else ''}" for n, of in (
                (result.charts, "chart"), (result.cones, "cone")))
            what = what.format(fill=round(100 * result.occupancy))
            self.assertRegex(result.log[start], rf"^{charts} {what}, with {cones} and no flipped faces\. "
                             r"The mean angle distortion is [\d.]+ \(1: none\), the mean area distortion "
                             r"[\d.]+\. It took [\d.]+ s\.$")
            numbers = [float(x) for x in re.findall(r"distortion(?: is)? (\d+\.?\d*)\b", result.log[start])]
            for number, key in zip(numbers, ("qc_area_mean", "area_distortion_mean"), strict=True):
                self.assertAlmostEqual(number, result.results[key], delta=1e-3 * number)
            self.assertEqual(result.log[start + 1:-3], result.messages)
            self.assertRegex("\n".join(result.log[-3:]), r"^(Automatic|The curvature) .*\nResult: .*\nSurface: .*$")

    def test_real_size_has_the_same_charts(self):
        for mesh in (meshes.torus(), meshes.double_torus(), meshes.hill()):
            fitted, real = (flatten(*arrays(mesh), normalize_uv=normalize) for normalize in (True, False))
            for key in ("charts", "seam_edges", "overlap_cuts", "seam_length", "cones", "padding_pixels"):
                self.assertEqual(fitted.results[key], real.results[key], key)
            if fitted.charts > 1:
                scale = numpy.ptp(real.uv) / numpy.ptp(fitted.uv)
                self.assertLess(numpy.abs(real.uv - scale * fitted.uv).max(), 1e-5 * scale)

    def test_tiles_have_the_texels_that_are_asked_for(self):
        vertices, faces = (numpy.asarray(a) for a in arrays(meshes.torus()))
        sides = vertices[faces[:, 1:]] - vertices[faces[:, :1]]
        area = numpy.linalg.norm(numpy.cross(sides[:, 0], sides[:, 1]), axis=1).sum() / 2
        density = 256 * numpy.sqrt(6 / area)  # six full tiles of 256 texels
        result = flatten(vertices, faces, texel_density=density, texture_size=256, padding=3)
        tile = numpy.floor(result.uv.mean(axis=1))
        self.assertEqual(set(map(tuple, tile.astype(int))),
                         {(i % 10, i // 10) for i in range(result.tiles)})
        inside = result.uv - tile[:, None]
        self.assertGreaterEqual(min(inside.min(), 1 - inside.max()), 3 / 256 - 1e-6)
        sides = result.uv[:, 1:] - result.uv[:, :1]
        drawn = (sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0]).sum() / 2
        self.assertAlmostEqual(256 * numpy.sqrt(drawn / area) / density, 1.0, delta=1e-5)
        self.assertAlmostEqual(result.occupancy, drawn / result.tiles, delta=1e-5)
        self.assertRegex("\n".join(result.log), f" % of {result.tiles} tiles, with ")
        for problem, values, words in (
                (ValueError, {"texel_density": -1.0}, "-1 of texel_density cannot be used"),
                (ricciflow.Refused, {"normalize_uv": False}, "choose normalize_uv"),
                (ricciflow.Refused, {"carry_texture": "new.png"}, "draws a single square")):
            with self.assertRaisesRegex(problem, words):
                flatten(vertices, faces, **{"texel_density": density, **values})
        with self.assertRaisesRegex(ricciflow.Refused, "lower texel_density to") as refusal:
            flatten(vertices, faces, texel_density=100 * density, texture_size=256)
        share = float(re.search(r"to ([\d.]+) %", str(refusal.exception))[1]) / 100
        self.assertGreater(
            flatten(vertices, faces, texel_density=share * 100 * density, texture_size=256).tiles, 40)

    def test_no_sphere_layer_of_another_surface(self):
        for mesh in (meshes.torus(), meshes.hill()):
            with self.assertWarnsRegex(ricciflow.RicciWarning, "genus 0.*no sphere layer"):
                result = flatten(*arrays(mesh), layers="Flat mesh and sphere")
            self.assertEqual(set(result.layers), {"flat"})

    def test_padding_without_room_is_told(self):
        """Of 36 charts in a square, seven margins of an eighth leave almost no room."""
        vertices = numpy.concatenate([arrays(meshes.hill(2))[0] + [5.0 * i, 0, 0] for i in range(36)])
        count = len(vertices) // 36
        faces = numpy.concatenate([arrays(meshes.hill(2))[1] + count * i for i in range(36)])
        with self.assertWarnsRegex(ricciflow.RicciWarning, "pixels apart, not padding 512: .* Raise texture_size"):
            result = flatten(vertices, faces, padding=512)
        self.assertLess(result.padding_pixels, 512)
        self.assertGreaterEqual(result.uv.min(), result.padding_pixels / 2048 - 1e-6)

    def test_doubts_about_islands_that_stay(self):
        """What is wrong is said, and that no parameter of new charts mends it."""
        vertices, faces = arrays(meshes.grid(100, 3, lambda s, t: (
            math.cos(13 * s) * (1 + t), math.sin(13 * s) * (1 + t), 3 * s)))  # from above, two turns of it
        for side in (1, -1):
            with self.assertWarnsRegex(ricciflow.RicciWarning, "faces overlap. Charts are kept as they were"):
                result = flatten(vertices, faces, uv=vertices[faces][..., :2] * [side, 1],
                                 charts="As they are, only packed")
            self.assertEqual(result.overlapping_faces, len(faces))
            for message in result.messages:
                if "usable" in message:
                    self.assertIn("kept as they were", message)

    def test_doubts_are_warnings(self):
        """As warnings, and with the result."""
        mesh = arrays(meshes.swirled(meshes.double_torus(), 4.0, 1.5))
        with self.assertWarnsRegex(ricciflow.RicciWarning, "This map is probably not usable") as caught:
            result = flatten(*mesh, target_curvature="Placed cones", cone_count=1,
                             charts="As the flow has them")
        self.assertEqual(os.path.basename(caught.filename), "test_wheel.py")
        self.assertIn(str(caught.warning), result.messages)
        self.assertLessEqual(set(result.messages), set(result.log))
        self.assertGreater(len(result.log), len(result.messages))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertEqual(flatten(*arrays(meshes.torus())).messages, [])

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
                             r"^\d\d+ chosen edges, 0 more, \d+ charts")
            self.assertRegex(run("chosen_seams.py", path["in.ply"], path["two.obj"], "60"),
                             "chosen edges, 0 more, 14 charts")
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

    @needs_pymeshlab
    def test_again_in_one_mesh_set(self):
        vertices, faces = arrays(meshes.sphere())
        order = numpy.argsort(vertices[:, 2])
        for road in roads():
            documents = mesh_set(vertices, faces)
            for cones in (order[[0, 1, -1]], order[[0, 1, -2, -1]]):
                for given in ({"selected": cones}, {"curvature": numpy.where(
                        numpy.isin(range(len(vertices)), cones), 4 * numpy.pi / len(cones), 0.0)}):
                    with self.subTest(road, given=list(given)):
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
        with self.assertRaisesRegex(ricciflow.Refused, "^'Flat everywhere' needs"):
            flatten(good, target_curvature="Flat everywhere")
        for mistakes in ([0.5], [-1], [len(good[0])]):
            with self.assertRaisesRegex(ValueError, "^selected must hold indices"):
                flatten(good, selected=mistakes)
        with self.assertRaises(ValueError):
            flatten(good, curvature=[0.0])

    @needs_pymeshlab
    def test_refusals_in_pymeshlab(self):
        """They are PyMeshLab's exceptions, too."""
        good = arrays(meshes.hill())
        for road in roads():
            for error in (ricciflow.Refused, pymeshlab.PyMeshLabException):
                with self.subTest(road, error=error.__name__):
                    with self.assertRaisesRegex(error, "^'Flat everywhere' needs"):
                        flatten(mesh_set(*good), target_curvature="Flat everywhere")
                    with self.assertRaisesRegex(error, "^'Flat everywhere' needs"):
                        getattr(mesh_set(*good), ricciflow.EUCLIDEAN)(target_curvature=1)
                    with self.assertRaisesRegex(error, "^The mesh is a point cloud"):
                        flatten(pymeshlab.Mesh(good[0]))
            for error in (ValueError, pymeshlab.PyMeshLabException):
                with self.assertRaisesRegex(error, "^The value -1 of cone_count"):
                    flatten(mesh_set(*good), cone_count=-1)
            with self.assertRaisesRegex(ValueError, "holds no mesh"):
                flatten(pymeshlab.MeshSet(), selected=[0])

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

    @needs_pymeshlab
    def test_layers_of_a_mesh_set(self):
        for road in roads():
            documents = pymeshlab.MeshSet()
            documents.create_sphere()
            self.assertEqual(set(flatten(documents, layers="Flat mesh and sphere").layers),
                             {"flat", "sphere"}, road)
            again = flatten(documents, layers="Sphere")  # not those of the first run
            self.assertEqual(set(again.layers), {"sphere"})
            lengths = numpy.linalg.norm(again.layers["sphere"].vertices, axis=1)
            self.assertTrue(numpy.allclose(lengths, 1.0))
            self.assertEqual([mesh.label().split()[0] for mesh in documents],
                             ["Sphere", "Flat", "Sphere", "Sphere"])

    def test_gltf(self):
        """PyMeshLab and trimesh read the same coordinates back. Of a scene all meshes are taken."""
        try:
            import PIL.Image
            import trimesh
        except ImportError as problem:
            self.skipTest(f"trimesh or Pillow cannot be imported: {problem}")
        vertices, faces = arrays(meshes.double_torus())
        result = flatten(vertices, faces)
        with tempfile.TemporaryDirectory() as folder:
            for ending in (".glb", ".gltf"):
                path = os.path.join(folder, "one" + ending)
                result.save(path)
                if pymeshlab is not None:
                    again = pymeshlab.MeshSet()
                    again.load_new_mesh(path)
                    uv = again.current_mesh().wedge_tex_coord_matrix().reshape(-1, 3, 2)
                    self.assertLess(abs(uv - result.uv).max(), 1e-6)
                    self.assertEqual(again.current_mesh().texture_number(), 0)
                again = trimesh.load(path, force="mesh", process=False)
                uv = numpy.asarray(again.visual.uv)[numpy.asarray(again.faces)]
                self.assertLess(abs(uv - result.uv).max(), 1e-6)
            self.assertEqual(sorted(os.listdir(folder)), ["one.glb", "one.gltf"])
            scene = trimesh.Scene([trimesh.Trimesh(vertices, faces),
                                   trimesh.Trimesh(vertices + 9.0, faces)])
            scene.export(os.path.join(folder, "two.glb"))
            for given in (scene, os.path.join(folder, "two.glb")):
                self.assertEqual(len(flatten(given).faces), 2 * len(faces))
            # A transferred texture goes with the mesh, else the old one with its coordinates.
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
                self.assertEqual(image and image.size, (64, 64) if texture else (8, 8))

    def test_pickled(self):
        """Copies, and results of other processes, have and save the same."""
        vertices, faces = arrays(meshes.double_torus())
        result = flatten(vertices, faces, layers="Flat mesh")
        with concurrent.futures.ProcessPoolExecutor(
                1, multiprocessing.get_context("fork")) as pool:
            elsewhere = pool.submit(flatten, vertices, faces, layers="Flat mesh").result()
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
                self.assert_same(other, result, ("flat",))
                self.assertEqual(saved(other), expected)
                if pymeshlab is not None:
                    self.assertEqual([mesh.label().split()[:1] for mesh in other.mesh_set],
                                     [["Flat"], []])
                    self.assertTrue(numpy.array_equal(
                        other.mesh_set.current_mesh().wedge_tex_coord_matrix().reshape(-1, 3, 2),
                        result.uv))

    def test_copies_write_the_file(self):
        """With all that it holds, also where triangles are refined; without it the mesh alone."""
        with tempfile.TemporaryDirectory() as folder:
            path = {name: os.path.join(folder, name) for name in ("in.obj", "one.obj", "two.obj", "in.glb")}
            flatten(arrays(meshes.hill())).save(path["in.glb"])
            with open(path["in.obj"], "w", encoding="utf-8") as target:
                target.write("# by hand\no thing\n" + "".join("v %r %r %r\n" % v for v in meshes.hill().vertices))
                target.write("".join("f %d %d %d\n" % tuple(v + 1 for v in f) for f in meshes.hill().faces))
            for given in ("in.obj", "in.glb"):
                for output in ("Keep the mesh", "Common refinement"):
                    result = flatten(path[given], output_triangulation=output)
                    copied = pickle.loads(pickle.dumps(result))
                    for one, name in ((result, "one.obj"), (copied, "two.obj")):
                        one.save(path[name])
                    with open(path["one.obj"], "rb") as one, open(path["two.obj"], "rb") as two:
                        text = one.read()
                        self.assertEqual(text, two.read())
                    self.assertEqual(b"# by hand\no thing\n" in text, given == "in.obj")
            os.remove(path["in.glb"])
            copied.save(path["two.obj"])
            self.assertEqual(len(flatten(path["two.obj"]).faces), len(copied.faces))

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
                (TypeError, "'island_margin': it is 'padding' here", {"island_margin": 2}),
                (TypeError, "'chart_margin': it is 'padding' now.* 0.004 is 4 at", {"chart_margin": 0.01}),
                (TypeError, "'flat_layer': it is layers='Flat mesh' now", {"flat_layer": True}),
                (TypeError, "'sphere_layer': it is layers='Sphere' now", {"sphere_layer": True}),
                (TypeError, "'options': its names are parameters", {"options": "time_limit=1"}),
                (ValueError, "'Without overlap, cut for room'.*'Without overlap, cut for packing'",
                 {"charts": "Without overlap, cut for room"}),
                (ValueError, "'Disc' is not a choice: did you mean 'Disk'", {"target_curvature": "Disc"}),
                (ValueError, "'Torus' is not a choice: .*'Flat everywhere'", {"target_curvature": "Torus"}),
                (ValueError, "^target_curvature: 99", {"target_curvature": 99}),
                (TypeError, "^cone_distortion must be of type float", {"cone_distortion": "a"}),
                (TypeError, "^colorize must be of type bool", {"colorize": "yes"}),
                (TypeError, "^texture_size must be of type int", {"texture_size": 2.5}),
                (TypeError, "^selected must hold numbers, not 'first'", {"selected": "first"}),
                (TypeError, "^selected must hold numbers, not {0: 1}", {"selected": {0: 1}}),
                (TypeError, "^curvature must hold numbers, not .'a'", {"curvature": ["a"]}),
                (TypeError, "^progress must be True or a function, not 'bar'", {"progress": "bar"}),
                (ValueError, "cannot be used", {"cone_distortion": -1.0}),
                (FileNotFoundError, "there is no folder", {"report": "no such folder/report.html"})):
            with self.assertRaisesRegex(error, pattern):
                flatten(good, **slip)
        result = flatten(good)
        for path, error, pattern in (("hill.stl", ValueError, "ends in .obj or .ply or .glb"),
                                     ("no such folder/hill.ply", FileNotFoundError, "no such folder")):
            with self.assertRaisesRegex(error, pattern):
                result.save(path)
        flatten(good, target_curvature="disk", colorize=numpy.True_, cone_distortion=numpy.float32(1))

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

    def test_formats_without_shared_vertices(self):
        """A surface of STL is one, unless its faces are wanted apart."""
        vertices, faces = arrays(meshes.double_torus())
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "slab.stl")
            write_stl(path, vertices, faces)
            result = flatten(path)
            self.assertEqual((result.genus, result.components), (2, 1))
            self.assertEqual((result.joined_edges, result.pieces_apart), (3 * len(faces) // 2, 0))
            self.assertEqual(result.charts, flatten(vertices, faces).charts)
            apart = flatten(path, join_vertices="Never")
            self.assertEqual((apart.components, apart.joined_edges), (len(faces), 0))

    def test_chart_rotation(self):
        """Islands that are only packed: as they are, straight ones upright, or anyhow; all at one scale."""
        vertices, faces = arrays(meshes.plane(6))
        straight = vertices[faces][..., :2]
        uv, cell = straight.copy(), numpy.arange(len(faces)) // 18
        for chart in range(4):  # 18 faces each, at angles and places of their own
            z = (uv[cell == chart] @ [1, 1j]) * numpy.exp(1j * (0.3 + chart)) + 20 * chart
            uv[cell == chart] = numpy.stack([z.real, z.imag], axis=-1)

        def sides(corners):
            return (corners[:, 1] - corners[:, 0]) @ [1, 1j]
        for rotation, before, symmetry in (("None", uv, 1), ("Right angles", straight, 4), ("Any", uv, 0)):
            result = flatten(vertices, faces, uv=uv, charts="As they are, only packed",
                             chart_rotation=rotation)
            change = sides(result.uv) / sides(before)
            self.assertEqual(result.charts, 4)
            self.assertLess(numpy.abs(numpy.abs(change) / abs(change[0]) - 1).max(), 1e-4)  # floats
            unit = change / numpy.abs(change)
            self.assertLess(numpy.abs(unit ** symmetry - 1).max(), 1e-3, rotation)
        # A chart that keeps its direction is not cut for packing.
        torus = arrays(meshes.torus())
        cut, kept, whole = ((result.charts, result.overlap_cuts) for result in (
            flatten(*torus), flatten(*torus, chart_rotation="None"), flatten(*torus, charts="Without overlap")))
        self.assertGreater(cut, whole)
        self.assertEqual(kept, whole)

    def test_results_are_attributes(self):
        result = flatten(arrays(meshes.torus()))
        self.assertLessEqual(set(common.ALWAYS), set(result.results))
        for key, value in result.results.items():
            self.assertTrue(numpy.array_equal(getattr(result, key), value), key)
            self.assertTrue(getattr(type(result), key).__doc__, key)
        self.assertFalse(hasattr(result, "annulus_modulus"))
        with self.assertRaisesRegex(AttributeError, "annulus_modulus: flat annulus"):
            result.annulus_modulus  # pylint: disable=pointless-statement

    @needs_pymeshlab
    def test_methods_and_signatures(self):
        documents = pymeshlab.MeshSet()
        documents.create_torus()
        for our_filter, function, description in FILTERS:
            method = getattr(pymeshlab.MeshSet, our_filter.PYTHON_NAME)
            names = [name for name, _, _ in common.all_parameters(our_filter)]
            self.assertEqual(list(inspect.signature(method).parameters)[1:], names)
            self.assertEqual(list(inspect.signature(function).parameters)[9:], names)
            for parameter in description["parameters"]:
                self.assertIn(parameter["label"], method.__doc__)
                self.assertIn(parameter["label"], function.__doc__)
            places = [p["place"] for p in description["parameters"]]
            self.assertEqual(places[:common.SHOWN + 1], common.SHOWN * ["shown"] + ["advanced"])
            self.assertEqual(names[places.index("options"):], [name for name, _, _ in our_filter.RARE])
            self.assertLessEqual(len(our_filter.PARAMETERS), 16)
            options = subprocess.run(
                [sys.executable, "-m", "ricciflow", *["--hyperbolic"] * (our_filter is common.HYPERBOLIC), "--help"],
                env=dict(os.environ, PYTHONPATH=os.path.join(common.BUILD, "python")),
                capture_output=True, text=True, check=True).stdout.split("parameters of the filter:")[1]
            self.assertEqual(re.findall(r"(?m)^  --([\w-]+)", options), [name.replace("_", "-") for name in names])
        self.assertLess(max(map(len, pydoc.render_doc(function).splitlines()[:3])), 100)
        with self.assertRaisesRegex(TypeError, "did you mean 'seams'"):
            documents.compute_texcoord_parametrization_ricci_flow_euclidean_per_wedge(seam="Shortest")
        returned = documents.compute_texcoord_parametrization_ricci_flow_euclidean_per_wedge()
        self.assertEqual(returned["genus"], 1)
        if not ricciflow.pymeshlab.USES_PLUGIN:
            return
        for our_filter, _, description in FILTERS:
            values = documents.filter_parameter_values(our_filter.PYTHON_NAME)
            self.assertEqual(list(values), [name for name, _, _ in our_filter.PARAMETERS + our_filter.RARE])
            for parameter in description["parameters"]:
                default = parameter["default"]
                if parameter["type"] == "enum":
                    default = parameter["choices"].index(default)
                found = values[parameter["name"]]
                if parameter["type"] == "float":
                    found = float(f"{found:.7g}")  # single precision in the host
                self.assertEqual(found, default)

    def test_types(self):
        """The stub has what the module has, with the same parameters."""
        stub = ast.parse(read("filter_ricci", "python", "ricciflow", "__init__.pyi"))
        named = {node.name: node for node in stub.body if hasattr(node, "name")}
        self.assertLessEqual(set(named) & set(dir(ricciflow)),
                             set(ricciflow.__all__))
        for name in ricciflow.__all__:
            self.assertTrue(name in named or name in ("EUCLIDEAN", "HYPERBOLIC"), name)
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
                                 ("flatten(['x.ply', 'y.ply'])[0].charts + 1", 0),
                                 ("flatten(['x.ply', 'y.ply']).charts", 1),
                                 ("xatlas.parametrize([[0.0, 0, 0]], [[0, 0, 0]])[2].max()", 0),
                                 ("uniformize('x.ply').hyperbolic_area.real", 0)):
                with open(program, "w", encoding="utf-8") as source:
                    source.write(f"from ricciflow import flatten, uniformize, xatlas\n{line}\n")
                os.environ["MYPYPATH"] = os.path.join(common.BUILD, "python")
                out, _, code = api.run(["--ignore-missing-imports", "--cache-dir", folder, program])
                self.assertEqual(code, errors, line + "\n" + out)


class Together(unittest.TestCase):
    """Several meshes in one square."""

    @staticmethod
    def densities(result):
        """Area in the square over the area in space, of each face."""
        a, b = (result.uv[:, k] - result.uv[:, 0] for k in (1, 2))
        corners = result.vertices[result.faces]
        sides = corners[:, 1:] - corners[:, :1]
        space = numpy.linalg.norm(numpy.cross(sides[:, 0], sides[:, 1]), axis=1)
        return (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / space

    def test_one_square(self):
        """As one mesh of three components: charts lie beside each other, and isometric ones at one scale."""
        parts = [arrays(mesh) for mesh in (meshes.plane(5), meshes.plane(4), meshes.plane(3))]
        results = flatten([(3.0 ** i * vertices, faces) for i, (vertices, faces) in enumerate(parts)])
        first = numpy.cumsum([0] + [len(vertices) for vertices, _ in parts])
        whole = flatten(numpy.concatenate([3.0 ** i * part[0] for i, part in enumerate(parts)]),
                        numpy.concatenate([part[1] + start for part, start in zip(parts, first)]))
        self.assertTrue(numpy.array_equal(numpy.concatenate([r.uv for r in results]), whole.uv))
        self.assertEqual(whole.overlapping_faces, 0)
        density = self.densities(results[0])[0]
        for i, (result, (vertices, faces)) in enumerate(zip(results, parts)):
            self.assertTrue(numpy.array_equal(result.faces, faces))
            self.assertTrue(numpy.array_equal(result.vertices, 3.0 ** i * vertices))
            self.assertEqual(result.quality.shape, (len(vertices),))
            self.assertLess(numpy.abs(self.densities(result) / density - 1).max(), 1e-4)  # floats
            self.assertEqual(result.charts, whole.charts)

    def test_meshes_stay_apart(self):
        """Halves of a torus meet along edges, and faces of one mesh that share no vertices are joined."""
        vertices, faces = arrays(meshes.torus())
        half = len(faces) // 2
        whole = numpy.concatenate((vertices, vertices))
        other = numpy.concatenate((faces[:half], faces[half:] + len(vertices)))
        self.assertGreater(flatten(whole, other, join_vertices="Always").joined_edges, 0)
        parts = [(vertices[part].reshape(-1, 3), numpy.arange(3 * len(part)).reshape(-1, 3))
                 for part in (faces[:half], faces[half:])]
        for join in ("Automatic", "Always"):
            alone = [flatten(*part, join_vertices=join) for part in parts]
            both = flatten(parts, join_vertices=join)
            for key in ("joined_edges", "components", "boundary_loops"):
                self.assertEqual(both[0].results[key], sum(one.results[key] for one in alone), key)
            self.assertEqual((both[0].components, both[0].pieces_apart), (2, 0))
        # The cuts of one stay as they are beside the soup of another.
        with tempfile.TemporaryDirectory() as folder:
            write_stl(os.path.join(folder, "soup.stl"), vertices, faces)
            results = flatten([os.path.join(folder, "soup.stl"), (whole, other)])
            alone = flatten(whole, other)
            self.assertEqual(results[0].joined_edges, 3 * len(faces) // 2)
            self.assertGreater(alone.pieces_apart, 0)
            for key, of_soup in (("pieces_apart", 0), ("boundary_loops", 0), ("components", 1)):
                self.assertEqual(results[0].results[key], alone.results[key] + of_soup, key)

    def test_a_pair_is_one_mesh(self):
        vertices, faces = arrays(meshes.hill())
        pair = flatten([vertices, faces])
        self.assertTrue(numpy.array_equal(pair.uv, flatten(vertices, faces).uv))
        pair = flatten([vertices.tolist(), faces.tolist()])
        self.assertEqual(len(pair.faces), len(faces))

    def test_refinement(self):
        """Vertices that are added go to the mesh whose faces have them."""
        parts = [arrays(meshes.swirled(meshes.plane(12))), arrays(meshes.plane(4))]
        results = flatten(parts, output_triangulation="Common refinement", target_curvature="Disk")
        self.assertGreater(len(results[0].vertices), len(parts[0][0]))
        for result, (vertices, faces) in zip(results, parts):
            self.assertTrue(numpy.array_equal(result.vertices[:len(vertices)], vertices))
            self.assertEqual(set(result.faces.ravel()), set(range(len(result.vertices))))
            space = numpy.abs(numpy.cross(*(result.vertices[result.faces[:, k]] -
                                            result.vertices[result.faces[:, 0]] for k in (1, 2)))[:, 2])
            own = numpy.abs(numpy.cross(*(vertices[faces[:, k]] - vertices[faces[:, 0]]
                                          for k in (1, 2)))[:, 2])
            self.assertAlmostEqual(space.sum() / own.sum(), 1.0, places=9)

    def test_pictures(self):
        """A texture for all: each mesh shows its own picture, one without any its colour."""
        with tempfile.TemporaryDirectory() as folder:
            paths = []
            for name, colour in (("red", (255, 0, 0)), ("blue", (0, 0, 255))):
                textures.write_png(os.path.join(folder, name + ".png"),
                                   textures.Image([[colour] * 8 for _ in range(8)], 8))
                path = os.path.join(folder, name + ".ply")
                mesh = meshes.plane(3)
                textures.write_ply(path, mesh, [[mesh.vertices[v][:2] for v in face]
                                                for face in mesh.faces], [name + ".png"])
                paths.append(path)
            plain = arrays(meshes.plane(2))
            texture = os.path.join(folder, "all.png")
            results = flatten([paths[0], plain, paths[1]], carry_texture=texture, texture_size=64)
            image_of_all = textures.read_png(texture)
            for result, wanted in zip(results, ((1, 0, 0), (1, 1, 1), (0, 0, 1))):
                for wedge in result.uv.tolist():
                    u, v = (sum(corner[k] for corner in wedge) / 3 for k in (0, 1))
                    texel = image_of_all.rows[int((1 - v) * 64)][int(u * 64)][:3]
                    self.assertEqual(tuple(c / image_of_all.top for c in texel), wanted)
            for result, name in zip(results, ("red.obj", "plain.obj", "blue.obj")):
                result.save(os.path.join(folder, name))
                again = flatten(os.path.join(folder, name), charts="As they are, only packed")
                self.assertEqual(len(again.faces), len(result.faces))

    def test_refused(self):
        one = arrays(meshes.hill())
        with self.assertRaisesRegex(TypeError, "selected is for one mesh"):
            flatten([one, one], selected=[1])
        broken = arrays(meshes.with_nan(meshes.hill()))
        with self.assertRaises(ricciflow.Refused) as alone:
            flatten(*broken)
        with self.assertRaises(ricciflow.Refused) as together:
            flatten([one, broken, broken], time_limit=60)
        self.assertEqual(str(together.exception), f"Mesh 2 of 3: {alone.exception}")
        needles = arrays(meshes.swirled(meshes.plane(12)))
        for refused, values, place in (
                (one, {"target_curvature": "Flat everywhere"}, ""),
                (needles, {"method": "Fixed triangles"}, f"Component with face 0 ({len(needles[1])} faces): ")):
            with self.assertRaises(ricciflow.Refused) as alone:
                flatten(*refused, **values)
            with self.assertRaises(ricciflow.Refused) as together:
                flatten([arrays(meshes.torus()), refused], **values)
            self.assertEqual(str(together.exception), f"Mesh 2 of 2: {place}{alone.exception}")
        with self.assertRaisesRegex(ricciflow.Refused, "^The run was stopped"):
            flatten([one, one], time_limit=1e-9)
        with self.assertRaisesRegex(ValueError, "^The value -1 of cone_count"):
            flatten([one, one], cone_count=-1)
        with self.assertRaisesRegex(ricciflow.Refused, "no texture coordinates: mesh 1, mesh 2"):
            flatten([one, one], charts="As they are, only packed")
        with self.assertRaisesRegex(ValueError, "Mesh 2 of 2: .*indices from 0"):
            flatten([one, (one[0][:3], one[1])])
        with tempfile.TemporaryDirectory() as folder:
            paths = [os.path.join(folder, name) for name in ("a.ply", "b.obj")]
            textures.write_ply(paths[0], meshes.hill(), colours=[(255, 0, 0, 255)] * len(one[0]))
            with open(paths[1], "w", encoding="utf-8") as target:
                target.write("mtllib b.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
            with open(os.path.join(folder, "b.mtl"), "w", encoding="utf-8") as target:
                target.write("newmtl m\nKd 0 0 1\n")
            with self.assertRaisesRegex(ricciflow.Refused, r"a\.ply.*b\.obj.*Bake them apart"):
                flatten(paths, carry_texture=os.path.join(folder, "c.png"))
            self.assertEqual([len(result.faces) for result in flatten(paths)], [len(one[1]), 1])

    @needs_pymeshlab
    def test_meshes_of_pymeshlab(self):
        parts = [arrays(meshes.hill()), arrays(meshes.torus())]
        hosted = flatten([pymeshlab.Mesh(*part) for part in parts])
        for one, other in zip(hosted, flatten(parts)):
            self.assertTrue(numpy.array_equal(one.uv, other.uv))


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
                self.check(vertices, faces, ricciflow.xatlas.parametrize)
                alone = numpy.vstack([vertices[:1], vertices])  # a vertex without a face
                self.check(alone, faces + 1, ricciflow.xatlas.parametrize)

    def test_beside_xatlas(self):
        """The same signature, and no more charts."""
        try:
            import xatlas
        except ImportError as problem:
            self.skipTest(f"xatlas cannot be imported: {problem}")
        ours = inspect.signature(ricciflow.xatlas.parametrize).parameters
        stated = re.search(r"parametrize\((.*)\) ->", xatlas.parametrize.__doc__).group(1)
        self.assertEqual(list(ours), re.findall(r"(\w+): ", stated))
        for surface in self.surfaces:
            vertices, faces = arrays(surface())
            with self.subTest(surface=surface.__name__):
                self.assertLessEqual(
                    self.check(vertices, faces, ricciflow.xatlas.parametrize),
                    self.check(vertices, faces, xatlas.parametrize))


if __name__ == "__main__":
    common.main()
