// SPDX-License-Identifier: GPL-3.0-or-later
// What PyMeshLab does not give to programs, for the Python package: the progress and the log of a run, with a way to
// end it.
#include "meshlab.h"

/// Sets the listener of the runs that this thread starts from now on (meshlab.h); null: none.
extern "C" Q_DECL_EXPORT void filter_ricci_listen(vcg::CallBackPos* listener)
{
	filter_ricci::listener = listener;
}
