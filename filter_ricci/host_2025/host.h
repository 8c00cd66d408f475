// SPDX-License-Identifier: GPL-3.0-or-later
// MeshLab 2022.02 and later, and PyMeshLab, as the bridge sees them.
#ifndef FILTER_RICCI_HOST_H
#define FILTER_RICCI_HOST_H

#include <common/plugins/interfaces/filter_plugin.h>

#include <string>

namespace filter_ricci::host {

/// Of the entry of the menu Render that draws the histogram of the vertex quality.
constexpr const char* kHistogramName = "Show Vertex Quality Histogram";

inline void removeMesh(MeshDocument& md, MeshModel* mesh)
{
	md.delMesh(static_cast<unsigned int>(mesh->id()));
}

inline void copyTextures(const MeshModel& from, MeshModel& to)
{
	for (const std::string& name : from.cm.textures)
		to.addTexture(name, from.getTexture(name));
}

inline const std::string& progressText(const std::string& what)
{
	return what;
}

} // namespace filter_ricci::host

#endif
