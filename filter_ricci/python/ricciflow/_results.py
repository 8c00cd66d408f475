# SPDX-License-Identifier: GPL-3.0-or-later
"""What the filters return: key -> (type, meaning)."""
# Made by document_filters.py.

EUCLIDEAN_RESULTS = \
{'converged': ('bool', 'always true, because anything else is an error'),
 'iterations': ('int', 'Newton steps of all solves, including discarded candidates'),
 'max_curvature_error': ('float', 'max|K̄ − K| in radians where K is prescribed'),
 'residual_floor': ('float', 'the smallest residual that rounding permits'),
 'lengthened': ('float',
                '0, except where a face has no area or one side a million times shorter than '
                'another: the solver lengthens the edges at its vertices, and this is the '
                'largest fraction of an edge that is added (1: of an edge without length)'),
 'qc_mean': ('float',
             'angle distortion σ₁/σ₂ (1: none), mean over faces, excluding faces whose height '
             'is below 1e-9 of their side or that have no area in the plane'),
 'qc_area_mean': ('float', 'the same, mean by area on the mesh'),
 'qc_p99': ('float', 'the same, 99th percentile'),
 'qc_max': ('float', 'the same, largest'),
 'qc_vertex_mean': ('float', "the same, mean over vertices: the paper's number"),
 'area_distortion_mean': ('float',
                          "mean of max(s, 1/s), s = a face's share of the area in the plane "
                          'over its share in space, weighted by area in space (1: no area '
                          'distortion)'),
 'area_distortion_spread': ('float', 'standard deviation of ln s, weighted likewise'),
 'stretch': ('float',
             'Euclidean filter: symmetric Dirichlet energy, mean by area at the best scale of '
             'the map (4: none), excluding faces lower than a texel of the largest texture '
             '(1/16384 of √area) unless together they cover a row of texels'),
 'objective': ('float',
               'what Automatic minimises: stretch + 0.05 × (length of all seams) / √area'),
 'target_used': ('int',
                 'Euclidean filter: the target of the final map: the number of a '
                 'target_curvature, or 7: free boundary without cones, 8: boundary prescribed '
                 'by its length, 9: cut along sharp edges and unfolded; 0: components differ'),
 'expected_spread': ('float',
                     'Euclidean filter, where cones are considered: the area_distortion_spread '
                     'that the linear problem predicts'),
 'cone_vertices': ('vector',
                   'Euclidean filter: the vertices of the placed cones, and their curvatures '
                   'in radians'),
 'cone_curvatures': ('vector',
                     'Euclidean filter: the vertices of the placed cones, and their curvatures '
                     'in radians'),
 'boundary_ratio_min': ('float',
                        'Euclidean filter, free boundary: the smallest ratio of a boundary '
                        "edge's length in the map at real size to that on the mesh, 1 unless "
                        'the finish moves it'),
 'boundary_ratio_max': ('float', 'the largest such ratio'),
 'flipped_faces': ('int', 'faces that are flipped or have no area in the plane'),
 'flipped_by_rounding': ('int', 'additional ones after rounding to float'),
 'finish_moved': ('int',
                  'UV vertices that the repair moved; one that is moved again after rounding '
                  'to float counts twice'),
 'ended_early': ('int',
                 'searches (cones, repair, least distortion or stretch, division of disks) '
                 'that stopped at their work limit: the map is valid and could be slightly '
                 'better; the log says which'),
 'flips': ('int', 'intrinsic flips, including those before the flow'),
 'refinement_points': ('int',
                       'points of the common refinement that are not vertices of the mesh'),
 'edge_swaps': ('int', 'swaps made by Edge swaps'),
 'boundary_splits': ('int', 'boundary edges that it split'),
 'euler_characteristic': ('int',
                          'of the input, cut open where it is not an oriented manifold and at '
                          'the chosen seams'),
 'genus': ('int',
           'of the input, cut open where it is not an oriented manifold and at the chosen '
           'seams'),
 'boundary_loops': ('int',
                    'of the input, cut open where it is not an oriented manifold and at the '
                    'chosen seams'),
 'components': ('int',
                'of the input, cut open where it is not an oriented manifold and at the chosen '
                'seams'),
 'joined_edges': ('int',
                  'edges whose faces have vertices of their own there, joined by Join split '
                  'vertices'),
 'pieces_apart': ('int', 'pieces that it could join and does not'),
 'cut_nonmanifold_edges': ('int',
                           'edges cut because they have more than two faces, or two that '
                           'duplicate each other'),
 'split_vertices': ('int',
                    'vertices with several triangle fans, and so several places in the map'),
 'duplicate_faces': ('int', 'faces that duplicate another, each a separate sheet'),
 'one_sided_components': ('int', 'components cut along short one-sided loops'),
 'degenerate_faces': ('int', 'faces drawn as a segment or a point'),
 'chosen_seam_edges': ('int', 'edges opened by seams, without those on its border'),
 'chosen_seam_length': ('float', 'their length on the mesh'),
 'cones': ('int', 'interior vertices that are not flat'),
 'seam_edges': ('int', 'further edges of the input along which the mesh is cut'),
 'charts': ('int', 'charts (UV islands)'),
 'tiles': ('int', 'UDIM tiles that hold them (1 without texel_density)'),
 'occupancy': ('float',
               'packing efficiency: fraction of the unit square or of all tiles (without '
               'normalize_uv, of the square around all charts) that the charts cover'),
 'padding_pixels': ('float',
                    'padding between charts and to the border of that square, in pixels of '
                    'texture_size'),
 'capped_holes': ('int', 'boundary loops closed for the flow'),
 'overlapping_charts': ('int', 'charts with faces that overlap in the stored floats'),
 'overlapping_faces': ('int', 'faces that overlap another one, in their own chart or not'),
 'unequal_seams': ('int',
                   'seam edges whose two sides differ in (hyperbolic) length by more than '
                   '1/1000 in the stored floats, because flipped faces next to them were '
                   'repaired or by finish Least stretch'),
 'overlap_cuts': ('int',
                  'output edges cut to separate these, to pack better, to fit into tiles, or '
                  'around faces that floats cannot represent in their chart; parts joined '
                  'elsewhere reduce seam_edges'),
 'seam_length': ('float', 'length of seam_edges and overlap_cuts on the mesh, in its units'),
 'seam_length_relative': ('float', 'the same, over the square root of its area'),
 'torus_tau_re': ('float', 'flat torus: real part of its modulus in the fundamental domain'),
 'torus_tau_im': ('float', 'imaginary part of this modulus'),
 'annulus_modulus': ('float', 'flat annulus: ln(r₂/r₁) / 2π'),
 'rectangle_aspect': ('float', 'rectangle: longer side over shorter side'),
 'holonomy_error': ('float',
                    'with cone_rounding 1, except for Edge swaps: the largest distance of the '
                    'rotation across a seam from a multiple of π/2, in radians'),
 'period_matrix': ('vector',
                   'one closed component of genus g from 1 to 10: Re, Im of the entries of its '
                   "Riemann period matrix, g × g, row by row, which belongs to the mesh's own "
                   'flat faces and does not depend on the target'),
 'period_error': ('float',
                  'bound of its error: the largest distance, as logarithm, of the energies of '
                  'harmonic forms (genus 1: the distance in the hyperbolic plane)'),
 'texture_scale': ('float',
                   'with carry_texture, of faces that had a texture: texels of the new one per '
                   'unit of length over those of the old one, mean by area'),
 'sphere_qc_area_mean': ('float', 'of the sphere layer'),
 'sphere_area_distortion_mean': ('float', 'of the sphere layer'),
 'sphere_flipped_faces': ('int', 'of the sphere layer')}

