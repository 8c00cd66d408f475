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
    ) -> dict[str, Any]:
        """MeshLab's filter 'Generalized Ricci Flow (Hyperbolic)' on the current mesh."""
