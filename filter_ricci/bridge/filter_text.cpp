// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_text.h"

#include "parameters.h"

#include <stdexcept>

namespace filter_ricci {

namespace {

std::string quoted(const std::string& text)
{
	std::string json = "\"";
	for (const char c : text) {
		if (c == '"' || c == '\\')
			json += '\\';
		json += c;
	}
	return json + "\"";
}

std::string described(const Parameter& p)
{
	const char* const places[] = {"shown", "advanced", "options"};
	const char* const types[] = {"bool", "int", "float", "file"};
	const std::string type = p.choices.empty() ? types[p.value.index()] : "enum";
	std::string json = "{\"name\":" + quoted(p.name) + ",\"label\":" + quoted(p.label) +
					   ",\"tooltip\":" + quoted(p.tooltip) + ",\"place\":\"" +
					   places[static_cast<int>(p.place)] + "\",\"type\":\"" + type +
					   "\",\"default\":" +
					   (type == "enum" || type == "file" ? quoted(valueText(p)) : valueText(p));
	for (std::size_t i = 0; i < p.choices.size(); ++i)
		json += (i == 0 ? ",\"choices\":[" : ",") + quoted(p.choices[i]);
	if (!p.choices.empty())
		json += "]";
	if (!p.files.empty())
		json += ",\"files\":" + quoted(p.files);
	return json + "}";
}

std::string describedFilter(int filter)
{
	const FilterText text = filterText(filter);
	std::string json = "{\"name\":" + quoted(text.name) +
					   ",\"python_name\":" + quoted(text.pythonName) +
					   ",\"info\":" + quoted(text.info) + ",\"renamed\":";
	std::string renamed;
	for (const auto& [old, now] : renamedParameters(filter))
		renamed += (renamed.empty() ? "" : ",") + quoted(old) + ":" + quoted(now);
	json += "{" + renamed + "},\"parameters\":";
	char before = '[';
	for (const Parameter& p : filterParameters(filter)) {
		json += before + described(p);
		before = ',';
	}
	return json + "]}";
}

} // namespace

FilterText filterText(int filter)
{
	const std::string reference = "<br>See: Yang, Guo, Luo, Hu, Gu, <i>Generalized Discrete Ricci "
								  "Flow</i>, Computer Graphics Forum 28(7), 2009.";
	switch (filter) {
	case Euclidean:
		return {
			"Generalized Ricci Flow (Euclidean)",
			"compute_texcoord_parametrization_ricci_flow_euclidean_per_wedge",
			"<b>UV unwrap</b>: flattens any triangle mesh into few charts (UV islands) that do not "
			"overlap, with little angle distortion. A conformal parametrization per wedge, by the "
			"generalized discrete Ricci flow; the vertex quality becomes the distortion (1 = "
			"none)." +
				reference};
	case Hyperbolic:
		return {
			"Generalized Ricci Flow (Hyperbolic)",
			"compute_texcoord_parametrization_ricci_flow_hyperbolic_per_wedge",
			"<b>Hyperbolic uniformization</b>: flattens a mesh with handles or holes into the "
			"Poincaré disk, with little angle distortion. The parametrization is by the conformal "
			"metric of curvature -1, for meshes of negative Euler characteristic (two handles, a "
			"handle and a boundary, or three boundaries), or any with cones that make up for it. "
			"Texture coordinates are stored per wedge, and the distortion (1 = none) as the vertex "
			"quality." +
				reference};
	default:
		throw std::logic_error("This plugin has no filter with that id.");
	}
}

std::string filterDescriptions()
{
	return "[" + describedFilter(Euclidean) + "," + describedFilter(Hyperbolic) + "]";
}

} // namespace filter_ricci
