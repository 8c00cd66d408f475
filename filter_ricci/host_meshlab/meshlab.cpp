// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshlab.h"

#include "error_sentences.h"

#include <QStringList>

#include <algorithm>

namespace filter_ricci {

thread_local vcg::CallBackPos* listener = nullptr;

namespace {

using Clock = std::chrono::steady_clock;

/// Between two calls of a listener, which may be slow.
constexpr std::chrono::milliseconds kListenerPause(50);

/// Adds the host's kind of parameter.
template<class Rich, class... Arguments>
void add(RichParameterList& list, const Parameter& p, const Arguments&... arguments)
{
	const QString name = QString::fromStdString(p.name), label = QString::fromStdString(p.label),
				  tooltip = QString::fromStdString(p.tooltip);
	if (p.place != Place::Shown)
		list.addParam(host::advanced<Rich>(name, arguments..., label, tooltip));
	else
		list.addParam(Rich(name, arguments..., label, tooltip));
}

} // namespace

RichParameterList richParameters(int filter)
{
	Parameters parameters = dialogParameters(filter);
	for (const Parameter& p : filterParameters(filter))
		if (p.place == Place::Options && !host::hasDialog())
			parameters.push_back(p);
	RichParameterList list;
	for (const Parameter& p : parameters) {
		if (const bool* const isOn = std::get_if<bool>(&p.value))
			add<RichBool>(list, p, *isOn);
		else if (const double* const number = std::get_if<double>(&p.value))
			add<RichFloat>(list, p, static_cast<Scalarm>(*number));
		else if (const int* const whole = std::get_if<int>(&p.value)) {
			QStringList choices;
			for (const std::string& choice : p.choices)
				choices << QString::fromStdString(choice);
			if (choices.isEmpty())
				add<RichInt>(list, p, *whole);
			else
				add<RichEnum>(list, p, *whole, choices);
		}
		else if (p.files.empty())
			add<RichString>(list, p, QString());
		else
			add<host::FileToSave>(list, p, QString(), QString::fromStdString(p.files));
	}
	return list;
}

Parameters fromRich(int filter, const RichParameterList& par)
{
	Parameters parameters = filterParameters(filter);
	for (const auto& [old, now] : renamedParameters(filter))
		if (par.hasParameter(QString::fromStdString(old)))
			throw Refusal(noSuchParameter(filter, old));
	for (Parameter& p : parameters) {
		const QString name = QString::fromStdString(p.name);
		const bool isGiven = par.hasParameter(name);
		if (double* const number = std::get_if<double>(&p.value))
			// The default, too, is a number of the host.
			*number =
				static_cast<double>(isGiven ? par.getFloat(name) : static_cast<Scalarm>(*number));
		else if (!isGiven)
			continue;
		else if (bool* const isOn = std::get_if<bool>(&p.value))
			*isOn = par.getBool(name);
		else if (int* const whole = std::get_if<int>(&p.value))
			*whole = p.choices.empty() ? par.getInt(name) : par.getEnum(name);
		else
			p.value = host::text(par, name).toStdString();
	}
	if (par.hasParameter("options"))
		setOptions(filter, parameters, par.getString("options").toStdString());
	return parameters;
}

void HostProgress::log(const std::string& line)
{
	m_log(line);
	if (listener != nullptr)
		listener(-1, line.c_str());
}

void HostProgress::warn(const std::vector<std::string>& sentences) const
{
	for (std::size_t i = 1; listener != nullptr && i < sentences.size(); ++i)
		listener(-2, sentences[i].c_str());
}

bool HostProgress::update(double fraction, const std::string& what)
{
	const int percent = static_cast<int>(100.0 * std::clamp(fraction, 0.0, 1.0));
	if (m_callback != nullptr && !m_callback(percent, host::progressText(what).c_str()))
		return false;
	if (listener == nullptr || Clock::now() < m_nextTold)
		return true;
	const bool goesOn = listener(percent, what.c_str());
	m_nextTold = Clock::now() + kListenerPause;
	return goesOn;
}

} // namespace filter_ricci
