# SPDX-License-Identifier: GPL-3.0-or-later
"""What the filters return: key -> (type, meaning)."""
# Made by document_filters.py.

EUCLIDEAN_RESULTS = \
{'converged': ('bool', 'always true; anything else is an error'),
 'iterations': ('int', 'Newton steps, over all solves, also for maps that were not taken'),
 'max_curvature_error': ('float', 'max|K̄ − K| in radians where K is prescribed'),
 'residual_floor': ('float', 'the smallest residual that rounding allows'),
 'lengthened': ('float',
                '0, but where faces have no area or one side a million times shorter than '
                'another: the flow sees the edges at their vertices longer, and this is the '
                'largest share of an edge that is added (1: of an edge without length)'),
 'qc_mean': ('float',
             'conformal distortion σ₁/σ₂ (1: angles are kept), mean over faces; this and the '
             'three below leave out faces whose height is below 1e-9 of their side, and faces '
             'without area in the plane'),
 'qc_area_mean': ('float', 'the same, faces weighted by their area on the mesh'),
 'qc_p99': ('float', 'the same: 99th percentile over faces'),
 'qc_max': ('float', 'the same: largest of all faces'),
 'qc_vertex_mean': ('float', "mean over vertices of the vertex value: the paper's number"),
 'area_distortion_mean': ('float',
                          "with s = a face's share of the area in the plane over its share in "
                          'space: mean of max(s, 1/s), weighted by area in space; 1 if all '
                          'areas keep their ratios'),
 'area_distortion_spread': ('float', 'standard deviation of ln s, weighted likewise'),
 'stretch': ('float',
             'Euclidean filter: symmetric Dirichlet energy, mean by area at the best scale of '
             'the map: 4 if all lengths keep their ratios. It leaves out faces lower than a '
             'texel of the largest texture (1/16384 of √area), unless they cover as much as a '
             'row of texels'),
 'objective': ('float',
               'Euclidean filter: what Automatic makes small: stretch + 0.05 × (length of all '
               'seams) / √area'),
 'target_used': ('int',
                 'Euclidean filter: what the map was made with in the end: the number of a '
                 'target_curvature, or 7: a free boundary without cones, 8: a boundary '
                 'prescribed by its length, 9: cut along creases and unfolded; 0: components '
                 'differ'),
 'expected_spread': ('float',
                     'Euclidean filter, where cones are placed or declined: the '
                     'area_distortion_spread that the linear problem predicts'),
 'cone_vertices': ('vector',
                   'Euclidean filter: the vertices at which cones were placed, and their '
                   'curvatures in radians'),
 'cone_curvatures': ('vector',
                     'Euclidean filter: the vertices at which cones were placed, and their '
                     'curvatures in radians'),
 'boundary_ratio_min': ('float',
                        'Euclidean filter, free boundary: the least and the largest length of '
                        'a boundary edge in the map, without normalize_uv, over that on the '
                        'mesh; 1 but for what the finish moves'),
 'boundary_ratio_max': ('float',
                        'Euclidean filter, free boundary: the least and the largest length of '
                        'a boundary edge in the map, without normalize_uv, over that on the '
                        'mesh; 1 but for what the finish moves'),
 'flipped_faces': ('int', 'faces that are flipped or have no area in the plane'),
 'flipped_by_rounding': ('int', 'additional ones once the coordinates are floats'),
 'finish_moved': ('int',
                  'texture vertices that the repair moved; one moved again in the stored '
                  'coordinates counts twice'),
 'ended_early': ('int',
                 'searches for something better (cones that keep areas, repair, least '
                 'distortion or stretch, cuts for room, the division of disks) that the bound '
                 'on their work has ended: the map is valid, and could be a little better; the '
                 'log says which'),
 'flips': ('int', 'intrinsic flips, including those before the flow'),
 'refinement_points': ('int',
                       'points of the common refinement that are not vertices of the mesh; 0 '
                       'with Keep the mesh'),
 'edge_swaps': ('int', 'made by Edge swaps'),
 'boundary_splits': ('int', 'made by Edge swaps'),
 'euler_characteristic': ('int',
                          'of the input, cut open where it is no oriented manifold and at the '
                          'seams that are chosen; components are its pieces'),
 'genus': ('int',
           'of the input, cut open where it is no oriented manifold and at the seams that are '
           'chosen; components are its pieces'),
 'boundary_loops': ('int',
                    'of the input, cut open where it is no oriented manifold and at the seams '
                    'that are chosen; components are its pieces'),
 'components': ('int',
                'of the input, cut open where it is no oriented manifold and at the seams that '
                'are chosen; components are its pieces'),
 'cut_nonmanifold_edges': ('int',
                           'edges with more than two faces, or with two that have the same '
                           'vertices'),
 'split_vertices': ('int',
                    'vertices with several places in the map because of their fans of faces'),
 'duplicate_faces': ('int', 'faces with the vertices of another, each a sheet of its own'),
 'one_sided_components': ('int', 'cut along short one-sided loops'),
 'degenerate_faces': ('int',
                      'drawn as a segment or a point: faces that use a vertex twice, and those '
                      'of components without area'),
 'cones': ('int', 'interior vertices that are not flat'),
 'chosen_seam_edges': ('int',
                       'edges that are opened because seams asks for it, and their length on '
                       'the mesh; edges on its border do not count'),
 'chosen_seam_length': ('float',
                        'edges that are opened because seams asks for it, and their length on '
                        'the mesh; edges on its border do not count'),
 'seam_edges': ('int', 'further edges of the input along which the mesh is cut'),
 'charts': ('int', 'pieces in the plane'),
 'occupancy': ('float',
               'share of the unit square, without normalize_uv of the square that holds all '
               'charts, that the charts cover'),
 'capped_holes': ('int', 'loops closed for the flow'),
 'overlapping_charts': ('int',
                        'faces that cover a part of the plane together with another one, of '
                        'their chart or not, in the coordinates as floats; the charts that '
                        'these are in'),
 'overlapping_faces': ('int',
                       'faces that cover a part of the plane together with another one, of '
                       'their chart or not, in the coordinates as floats; the charts that '
                       'these are in'),
 'unequal_seams': ('int',
                   'edges of the seams whose two sides differ in length, in the disk in '
                   'hyperbolic length, by more than 1/1000, in the coordinates as floats: '
                   'flipped faces beside them were mended, or finish Least stretch has let the '
                   'seams go'),
 'overlap_cuts': ('int',
                  'edges of the output that are cut to separate them, or to set apart faces '
                  'that floats cannot hold in their chart; where parts are joined elsewhere, '
                  'there are fewer seam_edges'),
 'seam_length': ('float', 'length of these further edges and cuts on the mesh, in its units'),
 'seam_length_relative': ('float', 'the same, divided by the root of the area of the mesh'),
 'torus_tau_re': ('float', 'flat torus: its modulus in the fundamental domain'),
 'torus_tau_im': ('float', 'flat torus: its modulus in the fundamental domain'),
 'annulus_modulus': ('float', 'flat annulus: ln(r₂/r₁) / 2π'),
 'rectangle_aspect': ('float', 'rectangle: longer side over shorter side'),
 'holonomy_error': ('float',
                    'with cone_rounding 1, but for Edge swaps: the largest distance of the '
                    'rotation across a seam from a multiple of π/2, in radians'),
 'period_matrix': ('vector',
                   'one closed component of genus g from 1 to 10: Re, Im of the entries of its '
                   "Riemann period matrix, g × g, row by row; it is that of the mesh's own "
                   'flat faces, and no target changes it'),
 'period_error': ('float',
                  'bound of its error: the largest distance, as logarithm, of the energies of '
                  'harmonic forms (genus 1: the distance in the hyperbolic plane)'),
 'texture_scale': ('float',
                   'with carry_texture, of faces that had a texture: texels of the new one for '
                   'a unit of length over those of the old one, mean by area in space'),
 'sphere_qc_area_mean': ('float', 'of the sphere layer, if it was asked for'),
 'sphere_area_distortion_mean': ('float', 'of the sphere layer, if it was asked for'),
 'sphere_flipped_faces': ('int', 'of the sphere layer, if it was asked for')}

