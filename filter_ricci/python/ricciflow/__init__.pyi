# SPDX-License-Identifier: GPL-3.0-or-later
"""UV-unwraps triangle meshes: conformal maps by the discrete Ricci flow."""
# Made by document_filters.py.

import os
from typing import Any, Callable, Literal, NamedTuple, Protocol, Union, overload

import numpy
import numpy.typing
import pymeshlab

Floats = numpy.typing.NDArray[numpy.float64]
Integers = numpy.typing.NDArray[numpy.int32]
Complex = numpy.typing.NDArray[numpy.complex128]

class HasVerticesAndFaces(Protocol):
    vertices: Any
    faces: Any

MeshLike = Union[str, os.PathLike[str], pymeshlab.MeshSet, pymeshlab.Mesh,
                 HasVerticesAndFaces,
                 tuple[numpy.typing.ArrayLike, numpy.typing.ArrayLike]]

__version__: str
EUCLIDEAN: str
HYPERBOLIC: str

class Refused(Exception):
    """The mesh is refused; the text says why. It is unchanged."""

class RicciWarning(UserWarning):
    """A doubt about a map that was made: what it is, and what to do."""

class Layer(NamedTuple):
    """A new layer: vertices (V, 3) float64, and what joins them."""

    vertices: Floats
    faces: Integers
    edges: Integers

class Parametrization:
    """A mesh and its texture coordinates. It can be pickled and copied."""

    vertices: Floats
    """(V, 3) float64"""
    faces: Integers
    """(F, 3) int32, indices of vertices"""
    uv: Floats
    """(F, 3, 2) float64, texture coordinates of each corner of each face, as floats have them"""
    quality: Floats
    """(V,) float64, quasi-conformal distortion sigma1/sigma2 at the vertices; 1: angles kept"""
    log_radius: Floats
    """(V,) float64, logarithms of the radii of the flow's circles, up to a constant"""
    target_curvature: Floats
    """(V,) float64, the Gaussian curvature that the flow reached, in radians"""
    @property
    def layers(self) -> dict[str, Layer]:
        """those that were asked for, by what they are: flat, sphere, disk, cover, axes, polygon"""
    @property
    def mesh_set(self) -> pymeshlab.MeshSet:
        """PyMeshLab's MeshSet that holds the mesh, and the new layers if some were asked for"""
    results: dict[str, Any]
    """what the filter returned; each result is an attribute too"""
    messages: list[str]
    """doubts about the map; each is a RicciWarning, too"""
    log: list[str]
    """all lines that the run has written"""
    def indexed(self) -> tuple[Floats, numpy.typing.NDArray[numpy.intp]]:
        """Texture vertices (T, 2) and their indices at the corners of the faces (F, 3)."""
    def save(self, path: Union[str, os.PathLike[str]]) -> None:
        """Writes the mesh with its texture coordinates, and with the texture that carry_texture
        has drawn. What else was in the file that the mesh is from stays."""
    def save_layer(self, kind: str, path: Union[str, os.PathLike[str]]) -> None:
        """Writes one of the layers to a PLY file."""

