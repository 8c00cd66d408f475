# SPDX-License-Identifier: GPL-3.0-or-later
"""What the host tests share. A test that cannot run says why and exits with 77."""

import os
import sys
import types
import unittest

BUILD = os.path.abspath(sys.argv.pop(1)) if len(sys.argv) > 1 else ""
REPOSITORY = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

NAME = "Generalized Ricci Flow (Euclidean)"
PYTHON_NAME = "compute_texcoord_parametrization_ricci_flow_euclidean_per_wedge"

ALWAYS = {
    "converged": bool, "iterations": int, "max_curvature_error": float, "residual_floor": float,
    "lengthened": float, "qc_mean": float, "qc_vertex_mean": float, "qc_area_mean": float, "qc_p99": float,
    "qc_max": float, "area_distortion_mean": float, "area_distortion_spread": float,
    "stretch": float, "objective": float,
    "flipped_faces": int, "flipped_by_rounding": int, "finish_moved": int, "ended_early": int, "flips": int,
    "refinement_points": int, "edge_swaps": int, "boundary_splits": int, "euler_characteristic": int,
    "genus": int, "boundary_loops": int, "components": int, "cut_nonmanifold_edges": int,
    "split_vertices": int, "duplicate_faces": int, "one_sided_components": int,
    "degenerate_faces": int, "cones": int, "chosen_seam_edges": int,
    "chosen_seam_length": float, "seam_edges": int,
    "seam_length": float, "seam_length_relative": float, "charts": int,
    "occupancy": float, "capped_holes": int,
    "overlapping_charts": int, "overlapping_faces": int, "unequal_seams": int, "overlap_cuts": int}


class vector(list):
    """Numbers that are one result."""


INVARIANTS = {
    "torus_tau_re": float, "torus_tau_im": float, "annulus_modulus": float,
    "rectangle_aspect": float, "holonomy_error": float, "period_matrix": vector,
    "period_error": float}
CHOSEN = {"target_used": int, "expected_spread": float, "cone_vertices": vector, "cone_curvatures": vector}
FREE_BOUNDARY = {"boundary_ratio_min": float, "boundary_ratio_max": float}
SPHERE = {
    "sphere_qc_area_mean": float, "sphere_area_distortion_mean": float,
    "sphere_flipped_faces": int}

TEXTURE = {"texture_scale": float}

# Parameter ids in the order of the public interface.
SEAMS = ["Shortest", "Existing texture seams", "Selected edges", "Border of selected faces"]
TARGET = ["Automatic", "Flat everywhere", "Disk", "Rectangle", "Cones at selected vertices",
          "From vertex quality", "Placed cones"]
METHOD = ["Intrinsic flips", "Fixed triangles", "Edge swaps", "Thurston"]
CHOICES = {"target_curvature": TARGET, "seams": SEAMS,
           "cone_rounding": ["Free", "Multiples of pi/2"],
           "method": METHOD,
           "charts": ["As the flow has them", "Without overlap", "Without overlap, cut for room",
                      "As they are, only packed"],
           "join_vertices": ["Automatic", "Never", "Always"],
           "output_triangulation": ["Keep the mesh", "Common refinement"],
           "finish": ["None", "Repair", "Least distortion", "Least stretch"],
           "holes": ["Boundaries", "Capped", "Short ones capped"]}
PARAMETERS = [
    ("target_curvature", "Enum", 0), ("free_boundary", "Bool", True), ("cone_distortion", "Float", 0.0),
    ("seams", "Enum", 0), ("output_triangulation", "Enum", 0), ("chart_margin", "Float", 0.0),
    ("colorize", "Bool", False), ("flat_layer", "Bool", False),
    ("holes", "Enum", 2), ("seam_hiding", "Float", 0.0), ("cone_count", "Int", 0),
    ("cone_rounding", "Enum", 0),
    ("method", "Enum", 0), ("finish", "Enum", 2), ("charts", "Enum", 2),
    ("normalize_uv", "Bool", True), ("sphere_layer", "Bool", False),
    ("join_vertices", "Enum", 0),
    ("carry_texture", "String", ""), ("texture_size", "Int", 2048), ("report", "String", ""),
    ("epsilon", "Float", 1e-8), ("time_limit", "Float", 0.0)]

HYPERBOLIC = types.SimpleNamespace(
    NAME="Generalized Ricci Flow (Hyperbolic)",
    PYTHON_NAME="compute_texcoord_parametrization_ricci_flow_hyperbolic_per_wedge",
    CHOICES={
        "target_curvature": ["Hyperbolic metric", "Cones at selected vertices",
                             "From vertex quality"],
        "seams": SEAMS, "method": METHOD[:2],
        "output_triangulation": ["Keep the mesh", "Common refinement"],
        "finish": ["None", "Repair"],
        "join_vertices": ["Automatic", "Never", "Always"]},
    PARAMETERS=[
        ("target_curvature", "Enum", 0), ("cone_angle", "Float", 180.0),
        ("output_triangulation", "Enum", 0), ("colorize", "Bool", False),
        ("flat_layer", "Bool", False), ("universal_cover", "Int", 0),
        ("generator_axes", "Bool", False), ("canonical_polygon", "Bool", False),
        ("seams", "Enum", 0), ("free_boundary", "Bool", False), ("method", "Enum", 0),
        ("finish", "Enum", 1), ("join_vertices", "Enum", 0),
        ("carry_texture", "String", ""), ("texture_size", "Int", 2048), ("report", "String", ""),
        ("epsilon", "Float", 1e-8), ("time_limit", "Float", 0.0)])

# What the dialogs show at once; the rest is behind "Show advanced parameters".
SHOWN = 8


def skip(reason):
    print(f"SKIPPED: {reason}", flush=True)
    sys.exit(77)


def main():
    program = unittest.main(exit=False, verbosity=2)
    sys.exit(0 if program.result.wasSuccessful() and program.result.testsRun > 0 else 1)
