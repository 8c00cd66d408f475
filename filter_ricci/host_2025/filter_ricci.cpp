// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_ricci.h"

#include "meshlab.h"

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

FilterRicciPlugin::FilterRicciPlugin()
{
	typeList = {filter_ricci::Euclidean, filter_ricci::Hyperbolic};
	for (const ActionIDType filter : types())
		actionList.push_back(new QAction(filterName(filter), this));
}

QString FilterRicciPlugin::pluginName() const
{
	return "FilterRicci";
}

QString FilterRicciPlugin::vendor() const
{
	return "Generalized Ricci Flow";
}

QString FilterRicciPlugin::filterName(ActionIDType filter) const
{
	return QString::fromStdString(filter_ricci::filterText(filter).name);
}

QString FilterRicciPlugin::pythonFilterName(ActionIDType filter) const
{
	return QString::fromStdString(filter_ricci::filterText(filter).pythonName);
}

QString FilterRicciPlugin::filterInfo(ActionIDType filter) const
{
	return QString::fromStdString(filter_ricci::filterText(filter).info);
}

FilterRicciPlugin::FilterClass FilterRicciPlugin::getClass(const QAction*) const
{
	return FilterClass(Texture | Quality);
}

FilterRicciPlugin::FilterArity FilterRicciPlugin::filterArity(const QAction*) const
{
	return SINGLE_MESH;
}

int FilterRicciPlugin::getPreConditions(const QAction*) const
{
	return filter_ricci::preConditions();
}

int FilterRicciPlugin::postCondition(const QAction*) const
{
	return filter_ricci::postConditions();
}

// The variant with a document, because the host's default asks a document without a mesh for one.
RichParameterList FilterRicciPlugin::initParameterList(const QAction* action, const MeshDocument&)
{
	return filter_ricci::richParameters(ID(action));
}

std::map<std::string, QVariant> FilterRicciPlugin::applyFilter(
	const QAction* action,
	const RichParameterList& par,
	MeshDocument& md,
	unsigned int& postConditionMask,
	vcg::CallBackPos* cb)
{
	try {
		const int filter = ID(action);
		filter_ricci::HostProgress progress(
			cb, [this](const std::string& line) { this->log(line); });
		const auto outcome =
			filter_ricci::applyFilter(filter, filter_ricci::fromRich(filter, par), md, progress);
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
