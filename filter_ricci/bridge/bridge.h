// SPDX-License-Identifier: GPL-3.0-or-later
// What every host shares: one run of a filter on the current mesh of a document. The hosts only pass calls on.
#ifndef FILTER_RICCI_BRIDGE_H
#define FILTER_RICCI_BRIDGE_H

// Each host has its own host.h, found through the include path of its target: MeshDocument and MeshModel as MeshLab
// has them, with the mesh CMeshO of vcglib, and in the namespace host what else the bridge asks of a host. Texts are in
// UTF-8.
#include "host.h"

#include "parameters.h"
#include "results.h"

#include <ricci/progress.h>

#include <string>
#include <vector>

namespace filter_ricci {

/// MeshModel::MeshElement bits the host checks before a run.
int preConditions();

/// MeshModel::MeshElement bits the filter may change. They contain the element-number bits on
/// purpose: hosts offer no live preview then, and a preview would solve the whole flow again at
/// every change of a parameter and leave a new layer each time.
int postConditions();

struct Outcome
{
	Results results;
	std::vector<std::string>
		sentences; ///< the first one says what came out, the others are doubts about the map
	std::vector<std::string> details; ///< further lines of the log
	int changedElements = 0;          ///< MeshModel::MeshElement bits
	std::vector<int> chart;           ///< [face of the mesh as it is now] -1 where it has none
	std::vector<int> origin;          ///< [likewise] the face that it is a piece of
};

/// The exception being handled, as one or more sentences for the user: the mesh is unchanged. Call it inside a
/// catch block only.
std::string failure(int filter);

/// Runs the filter on the current mesh of \p md. Nothing is written before everything is computed.
/// \param parameters those of filterParameters(), in their order, with the values that were chosen
/// \throw Refusal, ricci::Error, std::bad_alloc and what vcglib throws; see failure().
Outcome
applyFilter(int filter, const Parameters& parameters, MeshDocument& md, ricci::Progress& listener);

} // namespace filter_ricci

#endif
