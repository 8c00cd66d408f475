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
    "genus": int, "boundary_loops": int, "components": int, "joined_edges": int, "pieces_apart": int,
    "cut_nonmanifold_edges": int,
    "split_vertices": int, "duplicate_faces": int, "one_sided_components": int,
    "degenerate_faces": int, "cones": int, "chosen_seam_edges": int,
    "chosen_seam_length": float, "seam_edges": int,
    "seam_length": float, "seam_length_relative": float, "charts": int, "tiles": int,
    "occupancy": float, "padding_pixels": float, "capped_holes": int,
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

# Parameter ids in the order of the public interface. MeshLab has one text, "options", for the RARE ones, PyMeshLab both.
SEAMS = ["Shortest", "Existing texture seams", "Selected edges", "Border of selected faces", "Sharp edges"]
TARGET = ["Automatic", "Flat everywhere", "Disk", "Rectangle", "Cones at selected vertices",
          "From vertex quality", "Placed cones"]
METHOD = ["Intrinsic flips", "Fixed triangles", "Edge swaps", "Thurston"]
CHOICES = {"target_curvature": TARGET, "seams": SEAMS, "method": METHOD,
           "layers": ["None", "Flat mesh", "Sphere", "Flat mesh and sphere"],
           "charts": ["As the flow has them", "Without overlap", "Without overlap, cut for packing",
                      "As they are, only packed"],
           "output_triangulation": ["Keep the mesh", "Common refinement"],
           "finish": ["None", "Repair", "Least distortion", "Least stretch"],
           "holes": ["Boundaries", "Capped", "Short ones capped"]}
RARE_CHOICES = {"cone_rounding": ["Free", "Multiples of pi/2"],
                "chart_rotation": ["None", "Right angles", "Any"],
                "join_vertices": ["Automatic", "Never", "Always"]}
OPTIONS = ("options", "String", "")
PARAMETERS = [
    ("target_curvature", "Enum", 0), ("free_boundary", "Bool", True), ("cone_distortion", "Float", 0.0),
    ("seams", "Enum", 0), ("padding", "Int", 2), ("texture_size", "Int", 2048),
    ("carry_texture", "String", ""), ("layers", "Enum", 0),
    ("charts", "Enum", 2), ("normalize_uv", "Bool", True), ("holes", "Enum", 2),
    ("output_triangulation", "Enum", 0), ("finish", "Enum", 2), ("method", "Enum", 0),
    ("epsilon", "Float", 1e-8), OPTIONS]
COMMONLY_RARE = [
    ("sharp_angle", "Float", 30.0), ("join_vertices", "Enum", 0), ("colorize", "Bool", False),
    ("report", "String", ""), ("time_limit", "Float", 0.0)]
RARE = [("cone_count", "Int", 0), ("cone_rounding", "Enum", 0), ("seam_hiding", "Float", 0.0),
        ("texel_density", "Float", 0.0), ("chart_rotation", "Enum", 2), *COMMONLY_RARE]

HYPERBOLIC = types.SimpleNamespace(
    NAME="Generalized Ricci Flow (Hyperbolic)",
    PYTHON_NAME="compute_texcoord_parametrization_ricci_flow_hyperbolic_per_wedge",
    CHOICES={
        "target_curvature": ["Hyperbolic metric", "Cones at selected vertices",
                             "From vertex quality"],
        "seams": SEAMS, "method": METHOD[:2],
        "output_triangulation": ["Keep the mesh", "Common refinement"],
        "finish": ["None", "Repair"]},
    RARE_CHOICES={"join_vertices": RARE_CHOICES["join_vertices"]},
    PARAMETERS=[
        ("target_curvature", "Enum", 0), ("cone_angle", "Float", 180.0), ("seams", "Enum", 0),
        ("output_triangulation", "Enum", 0), ("flat_layer", "Bool", False), ("universal_cover", "Int", 0),
        ("generator_axes", "Bool", False), ("canonical_polygon", "Bool", False),
        ("free_boundary", "Bool", False), ("method", "Enum", 0), ("finish", "Enum", 1),
        ("carry_texture", "String", ""), ("texture_size", "Int", 2048), ("epsilon", "Float", 1e-8), OPTIONS],
    RARE=COMMONLY_RARE)

# What the dialogs show at once; the rest is behind "Show advanced parameters".
SHOWN = 8


def all_parameters(our_filter):
    """As Python, C and the command line have them."""
    return our_filter.PARAMETERS[:-1] + our_filter.RARE


def in_dialog(our_filter, values):
    """Parameters as MeshLab has them."""
    rare = {name: values[name] for name, _, _ in our_filter.RARE if name in values}
    shown = {name: value for name, value in values.items() if name not in rare}
    if rare:
        shown["options"] = "; ".join(f"{name}={value}" for name, value in rare.items())
    return shown


def skip(reason):
    print(f"SKIPPED: {reason}", flush=True)
    sys.exit(77)


def main():
    program = unittest.main(exit=False, verbosity=2)
    sys.exit(0 if program.result.wasSuccessful() and program.result.testsRun > 0 else 1)
