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
		"Computes a <b>conformal parametrization</b>: the discrete surface Ricci flow finds the "
		"metric, conformal to that of the mesh, whose Gaussian curvature is the one asked for. "
		"Where the curvature is zero the metric is flat, and the surface is cut and unrolled into "
		"the plane. The result is written as <b>per-wedge texture coordinates</b>. The generalized "
		"circle packing reproduces the edge lengths of any triangle mesh exactly, so thin "
		"triangles "
		"need no remeshing.<br><br>"
		"<b>Input:</b> an oriented triangle mesh that is a manifold with or without boundary. "
		"Several connected components are solved one by one and packed side by side. "
		"<b>Output:</b> wedge texture coordinates; the quasi-conformal distortion (1 = angles are "
		"kept exactly) as vertex quality; the logarithm of the radii as the custom vertex "
		"attribute "
		"<i>ricci_u</i>. The shape of the mesh is not changed, and after a failure nothing is.<br>"
		"<br>"
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
	default:
		throw std::logic_error("This plugin has no filter with that id.");
	}
}

} // namespace filter_ricci
