// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshlab.h"

#include <QObject>

namespace {

QVariant toVariant(const std::vector<double>& values)
{
	const Eigen::VectorXd vector =
		Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
	return QVariant::fromValue(vector);
}

template<class Number>
QVariant toVariant(Number value)
{
	return QVariant(value);
}

std::map<std::string, QVariant> toMap(const filter_ricci::Results& results)
{
	std::map<std::string, QVariant> map;
	for (const filter_ricci::Result& result : results)
		map[result.key] = std::visit([](const auto& v) { return toVariant(v); }, result.value);
	return map;
}

} // namespace

/// The filter as a plugin of MeshLab 2022.02 and later, and of PyMeshLab. Only MLException leaves
/// it: the host would abort at any other.
class FilterRicciPlugin : public QObject, public FilterPlugin
{
	Q_OBJECT
	MESHLAB_PLUGIN_IID_EXPORTER(FILTER_PLUGIN_IID)
	Q_INTERFACES(FilterPlugin)

public:
	FilterRicciPlugin()
	{
		typeList = {filter_ricci::Euclidean, filter_ricci::Hyperbolic};
		for (const ActionIDType filter : types())
			actionList.push_back(new QAction(FilterRicciPlugin::filterName(filter), this));
	}

	QString pluginName() const override { return "FilterRicci"; }
	QString vendor() const override { return "Generalized Ricci Flow"; }

	QString filterName(ActionIDType filter) const override
	{
		return QString::fromStdString(filter_ricci::filterText(filter).name);
	}

	QString pythonFilterName(ActionIDType filter) const override
	{
		return QString::fromStdString(filter_ricci::filterText(filter).pythonName);
	}

	QString filterInfo(ActionIDType filter) const override
	{
		return QString::fromStdString(filter_ricci::filterText(filter).info);
	}

	FilterClass getClass(const QAction*) const override { return FilterClass(Texture | Quality); }
	FilterArity filterArity(const QAction*) const override { return SINGLE_MESH; }
	int getPreConditions(const QAction*) const override { return filter_ricci::preConditions(); }
	int postCondition(const QAction*) const override { return filter_ricci::postConditions(); }

	// The variant with a document, because the host's default asks a document without a mesh for one.
	RichParameterList initParameterList(const QAction* action, const MeshDocument&) override
	{
		return filter_ricci::richParameters(ID(action));
	}

	std::map<std::string, QVariant> applyFilter(
		const QAction* action,
		const RichParameterList& par,
		MeshDocument& md,
		unsigned int& postConditionMask,
		vcg::CallBackPos* cb) override
	{
		try {
			const int filter = ID(action);
			filter_ricci::HostProgress progress(
				cb, [this](const std::string& line) { this->log(line); });
			const auto outcome = filter_ricci::applyFilter(
				filter, filter_ricci::fromRich(filter, par), md, progress);
			progress.warn(outcome.sentences);
			postConditionMask = static_cast<unsigned int>(outcome.changedElements);
			return toMap(outcome.results);
		}
		catch (...) {
			// PyMeshLab leaves a failed filter with the log of its document, which may not outlive it.
			setLog(nullptr);
			throw MLException(QString::fromStdString(filter_ricci::failure(ID(action))));
		}
	}
};

#include "filter_ricci.moc"
