# SPDX-License-Identifier: GPL-3.0-or-later
"""Real meshes from ../shared/meshes, beside the repository, in PyMeshLab.
Usage: test_shared_meshes.py BUILD_DIR [TEST...]"""

import glob
import os
import subprocess
import sys
import tempfile
import time
import unittest

import common
import meshes

SHARED = os.path.join(os.path.dirname(common.REPOSITORY), "shared")
MESHES = os.path.join(SHARED, "meshes")
ORACLE = os.path.join(SHARED, "verify_uv.py")
if not os.path.isdir(MESHES):
    common.skip("../shared/meshes is not there")

from pymeshlab_host import load, pymeshlab, run  # noqa: E402 (only where the meshes are)

# Clean meshes that need no cones: every one of them has to be solved.
SOLVED = ("annulus_", "b27_", "b4_", "disk_", "g1_", "g2b1_", "mc_blob_annulus", "mc_blob_disk",
          "mc_bunny_disk", "mc_rocker_g1", "mc_torus_g1", "nefertiti_disk", "plane_holes")


def write_obj(path, mesh):
    """Nine digits, which is all that the host's single-precision texture coordinates have."""
    with open(path, "w", encoding="utf-8") as out:
        for x, y, z in mesh.vertex_matrix():
            out.write(f"v {x:.17g} {y:.17g} {z:.17g}\n")
        for u, v in mesh.wedge_tex_coord_matrix():
            out.write(f"vt {u:.9g} {v:.9g}\n")
        for i, face in enumerate(mesh.face_matrix()):
            out.write("f " + " ".join(f"{v + 1}/{3 * i + k + 1}" for k, v in enumerate(face)) + "\n")


class RockerArm(unittest.TestCase):
    """The paper's values for this mesh, Table 1, to a hundredth of what they have above 1."""

    def setUp(self):
        path = os.path.join(MESHES, "g1_rocker_arm.ply")
        if not os.path.exists(path):
            common.skip("../shared/meshes/g1_rocker_arm.ply is not there")
        self.documents = load(path)

    def test_inversive_distance(self):
        returned = run(self.documents, target_curvature="Flat everywhere", method="Fixed triangles",
                       epsilon=1e-10)
        self.assertLess(returned["max_curvature_error"], 1e-10)
        self.assertAlmostEqual(returned["qc_vertex_mean"], 1.0461, delta=0.000461)
        self.assertEqual(returned["flipped_faces"], 0)
        self.check_with_oracle()

    def test_thurston(self):
        returned = run(self.documents, target_curvature="Flat everywhere", method="Thurston")
        self.assertAlmostEqual(returned["qc_vertex_mean"], 1.7405, delta=0.007405)

    def check_with_oracle(self):
        if not os.path.exists(ORACLE):
            print("SKIPPED: ../shared/verify_uv.py is not there")
            return
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "result.obj")
            write_obj(path, self.documents.current_mesh())
            checked = subprocess.run([sys.executable, ORACLE, path, "--seam-tol", "1e-3"],
                                     capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)


class Finish(unittest.TestCase):
    """No finish makes a map worse than it found it."""

    def test_of_a_map_with_flipped_faces(self):
        path = os.path.join(MESHES, "wild", "pb_xavier.ply")
        if not os.path.exists(path):
            common.skip("../shared/meshes/wild/pb_xavier.ply is not there")
        # One distortion, for the same cones: of maps with different ones the cheapest is taken, whatever its angles.
        for values in ({}, {"target_curvature": "Placed cones", "cone_distortion": 0.25}):
            with self.subTest(**values):
                flow, finished = (run(load(path), finish=finish, **values)
                                  for finish in ("None", "Least distortion"))
                self.assertGreater(flow["flipped_faces"], 0)
                self.assertEqual(finished["flipped_faces"], 0)
                self.assertEqual(finished["overlapping_faces"], 0)
                self.assertLess(finished["qc_area_mean"], flow["qc_area_mean"])
                self.assertLess(finished["objective"], flow["objective"])


class EveryMesh(unittest.TestCase):
    """Each is solved without a flipped face and with areas for a texture, or ends in a sentence."""

    def test_common_refinement(self):
        self.check_all(output_triangulation="Common refinement")

    def test_defaults(self):
        self.check_all()

    def check_all(self, **values):
        files = sorted(glob.glob(os.path.join(MESHES, "*.ply"))) + sorted(
            glob.glob(os.path.join(MESHES, "peers", "*.ply"))) + [
                os.path.join(MESHES, "hard", "g12_crank.ply")]
        self.assertGreater(len(files), 0)
        for path in files:
            name = os.path.splitext(os.path.basename(path))[0]
            if os.path.getsize(path) > 10e6:
                print(f"SKIPPED: {name} is too large for a test")
                continue
            with self.subTest(name):
                self.check(name, path, **values)

    def check(self, name, path, **values):
        documents = load(path)
        vertices = documents.current_mesh().vertex_number()
        start = time.monotonic()
        try:
            returned = run(documents, **values)
        except pymeshlab.PyMeshLabException as refusal:
            sentence = str(refusal).split("Details: ", 1)[1]
            print(f"{name:28} {sentence}", flush=True)
            self.assertRegex(sentence, r"\.$")
            self.assertNotIn("unexpectedly", sentence)
            self.assertFalse(name.startswith(SOLVED), sentence)
            return
        seconds = time.monotonic() - start
        print(f"{name:28} {returned['iterations']:3d} steps {seconds:6.2f} s "
              f"residual {returned['max_curvature_error']:.1e} "
              f"floor {returned['residual_floor']:.1e} "
              f"qc {returned['qc_vertex_mean']:.4f} flipped {returned['flipped_faces']} "
              f"by rounding {returned['flipped_by_rounding']}", flush=True)
        self.assertTrue(returned["converged"])
        wedges = documents.current_mesh().wedge_tex_coord_matrix().reshape(-1, 3, 2)
        self.assertTrue(all(meshes.uv_area(wedge) > 0 for wedge in wedges))
        self.assertEqual((returned["flipped_faces"], returned["flipped_by_rounding"]), (0, 0))
        self.assertLessEqual(returned["area_distortion_mean"], 3)
        self.assertEqual(documents.current_mesh().vertex_number(),
                         vertices + (returned["refinement_points"] if values else 0))


if __name__ == "__main__":
    common.main()
