# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python package: the wheel in an empty environment, and what a program gets from it.
Usage: test_wheel.py BUILD_DIR [TEST...], with PyMeshLab's Python."""

import ast
import base64
import glob
import hashlib
import inspect
import os
import re
import subprocess
import sys
import sysconfig
import tempfile
import unittest
import zipfile

import common
import meshes

sys.path.insert(0, os.path.join(common.BUILD, "python"))
try:
    import numpy
    import pymeshlab
except ImportError as problem:
    common.skip(f"PyMeshLab cannot be imported here: {problem}")
if not os.path.isdir(os.path.join(common.BUILD, "python")):
    common.skip("the Python package is not built")

import pymeshlab_ricci
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
        for result in (mesh, inside):
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
        a, b = numpy.asarray(result.generators).reshape(-1, 2, 2).transpose(1, 0, 2) @ [1, 1j]
        self.assertTrue(numpy.allclose(abs(a) ** 2 - abs(b) ** 2, 1.0))
        high, low = numpy.asarray(result.generators), numpy.asarray(result.generators_low)
        self.assertEqual(high.shape, low.shape)
        self.assertTrue((abs(low) <= 2.0 ** -53 * abs(high)).all())
        self.assertTrue(low.any())
        self.assertLess(result.generators_error, 1e-8)

    def test_refusals(self):
        good = arrays(meshes.hill())
        with self.assertRaisesRegex(pymeshlab_ricci.Refused, "^'Flat everywhere' needs"):
            flatten(good, target_curvature="Flat everywhere")
        with self.assertRaises(pymeshlab.PyMeshLabException):
            flatten("there is no such file.ply")
        for bad in ((good[0][:, :2], good[1]), (good[0], good[1] + 1), (good[0], good[1] + 0.5),
                    (good[0], good[1] - 1)):
            with self.assertRaises(ValueError):
                flatten(bad)
        with self.assertRaises(pymeshlab_ricci.Refused):
            flatten(good, target_curvature="Square")
        for selected in ([0.5], [-1], [len(good[0])]):
            with self.assertRaisesRegex(ValueError, "^selected must hold indices"):
                flatten(good, selected=selected)
        with self.assertRaises(ValueError):
            flatten(good, curvature=[0.0])

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
            self.assertEqual(list(inspect.signature(function).parameters)[3:], names)
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
                                 ("uniformize('x.ply').hyperbolic_area.real", 0)):
                with open(program, "w", encoding="utf-8") as source:
                    source.write(f"from pymeshlab_ricci import flatten, uniformize\n{line}\n")
                os.environ["MYPYPATH"] = os.path.join(common.BUILD, "python")
                out, _, code = api.run(["--ignore-missing-imports", "--cache-dir", folder, program])
                self.assertEqual(code, errors, line + "\n" + out)


if __name__ == "__main__":
    common.main()
