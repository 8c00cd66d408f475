// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_ricci.h"

#include "bridge.h"
#include "error_sentences.h"

#include <QCoreApplication>
#include <QSettings>
#include <QStringList>

namespace {

const char* const kShowAll = "MeshLab::Ricci::ShowAllParameters";

/// This host's dialog is a plain list, higher than many screens if it shows every parameter. What it
/// shows is a setting of the window, in whose file the host keeps it as XML. meshlabserver has no
/// settings; it takes no parameter that the filter does not tell it of.
filter_ricci::Shown shownParameters()
{
	const bool hasWindow = !QCoreApplication::organizationName().isEmpty();
	if (!hasWindow || QSettings().value(kShowAll).toString().contains("value=\"true\""))
		return filter_ricci::Shown::All;
	return filter_ricci::Shown::Basic;
}

/// Characters in a line of the dialog's help.
constexpr int kHelpWidth = 62;

/// The dialog has room for the lines of help that the text itself begins, and cuts off those that it breaks.
struct Help : RichParameter
{
	static void breakLines(RichParameter& parameter)
	{
		QString& text = parameter.*&Help::tooltip;
		QStringList lines;
		int width = kHelpWidth;
		for (const QString& word : text.split(' ')) {
			QString plain = word;
			const int length = plain.remove("<b>").remove("</b>").length();
			if (width + 1 + length <= kHelpWidth) {
				lines.back() += "&nbsp;" + word;
				width += 1 + length;
			}
			else {
				lines << word;
				width = length;
			}
		}
		text = lines.join("<br>");
	}
};

} // namespace

FilterRicciPlugin::FilterRicciPlugin()
{
	typeList << filter_ricci::Euclidean << filter_ricci::Hyperbolic;
	for (const FilterIDType filter : types())
		actionList << new QAction(filterName(filter), this);
}

QString FilterRicciPlugin::pluginName() const
{
	return "FilterRicci";
}

QString FilterRicciPlugin::filterName(FilterIDType filter) const
{
	return filter_ricci::filterText(filter).name;
}

QString FilterRicciPlugin::filterInfo(FilterIDType filter) const
{
	return filter_ricci::filterText(filter).info;
}

FilterRicciPlugin::FilterClass FilterRicciPlugin::getClass(QAction*)
{
	return FilterClass(Texture | Quality);
}

FilterRicciPlugin::FILTER_ARITY FilterRicciPlugin::filterArity(QAction*) const
{
	return SINGLE_MESH;
}

int FilterRicciPlugin::getPreConditions(QAction*) const
{
	return filter_ricci::preConditions();
}

int FilterRicciPlugin::postCondition(QAction*) const
{
	return filter_ricci::postConditions();
}

// The variant with a document, because the host's default asks a document without a mesh for one.
void FilterRicciPlugin::initParameterSet(QAction* action, MeshDocument&, RichParameterList& par)
{
	RichParameterList list = filter_ricci::filterParameters(ID(action), shownParameters());
	for (RichParameter& parameter : list)
		Help::breakLines(parameter);
	par.join(list);
}

// Called for each filter.
void FilterRicciPlugin::initGlobalParameterSet(QAction*, RichParameterList& settings)
{
	if (!settings.hasParameter(kShowAll))
		settings.addParam(RichBool(
			kShowAll,
			false,
			"Generalized Ricci Flow: show all parameters",
			"The dialogs of both filters show the parameters that few runs need, too."));
}

bool FilterRicciPlugin::applyFilter(
	QAction* action, MeshDocument& md, const RichParameterList& par, vcg::CallBackPos* cb)
{
	errorMessage.clear();
	try {
		const auto toLog = [this](const std::string& line) { Log(line); };
		filter_ricci::applyFilter(ID(action), par, md, cb, toLog);
		return true;
	}
	catch (...) {
		// meshlabserver prints the log only, the window shows errorMessage only.
		const std::string sentence = filter_ricci::currentErrorSentence();
		Log(sentence);
		errorMessage = QString::fromStdString(sentence);
		return false;
	}
}
