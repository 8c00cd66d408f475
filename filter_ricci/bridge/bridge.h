// SPDX-License-Identifier: GPL-3.0-or-later
// What every host shares: the filters' texts and parameters, and one run of a filter on the current
// mesh of a document. The hosts' plugin classes only pass calls on.
#ifndef FILTER_RICCI_BRIDGE_H
#define FILTER_RICCI_BRIDGE_H

// Each host has its own host.h, found through the include path of its target.
#include "host.h"

#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace filter_ricci {

/// Ids of the filters of this plugin, in menu order.
enum FilterId { Euclidean, Hyperbolic };

struct FilterText
{
	QString name;       ///< menu entry, and the name in .mlx scripts
	QString pythonName; ///< name in PyMeshLab
	QString info;       ///< HTML for the filter's dialog and the documentation
};

FilterText filterText(int filter);

/// The parameters in the order of the dialog. Hosts find them by their names.
RichParameterList filterParameters(int filter);

/// MeshModel::MeshElement bits the host checks before a run.
int preConditions();

/// MeshModel::MeshElement bits the filter may change. They contain the element-number bits on
/// purpose: hosts offer no live preview then, and a preview would solve the whole flow again at
/// every change of a parameter and leave a new layer each time.
int postConditions();

using Value = std::variant<bool, int, double, std::vector<double>>;
using Results = std::vector<std::pair<std::string, Value>>;
using Log = std::function<void(const std::string&)>;

struct Outcome
{
	Results results;
	std::vector<std::string> sentences; ///< that sum up the run
	int changedElements;                ///< MeshModel::MeshElement bits
};

/// The exception being handled, as one or more sentences for the user: the mesh is unchanged. Call it inside a
/// catch block only.
std::string failure(int filter);

/// Told of the progress of this thread's runs besides the host, many times a second, unless it is null; false
/// cancels. PyMeshLab's own callback cannot.
extern thread_local vcg::CallBackPos* listener;

/// Runs the filter on the current mesh of \p md. Parameters that \p par lacks have their defaults.
/// Nothing is written before everything is computed.
/// \throw Refusal, ricci::Error, std::bad_alloc and what vcglib throws; see failure().
Outcome applyFilter(
	int filter,
	const RichParameterList& par,
	MeshDocument& md,
	vcg::CallBackPos* callback,
	const Log& log);

} // namespace filter_ricci

#endif
