// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshlab.h"

#include <QApplication>
#include <QDockWidget>
#include <QGridLayout>
#include <QObject>
#include <QStringList>
#include <QTimer>

namespace {

/// Characters in a line of the dialog's help.
constexpr int kHelpWidth = 45;

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

/// This host's dialog is one column of rows (label, field, help), higher than many screens for so many
/// parameters. Once it is made, the lower half of them moves beside the upper one.
void showInTwoColumns(const QString& filter)
{
	constexpr int kFields = 3;
	for (QWidget* widget : QApplication::allWidgets()) {
		const auto* dialog = qobject_cast<QDockWidget*>(widget);
		if (dialog == nullptr || dialog->windowTitle() != filter || dialog->widget() == nullptr)
			continue;
		const auto* whole = qobject_cast<QGridLayout*>(dialog->widget()->layout());
		QLayoutItem* list = whole == nullptr ? nullptr : whole->itemAtPosition(1, 0);
		auto* rows = list == nullptr || list->widget() == nullptr
						 ? nullptr
						 : qobject_cast<QGridLayout*>(list->widget()->layout());
		if (rows == nullptr || rows->columnCount() > kFields)
			continue;
		const int count = rows->rowCount(), half = (count + 1) / 2;
		for (int row = half; row < count; ++row)
			for (int field = 0; field < kFields; ++field)
				if (QLayoutItem* item = rows->itemAtPosition(row, field)) {
					int at = 0, column = 0, height = 0, width = 0;
					const int index = rows->indexOf(item->widget());
					rows->getItemPosition(index, &at, &column, &height, &width);
					rows->addItem(
						rows->takeAt(index),
						row - half,
						kFields + column,
						height,
						width,
						item->alignment());
				}
		list->widget()->setMinimumSize(rows->sizeHint());
		// The filter's text is higher where it is broken into lines, which the hint does not know. Nothing above it has a
		// size of its own: help makes it larger.
		QWidget* const text = whole->itemAtPosition(0, 0)->widget();
		text->setMinimumHeight(text->heightForWidth(rows->sizeHint().width()));
		widget->setMinimumSize(dialog->widget()->sizeHint());
		widget->adjustSize();
	}
}

} // namespace

/// The filter as a plugin of MeshLab 2020.09. No exception leaves it: the host would abort.
class FilterRicciPlugin : public QObject, public MeshFilterInterface
{
	Q_OBJECT
	MESHLAB_PLUGIN_IID_EXPORTER(MESH_FILTER_INTERFACE_IID)
	Q_INTERFACES(MeshFilterInterface)

public:
	FilterRicciPlugin()
	{
		typeList << filter_ricci::Euclidean << filter_ricci::Hyperbolic;
		for (const FilterIDType filter : types())
			actionList << new QAction(FilterRicciPlugin::filterName(filter), this);
	}

	QString pluginName() const override { return "FilterRicci"; }

	QString filterName(FilterIDType filter) const override
	{
		return QString::fromStdString(filter_ricci::filterText(filter).name);
	}

	QString filterInfo(FilterIDType filter) const override
	{
		return QString::fromStdString(filter_ricci::filterText(filter).info);
	}

	FilterClass getClass(QAction*) override { return FilterClass(Texture | Quality); }
	FILTER_ARITY filterArity(QAction*) const override { return SINGLE_MESH; }
	int getPreConditions(QAction*) const override { return filter_ricci::preConditions(); }
	int postCondition(QAction*) const override { return filter_ricci::postConditions(); }

	// The variant with a document, because the host's default asks a document without a mesh for one.
	void initParameterSet(QAction* action, MeshDocument&, RichParameterList& par) override
	{
		RichParameterList list = filter_ricci::richParameters(ID(action));
		for (RichParameter& parameter : list)
			Help::breakLines(parameter);
		par.join(list);
		if (filter_ricci::host::hasWindow())
			QTimer::singleShot(
				0, this, [name = filterName(ID(action))] { showInTwoColumns(name); });
	}

	bool applyFilter(
		QAction* action,
		MeshDocument& md,
		const RichParameterList& par,
		vcg::CallBackPos* cb) override
	{
		errorMessage.clear();
		try {
			const int filter = ID(action);
			filter_ricci::HostProgress progress(cb, [this](const std::string& line) { Log(line); });
			filter_ricci::applyFilter(filter, filter_ricci::fromRich(filter, par), md, progress);
			return true;
		}
		catch (...) {
			// meshlabserver prints the log only, the window shows errorMessage only.
			const std::string sentence = filter_ricci::failure(ID(action));
			Log(sentence);
			errorMessage = QString::fromStdString(sentence);
			return false;
		}
	}
};

#include "filter_ricci.moc"
