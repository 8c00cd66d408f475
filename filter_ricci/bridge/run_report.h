// SPDX-License-Identifier: GPL-3.0-or-later
// The parameter "report": a run of the filter as one HTML page that needs no other file, and as CSV.
#ifndef FILTER_RICCI_RUN_REPORT_H
#define FILTER_RICCI_RUN_REPORT_H

#include "output_file.h"
#include "results.h"

#include <ricci/layout/parametrization.h>

#include <string>
#include <vector>

namespace filter_ricci {

struct RunReport
{
	std::string filter, mesh; ///< their names
	std::string size;         ///< of the mesh, as part of a sentence
	const Parameters& settings;
	std::vector<std::string> notes; ///< what the log said of the mesh
	const Results& results;
	const ricci::Parametrization& map;
};

/// The files of a report, found writable before the run that it is about.
class ReportFiles
{
public:
	/// \param wanted a path that ends in .html (page, and data beside it) or in .csv (data alone), see
	/// absolutePath(); empty: no report
	/// \throw Refusal if no file can be written there; nothing has been written then
	ReportFiles(const std::string& wanted, const std::string& folder);

	/// Writes the files beside their places.
	/// \throw Refusal if one cannot be written after all (a full disk)
	void write(const RunReport& report);

	/// Moves the written files to their places.
	/// \return their names
	/// \throw Refusal if that cannot be done
	std::vector<std::string> publish();

private:
	OutputFile m_page, m_data; // without a name: not wanted
};

} // namespace filter_ricci

#endif
