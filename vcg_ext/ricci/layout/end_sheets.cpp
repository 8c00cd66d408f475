// SPDX-License-Identifier: GPL-3.0-or-later
#include "end_sheets.h"

namespace ricci {

void takeMetric(const FlowResult& flow, EndSheets& sheets)
{
	const Triangulation& end = flow.metric->triangulation();
	const Triangulation& t = sheets.triangulation;
	sheets.lengths.resize(t.edgeCount());
	sheets.angles.resize(t.halfedgeCount(), 0.0);
	for (const Face s : t.faces()) {
		const auto h = t.halfedges(s), original = end.halfedges(sheets.endFace[s]);
		for (std::size_t k = 0; k < 3; ++k) {
			sheets.lengths[h[k].edge()] = flow.metric->lengths()[original[k].edge()];
			sheets.angles[h[k]] = flow.metric->angles()[original[k]];
		}
	}
}

PlanarLayout layOutInPlane(const EndSheets& sheets, Face root)
{
	const EdgeArray<char> noCut(sheets.triangulation.edgeCount(), 0);
	return layOutInPlane(sheets.triangulation, sheets.lengths, sheets.angles, noCut, root);
}

HyperbolicLayout layOutInDisk(const EndSheets& sheets)
{
	const EdgeArray<char> noCut(sheets.triangulation.edgeCount(), 0);
	return layOutInDisk(sheets.triangulation, sheets.lengths, sheets.angles, noCut);
}

} // namespace ricci
