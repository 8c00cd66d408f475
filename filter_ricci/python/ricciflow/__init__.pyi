# SPDX-License-Identifier: GPL-3.0-or-later
"""UV-unwraps triangle meshes: conformal maps by the discrete Ricci flow."""
# Made by document_filters.py.

import os
from typing import Any, Callable, Literal, NamedTuple, Protocol, Union

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
    """always true; anything else is an error"""
    iterations: int
    """Newton steps, over all solves, also for maps that were not taken"""
    max_curvature_error: float
    """max|K̄ − K| in radians where K is prescribed"""
    residual_floor: float
    """the smallest residual that rounding allows"""
    lengthened: float
    """0, but where faces have no area or one side a million times shorter than another: the
    flow sees the edges at their vertices longer, and this is the largest share of an edge that
    is added (1: of an edge without length)"""
    qc_mean: float
    """conformal distortion σ₁/σ₂ (1: angles are kept), mean over faces; this and the three
    below leave out faces whose height is below 1e-9 of their side, and faces without area in
    the plane"""
    qc_area_mean: float
    """the same, faces weighted by their area on the mesh"""
    qc_p99: float
    """the same: 99th percentile over faces"""
    qc_max: float
    """the same: largest of all faces"""
    qc_vertex_mean: float
    """mean over vertices of the vertex value: the paper's number"""
    area_distortion_mean: float
    """with s = a face's share of the area in the plane over its share in space: mean of max(s,
    1/s), weighted by area in space; 1 if all areas keep their ratios"""
    area_distortion_spread: float
    """standard deviation of ln s, weighted likewise"""
    stretch: float
    """Euclidean filter: symmetric Dirichlet energy, mean by area at the best scale of the map:
    4 if all lengths keep their ratios. It leaves out faces lower than a texel of the largest
    texture (1/16384 of √area), unless they cover as much as a row of texels"""
    objective: float
    """Euclidean filter: what Automatic makes small: stretch + 0.05 × (length of all seams) /
    √area"""
    target_used: int
    """Euclidean filter: what the map was made with in the end: the number of a
    target_curvature, or 7: a free boundary without cones, 8: a boundary prescribed by its
    length, 9: cut along creases and unfolded; 0: components differ"""
    expected_spread: float
    """Euclidean filter, where cones are placed or declined: the area_distortion_spread that the
    linear problem predicts"""
    cone_vertices: Floats
    """Euclidean filter: the vertices at which cones were placed, and their curvatures in
    radians"""
    cone_curvatures: Floats
    """Euclidean filter: the vertices at which cones were placed, and their curvatures in
    radians"""
    boundary_ratio_min: float
    """Euclidean filter, free boundary: the least and the largest length of a boundary edge in
    the map, without normalize_uv, over that on the mesh; 1 but for what the finish moves"""
    boundary_ratio_max: float
    """Euclidean filter, free boundary: the least and the largest length of a boundary edge in
    the map, without normalize_uv, over that on the mesh; 1 but for what the finish moves"""
    flipped_faces: int
    """faces that are flipped or have no area in the plane"""
    flipped_by_rounding: int
    """additional ones once the coordinates are floats"""
    finish_moved: int
    """texture vertices that the repair moved; one moved again in the stored coordinates counts
    twice"""
    ended_early: int
    """searches for something better (cones that keep areas, repair, least distortion or
    stretch, cuts for room, the division of disks) that the bound on their work has ended: the
    map is valid, and could be a little better; the log says which"""
    flips: int
    """intrinsic flips, including those before the flow"""
    refinement_points: int
    """points of the common refinement that are not vertices of the mesh; 0 with Keep the
    mesh"""
    edge_swaps: int
    """made by Edge swaps"""
    boundary_splits: int
    """made by Edge swaps"""
    euler_characteristic: int
    """of the input, cut open where it is no oriented manifold and at the seams that are chosen;
    components are its pieces"""
    genus: int
    """of the input, cut open where it is no oriented manifold and at the seams that are chosen;
    components are its pieces"""
    boundary_loops: int
    """of the input, cut open where it is no oriented manifold and at the seams that are chosen;
    components are its pieces"""
    components: int
    """of the input, cut open where it is no oriented manifold and at the seams that are chosen;
    components are its pieces"""
    cut_nonmanifold_edges: int
    """edges with more than two faces, or with two that have the same vertices"""
    split_vertices: int
    """vertices with several places in the map because of their fans of faces"""
    duplicate_faces: int
    """faces with the vertices of another, each a sheet of its own"""
    one_sided_components: int
    """cut along short one-sided loops"""
    degenerate_faces: int
    """drawn as a segment or a point: faces that use a vertex twice, and those of components
    without area"""
    cones: int
    """interior vertices that are not flat"""
    chosen_seam_edges: int
    """edges that are opened because seams asks for it, and their length on the mesh; edges on
    its border do not count"""
    chosen_seam_length: float
    """edges that are opened because seams asks for it, and their length on the mesh; edges on
    its border do not count"""
    seam_edges: int
    """further edges of the input along which the mesh is cut"""
    charts: int
    """pieces in the plane"""
    occupancy: float
    """share of the unit square, without normalize_uv of the square that holds all charts, that
    the charts cover"""
    capped_holes: int
    """loops closed for the flow"""
    overlapping_charts: int
    """faces that cover a part of the plane together with another one, of their chart or not, in
    the coordinates as floats; the charts that these are in"""
    overlapping_faces: int
    """faces that cover a part of the plane together with another one, of their chart or not, in
    the coordinates as floats; the charts that these are in"""
    unequal_seams: int
    """edges of the seams whose two sides differ in length, in the disk in hyperbolic length, by
    more than 1/1000, in the coordinates as floats: flipped faces beside them were mended, or
    finish Least stretch has let the seams go"""
    overlap_cuts: int
    """edges of the output that are cut to separate them, or to set apart faces that floats
    cannot hold in their chart; where parts are joined elsewhere, there are fewer seam_edges"""
    seam_length: float
    """length of these further edges and cuts on the mesh, in its units"""
    seam_length_relative: float
    """the same, divided by the root of the area of the mesh"""
    torus_tau_re: float
    """flat torus: its modulus in the fundamental domain"""
    torus_tau_im: float
    """flat torus: its modulus in the fundamental domain"""
    annulus_modulus: float
    """flat annulus: ln(r₂/r₁) / 2π"""
    rectangle_aspect: float
    """rectangle: longer side over shorter side"""
    holonomy_error: float
    """with cone_rounding 1, but for Edge swaps: the largest distance of the rotation across a
    seam from a multiple of π/2, in radians"""
    period_matrix: Floats
    """one closed component of genus g from 1 to 10: Re, Im of the entries of its Riemann period
    matrix, g × g, row by row; it is that of the mesh's own flat faces, and no target changes
    it"""
    period_error: float
    """bound of its error: the largest distance, as logarithm, of the energies of harmonic forms
    (genus 1: the distance in the hyperbolic plane)"""
    texture_scale: float
    """with carry_texture, of faces that had a texture: texels of the new one for a unit of
    length over those of the old one, mean by area in space"""
    sphere_qc_area_mean: float
    """of the sphere layer, if it was asked for"""
    sphere_area_distortion_mean: float
    """of the sphere layer, if it was asked for"""
    sphere_flipped_faces: int
    """of the sphere layer, if it was asked for"""