HYPERBOLIC_RESULTS = \
{'hyperbolic_area': ('float',
                     'from the side lengths alone: an independent check of Gauss-Bonnet'),
 'left_out_components': ('int',
                         'components without a hyperbolic metric, placed beside the disk; '
                         'areas and distortion exclude them'),
 'relation_error': ('float',
                    'the gap where the layout should close: the largest angle (radians) or '
                    'hyperbolic length by which the isometries between neighbouring copies '
                    'miss a seam vertex on the way around it; at cones of angle θ the error of '
                    '|trace| = 2 |cos(θ/2)|, at geodesic boundaries that of their length L in '
                    '|trace| = 2 cosh(L/2)'),
 'generators': ('vector',
                'with Axes of the generators or Canonical polygon, one component only: Re a, '
                'Im a, Re b, Im b of the isometries z → (az + b)/(b̄z + ā), |a|² − |b|² = 1: a '
                'canonical basis a₁, b₁, …, then one isometry for each boundary loop and cone; '
                'Π[aᵢ, bᵢ] Π eₖ = ±1'),
 'generators_low': ('vector',
                    'with generators, number by number: the digits beyond those of a double. '
                    'The sum has 31 digits: mpf(high) + mpf(low) of mpmath, with mp.dps = 40'),
 'generators_error': ('float',
                      'with generators: largest entry of Π[aᵢ, bᵢ] Π eₖ ∓ 1 for the sums')}
