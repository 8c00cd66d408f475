// SPDX-License-Identifier: GPL-3.0-or-later
// What the plugins for all versions of MeshLab share: between the bridge and MeshLab's parameters, documents and
// callbacks.
#ifndef FILTER_RICCI_MESHLAB_H
#define FILTER_RICCI_MESHLAB_H

#include "bridge.h"

#include <chrono>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace filter_ricci {

/// The parameters of a filter as the host has them.
RichParameterList richParameters(int filter);

/// Those that \p par has, by their names; the others have their defaults.
Parameters fromRich(int filter, const RichParameterList& par);

/// Told of this thread's runs besides the host, unless it is null: percent of the work that is done and what is being
/// done, many times a second, and false cancels; -1 and a line of the log; -2 and one of those lines, once more, that
/// is a doubt about the map. PyMeshLab's own callback cannot cancel, and its log is not given to programs.
extern thread_local vcg::CallBackPos* listener;

/// Speaks to the host, and to the listener.
class HostProgress : public ricci::Progress
{
public:
	using Log = std::function<void(const std::string&)>;

	/// \param callback may be null
	HostProgress(vcg::CallBackPos* callback, Log log) : m_callback(callback), m_log(std::move(log))
	{
	}

	void log(const std::string& line) override;
	bool update(double fraction, const std::string& what) override;

	/// Tells the listener the doubts among an Outcome's sentences.
	void warn(const std::vector<std::string>& sentences) const;

private:
	vcg::CallBackPos* m_callback;
	Log m_log;
	std::chrono::steady_clock::time_point m_nextTold;
};

} // namespace filter_ricci

#endif
