// SPDX-License-Identifier: GPL-3.0-or-later
#include "output_file.h"

#include "error_sentences.h"
#include "parameters.h"

#include <cerrno>
#include <system_error>
#include <utility>

namespace filter_ricci {

namespace {

namespace fs = std::filesystem;

std::FILE* opened(const fs::path& path, const char* mode)
{
#ifdef _WIN32
	const std::wstring wide(mode, mode + std::char_traits<char>::length(mode));
	return _wfopen(path.c_str(), wide.c_str());
#else
	return std::fopen(path.c_str(), mode);
#endif
}

/// Of the last call of the C library.
std::string lastReason()
{
	return errno == 0 ? kDiskFull : std::generic_category().message(errno);
}

} // namespace

fs::path absolutePath(const std::string& wanted, const std::string& folder)
{
	std::error_code isGone; // then only absolute paths lead anywhere
	return (fs::current_path(isGone) / fs::u8path(folder) / fs::u8path(wanted)).lexically_normal();
}

std::string endingOf(const fs::path& path)
{
	const std::string name = path.filename().u8string();
	const std::size_t point = name.rfind('.');
	return point == std::string::npos ? std::string() : lower(name.substr(point + 1));
}

bool OutputFile::Open::close()
{
	errno = 0;
	return std::fclose(std::exchange(stream, nullptr)) == 0;
}

OutputFile::Open::~Open()
{
	std::error_code ignored;
	if (stream != nullptr)
		close();
	if (!path.empty())
		fs::remove(path, ignored);
}

OutputFile::OutputFile(const fs::path& path, const char* what) : m_path(path), m_what(what)
{
	std::error_code ignored;
	if (fs::is_symlink(path, ignored)) {
		const fs::path target = fs::weakly_canonical(path, ignored);
		if (!target.empty())
			m_path = target;
	}
	const std::string reason = whyNotWritable();
	if (!reason.empty())
		throw Refusal(
			m_what + (" " + name()) + " cannot be written (" + reason +
			"): choose another place for it.");
}

void OutputFile::refuse(const std::string& reason) const
{
	throw Refusal(
		m_what + (" " + name()) + " could not be written (" + reason +
		"): choose another place for it. The mesh is unchanged.");
}

std::string OutputFile::whyNotWritable()
{
	std::error_code ignored;
	const fs::file_status status = fs::status(m_path, ignored);
	if (fs::is_directory(status))
		return "it is a folder";
	if (fs::exists(status) && !fs::is_regular_file(status))
		return "it is not a file";
	errno = 0;
	if (fs::exists(status)) { // a folder may let files be replaced that may not be written
		std::FILE* const present = opened(m_path, "ab");
		if (present == nullptr)
			return lastReason();
		std::fclose(present);
	}
	const std::string reason = open();
	m_open.reset();
	return reason;
}

std::string OutputFile::open()
{
	auto file = std::make_unique<Open>();
	for (int i = 0; file->stream == nullptr; ++i) { // others may write to the same place
		fs::path path = m_path;
		path += "." + std::to_string(i) + ".part";
		errno = 0;
		file->stream = opened(path, "wbx");
		if (file->stream != nullptr)
			file->path = path;
		else if (errno != EEXIST)
			return lastReason();
	}
	std::setvbuf(file->stream, nullptr, _IONBF, 0); // a full disk is seen at once
	m_open = std::move(file);
	return {};
}

void OutputFile::write(std::string_view bytes)
{
	if (!m_open)
		if (const std::string reason = open(); !reason.empty())
			refuse(reason);
	errno = 0;
	if (std::fwrite(bytes.data(), 1, bytes.size(), m_open->stream) != bytes.size())
		refuse(lastReason());
}

void OutputFile::publish()
{
	if (!m_open)
		return;
	if (!m_open->close())
		refuse(lastReason());
	std::error_code problem, ignored;
	const fs::file_status present = fs::status(m_path, ignored);
	if (fs::exists(present))
		fs::permissions(m_open->path, present.permissions(), ignored);
	fs::rename(m_open->path, m_path, problem);
	if (problem)
		refuse(problem.message());
	m_open->path.clear();
}

} // namespace filter_ricci