class Flattening(Parametrization):
    converged: bool
    """always true, because anything else is an error"""
    iterations: int
    """Newton steps of all solves, including discarded candidates"""
    max_curvature_error: float
    """max|K̄ − K| in radians where K is prescribed"""
    residual_floor: float
    """the smallest residual that rounding permits"""
    lengthened: float
    """0, except where a face has no area or one side a million times shorter than another: the
    solver lengthens the edges at its vertices, and this is the largest fraction of an edge that
    is added (1: of an edge without length)"""
    qc_mean: float
    """angle distortion σ₁/σ₂ (1: none), mean over faces, excluding faces whose height is below
    1e-9 of their side or that have no area in the plane"""
    qc_area_mean: float
    """the same, mean by area on the mesh"""
    qc_p99: float
    """the same, 99th percentile"""
    qc_max: float
    """the same, largest"""
    qc_vertex_mean: float
    """the same, mean over vertices: the paper's number"""
    area_distortion_mean: float
    """mean of max(s, 1/s), s = a face's share of the area in the plane over its share in space,
    weighted by area in space (1: no area distortion)"""
    area_distortion_spread: float
    """standard deviation of ln s, weighted likewise"""
    stretch: float
    """Euclidean filter: symmetric Dirichlet energy, mean by area at the best scale of the map
    (4: none), excluding faces lower than a texel of the largest texture (1/16384 of √area)
    unless together they cover a row of texels"""
    objective: float
    """what Automatic minimises: stretch + 0.05 × (length of all seams) / √area"""
    target_used: int
    """Euclidean filter: the target of the final map: the number of a target_curvature, or 7:
    free boundary without cones, 8: boundary prescribed by its length, 9: cut along sharp edges
    and unfolded; 0: components differ"""
    expected_spread: float
    """Euclidean filter, where cones are considered: the area_distortion_spread that the linear
    problem predicts"""
    cone_vertices: Floats
    """Euclidean filter: the vertices of the placed cones, and their curvatures in radians"""
    cone_curvatures: Floats
    """Euclidean filter: the vertices of the placed cones, and their curvatures in radians"""
    boundary_ratio_min: float
    """Euclidean filter, free boundary: the smallest ratio of a boundary edge's length in the
    map at real size to that on the mesh, 1 unless the finish moves it"""
    boundary_ratio_max: float
    """the largest such ratio"""
    flipped_faces: int
    """faces that are flipped or have no area in the plane"""
    flipped_by_rounding: int
    """additional ones after rounding to float"""
    finish_moved: int
    """UV vertices that the repair moved; one that is moved again after rounding to float counts
    twice"""
    ended_early: int
    """searches (cones, repair, least distortion or stretch, division of disks) that stopped at
    their work limit: the map is valid and could be slightly better; the log says which"""
    flips: int
    """intrinsic flips, including those before the flow"""
    refinement_points: int
    """points of the common refinement that are not vertices of the mesh"""
    edge_swaps: int
    """swaps made by Edge swaps"""
    boundary_splits: int
    """boundary edges that it split"""
    euler_characteristic: int
    """of the input, cut open where it is not an oriented manifold and at the chosen seams"""
    genus: int
    """of the input, cut open where it is not an oriented manifold and at the chosen seams"""
    boundary_loops: int
    """of the input, cut open where it is not an oriented manifold and at the chosen seams"""
    components: int
    """of the input, cut open where it is not an oriented manifold and at the chosen seams"""
    joined_edges: int
    """edges whose faces have vertices of their own there, joined by Join split vertices"""
    pieces_apart: int
    """pieces that it could join and does not"""
    cut_nonmanifold_edges: int
    """edges cut because they have more than two faces, or two that duplicate each other"""
    split_vertices: int
    """vertices with several triangle fans, and so several places in the map"""
    duplicate_faces: int
    """faces that duplicate another, each a separate sheet"""
    one_sided_components: int
    """components cut along short one-sided loops"""
    degenerate_faces: int
    """faces drawn as a segment or a point"""
    chosen_seam_edges: int
    """edges opened by seams, without those on its border"""
    chosen_seam_length: float
    """their length on the mesh"""
    cones: int
    """interior vertices that are not flat"""
    seam_edges: int
    """further edges of the input along which the mesh is cut"""
    charts: int
    """charts (UV islands)"""
    tiles: int
    """UDIM tiles that hold them (1 without texel_density)"""
    occupancy: float
    """packing efficiency: fraction of the unit square or of all tiles (without normalize_uv, of
    the square around all charts) that the charts cover"""
    padding_pixels: float
    """padding between charts and to the border of that square, in pixels of texture_size"""
    capped_holes: int
    """boundary loops closed for the flow"""
    overlapping_charts: int
    """charts with faces that overlap in the stored floats"""
    overlapping_faces: int
    """faces that overlap another one, in their own chart or not"""
    unequal_seams: int
    """seam edges whose two sides differ in (hyperbolic) length by more than 1/1000 in the
    stored floats, because flipped faces next to them were repaired or by finish Least
    stretch"""
    overlap_cuts: int
    """output edges cut to separate these, to pack better, to fit into tiles, or around faces
    that floats cannot represent in their chart; parts joined elsewhere reduce seam_edges"""
    seam_length: float
    """length of seam_edges and overlap_cuts on the mesh, in its units"""
    seam_length_relative: float
    """the same, over the square root of its area"""
    torus_tau_re: float
    """flat torus: real part of its modulus in the fundamental domain"""
    torus_tau_im: float
    """imaginary part of this modulus"""
    annulus_modulus: float
    """flat annulus: ln(r₂/r₁) / 2π"""
    rectangle_aspect: float
    """rectangle: longer side over shorter side"""
    holonomy_error: float
    """with cone_rounding 1, except for Edge swaps: the largest distance of the rotation across
    a seam from a multiple of π/2, in radians"""
    period_matrix: Floats
    """one closed component of genus g from 1 to 10: Re, Im of the entries of its Riemann period
    matrix, g × g, row by row, which belongs to the mesh's own flat faces and does not depend on
    the target"""
    period_error: float
    """bound of its error: the largest distance, as logarithm, of the energies of harmonic forms
    (genus 1: the distance in the hyperbolic plane)"""
    texture_scale: float
    """with carry_texture, of faces that had a texture: texels of the new one per unit of length
    over those of the old one, mean by area"""
    sphere_qc_area_mean: float
    """of the sphere layer"""
    sphere_area_distortion_mean: float
    """of the sphere layer"""
    sphere_flipped_faces: int
    """of the sphere layer"""

