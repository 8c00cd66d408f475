// SPDX-License-Identifier: GPL-3.0-or-later
// What PyMeshLab does not give to programs, for the Python package: the texts and choices of parameters, and
// the progress of a run with a way to end it.
#include "meshlab.h"

#include <string>

/// filter_ricci::filterDescriptions(). The text lives as long as the plugin is loaded.
extern "C" Q_DECL_EXPORT const char* filter_ricci_description()
{
	static const std::string text = filter_ricci::filterDescriptions();
	return text.c_str();
}

/// Sets the listener of the runs that this thread starts from now on (meshlab.h); null: none.
extern "C" Q_DECL_EXPORT void filter_ricci_listen(vcg::CallBackPos* listener)
{
	filter_ricci::listener = listener;
}
