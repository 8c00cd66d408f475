// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_RICCI_PLUGIN_H
#define FILTER_RICCI_PLUGIN_H

#include "host.h"

#include <QObject>

/// The filter as a plugin of MeshLab 2020.09. No exception leaves it: the host would abort.
class FilterRicciPlugin : public QObject, public MeshFilterInterface
{
	Q_OBJECT
	MESHLAB_PLUGIN_IID_EXPORTER(MESH_FILTER_INTERFACE_IID)
	Q_INTERFACES(MeshFilterInterface)

public:
	FilterRicciPlugin();

	QString pluginName() const override;
	QString filterName(FilterIDType filter) const override;
	QString filterInfo(FilterIDType filter) const override;
	FilterClass getClass(QAction* action) override;
	FILTER_ARITY filterArity(QAction* action) const override;
	int getPreConditions(QAction* action) const override;
	int postCondition(QAction* action) const override;

	void initParameterSet(QAction* action, MeshDocument& md, RichParameterList& par) override;
	bool applyFilter(
		QAction* action,
		MeshDocument& md,
		const RichParameterList& par,
		vcg::CallBackPos* cb) override;
};

#endif