class Uniformization(Parametrization):
    disk: Complex
    """(F, 3) complex128: the corners of the faces in the Poincaré disk, |z| < 1"""
    converged: bool
    """always true, because anything else is an error"""
    iterations: int
    """Newton steps of all solves, including discarded candidates"""
    max_curvature_error: float
    """max|K̄ − K| in radians where K is prescribed"""
    residual_floor: float
    """the smallest residual that rounding permits"""
    lengthened: float
    """0, except where a face has no area or one side a million times shorter than another: the
    solver lengthens the edges at its vertices, and this is the largest fraction of an edge that
    is added (1: of an edge without length)"""
    qc_mean: float
    """angle distortion σ₁/σ₂ (1: none), mean over faces, excluding faces whose height is below
    1e-9 of their side or that have no area in the plane"""
    qc_area_mean: float
    """the same, mean by area on the mesh"""
    qc_p99: float
    """the same, 99th percentile"""
    qc_max: float
    """the same, largest"""
    qc_vertex_mean: float
    """the same, mean over vertices: the paper's number"""
    area_distortion_mean: float
    """mean of max(s, 1/s), s = a face's share of the area in the plane over its share in space,
    weighted by area in space (1: no area distortion)"""
    area_distortion_spread: float
    """standard deviation of ln s, weighted likewise"""
    stretch: float
    """Euclidean filter: symmetric Dirichlet energy, mean by area at the best scale of the map
    (4: none), excluding faces lower than a texel of the largest texture (1/16384 of √area)
    unless together they cover a row of texels"""
    objective: float
    """what Automatic minimises: stretch + 0.05 × (length of all seams) / √area"""
    target_used: int
    """Euclidean filter: the target of the final map: the number of a target_curvature, or 7:
    free boundary without cones, 8: boundary prescribed by its length, 9: cut along sharp edges
    and unfolded; 0: components differ"""
    expected_spread: float
    """Euclidean filter, where cones are considered: the area_distortion_spread that the linear
    problem predicts"""
    cone_vertices: Floats
    """Euclidean filter: the vertices of the placed cones, and their curvatures in radians"""
    cone_curvatures: Floats
    """Euclidean filter: the vertices of the placed cones, and their curvatures in radians"""
    boundary_ratio_min: float
    """Euclidean filter, free boundary: the smallest ratio of a boundary edge's length in the
    map at real size to that on the mesh, 1 unless the finish moves it"""
    boundary_ratio_max: float
    """the largest such ratio"""
    flipped_faces: int
    """faces that are flipped or have no area in the plane"""
    flipped_by_rounding: int
    """additional ones after rounding to float"""
    finish_moved: int
    """UV vertices that the repair moved; one that is moved again after rounding to float counts
    twice"""
    ended_early: int
    """searches (cones, repair, least distortion or stretch, division of disks) that stopped at
    their work limit: the map is valid and could be slightly better; the log says which"""
    flips: int
    """intrinsic flips, including those before the flow"""
    refinement_points: int
    """points of the common refinement that are not vertices of the mesh"""
    edge_swaps: int
    """swaps made by Edge swaps"""
    boundary_splits: int
    """boundary edges that it split"""
    euler_characteristic: int
    """of the input, cut open where it is not an oriented manifold and at the chosen seams"""
    genus: int
    """of the input, cut open where it is not an oriented manifold and at the chosen seams"""
    boundary_loops: int
    """of the input, cut open where it is not an oriented manifold and at the chosen seams"""
    components: int
    """of the input, cut open where it is not an oriented manifold and at the chosen seams"""
    joined_edges: int
    """edges whose faces have vertices of their own there, joined by Join split vertices"""
    pieces_apart: int
    """pieces that it could join and does not"""
    cut_nonmanifold_edges: int
    """edges cut because they have more than two faces, or two that duplicate each other"""
    split_vertices: int
    """vertices with several triangle fans, and so several places in the map"""
    duplicate_faces: int
    """faces that duplicate another, each a separate sheet"""
    one_sided_components: int
    """components cut along short one-sided loops"""
    degenerate_faces: int
    """faces drawn as a segment or a point"""
    chosen_seam_edges: int
    """edges opened by seams, without those on its border"""
    chosen_seam_length: float
    """their length on the mesh"""
    cones: int
    """interior vertices that are not flat"""
    seam_edges: int
    """further edges of the input along which the mesh is cut"""
    charts: int
    """charts (UV islands)"""
    tiles: int
    """UDIM tiles that hold them (1 without texel_density)"""
    occupancy: float
    """packing efficiency: fraction of the unit square or of all tiles (without normalize_uv, of
    the square around all charts) that the charts cover"""
    padding_pixels: float
    """padding between charts and to the border of that square, in pixels of texture_size"""
    capped_holes: int
    """boundary loops closed for the flow"""
    overlapping_charts: int
    """charts with faces that overlap in the stored floats"""
    overlapping_faces: int
    """faces that overlap another one, in their own chart or not"""
    unequal_seams: int
    """seam edges whose two sides differ in (hyperbolic) length by more than 1/1000 in the
    stored floats, because flipped faces next to them were repaired or by finish Least
    stretch"""
    overlap_cuts: int
    """output edges cut to separate these, to pack better, to fit into tiles, or around faces
    that floats cannot represent in their chart; parts joined elsewhere reduce seam_edges"""
    seam_length: float
    """length of seam_edges and overlap_cuts on the mesh, in its units"""
    seam_length_relative: float
    """the same, over the square root of its area"""
    torus_tau_re: float
    """flat torus: real part of its modulus in the fundamental domain"""
    torus_tau_im: float
    """imaginary part of this modulus"""
    annulus_modulus: float
    """flat annulus: ln(r₂/r₁) / 2π"""
    rectangle_aspect: float
    """rectangle: longer side over shorter side"""
    holonomy_error: float
    """with cone_rounding 1, except for Edge swaps: the largest distance of the rotation across
    a seam from a multiple of π/2, in radians"""
    period_matrix: Floats
    """one closed component of genus g from 1 to 10: Re, Im of the entries of its Riemann period
    matrix, g × g, row by row, which belongs to the mesh's own flat faces and does not depend on
    the target"""
    period_error: float
    """bound of its error: the largest distance, as logarithm, of the energies of harmonic forms
    (genus 1: the distance in the hyperbolic plane)"""
    texture_scale: float
    """with carry_texture, of faces that had a texture: texels of the new one per unit of length
    over those of the old one, mean by area"""
    sphere_qc_area_mean: float
    """of the sphere layer"""
    sphere_area_distortion_mean: float
    """of the sphere layer"""
    sphere_flipped_faces: int
    """of the sphere layer"""
    hyperbolic_area: float
    """from the side lengths alone: an independent check of Gauss-Bonnet"""
    left_out_components: int
    """components without a hyperbolic metric, placed beside the disk; areas and distortion
    exclude them"""
    relation_error: float
    """the gap where the layout should close: the largest angle (radians) or hyperbolic length
    by which the isometries between neighbouring copies miss a seam vertex on the way around it;
    at cones of angle θ the error of |trace| = 2 |cos(θ/2)|, at geodesic boundaries that of
    their length L in |trace| = 2 cosh(L/2)"""
    generators: Complex
    """with Axes of the generators or Canonical polygon, one component only: Re a, Im a, Re b,
    Im b of the isometries z → (az + b)/(b̄z + ā), |a|² − |b|² = 1: a canonical basis a₁, b₁, …,
    then one isometry for each boundary loop and cone; Π[aᵢ, bᵢ] Π eₖ = ±1; here (n, 2, 2)
    complex128, the matrices of the isometries"""
    generators_low: Complex
    """with generators, number by number: the digits beyond those of a double. The sum has 31
    digits: mpf(high) + mpf(low) of mpmath, with mp.dps = 40; here (n, 2, 2) complex128, the
    matrices of the isometries"""
    generators_error: float
    """with generators: largest entry of Π[aᵢ, bᵢ] Π eₖ ∓ 1 for the sums"""

