# SPDX-License-Identifier: GPL-3.0-or-later
"""What the filters return: key -> (type, meaning)."""
# Made by document_filters.py.

EUCLIDEAN_RESULTS = \
{'converged': ('bool', 'always true; anything else is an error'),
 'iterations': ('int', 'Newton steps, over all solves'),
 'max_curvature_error': ('float', 'max|K̄ − K| in radians where K is prescribed'),
 'residual_floor': ('float', 'the smallest residual that rounding allows'),
 'qc_mean': ('float',
             'conformal distortion σ₁/σ₂ (1: angles are kept), mean over faces; this and the '
             'three below leave out faces whose height is below 1e-9 of their side, and faces '
             'without area in the plane'),
 'qc_area_mean': ('float', 'the same, faces weighted by their area on the mesh'),
 'qc_p99': ('float', 'the same: 99th percentile over faces, largest'),
 'qc_max': ('float', 'the same: 99th percentile over faces, largest'),
 'qc_vertex_mean': ('float', "mean over vertices of the vertex value: the paper's number"),
 'area_distortion_mean': ('float',
                          "with s = a face's share of the area in the plane over its share in "
                          'space: mean of max(s, 1/s), weighted by area in space; 1 if all '
                          'areas keep their ratios'),
 'area_distortion_spread': ('float', 'standard deviation of ln s, weighted likewise'),
 'flipped_faces': ('int', 'faces that are turned over or have no area in the plane'),
 'flipped_by_rounding': ('int', 'additional ones once the coordinates are floats'),
 'finish_moved': ('int',
                  'texture vertices that the repair moved; one moved again in the stored '
                  'coordinates counts twice'),
 'flips': ('int', 'intrinsic flips, including those before the flow'),
 'refinement_points': ('int',
                       'points of the common refinement that are not vertices of the mesh; '
                       'counted with Keep the mesh too'),
 'edge_swaps': ('int', 'made by Edge swap'),
 'boundary_splits': ('int', 'made by Edge swap'),
 'euler_characteristic': ('int', 'of the input'),
 'genus': ('int', 'of the input'),
 'boundary_loops': ('int', 'of the input'),
 'components': ('int', 'of the input'),
 'cut_nonmanifold_edges': ('int',
                           'edges of more than two faces, cut so that each sheet has two'),
 'split_vertices': ('int', 'vertices with more than one fan of faces, or on such an edge'),
 'duplicate_faces': ('int', 'faces with the vertices of another: sheets of their own'),
 'one_sided_components': ('int', 'components cut along short one-sided loops'),
 'degenerate_faces': ('int', 'faces without area, which are drawn as lines or points'),
 'cones': ('int', 'interior vertices that are not flat'),
 'seam_edges': ('int', 'edges of the input along which the mesh is cut'),
 'charts': ('int', 'pieces in the plane'),
 'capped_holes': ('int', 'loops closed for the flow'),
 'overlapping_charts': ('int',
                        'charts that cover a part of the plane more than once; the faces that '
                        'do so'),
 'overlapping_faces': ('int',
                       'charts that cover a part of the plane more than once; the faces that '
                       'do so'),
 'overlap_cuts': ('int',
                  'edges of the output that are cut to separate them, less those along which '
                  'parts were joined elsewhere'),
 'seam_length': ('float', 'length of both kinds of cuts on the mesh, in its units'),
 'seam_length_relative': ('float', 'the same, divided by the root of the area of the mesh'),
 'torus_tau_re': ('float', 'flat torus: its modulus in the fundamental domain'),
 'torus_tau_im': ('float', 'flat torus: its modulus in the fundamental domain'),
 'annulus_modulus': ('float', 'flat annulus: ln(r₂/r₁) / 2π'),
 'rectangle_aspect': ('float', 'rectangle: longer side over shorter side'),
 'sphere_qc_area_mean': ('float', 'of the sphere layer, if it was asked for'),
 'sphere_area_distortion_mean': ('float', 'of the sphere layer, if it was asked for'),
 'sphere_flipped_faces': ('int', 'of the sphere layer, if it was asked for')}

HYPERBOLIC_RESULTS = \
{'hyperbolic_area': ('float',
                     'computed from the side lengths alone, so it is an independent check of '
                     'Gauss-Bonnet'),
 'relation_error': ('float',
                    "how far the layout is from closing up: the error of the group's relation "
                    'as read off the fundamental polygon, and the error of the length L of '
                    'each geodesic boundary against its isometry, |trace| = 2 cosh(L/2)'),
 'generators': ('vector',
                'with Axes of the generators or Canonical polygon, one component only: Re a, '
                'Im a, Re b, Im b of the isometries z → (az + b)/(b̄z + ā), |a|² − |b|² = 1: a '
                'canonical basis a₁, b₁, …, then one isometry for each boundary loop and cone; '
                'Π[aᵢ, bᵢ] Π eₖ = ±1')}
