// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_RICCI_FILTER_TEXT_H
#define FILTER_RICCI_FILTER_TEXT_H

#include <string>

namespace filter_ricci {

/// Ids of the filters, in menu order.
enum FilterId { Euclidean, Hyperbolic };

/// In UTF-8.
struct FilterText
{
	std::string name;       ///< menu entry, and the name in .mlx scripts
	std::string pythonName; ///< name in PyMeshLab
	std::string info;       ///< HTML for the filter's dialog and the documentation
};

/// \throw std::logic_error for an id that is none
FilterText filterText(int filter);

/// Both filters in menu order, with all that their dialogs show, as JSON: ricci_description() says how.
std::string filterDescriptions();

} // namespace filter_ricci

#endif