@overload
def flatten(
    mesh: list[MeshLike],
    *,
    progress: Union[bool, Callable[[float, str], object], None] = None,
    **parameters: Any,
) -> list[Flattening]:
    """Several meshes, whose charts share one square."""
@overload
def flatten(
    mesh: Union[MeshLike, numpy.typing.ArrayLike],
    faces: Union[numpy.typing.ArrayLike, None] = None,
    *,
    selected: Union[numpy.typing.ArrayLike, set[int], None] = None,
    curvature: Union[numpy.typing.ArrayLike, None] = None,
    uv: Union[numpy.typing.ArrayLike, None] = None,
    selected_edges: Union[numpy.typing.ArrayLike, None] = None,
    selected_faces: Union[numpy.typing.ArrayLike, set[int], None] = None,
    diagonals: Union[numpy.typing.ArrayLike, None] = None,
    progress: Union[bool, Callable[[float, str], object], None] = None,
    target_curvature: Union[int, Literal[
        'Automatic',
        'Flat everywhere',
        'Disk',
        'Rectangle',
        'Cones at selected vertices',
        'From vertex quality',
        'Placed cones',
    ]] = 'Automatic',
    free_boundary: bool = True,
    cone_distortion: float = 0.0,
    seams: Union[int, Literal[
        'Shortest',
        'Existing texture seams',
        'Selected edges',
        'Border of selected faces',
        'Sharp edges',
    ]] = 'Shortest',
    padding: int = 2,
    texture_size: int = 2048,
    carry_texture: str = '',
    layers: Union[int, Literal[
        'None',
        'Flat mesh',
        'Sphere',
        'Flat mesh and sphere',
    ]] = 'None',
    charts: Union[int, Literal[
        'As the flow has them',
        'Without overlap',
        'Without overlap, cut for packing',
        'As they are, only packed',
    ]] = 'Without overlap, cut for packing',
    normalize_uv: bool = True,
    holes: Union[int, Literal[
        'Boundaries',
        'Capped',
        'Short ones capped',
    ]] = 'Short ones capped',
    output_triangulation: Union[int, Literal[
        'Keep the mesh',
        'Common refinement',
    ]] = 'Keep the mesh',
    finish: Union[int, Literal[
        'None',
        'Repair',
        'Least distortion',
        'Least stretch',
    ]] = 'Least distortion',
    method: Union[int, Literal[
        'Intrinsic flips',
        'Fixed triangles',
        'Edge swaps',
        'Thurston',
    ]] = 'Intrinsic flips',
    epsilon: float = 1e-08,
    cone_count: int = 0,
    cone_rounding: Union[int, Literal[
        'Free',
        'Multiples of pi/2',
    ]] = 'Free',
    seam_hiding: float = 0.0,
    texel_density: float = 0.0,
    chart_rotation: Union[int, Literal[
        'None',
        'Right angles',
        'Any',
    ]] = 'Any',
    sharp_angle: float = 30.0,
    join_vertices: Union[int, Literal[
        'Automatic',
        'Never',
        'Always',
    ]] = 'Automatic',
    colorize: bool = False,
    report: str = '',
    time_limit: float = 0.0,
) -> Flattening:
    """UV-unwraps a mesh: a conformal map into the plane.

    target_curvature: Shape of the UV layout: its outline, and its cones, the points where it is
        not flat. Automatic suits most meshes.
    free_boundary: Let the outline of an open mesh take its natural shape. Ignored by Disk,
        Rectangle and flat annuli.
    cone_distortion: Largest area distortion that cones may leave (0.25: 25 %). 0: area
        distortion and seam length are balanced.
    seams: Cut along the shortest paths only, or first along UV seams, selected edges, the
        outline of selected faces, or edges sharper than 30 degrees (sharp_angle).
    padding: Empty pixels between charts (UV islands) and to the border, for baking: of a
        texture of 'Texture size' that covers the whole layout.
    texture_size: Width and height of the texture, 16 to 16384 pixels. 0: the resolution of the
        old textures is kept; 2048 if none is transferred.
    carry_texture: Bake the present textures, or else the colours, into this PNG file for the
        new UVs. Empty: no texture.
    layers: Add the mesh laid out in the plane, cut along its seams, or mapped conformally to
        the unit sphere (closed surfaces of genus 0).
    charts: Leave charts whole, split those that overlap, or for Automatic without chosen seams
        also for better packing. Only packed: the old islands keep their shape.
    normalize_uv: Scale the UVs uniformly into [0,1] x [0,1]. Off: the same charts in the real
        size of the mesh.
    holes: Fill holes while solving, so that no seam runs to them: all boundary loops but the
        longest, or only short ones (0.1 √area).
    output_triangulation: Common refinement adds vertices where edges of the solver cross those
        of the mesh, so that the map is exact on every piece.
    finish: After the solve, repair flipped faces; then minimise angle distortion, or stretch,
        where the two sides of a seam may differ. Needs 'Intrinsic flips'.
    method: What happens when a triangle degenerates during the solve: the solver flips edges
        (recommended) or swaps them, or the run fails. Thurston: the conventional flow.
    epsilon: The solve stops when the curvature of every vertex is this close to its target, in
        radians, or rounding allows no better.
    cone_count: The number of placed cones. 0: 'Cones: area distortion' decides.
    cone_rounding: Free: the least area distortion. Multiples of pi/2: a seamless map for quad
        remeshing, whose seams differ by quarter turns.
    seam_hiding: From 0 (the seams are as short as possible) to 1 (an edge on a ridge counts as
        ten times longer).
    texel_density: Lay charts at this density into UDIM tiles of 'Texture size', up to 100;
        larger charts are cut. 0: one square.
    chart_rotation: None: charts do not rotate, and are not cut for packing. Right angles:
        straight ones upright, others by 90 degrees.
    sharp_angle: The seams 'Sharp edges' are those at which the surface bends by more than this.
    join_vertices: Treat vertices that coincide along edges as one, as in formats that split
        them. Automatic: only if faces share almost no vertices.
    colorize: Colour the vertices by angle distortion: from blue (none) to red (99th percentile
        or worse).
    report: Write a report: a page with diagrams and its data (.html), or the data alone (.csv).
        Empty: no report.
    time_limit: A run that takes longer ends with an error and leaves the mesh unchanged. 0: no
        limit.
    """

