// SPDX-License-Identifier: GPL-3.0-or-later
// What PyMeshLab does not give to programs, for the Python package: the texts and choices of parameters, and
// the progress of a run with a way to end it.
#include "bridge.h"

#include <QByteArray>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

namespace {

QJsonObject described(const RichParameter& parameter)
{
	QJsonObject object = {
		{"name", parameter.name()},
		{"label", parameter.fieldDescription()},
		{"tooltip", parameter.toolTip()},
		{"advanced", parameter.isAdvanced()}};
	const Value& value = parameter.value();
	if (const auto* choice = dynamic_cast<const RichEnum*>(&parameter)) {
		object["type"] = "enum";
		object["choices"] = QJsonArray::fromStringList(choice->enumvalues);
		object["default"] = choice->enumvalues.at(value.getInt());
	}
	else if (dynamic_cast<const RichBool*>(&parameter) != nullptr) {
		object["type"] = "bool";
		object["default"] = value.getBool();
	}
	else if (dynamic_cast<const RichInt*>(&parameter) != nullptr) {
		object["type"] = "int";
		object["default"] = value.getInt();
	}
	else if (dynamic_cast<const RichFloat*>(&parameter) != nullptr) {
		object["type"] = "float";
		object["default"] = value.getFloat();
	}
	else {
		object["type"] = "file";
		object["default"] = value.getString();
	}
	return object;
}

QJsonObject describedFilter(int filter)
{
	const filter_ricci::FilterText text = filter_ricci::filterText(filter);
	QJsonArray parameters;
	for (const RichParameter& parameter : filter_ricci::filterParameters(filter))
		parameters.append(described(parameter));
	return {
		{"name", text.name},
		{"python_name", text.pythonName},
		{"info", text.info},
		{"parameters", parameters}};
}

} // namespace

/// The filters in menu order with all that their dialogs show, as JSON in UTF-8. The text lives as
/// long as the plugin is loaded.
extern "C" Q_DECL_EXPORT const char* filter_ricci_description()
{
	static const QByteArray text = QJsonDocument(QJsonArray{
													 describedFilter(filter_ricci::Euclidean),
													 describedFilter(filter_ricci::Hyperbolic)})
									   .toJson(QJsonDocument::Compact);
	return text.constData();
}

/// Sets the listener of the runs that this thread starts from now on (bridge.h); null: none.
extern "C" Q_DECL_EXPORT void filter_ricci_listen(vcg::CallBackPos* listener)
{
	filter_ricci::listener = listener;
}
