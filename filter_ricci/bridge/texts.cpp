// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge.h"

#include <stdexcept>

namespace filter_ricci {

namespace {

const char* const kReference =
	"See: <i>Yong-Liang Yang, Ren Guo, Feng Luo, Shi-Min Hu, Xianfeng Gu</i><br>"
	"<b>\"Generalized Discrete Ricci Flow\"</b>, Computer Graphics Forum 28(7), 2005-2014, 2009.";

FilterText euclideanText()
{
	FilterText text;
	text.name = "Generalized Ricci Flow (Euclidean)";
	text.pythonName = "compute_texcoord_parametrization_ricci_flow_euclidean_per_wedge";
	text.info =
		"<b>Conformal parametrization</b> into per-wedge texture coordinates, unrolled from the "
		"metric with the curvature asked for, which the discrete Ricci flow finds. Thin triangles "
		"need no remeshing.<br>"
		"<b>Input:</b> a triangle mesh of any topology.<br>"
		"<b>Output:</b> texture coordinates (to be seen with <i>Set Texture</i>), the distortion "
		"(1 = angles kept) as vertex quality.<br>";
	text.info += kReference;
	return text;
}

FilterText hyperbolicText()
{
	FilterText text;
	text.name = "Generalized Ricci Flow (Hyperbolic)";
	text.pythonName = "compute_texcoord_parametrization_ricci_flow_hyperbolic_per_wedge";
	text.info =
		"<b>Hyperbolic uniformization</b>: the metric of curvature -1 that is conformal to the "
		"mesh's own, unrolled into the Poincaré disk.<br>"
		"<b>Input:</b> a triangle mesh of negative Euler characteristic (two handles, a handle "
		"and a boundary, or three boundaries), or any with cones that make up for it.<br>"
		"<b>Output:</b> texture coordinates (to be seen with <i>Set Texture</i>), the distortion "
		"(1 = angles kept) as vertex quality, on request the generators of the Fuchsian group.<br>";
	text.info += kReference;
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