class Uniformization(Parametrization):
    disk: Complex
    """(F, 3) complex128: the corners of the faces in the Poincaré disk, |z| < 1"""
    converged: bool
    """always true; anything else is an error"""
    iterations: int
    """Newton steps, over all solves, also for maps that were not taken"""
    max_curvature_error: float
    """max|K̄ − K| in radians where K is prescribed"""
    residual_floor: float
    """the smallest residual that rounding allows"""
    lengthened: float
    """0, but where faces have no area or one side a million times shorter than another: the
    flow sees the edges at their vertices longer, and this is the largest share of an edge that
    is added (1: of an edge without length)"""
    qc_mean: float
    """conformal distortion σ₁/σ₂ (1: angles are kept), mean over faces; this and the three
    below leave out faces whose height is below 1e-9 of their side, and faces without area in
    the plane"""
    qc_area_mean: float
    """the same, faces weighted by their area on the mesh"""
    qc_p99: float
    """the same: 99th percentile over faces"""
    qc_max: float
    """the same: largest of all faces"""
    qc_vertex_mean: float
    """mean over vertices of the vertex value: the paper's number"""
    area_distortion_mean: float
    """with s = a face's share of the area in the plane over its share in space: mean of max(s,
    1/s), weighted by area in space; 1 if all areas keep their ratios"""
    area_distortion_spread: float
    """standard deviation of ln s, weighted likewise"""
    stretch: float
    """Euclidean filter: symmetric Dirichlet energy, mean by area at the best scale of the map:
    4 if all lengths keep their ratios. It leaves out faces lower than a texel of the largest
    texture (1/16384 of √area), unless they cover as much as a row of texels"""
    objective: float
    """Euclidean filter: what Automatic makes small: stretch + 0.05 × (length of all seams) /
    √area"""
    target_used: int
    """Euclidean filter: what the map was made with in the end: the number of a
    target_curvature, or 7: a free boundary without cones, 8: a boundary prescribed by its
    length, 9: cut along creases and unfolded; 0: components differ"""
    expected_spread: float
    """Euclidean filter, where cones are placed or declined: the area_distortion_spread that the
    linear problem predicts"""
    cone_vertices: Floats
    """Euclidean filter: the vertices at which cones were placed, and their curvatures in
    radians"""
    cone_curvatures: Floats
    """Euclidean filter: the vertices at which cones were placed, and their curvatures in
    radians"""
    boundary_ratio_min: float
    """Euclidean filter, free boundary: the least and the largest length of a boundary edge in
    the map, without normalize_uv, over that on the mesh; 1 but for what the finish moves"""
    boundary_ratio_max: float
    """Euclidean filter, free boundary: the least and the largest length of a boundary edge in
    the map, without normalize_uv, over that on the mesh; 1 but for what the finish moves"""
    flipped_faces: int
    """faces that are flipped or have no area in the plane"""
    flipped_by_rounding: int
    """additional ones once the coordinates are floats"""
    finish_moved: int
    """texture vertices that the repair moved; one moved again in the stored coordinates counts
    twice"""
    ended_early: int
    """searches for something better (cones that keep areas, repair, least distortion or
    stretch, cuts for room, the division of disks) that the bound on their work has ended: the
    map is valid, and could be a little better; the log says which"""
    flips: int
    """intrinsic flips, including those before the flow"""
    refinement_points: int
    """points of the common refinement that are not vertices of the mesh; 0 with Keep the
    mesh"""
    edge_swaps: int
    """made by Edge swaps"""
    boundary_splits: int
    """made by Edge swaps"""
    euler_characteristic: int
    """of the input, cut open where it is no oriented manifold and at the seams that are chosen;
    components are its pieces"""
    genus: int
    """of the input, cut open where it is no oriented manifold and at the seams that are chosen;
    components are its pieces"""
    boundary_loops: int
    """of the input, cut open where it is no oriented manifold and at the seams that are chosen;
    components are its pieces"""
    components: int
    """of the input, cut open where it is no oriented manifold and at the seams that are chosen;
    components are its pieces"""
    cut_nonmanifold_edges: int
    """edges with more than two faces, or with two that have the same vertices"""
    split_vertices: int
    """vertices with several places in the map because of their fans of faces"""
    duplicate_faces: int
    """faces with the vertices of another, each a sheet of its own"""
    one_sided_components: int
    """cut along short one-sided loops"""
    degenerate_faces: int
    """drawn as a segment or a point: faces that use a vertex twice, and those of components
    without area"""
    cones: int
    """interior vertices that are not flat"""
    chosen_seam_edges: int
    """edges that are opened because seams asks for it, and their length on the mesh; edges on
    its border do not count"""
    chosen_seam_length: float
    """edges that are opened because seams asks for it, and their length on the mesh; edges on
    its border do not count"""
    seam_edges: int
    """further edges of the input along which the mesh is cut"""
    charts: int
    """pieces in the plane"""
    occupancy: float
    """share of the unit square, without normalize_uv of the square that holds all charts, that
    the charts cover"""
    capped_holes: int
    """loops closed for the flow"""
    overlapping_charts: int
    """faces that cover a part of the plane together with another one, of their chart or not, in
    the coordinates as floats; the charts that these are in"""
    overlapping_faces: int
    """faces that cover a part of the plane together with another one, of their chart or not, in
    the coordinates as floats; the charts that these are in"""
    unequal_seams: int
    """edges of the seams whose two sides differ in length, in the disk in hyperbolic length, by
    more than 1/1000, in the coordinates as floats: flipped faces beside them were mended, or
    finish Least stretch has let the seams go"""
    overlap_cuts: int
    """edges of the output that are cut to separate them, or to set apart faces that floats
    cannot hold in their chart; where parts are joined elsewhere, there are fewer seam_edges"""
    seam_length: float
    """length of these further edges and cuts on the mesh, in its units"""
    seam_length_relative: float
    """the same, divided by the root of the area of the mesh"""
    torus_tau_re: float
    """flat torus: its modulus in the fundamental domain"""
    torus_tau_im: float
    """flat torus: its modulus in the fundamental domain"""
    annulus_modulus: float
    """flat annulus: ln(r₂/r₁) / 2π"""
    rectangle_aspect: float
    """rectangle: longer side over shorter side"""
    holonomy_error: float
    """with cone_rounding 1, but for Edge swaps: the largest distance of the rotation across a
    seam from a multiple of π/2, in radians"""
    period_matrix: Floats
    """one closed component of genus g from 1 to 10: Re, Im of the entries of its Riemann period
    matrix, g × g, row by row; it is that of the mesh's own flat faces, and no target changes
    it"""
    period_error: float
    """bound of its error: the largest distance, as logarithm, of the energies of harmonic forms
    (genus 1: the distance in the hyperbolic plane)"""
    texture_scale: float
    """with carry_texture, of faces that had a texture: texels of the new one for a unit of
    length over those of the old one, mean by area in space"""
    sphere_qc_area_mean: float
    """of the sphere layer, if it was asked for"""
    sphere_area_distortion_mean: float
    """of the sphere layer, if it was asked for"""
    sphere_flipped_faces: int
    """of the sphere layer, if it was asked for"""
    hyperbolic_area: float
    """computed from the side lengths alone, so it is an independent check of Gauss-Bonnet"""
    left_out_components: int
    """components without a hyperbolic metric, which lie beside the disk; areas and distortion
    are those of the others"""
    relation_error: float
    """how far the layout is from closing up: the largest angle (radians) or hyperbolic length
    by which the isometries between neighbouring copies miss a vertex of the seam on the way
    round it, seen from that vertex; at cones of angle θ the error of |trace| = 2 |cos(θ/2)|, at
    geodesic boundaries that of their length L in |trace| = 2 cosh(L/2)"""
    generators: Complex
    """with Axes of the generators or Canonical polygon, one component only: Re a, Im a, Re b,
    Im b of the isometries z → (az + b)/(b̄z + ā), |a|² − |b|² = 1: a canonical basis a₁, b₁, …,
    then one isometry for each boundary loop and cone; Π[aᵢ, bᵢ] Π eₖ = ±1; here (n, 2, 2)
    complex128, the matrices of the isometries"""
    generators_low: Complex
    """with generators, number by number: what a float cannot hold of it. The sum has 31 digits;
    here (n, 2, 2) complex128, the matrices of the isometries"""
    generators_error: float
    """with generators: largest entry of Π[aᵢ, bᵢ] Π eₖ ∓ 1 for the sums"""

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
    ]] = 'Shortest',
    output_triangulation: Union[int, Literal[
        'Keep the mesh',
        'Common refinement',
    ]] = 'Keep the mesh',
    chart_margin: float = 0.0,
    colorize: bool = False,
    flat_layer: bool = False,
    holes: Union[int, Literal[
        'Boundaries',
        'Capped',
        'Short ones capped',
    ]] = 'Short ones capped',
    seam_hiding: float = 0.0,
    cone_count: int = 0,
    cone_rounding: Union[int, Literal[
        'Free',
        'Multiples of pi/2',
    ]] = 'Free',
    method: Union[int, Literal[
        'Intrinsic flips',
        'Fixed triangles',
        'Edge swaps',
        'Thurston',
    ]] = 'Intrinsic flips',
    finish: Union[int, Literal[
        'None',
        'Repair',
        'Least distortion',
        'Least stretch',
    ]] = 'Least distortion',
    charts: Union[int, Literal[
        'As the flow has them',
        'Without overlap',
        'Without overlap, cut for room',
        'As they are, only packed',
    ]] = 'Without overlap, cut for room',
    normalize_uv: bool = True,
    sphere_layer: bool = False,
    join_vertices: Union[int, Literal[
        'Automatic',
        'Never',
        'Always',
    ]] = 'Automatic',
    carry_texture: str = '',
    texture_size: int = 2048,
    report: str = '',
    epsilon: float = 1e-08,
    time_limit: float = 0.0,
) -> Flattening:
    """UV-unwraps a mesh: a conformal map into the plane.

    target_curvature: What the flow is asked to reach. Automatic suits most meshes: it places
        cones where areas would change much.
    free_boundary: The boundary keeps its lengths, but for what the finish changes. Not read for
        Disk, Rectangle and the flat annulus.
    cone_distortion: 0: the cones that are worth their seams. Above 0: so many that areas change
        by less than this (0.25: by a quarter).
    seams: Shortest, or first where you choose: at texture seams, along selected edges ('Select
        Crease Edges'), or round selected faces.
    output_triangulation: Common refinement: faces are divided where the flow's edges cross
        them, so that the map is exact on every piece.
    chart_margin: Room round each chart, as a share of the side of the square, for baking.
        0.004: 4 pixels of 1024, 8 of 2048.
    colorize: Colour the vertices from blue (angles kept) over cyan, green and yellow to red
        (the 99th percentile over the faces, and more).
    flat_layer: Add a layer with the mesh laid out in the plane, cut along its seams.
    holes: Boundary loops other than the longest: boundaries too, or Capped for the flow, so
        that the chart goes round them without seams. Short ones capped: those within a tenth of
        the root of the area, even if all are.
    seam_hiding: 0: the seams are as short as can be. Up to 1: an edge on a ridge counts up to
        ten times its length, so that seams run through hollows.
    cone_count: The number of placed cones. 0: as many as 'Cones: area distortion' asks for.
    cone_rounding: Free: those that change areas least. Multiples of pi/2: as quadrangulations
        need them; all seams then differ by quarter turns.
    method: If a triangle breaks, intrinsic flips or the paper's edge swaps give the flow
        others, and fixed triangles end with an error; the mesh is never changed. Thurston: the
        conventional flow on the mesh's triangles, to compare with.
    finish: Repairs faces that would come out flipped, and on 'Keep the mesh' gives the mesh the
        least mean conformal distortion, or the least stretch, of lengths too: best on chosen
        seams, whose sides then differ. Only for the method 'Intrinsic flips'.
    charts: Without overlap: charts that cover a part of the plane twice are cut apart along the
        shortest lines. Cut for room: with Automatic, also a chart that fills little of the
        square, where the room is worth the seam. As they are: those of the texture coordinates
        that the mesh has keep their shape, and are only turned, scaled by one factor and
        packed.
    normalize_uv: Scale the texture coordinates uniformly into [0,1] x [0,1]. Off: they keep the
        scale of the metric.
    sphere_layer: Add a layer with the mesh mapped conformally to the unit sphere. Only for one
        closed surface of genus 0.
    join_vertices: Vertices that lie on each other along edges are one for the map, as formats
        split them for normals and texture coordinates; the mesh keeps them. Automatic: where
        faces share next to no vertices. Solids that touch and double-sided faces stay apart.
    carry_texture: A PNG file that gets what the mesh shows now, its textures or else its
        colours, drawn for the new texture coordinates. Empty: no texture.
    texture_size: Width and height of the new texture, 16 to 16384 texels. 0: as fine as the old
        ones.
    report: A report of the run: a page with diagrams and its data beside it (.html), or the
        data alone (.csv). Empty: no report.
    epsilon: The flow stops when the curvature of every vertex is this close to its target, in
        radians, or at the floor that rounding sets.
    time_limit: A run that takes longer ends with an error and leaves the mesh as it was. 0: no
        limit.
    """

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
    output_triangulation: Union[int, Literal[
        'Keep the mesh',
        'Common refinement',
    ]] = 'Keep the mesh',
    colorize: bool = False,
    flat_layer: bool = False,
    universal_cover: int = 0,
    generator_axes: bool = False,
    canonical_polygon: bool = False,
    seams: Union[int, Literal[
        'Shortest',
        'Existing texture seams',
        'Selected edges',
        'Border of selected faces',
    ]] = 'Shortest',
    free_boundary: bool = False,
    method: Union[int, Literal[
        'Intrinsic flips',
        'Fixed triangles',
    ]] = 'Intrinsic flips',
    finish: Union[int, Literal[
        'None',
        'Repair',
    ]] = 'Repair',
    join_vertices: Union[int, Literal[
        'Automatic',
        'Never',
        'Always',
    ]] = 'Automatic',
    carry_texture: str = '',
    texture_size: int = 2048,
    report: str = '',
    epsilon: float = 1e-08,
    time_limit: float = 0.0,
) -> Uniformization:
    """Hyperbolic metric of a mesh, in the Poincaré disk.

    target_curvature: The curvature at the vertices, beyond the constant -1 of the triangles.
        Hyperbolic metric: none, for surfaces of negative Euler characteristic.
    cone_angle: The sum of the angles at each selected vertex, for 'Cones at selected vertices'.
        360 is no cone.
    output_triangulation: Common refinement: faces are divided where the flow's edges cross
        them, so that the map is exact on every piece.
    colorize: Colour the vertices from blue (angles kept) over cyan, green and yellow to red
        (the 99th percentile over the faces, and more).
    flat_layer: Add a layer with the mesh laid out in the Poincaré disk, cut along its seams.
    universal_cover: Add a layer with the mesh in the Poincaré disk and this many rings of
        copies round it, which tile the disk. 0: no layer.
    generator_axes: Add a layer with the axes of the canonical generators of the Fuchsian group,
        as edges. On the surface they are closed geodesics.
    canonical_polygon: Add a layer with a fundamental polygon of 4 sides for each handle, as
        edges. Its sides are geodesics that the canonical generators pair.
    seams: Shortest, or first where you choose: at texture seams, along selected edges ('Select
        Crease Edges'), or round selected faces.
    free_boundary: The circles of the boundary's vertices keep their radii, and the target holds
        inside only. Off: the target holds on the boundary too.
    method: If a triangle breaks, intrinsic flips give the flow others, and fixed triangles end
        with an error; the mesh is never changed.
    finish: Repairs faces that would come out flipped. Only for the method 'Intrinsic flips'.
    join_vertices: Vertices that lie on each other along edges are one for the map, as formats
        split them for normals and texture coordinates; the mesh keeps them. Automatic: where
        faces share next to no vertices. Solids that touch and double-sided faces stay apart.
    carry_texture: A PNG file that gets what the mesh shows now, its textures or else its
        colours, drawn for the new texture coordinates. Empty: no texture.
    texture_size: Width and height of the new texture, 16 to 16384 texels. 0: as fine as the old
        ones.
    report: A report of the run: a page with diagrams and its data beside it (.html), or the
        data alone (.csv). Empty: no report.
    epsilon: The flow stops when the curvature of every vertex is this close to its target, in
        radians, or at the floor that rounding sets.
    time_limit: A run that takes longer ends with an error and leaves the mesh as it was. 0: no
        limit.
    """
