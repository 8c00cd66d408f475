# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line of the Python package: nothing is lost and nothing is done twice.
Usage: test_batch.py BUILD_DIR [TEST...], with a Python that has numpy; one test needs Dask, one PyMeshLab."""

import csv
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import common
import meshes
import textures

try:
    import numpy  # noqa: F401  pylint: disable=unused-import
except ImportError as problem:
    common.skip(f"numpy cannot be imported here: {problem}")
try:
    import pymeshlab
except ImportError:
    pymeshlab = None
try:
    from dask import distributed
except ImportError:
    distributed = None

PACKAGE = os.path.join(common.BUILD, "python")
if not os.path.isdir(PACKAGE):
    common.skip("the Python package is not built")
COUNT = 12


class Batch(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.meshes = os.path.join(folder.name, "meshes")
        self.out = os.path.join(folder.name, "out")
        self.hooks = os.path.join(folder.name, "hooks")
        self.stems = {}  # of meshes, without which their files in OUT end
        os.makedirs(os.path.join(self.meshes, "more"))

    def write(self, name, mesh):
        meshes.write_ply(os.path.join(self.meshes, name), mesh)

    def write_tori(self):
        names = [f"{i}.ply" if i % 2 else f"more/{i}.ply" for i in range(COUNT)]
        for i, name in enumerate(names):
            self.write(name, meshes.torus(columns=10 + i))
        return names

    def start(self, *options):
        environment = {**os.environ, "PYTHONPATH": PACKAGE + os.pathsep + self.hooks}
        return subprocess.Popen(
            [sys.executable, "-m", "ricciflow", self.meshes, self.out, *options],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, errors="replace", env=environment)

    def start_cluster(self):
        """Two workers in a process of their own; the scheduler's address."""
        cluster = subprocess.Popen(
            [sys.executable, "-c",
             "from dask.distributed import LocalCluster\n"
             "with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as c:\n"
             "    print(c.scheduler_address, flush=True)\n"
             "    input()\n"],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
            env={**os.environ, "PYTHONPATH": PACKAGE})
        self.addCleanup(cluster.wait)
        self.addCleanup(cluster.stdout.close)
        self.addCleanup(cluster.stdin.close)
        return cluster.stdout.readline().strip()

    def batch(self, *options):
        process = self.start(*options)
        printed, errors = process.communicate(timeout=800)
        return process.returncode, printed + errors

    def records(self):
        found = {}
        for place, _, names in os.walk(self.out):
            for name in names:
                if name.endswith(".json"):
                    path = os.path.join(place, name)
                    with open(path, encoding="utf-8") as source:
                        record = json.load(source)
                    found[record["mesh"]] = record
                    self.stems[record["mesh"]] = os.path.relpath(path, self.out)[:-5]
        return found

    def times(self):
        return {mesh: os.stat(os.path.join(self.out, self.stems[mesh] + ".json")).st_mtime_ns
                for mesh in self.records()}

    def check_solved(self, names, genus=1):
        records = self.records()
        self.assertEqual(set(records), set(names))
        for name in names:
            self.assertEqual(records[name]["state"], "solved", records[name])
            self.assertIn(genus, (records[name]["results"]["genus"], None))
            mesh = meshes.read_ply(os.path.join(self.out, self.stems[name] + ".ply"))
            self.assertIsNotNone(mesh.wedges)
        with open(os.path.join(self.out, "results.csv"), encoding="utf-8", newline="") as source:
            rows = list(csv.DictReader(source))
        self.assertEqual(sorted(row["mesh"] for row in rows), sorted(names))
        self.assertEqual(os.path.getsize(os.path.join(self.out, "failures.txt")), 0)
        left = [name for _, folders, files in os.walk(self.out) for name in folders + files
                if ".part" in name]
        self.assertEqual(left, [])

    @unittest.skipIf(distributed is None, "Dask is not installed")
    def test_killed_worker_loses_nothing(self):
        names = self.write_tori()
        address = self.start_cluster()
        process = self.start("--scheduler", address)
        with distributed.Client(address) as client:
            while len(self.records()) < 2 and process.poll() is None:
                time.sleep(0.05)
            self.assertIsNone(process.poll(), "the batch ended too early")
            workers = client.run(os.getpid)
            os.kill(next(iter(workers.values())), signal.SIGKILL)
            self.assertLess(len(self.records()), COUNT, "the batch was over already")
        printed, errors = process.communicate(timeout=800)
        self.assertEqual(process.returncode, 0, printed + errors)
        self.check_solved(names)

        # A second run has nothing to do; without two of the results, those two.
        before = self.times()
        code, text = self.batch("--workers", "1")
        self.assertEqual(code, 0, text)
        self.assertIn(f"{COUNT} meshes, {COUNT} done before, 0 to run", text)
        self.assertEqual(self.times(), before)
        missing = [names[3], names[4]]
        for name in missing:
            os.remove(os.path.join(self.out, self.stems[name] + ".json"))
        code, text = self.batch("--workers", "1")
        self.assertEqual(code, 0, text)
        self.assertIn("2 to run", text)
        after = self.times()
        self.assertEqual({name for name in names if after[name] != before[name]}, set(missing))
        self.check_solved(names)

    def test_layers_and_no_results_of_other_parameters(self):
        self.write("double.ply", meshes.double_torus())
        self.write("double.ply.ply", meshes.hill())  # a name that begins alike
        code, text = self.batch("--layers", "Flat mesh", "--report", "run.html")
        self.assertEqual(code, 0, text)
        others = {file for file in os.listdir(self.out) if file.startswith("double.ply.ply.")}
        self.assertEqual(others, {"double.ply.ply." + ending
                                  for ending in ("csv", "flat.ply", "html", "json", "ply")})
        flat = meshes.read_ply(os.path.join(self.out, "double.ply.flat.ply"))
        self.assertTrue(all(z == 0.0 for _, _, z in flat.vertices))
        self.assertTrue(os.path.exists(os.path.join(self.out, "double.ply.ply")))
        code, text = self.batch("--target-curvature", "Disk")
        self.assertEqual(code, 0, text)
        self.assertEqual(self.records()["double.ply"]["state"], "refused")
        self.assertEqual(sorted(os.listdir(self.out)),
                         ["double.ply.json", "double.ply.ply.json", "double.ply.ply.ply",
                          "failures.txt", "results.csv"])

    def test_other_parameters_or_another_mesh_run_again(self):
        self.write("one.ply", meshes.hill(6))
        self.write("two.ply", meshes.hill(7))
        self.assertEqual(self.batch("--workers", "1")[0], 0)
        code, text = self.batch("--workers", "1", "--target-curvature", "Disk")
        self.assertIn("2 to run", text)
        self.write("two.ply", meshes.hill(8))
        code, text = self.batch("--workers", "1", "--target-curvature", "Disk")
        self.assertEqual(code, 0, text)
        self.assertIn("1 to run", text)

    def test_each_mesh_has_its_own_files(self):
        """The ending of a name counts."""
        names = ["1.ply", "more/2.ply"]
        for i, name in enumerate(names):
            mesh = meshes.torus(columns=10 + i)
            wedges = textures.shattered(mesh.faces)
            place = os.path.join(self.meshes, os.path.dirname(name))
            textures.write_png(os.path.join(place, "old.png"), textures.painted(mesh, wedges, 256))
            textures.write_ply(os.path.join(self.meshes, name), mesh, wedges, ["old.png"])
        code, text = self.batch("--workers", "2", "--carry-texture", "new.png", "--texture-size",
                                "64", "--report", "run.csv")
        self.assertEqual(code, 0, text)
        self.check_solved(names)
        for name in names:
            place, file = os.path.split(os.path.join(self.out, os.path.splitext(name)[0]))
            written = [file + ending for ending in (".json", ".ply", ".png", ".csv")]
            written += ["failures.txt", "more", "results.csv"] if place == self.out else []
            self.assertEqual(sorted(os.listdir(place)), sorted(written))
            with open(os.path.join(place, file + ".ply"), "rb") as saved:
                self.assertIn(f"TextureFile {file}.png\n".encode(), saved.read(2000))
            image = textures.read_png(os.path.join(place, file + ".png"))
            self.assertEqual((image.width, image.height), (64, 64))
        self.assertEqual(sorted(os.listdir(self.meshes)), ["1.ply", "more", "old.png"])
        self.assertEqual(sorted(os.listdir(os.path.join(self.meshes, "more"))), ["2.ply", "old.png"])

    def test_refusals_and_failures_are_listed(self):
        disk = ("--target-curvature", "Disk")
        self.write("good.ply", meshes.hill())
        self.write("torus.ply", meshes.torus())
        code, text = self.batch("--workers", "1", *disk)
        self.assertEqual(code, 0, text)
        record = self.records()["torus.ply"]
        self.assertEqual(record["state"], "refused")
        self.assertIn("topological disk", record["reason"])
        with open(os.path.join(self.out, "failures.txt"), encoding="utf-8") as source:
            self.assertRegex(source.read(), r"^torus.ply\trefused\t.*topological disk")

        # A process that dies or lasts too long is a failure of its mesh alone.
        code, text = self.batch(
            "--workers", "1", *disk, "--timeout", "0.001", "--seam-hiding", "0.25")
        self.assertEqual(code, 1, text)
        self.assertEqual({r["state"] for r in self.records().values()}, {"timeout"})
        os.makedirs(self.hooks)
        with open(os.path.join(self.hooks, "sitecustomize.py"), "w", encoding="utf-8") as hook:
            hook.write("import os, sys\n"
                       "if 'good.ply' in sys.orig_argv[-1]:\n"
                       "    os.abort()\n")
        code, text = self.batch("--workers", "1", *disk)
        self.assertEqual(code, 1, text)
        self.assertEqual({name: r["state"] for name, r in self.records().items()},
                         {"good.ply": "crashed", "torus.ply": "refused"})
        self.assertIn("SIGABRT", self.records()["good.ply"]["reason"])
        self.assertIn("0 to run", self.batch("--workers", "1", *disk)[1])
        os.remove(os.path.join(self.hooks, "sitecustomize.py"))
        code, text = self.batch("--workers", "1", *disk, "--retry")
        self.assertEqual(code, 0, text)
        self.assertIn("1 to run", text)

    def test_names_of_results(self):
        """Without the ending of the mesh, unless two would meet; a mesh whose name has changed takes
        its older files along."""
        self.write("alone.ply", meshes.hill(4))
        self.write("pair.ply", meshes.hill(5))
        self.write("pair.old.ply", meshes.hill(6))
        os.makedirs(self.out)
        with open(os.path.join(self.out, "other.json"), "w", encoding="utf-8") as other:
            other.write('{"of": "a person"}')
        self.write("other.ply", meshes.hill(4))

        def results():
            return {name for name in os.listdir(self.out) if name.endswith(".ply")}
        self.assertEqual(self.batch()[0], 0)
        self.assertEqual(results(), {"alone.ply", "pair.ply.ply", "pair.old.ply", "other.ply.ply"})
        os.remove(os.path.join(self.meshes, "pair.old.ply"))
        self.assertIn("3 meshes, 2 done before, 1 to run", self.batch()[1])
        self.assertEqual(results(), {"alone.ply", "pair.ply", "pair.old.ply", "other.ply.ply"})
        self.assertIn("0 to run", self.batch()[1])
        with open(os.path.join(self.out, "other.json"), encoding="utf-8") as other:
            self.assertEqual(json.load(other), {"of": "a person"})

    def test_what_came_out(self):
        """One sentence, all results if they are asked for, and doubts: on standard error and in the
        table of a folder."""
        self.write("hill.ply", meshes.hill())
        path, out = os.path.join(self.meshes, "hill.ply"), self.out + ".ply"

        def run(mesh, target, *options):
            done = subprocess.run([sys.executable, "-m", "ricciflow", mesh, target, *options],
                                  capture_output=True, text=True,
                                  env={**os.environ, "PYTHONPATH": PACKAGE})
            self.assertEqual(done.returncode, 0, done.stderr)
            return done.stdout, done.stderr
        said = rf"^1 chart, \d\d % filled, no flips, \d+\.\d s -> {re.escape(out)}\n"
        printed, errors = run(path, out)
        self.assertRegex(printed, said + "$")
        self.assertEqual(errors, "")
        self.assertEqual(run(path, out, "--quiet"), ("", ""))
        printed, errors = run(path, out, "--verbose", "--target-curvature", "Disk")
        self.assertRegex(printed, said + "(?s:.*)charts = 1\n")
        self.assertRegex(errors, "^hill.ply: This map is probably not usable: .*\n$")
        _, errors = run(self.meshes, self.out, "--target-curvature", "Disk")
        self.assertRegex(errors, "^hill.ply: This map is probably not usable: .*\n$")
        with open(os.path.join(self.out, "results.csv"), encoding="utf-8", newline="") as source:
            row, = csv.DictReader(source)
        self.assertIn("not usable", row["messages"])

    @unittest.skipIf(pymeshlab is None, "PyMeshLab, which reads most of them, is not installed")
    def test_every_format_and_what_is_skipped(self):
        for ending in ("3ds", "dae", "obj", "off", "ply", "stl", "wrl", "x3d"):
            documents = pymeshlab.MeshSet()
            documents.create_sphere(subdiv=2)
            documents.save_current_mesh(os.path.join(self.meshes, f"ball.{ending}"))
        for name in ("notes.md", "more/old.png", "more/LICENCE"):
            with open(os.path.join(self.meshes, name), "w", encoding="utf-8") as other:
                other.write("{}")
        with open(os.path.join(self.meshes, "broken.ply"), "w", encoding="utf-8") as broken:
            broken.write("ply\nformat ascii 1.0\nelement vertex 5\n")
        code, text = self.batch()
        self.assertEqual(code, 1, text)
        self.assertRegex(text, r"Skipped: 1 x \.md, .*1 x \.png, 1 x without an ending")
        states = {name: record["state"] for name, record in self.records().items()}
        self.assertEqual(states.pop("broken.ply"), "unreadable")
        self.assertEqual(set(states.values()), {"solved"}, self.records())
        self.assertEqual({name.split(".")[1] for name in states},
                         {"3ds", "dae", "obj", "off", "ply", "stl", "wrl", "x3d"})
        self.assertIn("0 to run", self.batch()[1])

    def test_out_is_in(self):
        """Results are not meshes, and no mesh is replaced by a result."""
        self.out = self.meshes
        self.write("hill.ply", meshes.hill())
        self.write("more/torus.ply", meshes.torus())
        for ran in (2, 0):
            code, text = self.batch("--layers", "Flat mesh", "--report", "run.html")
            self.assertEqual(code, 0, text)
            self.assertIn(f"2 meshes, {2 - ran} done before, {ran} to run", text)
            self.assertNotIn("Skipped", text)
        self.write("hill.ply", meshes.hill(9))
        self.assertIn("2 meshes, 1 done before, 1 to run", self.batch("--layers", "Flat mesh", "--report",
                                                                      "run.html")[1])
        self.check_solved(["hill.ply", "more/torus.ply"], genus=None)
        self.write("double.ply", meshes.double_torus())
        self.write("double.ply.ply", meshes.torus())
        code, text = self.batch()
        self.assertEqual(code, 2, text)
        self.assertIn("would replace the mesh", text)

    def test_sentences(self):
        """What cannot be done is said in one line, without a traceback."""
        self.write("hill.ply", meshes.hill())
        path, bare = os.path.join(self.meshes, "hill.ply"), os.path.join(self.meshes, "hill")
        with open(bare, "w", encoding="utf-8") as target:
            target.write("v 0 0 0\n")
        for mesh, out, options, code, pattern in (
                ("nothing", "out", (), 2, "There is no file or folder"),
                (bare, "out.obj", (), 1, "hill has no ending that tells its format"),
                (self.meshes, "out", ("--workers", "-1"), 2, "'-1' is not a whole number"),
                (self.meshes, path, (), 1, "hill.ply: File exists"),
                (path, "out.stl", (), 2, "OUT must end in .obj or .ply"),
                (path, os.path.join(path, "out.ply"), (), 1, "hill.ply"),
                (path, "out.ply", ("--target-curvature", "Disc"), 2, "did you mean 'Disk'"),
                (path, "out.ply", ("--chart-margin=0.004",), 2, "--chart-margin: it is 'padding' now"),
                (path, "out.ply", ("--no-flat-layer",), 2, "--no-flat-layer: it is layers='Flat mesh' now"),
                (path, "out.ply", ("more",), 2, "There is no place for 'more'"),
                (path, "out.ply", ("--cone-distortion", "-1"), 1, "failed: .* cannot be used")):
            with self.subTest(out=out, options=options):
                done = subprocess.run(
                    [sys.executable, "-m", "ricciflow", mesh, out, *options],
                    capture_output=True, text=True, env={**os.environ, "PYTHONPATH": PACKAGE})
                self.assertEqual(done.returncode, code, done.stderr)
                self.assertRegex(done.stderr, pattern)
                self.assertLessEqual(len(done.stderr.splitlines()), 2, done.stderr)
                self.assertNotIn("Traceback", done.stderr)

    def test_a_folder_that_cannot_be_written(self):
        """Root may write everywhere but on a medium that nobody may write: os.access() knows."""
        self.write("hill.ply", meshes.hill())
        os.makedirs(self.out, exist_ok=True)
        for mesh, out in ((self.meshes, self.out),
                          (os.path.join(self.meshes, "hill.ply"), os.path.join(self.out, "a.ply"))):
            done = subprocess.run(
                [sys.executable, "-c", "import os, sys\n"
                 "from ricciflow.__main__ import main\n"
                 "os.access = lambda place, mode: mode != os.W_OK\n"
                 "sys.exit(main(sys.argv[1:]))", mesh, out],
                capture_output=True, text=True, env={**os.environ, "PYTHONPATH": PACKAGE})
            self.assertEqual((done.returncode, done.stderr),
                             (1, f"{self.out}: the folder cannot be written\n"))
            self.assertEqual(os.listdir(self.out), [])

    def test_interrupted(self):
        names = self.write_tori()
        process = self.start("--workers", "2")
        while len(self.records()) < 2 and process.poll() is None:
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        printed, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, printed + errors)
        self.assertIn("to continue", errors)
        done = self.times()
        self.assertLess(len(done), COUNT, "the batch was over already")
        with open(os.path.join(self.out, "failures.txt"), encoding="utf-8") as source:
            self.assertEqual(source.read().count("missing"), COUNT - len(done))
        code, text = self.batch("--workers", "2")
        self.assertEqual(code, 0, text)
        self.assertIn(f"{len(done)} done before", text)
        self.assertEqual({name: self.times()[name] for name in done}, done)
        self.check_solved(names)

    def test_one_atlas(self):
        """All meshes in one square: no two faces share a texel."""
        names = ["a.ply", "more/b.ply"]
        for name, mesh in zip(names, (meshes.torus(), meshes.hill())):
            self.write(name, mesh)
        code, text = self.batch("--one-atlas", "--padding", "2", "--texture-size", "256")
        self.assertEqual(code, 0, text)
        self.assertRegex(text, r"\d charts?, .* no flips, .*out\n")
        self.check_solved(names, genus=None)
        owner = {}
        for name in names:
            mesh = meshes.read_ply(os.path.join(self.out, self.stems[name] + ".ply"))
            for wedge in mesh.wedges:
                for x, y, _ in textures.texels_in(wedge, 256, 256):
                    self.assertEqual(owner.setdefault((x, y), name), name)
        self.assertEqual(set(owner.values()), set(names))
        code, text = self.batch("--one-atlas", "--quiet", "--layers", "Flat mesh")
        self.assertEqual((code, text), (0, ""))
        layer = meshes.read_ply(os.path.join(self.out, "atlas.flat.ply"))
        self.assertEqual(len(layer.faces), len(meshes.torus().faces) + len(meshes.hill().faces))
        code, text = self.batch("--one-atlas", "--scheduler", "local")
        self.assertEqual(code, 2)
        self.assertIn("--scheduler does not go with --one-atlas", text)
        self.write("c.ply", meshes.with_nan(meshes.hill()))
        code, text = self.batch("--one-atlas")
        self.assertEqual(code, 1)
        self.assertIn("refused: ", text)
        self.assertEqual({record["mesh"]: record["state"] for record in self.records().values()},
                         {"c.ply": "refused", **dict.fromkeys(names, "missing")})
        self.assertEqual([name for name in os.listdir(self.out) if name.endswith(".ply")], [])
        with open(os.path.join(self.meshes, "ba.ply"), "w", encoding="utf-8") as target:
            target.write("x")  # another name ends like its own
        self.assertEqual(self.batch("--one-atlas")[0], 1)
        with open(os.path.join(self.out, "failures.txt"), encoding="utf-8") as source:
            for line in source:
                name, state, reason = line.split("\t")
                self.assertEqual(state, "unreadable" if name == "ba.ply" else "missing")
                self.assertIn("ba.ply", reason)

    def test_names_of_any_bytes(self):
        self.write("a.ply", meshes.torus())
        os.rename(os.path.join(self.meshes, "a.ply"),
                  os.path.join(os.fsencode(self.meshes), b"m\xe4t.ply"))
        with open(os.path.join(self.meshes, "b.obj"), "wb") as target:
            target.write(b"mtllib f\xe4rbe.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        for _ in range(2):
            code, text = self.batch()
            self.assertEqual(code, 0, text)
            with open(os.path.join(self.out, "results.csv"), encoding="utf-8") as source:
                self.assertEqual([row[:2] for row in csv.reader(source)][1:],
                                 [["b.obj", "solved"], [r"m\udce4t.ply", "solved"]])

    def test_one_atlas_of_one_file(self):
        self.write("a.ply", meshes.torus())
        self.meshes = os.path.join(self.meshes, "a.ply")
        code, text = self.batch("--one-atlas")
        self.assertEqual(code, 2)
        self.assertIn("--one-atlas is for a folder", text)


if __name__ == "__main__":
    common.main()