HYPERBOLIC_RESULTS = \
{'hyperbolic_area': ('float',
                     'computed from the side lengths alone, so it is an independent check of '
                     'Gauss-Bonnet'),
 'left_out_components': ('int',
                         'components without a hyperbolic metric, which lie beside the disk; '
                         'areas and distortion are those of the others'),
 'relation_error': ('float',
                    'how far the layout is from closing up: the largest angle (radians) or '
                    'hyperbolic length by which the isometries between neighbouring copies '
                    'miss a vertex of the seam on the way round it, seen from that vertex; at '
                    'cones of angle θ the error of |trace| = 2 |cos(θ/2)|, at geodesic '
                    'boundaries that of their length L in |trace| = 2 cosh(L/2)'),
 'generators': ('vector',
                'with Axes of the generators or Canonical polygon, one component only: Re a, '
                'Im a, Re b, Im b of the isometries z → (az + b)/(b̄z + ā), |a|² − |b|² = 1: a '
                'canonical basis a₁, b₁, …, then one isometry for each boundary loop and cone; '
                'Π[aᵢ, bᵢ] Π eₖ = ±1'),
 'generators_low': ('vector',
                    'with generators, number by number: what a float cannot hold of it. The '
                    'sum has 31 digits'),
 'generators_error': ('float',
                      'with generators: largest entry of Π[aᵢ, bᵢ] Π eₖ ∓ 1 for the sums')}
