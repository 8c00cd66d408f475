// SPDX-License-Identifier: GPL-3.0-or-later
// MeshLab 2022.02 and later, and PyMeshLab, as the bridge sees them.
#ifndef FILTER_RICCI_HOST_H
#define FILTER_RICCI_HOST_H

#include <common/plugins/interfaces/filter_plugin.h>

#include "documents.h"

#include <filesystem>
#include <string>
#include <utility>

namespace filter_ricci::host {

/// Of the entry of the menu Render that draws the histogram of the vertex quality.
constexpr const char* kHistogramName = "Show Vertex Quality Histogram";

inline void removeMesh(MeshDocument& md, MeshModel* mesh)
{
	md.delMesh(static_cast<unsigned int>(mesh->id()));
}

/// Whether there is a dialog. Else it is PyMeshLab.
inline bool hasDialog()
{
	return hasWindow();
}

inline void copyTextures(const MeshModel& from, MeshModel& to)
{
	for (const std::string& name : from.cm.textures)
		to.addTexture(name, from.getTexture(name));
}

/// Null where the host found none when it opened the mesh: then it shows an image of its own.
inline Picture texture(const MeshModel& model, const std::string& name)
{
	const QImage image = model.getTexture(name);
	if (name == "dummy.png")
		for (const char* own : {":/resources/images/dummy.png", ":/img/dummy.png"})
			if (image == QImage(own))
				return Picture();
	return Picture(image);
}

/// Makes an image the only texture.
inline void setTexture(MeshModel& model, const std::string& name, const Picture& picture)
{
	model.clearTextures();
	model.addTexture(name, picture.image());
}

/// The name of a texture. This host keeps the image, and writes it beside the mesh when that is saved.
inline std::string
textureName(const std::filesystem::path& path, const std::filesystem::path& /*folder*/)
{
	return path.filename().u8string();
}

/// A parameter that few runs need: the dialog shows it on request only.
template<class Parameter, class... Arguments>
Parameter advanced(Arguments&&... arguments)
{
	return Parameter(std::forward<Arguments>(arguments)..., true);
}

#if __has_include(<common/parameters/rich_parameter/rich_file_save.h>)
using FileToSave = RichFileSave;
#else
using FileToSave = RichSaveFile;
#endif

inline QString text(const RichParameterList& par, const QString& id)
{
	return par.getString(id);
}

inline const std::string& progressText(const std::string& what)
{
	return what;
}

} // namespace filter_ricci::host

#endif
