// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge.h"

#include <stdexcept>

namespace filter_ricci {

namespace {

FilterText euclideanText()
{
	FilterText text;
	text.name = "Generalized Ricci Flow (Euclidean)";
	text.pythonName = "compute_texcoord_parametrization_ricci_flow_euclidean_per_wedge";
	text.info =
		"<b>Conformal parametrization</b> into per-wedge texture coordinates: the discrete Ricci "
		"flow finds the metric, conformal to the mesh's own, with the curvature asked for, and "
		"unrolls it into the plane. Thin triangles need no remeshing.<br>"
		"<b>Input:</b> a manifold triangle mesh of any topology, with or without boundary.<br>"
		"<b>Output:</b> texture coordinates (to be seen with <i>Set Texture</i>), the distortion "
		"(1 = angles kept) as vertex quality. Vertices and faces stay unless the common refinement "
		"is asked for; a refused mesh is unchanged.<br>"
		"See: <br />"
		"<i>Yong-Liang Yang, Ren Guo, Feng Luo, Shi-Min Hu, Xianfeng Gu</i><br/>"
		"<b>\"Generalized Discrete Ricci Flow\"</b><br/>"
		"Computer Graphics Forum, volume 28, Issue 7, Pages 2005-2014, 2009.<br/>";
	return text;
}

FilterText hyperbolicText()
{
	FilterText text;
	text.name = "Generalized Ricci Flow (Hyperbolic)";
	text.pythonName = "compute_texcoord_parametrization_ricci_flow_hyperbolic_per_wedge";
	text.info =
		"<b>Hyperbolic uniformization</b>: the discrete Ricci flow finds the metric of curvature "
		"-1 that is conformal to the mesh's own, and unrolls it into the Poincaré disk. For "
		"surfaces with two handles or more, with a handle and a boundary, or with three "
		"boundaries.<br>"
		"<b>Input:</b> a manifold triangle mesh of negative Euler characteristic, or any with "
		"cones that make up for it.<br>"
		"<b>Output:</b> texture coordinates (to be seen with <i>Set Texture</i>; the disk fills "
		"the unit square), the distortion as vertex quality, on request the generators of the "
		"Fuchsian group and layers with the disk and its tiling. Vertices and faces stay unless "
		"the common refinement is asked for.<br>"
		"See: <br />"
		"<i>Yong-Liang Yang, Ren Guo, Feng Luo, Shi-Min Hu, Xianfeng Gu</i><br/>"
		"<b>\"Generalized Discrete Ricci Flow\"</b><br/>"
		"Computer Graphics Forum, volume 28, Issue 7, Pages 2005-2014, 2009.<br/>";
	return text;
}

} // namespace

FilterText filterText(int filter)
{
	switch (filter) {
	case Euclidean:
		return euclideanText();
	case Hyperbolic:
		return hyperbolicText();
	default:
		throw std::logic_error("This plugin has no filter with that id.");
	}
}

} // namespace filter_ricci
