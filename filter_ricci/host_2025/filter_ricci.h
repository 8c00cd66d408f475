// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_RICCI_PLUGIN_H
#define FILTER_RICCI_PLUGIN_H

#include "host.h"

#include <QObject>

/// The filter as a plugin of MeshLab 2022.02 and later, and of PyMeshLab. Only MLException leaves
/// it: the host would abort at any other.
class FilterRicciPlugin : public QObject, public FilterPlugin
{
	Q_OBJECT
	MESHLAB_PLUGIN_IID_EXPORTER(FILTER_PLUGIN_IID)
	Q_INTERFACES(FilterPlugin)

public:
	FilterRicciPlugin();

	QString pluginName() const override;
	QString vendor() const override;
	QString filterName(ActionIDType filter) const override;
	QString pythonFilterName(ActionIDType filter) const override;
	QString filterInfo(ActionIDType filter) const override;
	FilterClass getClass(const QAction* action) const override;
	FilterArity filterArity(const QAction* action) const override;
	int getPreConditions(const QAction* action) const override;
	int postCondition(const QAction* action) const override;

	RichParameterList initParameterList(const QAction* action, const MeshDocument& md) override;
	std::map<std::string, QVariant> applyFilter(
		const QAction* action,
		const RichParameterList& par,
		MeshDocument& md,
		unsigned int& postConditionMask,
		vcg::CallBackPos* cb) override;
};

#endif
