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
	return errno == 0 ? "is the disk full?" : std::generic_category().message(errno);
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

OutputFile::OutputFile(const fs::path& path) : m_path(path)
{
	std::error_code ignored;
	if (fs::is_symlink(path, ignored)) {
		const fs::path target = fs::weakly_canonical(path, ignored);
		if (!target.empty())
			m_path = target;
	}
}

void OutputFile::requireWritable(const char* what)
{
	const std::string reason = whyNotWritable();
	if (!reason.empty())
		throw Refusal(
			what + (" " + name()) + " cannot be written (" + reason +
			"): choose another place for it.");
}

void OutputFile::require(bool isDone, const char* what) const
{
	if (!isDone)
		throw Refusal(
			what + (" " + name()) + " could not be written (" +
			(m_reason.empty() ? "is the disk full?" : m_reason) +
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
	const bool works = open();
	m_open.reset();
	return works ? std::string() : m_reason;
}

bool OutputFile::fail()
{
	m_reason = lastReason();
	return false;
}

bool OutputFile::open()
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
			return fail();
	}
	std::setvbuf(file->stream, nullptr, _IONBF, 0); // a full disk is seen at once
	m_open = std::move(file);
	return true;
}

bool OutputFile::write(const char* data, std::size_t size)
{
	if (!m_open && !open())
		return false;
	errno = 0;
	return std::fwrite(data, 1, size, m_open->stream) == size || fail();
}

bool OutputFile::publish()
{
	if (!m_open)
		return true;
	if (!m_open->close())
		return fail();
	std::error_code problem, ignored;
	const fs::file_status present = fs::status(m_path, ignored);
	if (fs::exists(present))
		fs::permissions(m_open->path, present.permissions(), ignored);
	fs::rename(m_open->path, m_path, problem);
	if (problem) {
		m_reason = problem.message();
		return false;
	}
	m_open->path.clear();
	return true;
}

} // namespace filter_ricci
