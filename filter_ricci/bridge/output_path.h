// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_RICCI_OUTPUT_PATH_H
#define FILTER_RICCI_OUTPUT_PATH_H

#include <QDir>
#include <QFileInfo>
#include <QSaveFile>
#include <QString>

namespace filter_ricci {

/// A relative path starts from \p folder.
inline QString absolutePath(const QString& wanted, const QString& folder)
{
	return QDir::cleanPath(QDir(folder).absoluteFilePath(wanted));
}

/// A QSaveFile writes beside its target and renames: if it opens, both are allowed, and a file that is
/// not committed leaves nothing behind.
inline QString whyNotWritable(const QString& path)
{
	if (QFileInfo(path).isDir())
		return "it is a folder";
	QSaveFile file(path);
	return file.open(QIODevice::WriteOnly) ? QString() : file.errorString();
}

} // namespace filter_ricci

#endif
