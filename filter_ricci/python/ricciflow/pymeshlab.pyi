# SPDX-License-Identifier: GPL-3.0-or-later
"""PyMeshLab as a host: both filters as methods of MeshSet."""
# Made by document_filters.py.

from typing import Any, Literal, Union

import pymeshlab
from pymeshlab import Mesh as Mesh

from . import Refused as _Refused

USES_PLUGIN: bool

class Refused(_Refused, pymeshlab.PyMeshLabException):
    """The mesh of a MeshSet is refused; the text says why."""

class MeshSet(pymeshlab.MeshSet):
    def compute_texcoord_parametrization_ricci_flow_euclidean_per_wedge(
        self,
        *,
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
    ) -> dict[str, Any]:
        """MeshLab's filter 'Generalized Ricci Flow (Euclidean)' on the current mesh."""
    def compute_texcoord_parametrization_ricci_flow_hyperbolic_per_wedge(
        self,
        *,
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
    ) -> dict[str, Any]:
        """MeshLab's filter 'Generalized Ricci Flow (Hyperbolic)' on the current mesh."""
