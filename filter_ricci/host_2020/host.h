// SPDX-License-Identifier: GPL-3.0-or-later
// MeshLab 2020.09 as the bridge sees it.
#ifndef FILTER_RICCI_HOST_H
#define FILTER_RICCI_HOST_H

#include <common/interfaces.h>

#include "documents.h"

#include <QDir>

#include <filesystem>
#include <string>
#include <type_traits>
#include <utility>

// This MeshLab loads any plugin unchecked: one with another layout of the mesh crashes it.
static_assert(std::is_same_v<Scalarm, float>, "MeshLab 2020.09 needs MESHLAB_SCALAR=float");
#ifdef _GLIBCXX_DEBUG
#error "MeshLab's containers are those without _GLIBCXX_DEBUG"
#endif

namespace filter_ricci::host {

/// Of the entry of the menu Render that draws the histogram of the vertex quality.
constexpr const char* kHistogramName = "Show Quality Histogram";

inline void removeMesh(MeshDocument& md, MeshModel* mesh)
{
	md.delMesh(mesh);
}

/// Whether there is a dialog, whose parameters scripts of meshlabserver have, too.
inline bool hasDialog()
{
	return true;
}

/// Textures are files here, known by their names only.
inline void copyTextures(const MeshModel& from, MeshModel& to)
{
	to.cm.textures = from.cm.textures;
}

/// Null if there is no such file, or none that Qt can read.
inline Picture texture(const MeshModel& model, const std::string& name)
{
	const QString file = QString::fromStdString(name);
	const QImage beside(QDir(model.pathName()).absoluteFilePath(file));
	return Picture(beside.isNull() ? QImage(file) : beside);
}

/// Makes an image, which has been written, the only texture. The window looks for it in the folder of
/// the process; meshlabserver needs that folder for what it writes.
inline void setTexture(MeshModel& model, const std::string& name, const Picture&)
{
	model.cm.textures.assign(1, name);
	if (hasWindow())
		QDir::setCurrent(model.pathName());
}

/// The name of a texture by which this host finds its file: below the folder of the mesh from there,
/// elsewhere by its path.
inline std::string
textureName(const std::filesystem::path& path, const std::filesystem::path& folder)
{
	const std::filesystem::path relative = path.lexically_relative(folder);
	const bool isBelow = !relative.empty() && *relative.begin() != "..";
	return (isBelow ? relative : path).generic_u8string();
}

/// A parameter that few runs need. This host knows no difference.
template<class Parameter, class... Arguments>
Parameter advanced(Arguments&&... arguments)
{
	return Parameter(std::forward<Arguments>(arguments)...);
}

/// The name of a file to be written, as a text: RichSaveFile has a button to browse, but forgets what is
/// typed.
class FileToSave : public RichString
{
public:
	FileToSave(
		const QString& id,
		const QString& value,
		const QString& /*filter*/,
		const QString& label,
		const QString& text) :
			RichString(id, value, label, text)
	{
	}
};

/// Of a file's name, which scripts may also hold as a text.
inline QString text(const RichParameterList& par, const QString& id)
{
	const Value& value = par.getParameterByName(id).value();
	return value.isFileName() ? value.getFileName() : value.getString();
}

/// meshlabserver prints the texts one after the other, without line ends.
inline std::string progressText(const std::string& what)
{
	return what + "\n";
}

} // namespace filter_ricci::host

#endif
