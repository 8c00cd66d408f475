// SPDX-License-Identifier: GPL-3.0-or-later
// The part of host.h that is the same for all versions of MeshLab.
#ifndef FILTER_RICCI_DOCUMENTS_H
#define FILTER_RICCI_DOCUMENTS_H

#include "picture.h"

#include <QCoreApplication>
#include <QString>

#include <string>
#include <vector>

namespace filter_ricci::host {

/// Programs without one have no settings of an organization.
inline bool hasWindow()
{
	return !QCoreApplication::organizationName().isEmpty();
}

/// Adds an empty layer, which does not become the current one.
inline MeshModel* addMesh(MeshDocument& md, const std::string& label)
{
	return md.addNewMesh(QString(), QString::fromStdString(label), false);
}

inline std::string label(const MeshModel& model)
{
	return model.label().toStdString();
}

/// Of the file, without its folder.
inline std::string name(const MeshModel& model)
{
	return model.shortName().toStdString();
}

/// Of the file.
inline std::string folder(const MeshModel& model)
{
	return model.pathName().toStdString();
}

/// All of it is one.
inline std::vector<int> parts(const MeshModel&)
{
	return {};
}

} // namespace filter_ricci::host

#endif