@overload
def uniformize(
    mesh: list[MeshLike],
    *,
    progress: Union[bool, Callable[[float, str], object], None] = None,
    **parameters: Any,
) -> list[Uniformization]:
    """Several meshes, whose charts share one square."""
@overload
def uniformize(
    mesh: Union[MeshLike, numpy.typing.ArrayLike],
    faces: Union[numpy.typing.ArrayLike, None] = None,
    *,
    selected: Union[numpy.typing.ArrayLike, set[int], None] = None,
    curvature: Union[numpy.typing.ArrayLike, None] = None,
    uv: Union[numpy.typing.ArrayLike, None] = None,
    selected_edges: Union[numpy.typing.ArrayLike, None] = None,
    selected_faces: Union[numpy.typing.ArrayLike, set[int], None] = None,
    diagonals: Union[numpy.typing.ArrayLike, None] = None,
    progress: Union[bool, Callable[[float, str], object], None] = None,
    target_curvature: Union[int, Literal[
        'Hyperbolic metric',
        'Cones at selected vertices',
        'From vertex quality',
    ]] = 'Hyperbolic metric',
    cone_angle: float = 180.0,
    seams: Union[int, Literal[
        'Shortest',
        'Existing texture seams',
        'Selected edges',
        'Border of selected faces',
        'Sharp edges',
    ]] = 'Shortest',
    output_triangulation: Union[int, Literal[
        'Keep the mesh',
        'Common refinement',
    ]] = 'Keep the mesh',
    flat_layer: bool = False,
    universal_cover: int = 0,
    generator_axes: bool = False,
    canonical_polygon: bool = False,
    free_boundary: bool = False,
    method: Union[int, Literal[
        'Intrinsic flips',
        'Fixed triangles',
    ]] = 'Intrinsic flips',
    finish: Union[int, Literal[
        'None',
        'Repair',
    ]] = 'Repair',
    carry_texture: str = '',
    texture_size: int = 2048,
    epsilon: float = 1e-08,
    sharp_angle: float = 30.0,
    join_vertices: Union[int, Literal[
        'Automatic',
        'Never',
        'Always',
    ]] = 'Automatic',
    colorize: bool = False,
    report: str = '',
    time_limit: float = 0.0,
) -> Uniformization:
    """Hyperbolic metric of a mesh, in the Poincaré disk.

    target_curvature: The curvature at the vertices, in addition to the constant -1 of the
        triangles. Hyperbolic metric: none, for surfaces of negative Euler characteristic.
    cone_angle: The sum of the angles at each selected vertex, for 'Cones at selected vertices'.
        360: not a cone.
    seams: Cut along the shortest paths only, or first along UV seams, selected edges, the
        outline of selected faces, or edges sharper than 30 degrees (sharp_angle).
    output_triangulation: Common refinement adds vertices where edges of the solver cross those
        of the mesh, so that the map is exact on every piece.
    flat_layer: Add a layer with the mesh laid out in the Poincaré disk, cut along its seams.
    universal_cover: Add a layer with the mesh in the Poincaré disk and this many rings of
        copies around it, which tile the disk. 0: no layer.
    generator_axes: Add a layer with the axes of the canonical generators of the Fuchsian group,
        as edges. On the surface they are closed geodesics.
    canonical_polygon: Add a layer with a fundamental polygon of 4 sides for each handle, as
        edges. The canonical generators pair its sides, which are geodesics.
    free_boundary: The circles at boundary vertices keep their radii, and the target holds at
        interior vertices only. Off: the target holds everywhere.
    method: What happens when a triangle degenerates during the solve: edges flip inside the
        solver (recommended), or the run fails.
    finish: After the solve, repair flipped faces. Needs the method 'Intrinsic flips'.
    carry_texture: Bake the present textures, or else the colours, into this PNG file for the
        new UVs. Empty: no texture.
    texture_size: Width and height of the texture, 16 to 16384 pixels. 0: the resolution of the
        old textures is kept; 2048 if none is transferred.
    epsilon: The solve stops when the curvature of every vertex is this close to its target, in
        radians, or rounding allows no better.
    sharp_angle: The seams 'Sharp edges' are those at which the surface bends by more than this.
    join_vertices: Treat vertices that coincide along edges as one, as in formats that split
        them. Automatic: only if faces share almost no vertices.
    colorize: Colour the vertices by angle distortion: from blue (none) to red (99th percentile
        or worse).
    report: Write a report: a page with diagrams and its data (.html), or the data alone (.csv).
        Empty: no report.
    time_limit: A run that takes longer ends with an error and leaves the mesh unchanged. 0: no
        limit.
    """
