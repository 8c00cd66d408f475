// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_report.h"

#include "charts_picture.h"
#include "error_sentences.h"
#include "histogram.h"

#include <ricci/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <locale>
#include <map>
#include <sstream>
#include <utility>

namespace filter_ricci {

namespace {

/// Never in the host's locale: a decimal comma would break page and table.
std::ostringstream plainStream(int precision)
{
	std::ostringstream out;
	out.imbue(std::locale::classic());
	out.precision(precision);
	return out;
}

std::string escaped(const std::string& plain)
{
	static const std::map<char, std::string> entities{
		{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
	std::string html;
	for (char c : plain) {
		const auto entity = entities.find(c);
		html += entity == entities.end() ? std::string(1, c) : entity->second;
	}
	return html;
}

std::string csvField(const std::string& plain)
{
	if (plain.find_first_of(",\"\n\r") == std::string::npos)
		return plain;
	std::string quoted = "\"";
	for (char c : plain)
		quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
	return quoted + "\"";
}

// Pictures: the frame of a diagram lies between (kLeft, kTop) and (kRight, kBottom).
constexpr double kWidth = 560, kHeight = 300;
constexpr double kLeft = 64, kRight = kWidth - 16, kTop = 16, kBottom = kHeight - 46;

std::string coordinate(double x)
{
	return ricci::numberText(std::round(100.0 * x) / 100.0, 7);
}

/// A diagram with linear axes; its ends are the axes' labels.
class Diagram
{
public:
	Diagram(double x0, double x1, double y0, double y1) : m_x0(x0), m_x1(x1), m_y0(y0), m_y1(y1)
	{
		m_svg << "<svg viewBox=\"0 0 " << kWidth << " " << kHeight
			  << "\" role=\"img\" xmlns=\"http://www.w3.org/2000/svg\">\n";
	}

	double x(double value) const
	{
		return kLeft + (value - m_x0) / (m_x1 - m_x0) * (kRight - kLeft);
	}
	double y(double value) const
	{
		return kBottom - (value - m_y0) / (m_y1 - m_y0) * (kBottom - kTop);
	}

	void bar(double from, double to, double height)
	{
		m_svg << "<rect class=\"bar\" x=\"" << coordinate(x(from)) << "\" y=\""
			  << coordinate(y(height)) << "\" width=\"" << coordinate(x(to) - x(from))
			  << "\" height=\"" << coordinate(kBottom - y(height)) << "\"/>\n";
	}

	void line(const std::vector<std::pair<double, double>>& points)
	{
		m_svg << "<polyline class=\"line\" points=\"";
		for (const auto& [px, py] : points)
			m_svg << coordinate(x(px)) << "," << coordinate(y(py)) << " ";
		m_svg << "\"/>\n";
		for (const auto& [px, py] : points)
			m_svg << "<circle class=\"dot\" cx=\"" << coordinate(x(px)) << "\" cy=\""
				  << coordinate(y(py)) << "\" r=\"3\"/>\n";
	}

	void tickX(double at, const std::string& label)
	{
		m_svg << "<line class=\"axis\" x1=\"" << coordinate(x(at)) << "\" x2=\""
			  << coordinate(x(at)) << "\" y1=\"" << kBottom << "\" y2=\"" << kBottom + 5
			  << "\"/>\n<text x=\"" << coordinate(x(at)) << "\" y=\"" << kBottom + 18
			  << "\" text-anchor=\"middle\">" << label << "</text>\n";
	}

	void tickY(double at, const std::string& label)
	{
		m_svg << "<line class=\"grid\" x1=\"" << kLeft << "\" x2=\"" << kRight << "\" y1=\""
			  << coordinate(y(at)) << "\" y2=\"" << coordinate(y(at)) << "\"/>\n<text x=\""
			  << kLeft - 6 << "\" y=\"" << coordinate(y(at) + 4) << "\" text-anchor=\"end\">"
			  << label << "</text>\n";
	}

	std::string finish(const std::string& labelX)
	{
		m_svg << "<line class=\"axis\" x1=\"" << kLeft << "\" x2=\"" << kRight << "\" y1=\""
			  << kBottom << "\" y2=\"" << kBottom << "\"/>\n<text x=\"" << (kLeft + kRight) / 2
			  << "\" y=\"" << kHeight - 8 << "\" text-anchor=\"middle\">" << labelX
			  << "</text>\n</svg>\n";
		return m_svg.str();
	}

private:
	double m_x0, m_x1, m_y0, m_y1;
	std::ostringstream m_svg = plainStream(7);
};

std::string histogramPicture(const Histogram& h, const std::string& label)
{
	const std::size_t highest = std::max<std::size_t>(
		1, h.counts.empty() ? 1 : *std::max_element(h.counts.begin(), h.counts.end()));
	Diagram diagram(h.low, h.high, 0.0, static_cast<double>(highest));
	for (int i = 0; i <= 4; ++i) {
		const double count = std::round(static_cast<double>(highest) * i / 4.0);
		diagram.tickY(count, ricci::numberText(count, 9));
	}
	for (std::size_t i = 0; i < h.counts.size(); ++i)
		if (h.counts[i] > 0)
			diagram.bar(
				h.lowEdge(i), h.lowEdge(i) + h.binWidth(), static_cast<double>(h.counts[i]));
	for (int i = 0; i <= 5; ++i) {
		const double at = h.low + (h.high - h.low) * i / 5.0;
		diagram.tickX(at, ricci::numberText(at, 8));
	}
	return diagram.finish(label);
}

using States = std::vector<ricci::FlowState>;

/// Those of each component.
std::vector<States> statesByComponent(const ricci::Report& data)
{
	std::vector<States> states;
	for (const ricci::FlowState& state : data.flowStates) {
		states.resize(std::max(states.size(), static_cast<std::size_t>(state.component) + 1));
		states[static_cast<std::size_t>(state.component)].push_back(state);
	}
	return states;
}

/// More components than this make the diagram unreadable; the data has them all.
constexpr std::size_t kMaxLines = 20;

std::string residualPicture(const ricci::Report& data)
{
	std::vector<States> components = statesByComponent(data);
	if (components.size() > kMaxLines)
		components.resize(kMaxLines);
	double low = 0.0, high = -99.0;
	int last = 1;
	for (States& states : components)
		for (ricci::FlowState& state : states) {
			last = std::max(last, state.step);
			state.residual = std::log10(std::max(state.residual, 1e-17));
			low = std::min(low, std::floor(state.residual));
			high = std::max(high, std::ceil(state.residual));
		}
	high = std::max(high, low + 1.0);
	Diagram diagram(0.0, static_cast<double>(last), low, high);
	const double step = std::max(1.0, std::ceil((high - low) / 8.0));
	for (double exponent = high; exponent >= low; exponent -= step)
		diagram.tickY(exponent, "1e" + ricci::numberText(exponent, 6));
	for (int i = 0; i <= last; i += (last + 10) / 10)
		diagram.tickX(static_cast<double>(i), std::to_string(i));
	for (const States& states : components) {
		std::vector<std::pair<double, double>> solve;
		int before = -1;
		for (const ricci::FlowState& state : states) {
			if (state.step == before) { // another solve begins
				diagram.line(solve);
				solve.clear();
			}
			solve.emplace_back(static_cast<double>(state.step), state.residual);
			before = state.step;
		}
		diagram.line(solve);
	}
	return diagram.finish("step");
}

const char* const kStyle =
	"body{font:15px/1.45 system-ui,sans-serif;max-width:1180px;margin:2em auto;padding:0 1em;"
	"color:#222;background:#fff}\n"
	"h1{font-size:1.5em}h2{font-size:1.1em;margin:1.6em 0 .3em}\n"
	".all{display:grid;gap:0 2em;"
	"grid-template-columns:repeat(auto-fit,minmax(min(480px,100%),1fr))}\n"
	".all>*{min-width:0}\n"
	"section>p{margin:0}svg{width:100%;height:auto;font:12px system-ui,sans-serif}\n"
	"svg.charts{font-size:9px}\n"
	".bar{fill:#3b6ea5}.line{fill:none;stroke:#b5462f;stroke-width:1.5}.dot{fill:#b5462f}\n"
	".axis{stroke:#222}.grid{stroke:#ddd}\n"
	".frame{fill:none;stroke:#ddd}.outline{fill:none;stroke:#222;stroke-width:.5}\n"
	"table{border-collapse:collapse}td,th{padding:.15em 1em .15em 0;text-align:left;"
	"border-bottom:1px solid #e4e4e4;font-variant-numeric:tabular-nums;vertical-align:top}\n"
	"td:first-child{min-width:13em}td:last-child{min-width:9em;overflow-wrap:anywhere}\n"
	"code{font-size:12px;color:#666}\n";

std::string tableRow(const std::string& label, const std::string& key, const std::string& value)
{
	return "<tr><td>" + escaped(label) + "</td><td><code>" + escaped(key) + "</code></td><td>" +
		   escaped(value) + "</td></tr>\n";
}

void addHistogram(std::ostream& csv, const char* start, const Histogram& h)
{
	if (h.below > 0)
		csv << start << "-inf," << h.below << "\n";
	for (std::size_t i = 0; i < h.counts.size(); ++i)
		csv << start << h.lowEdge(i) << "," << h.counts[i] << "\n";
	csv << start << h.high << "," << h.above << "\n";
}

/// The page: the charts, histograms of the distortion and of the area factors, residual of every Newton
/// step, tables of results and settings; pictures are SVG inside it. UTF-8.
std::string toHtml(const RunReport& report)
{
	const ricci::Report& data = report.map.report;
	const Histogram qc = distortionHistogram(data.qcValues),
					areas = factorHistogram(data.areaFactors);
	std::ostringstream page = plainStream(10);
	page << "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>"
		 << escaped(report.filter + ": " + report.mesh) << "</title>\n<style>\n"
		 << kStyle << "</style>\n</head>\n<body>\n<h1>" << escaped(report.filter) << "</h1>\n<p>"
		 << escaped(report.mesh) << "</p>\n<p>" << escaped(report.size) << "</p>\n";
	for (const std::string& note : report.notes)
		page << "<p>" << escaped(note) << "</p>\n";
	page << "<div class=\"all\">\n<section>\n<h2>Charts</h2>\n"
		 << chartsPicture(report.map.mesh)
		 << "<p>The colour is the scale: the share of a face's area in the plane over its share "
		 << "in space.</p>\n</section>\n<div>\n<section>\n"
		 << "<h2>Quasi-conformal distortion of the vertices</h2>\n"
		 << histogramPicture(
				qc, "&sigma;&#8321;/&sigma;&#8322;, mean of the faces at the vertex by area")
		 << "<p>1 where angles are kept. Vertices beyond the scale: " << qc.above
		 << ". <i>Colour by distortion</i> paints the vertices from "
		 << escaped(colourRamp(report.results)) << ".</p>\n"
		 << "</section>\n<section>\n<h2>Area factor of the faces</h2>\n"
		 << histogramPicture(areas, "log&#8322; of the share in the plane over the share in space")
		 << "<p>0 where areas keep their ratios. Faces beyond the scale: "
		 << areas.below + areas.above << ".</p>\n"
		 << "</section>\n</div>\n<section>\n<h2>Results</h2>\n<table>\n";
	for (const auto& [key, value, label] : report.results)
		page << tableRow(label, key, valueText(value, " "));
	page << "</table>\n</section>\n<div>\n<section>\n"
		 << "<h2>Largest curvature error before each Newton step</h2>\n"
		 << residualPicture(data)
		 << "<p>max |K&#772; &minus; K| in radians; a line for each solve of each component"
		 << (statesByComponent(data).size() > kMaxLines ? ", the first 20" : "")
		 << ".</p>\n</section>\n<section>\n<h2>Parameters</h2>\n<table>\n";
	for (const Parameter& p : report.settings)
		page << tableRow(p.label, p.name, valueText(p));
	page << "</table>\n</section>\n</div>\n</div>\n</body>\n</html>\n";
	return page.str();
}

/// The same data as rows "table,group,key,value": tables "setting" and "result" without a group,
/// "newton" (group: component, key: Newton steps done, value: residual in radians; a key that is repeated
/// begins another solve), "qc_histogram" (group:
/// vertices, key: lower end of the bin, value: vertices), "area_histogram" (group: faces, key: lower
/// end in log2 of the area factor, value: faces). UTF-8, fields quoted where they need it.
std::string toCsv(const RunReport& report)
{
	std::ostringstream csv = plainStream(10);
	csv << "table,group,key,value\n";
	csv << "setting,,filter," << csvField(report.filter) << "\n";
	csv << "setting,,mesh," << csvField(report.mesh) << "\n";
	for (const Parameter& p : report.settings)
		csv << "setting,," << p.name << "," << csvField(valueText(p)) << "\n";
	for (const Result& result : report.results)
		csv << "result,," << result.key << "," << csvField(valueText(result.value, " ")) << "\n";
	for (const ricci::FlowState& state : report.map.report.flowStates)
		csv << "newton," << state.component << "," << state.step << "," << state.residual << "\n";
	addHistogram(csv, "qc_histogram,vertices,", distortionHistogram(report.map.report.qcValues));
	addHistogram(csv, "area_histogram,faces,", factorHistogram(report.map.report.areaFactors));
	return csv.str();
}

} // namespace

ReportFiles::ReportFiles(const std::string& wanted, const std::string& folder)
{
	if (wanted.empty())
		return;
	const std::filesystem::path path = absolutePath(wanted, folder);
	const std::string ending = endingOf(path);
	if (ending != "html" && ending != "csv")
		throw Refusal(
			"The report " + wanted +
			" cannot be written: its name must end in .html (page, and its data beside it) or .csv "
			"(data alone).");
	if (ending == "html")
		m_page = OutputFile(path, "The report");
	m_data = OutputFile(
		ending == "csv" ? path : std::filesystem::path(path).replace_extension("csv"),
		"The report");
}

void ReportFiles::write(const RunReport& report)
{
	if (m_page.isWanted())
		m_page.write(toHtml(report));
	if (m_data.isWanted())
		m_data.write(toCsv(report));
}

std::vector<std::string> ReportFiles::publish()
{
	std::vector<std::string> written;
	for (OutputFile* file : {&m_page, &m_data})
		if (file->isWanted()) {
			file->publish();
			written.push_back(file->name());
		}
	return written;
}

} // namespace filter_ricci
