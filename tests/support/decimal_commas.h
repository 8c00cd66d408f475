// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_DECIMAL_COMMAS_H
#define RICCI_TESTS_DECIMAL_COMMAS_H

#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace ricci::testing {

/// While it lives the process has some locale that writes decimal commas, if the machine has one or
/// the build has made one (in the folder RICCI_LOCALES).
class DecimalCommas
{
public:
	DecimalCommas() : m_own(std::setlocale(LC_NUMERIC, nullptr))
	{
#if defined(RICCI_LOCALES) && !defined(_WIN32) // Windows has its own
		setenv("LOCPATH", RICCI_LOCALES, 1);
#endif
		for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "it_IT.UTF-8", "German_Germany"})
			if (std::setlocale(LC_NUMERIC, name) != nullptr)
				break;
#if defined(RICCI_LOCALES) && !defined(_WIN32)
		unsetenv("LOCPATH");
#endif
		char text[8];
		std::snprintf(text, sizeof text, "%.1f", 0.5);
		m_found = std::string(text) == "0,5";
	}
	~DecimalCommas()
	{
		std::setlocale(LC_NUMERIC, m_own.c_str());
	}
	DecimalCommas(const DecimalCommas&) = delete;
	DecimalCommas& operator=(const DecimalCommas&) = delete;

	/// Whether there is such a locale.
	bool found() const
	{
		return m_found;
	}

private:
	std::string m_own;
	bool m_found = false;
};

} // namespace ricci::testing

#endif
