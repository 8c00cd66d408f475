// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_RICCI_OUTPUT_FILE_H
#define FILTER_RICCI_OUTPUT_FILE_H

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace filter_ricci {

/// The place that \p wanted names; a relative one starts from \p folder, or where this is empty from the folder of the
/// process. Both are in UTF-8.
std::filesystem::path absolutePath(const std::string& wanted, const std::string& folder);

/// What stands behind the last point of a file's name, in lower case; empty if there is none.
std::string endingOf(const std::filesystem::path& path);

/// The reason where the system gives none.
constexpr const char* kDiskFull = "is the disk full?";

/// A file that is written beside its place and moved there at the end. Unless that is done nothing is left behind.
class OutputFile
{
public:
	/// None.
	OutputFile() = default;
	/// Files are as they were.
	/// \param path absolute; where it is a link, the file is written to which that leads
	/// \param what it is, such as "The report"
	/// \throw Refusal if it cannot be written
	OutputFile(const std::filesystem::path& path, const char* what);

	/// Whether there is a file to be written.
	bool isWanted() const { return !m_path.empty(); }

	/// Its place, in UTF-8.
	std::string name() const { return m_path.u8string(); }

	/// Appends bytes to the file beside its place. \throw Refusal
	void write(std::string_view bytes);

	/// Moves the file to its place, if it was written. \throw Refusal
	void publish();

	/// What is said where it could not be written. \throw Refusal
	[[noreturn]] void refuse(const std::string& reason) const;

private:
	/// Opened, and removed again unless it has been moved.
	struct Open
	{
		std::FILE* stream = nullptr;
		std::filesystem::path path;
		bool close();
		~Open();
	};

	std::string whyNotWritable();
	std::string open(); // why it cannot be

	std::filesystem::path m_path;
	const char* m_what = "";
	std::unique_ptr<Open> m_open;
};

} // namespace filter_ricci

#endif
