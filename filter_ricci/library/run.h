// SPDX-License-Identifier: GPL-3.0-or-later
// What stands behind a ricci_run.
#ifndef FILTER_RICCI_RUN_H
#define FILTER_RICCI_RUN_H

#include "error_sentences.h"
#include "host.h"
#include "parameters.h"
#include "ricci_c.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace filter_ricci {

/// A call that ricci_c.h does not allow.
class Misuse : public Refusal
{
	using Refusal::Refusal;
};

/// Inputs of a filter, and after execute() its outputs. The functions throw Misuse where ricci_c.h says RICCI_MISUSE,
/// and std::bad_alloc.
class LibraryRun
{
public:
	explicit LibraryRun(int filter) : m_filter(filter), m_parameters(filterParameters(filter)) {}

	int filter() const { return m_filter; }

	void setParameter(const std::string& name, const std::string& value);
	/// \param array null: none any more
	void setArray(const std::string& name, const ricci_array* array);
	void setText(const std::string& name, const std::string& text);
	/// \param picture null: one that could not be loaded
	void addPicture(const std::string& name, const ricci_array* picture);
	void setListener(ricci_listener listener, void* context);

	/// \throw what applyFilter() does
	void execute();

	/// An array and its entries; with a name, where it is an output.
	struct Array
	{
		std::string name;
		ricci_array shape = {};
		std::vector<unsigned char> bytes;

		double operator[](std::size_t i) const; ///< any entry, as a number
	};

	/// In their order.
	const std::vector<Array>& outputs() const { return m_outputs; }

private:
	const Array* input(const char* name) const;
	void checkLengths() const;
	void fill(MeshDocument& document) const;

	static int32_t nobody(void*, double, const char*) { return 1; }

	int m_filter;
	Parameters m_parameters;
	std::map<std::string, Array> m_inputs;
	std::vector<std::string> m_pictureNames;
	std::vector<host::Picture> m_pictures; // [picture]
	std::string m_name, m_folder;
	ricci_listener m_listener = nobody;
	void* m_context = nullptr;
	std::vector<Array> m_outputs;
};

} // namespace filter_ricci

#endif
