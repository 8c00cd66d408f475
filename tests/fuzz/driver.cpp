// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the fuzz target without libFuzzer: on files, and on inputs from a generator of its own,
// which are the same on every run. Does not watch coverage.
//
//     ricci_fuzz [--runs N] [--seed K] [--go-on] [--patience S] [FILE|FOLDER...]
//
// Ends at the first defect, with 1 and the input in the file "defect-input" (with --go-on, at the
// end, and the n-th input in "defect-input-n"); a crash or a hang leaves its input there as well.
#include "facade_check.h"
#include "support/random.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <vector>

#include <fcntl.h>
#include <sys/time.h>
#include <unistd.h>

namespace {

using Input = std::vector<std::uint8_t>;

constexpr const char* kDefectFile = "defect-input";

/// Seconds of CPU time after which an execution counts as hanging, except for --patience; sanitizers take
/// their time.
#if defined(__SANITIZE_ADDRESS__)
int patience = 300;
#else
int patience = 60;
#endif

constexpr int kMaxInputSize = 96;

/// Executions from one line of counts to the next.
constexpr long kBetweenReports = 100000;

const Input* running = nullptr;

void saveInput(const char* name = kDefectFile)
{
	const int file = open(name, O_CREAT | O_WRONLY | O_TRUNC, 0644);
	if (file < 0 || running == nullptr)
		return;
	[[maybe_unused]] const auto written = write(file, running->data(), running->size());
	close(file);
}

void onSignal(int number)
{
	saveInput();
	signal(number, SIG_DFL);
	raise(number);
}

void setPatience(int seconds)
{
	itimerval timer{};
	timer.it_value.tv_sec = seconds;
	setitimer(ITIMER_VIRTUAL, &timer, nullptr);
}

class Session
{
public:
	void goOn() { m_goOn = true; }
	int defects() const { return m_defects; }

	/// False at a defect.
	bool execute(const Input& input)
	{
		running = &input;
		setPatience(patience);
		const ricci::testing::Execution e = ricci::testing::runFacade(input.data(), input.size());
		setPatience(0);
		++m_count[e.verdict];
		if (e.defect.empty())
			return true;
		const std::string name =
			kDefectFile + (m_goOn ? "-" + std::to_string(++m_defects) : std::string());
		saveInput(name.c_str());
		std::printf("DEFECT: %s (input in %s)\n", e.defect.c_str(), name.c_str());
		std::fflush(stdout);
		return m_goOn;
	}

	long executions() const
	{
		long sum = 0;
		for (const auto& [verdict, n] : m_count)
			sum += n;
		return sum;
	}

	void print()
	{
		using ricci::testing::Verdict;
		std::printf(
			"%ld executions: %ld mapped, %ld refused, %ld cancelled\n",
			executions(),
			m_count[Verdict::Mapped],
			m_count[Verdict::Refused],
			m_count[Verdict::Cancelled]);
	}

private:
	bool m_goOn = false;
	int m_defects = 0;
	std::map<ricci::testing::Verdict, long> m_count;
};

Input readFile(const std::filesystem::path& path)
{
	std::ifstream file(path, std::ios::binary);
	return Input(std::istreambuf_iterator<char>(file), {});
}

/// Random bytes, or an input of the corpus with a few changes.
Input generate(const std::vector<Input>& corpus, ricci::testing::Random& random)
{
	Input input;
	if (corpus.empty() || random.coin()) {
		input.resize(static_cast<std::size_t>(random.index(kMaxInputSize)));
		for (std::uint8_t& x : input)
			x = static_cast<std::uint8_t>(random.index(256));
		return input;
	}
	input = corpus[static_cast<std::size_t>(random.index(static_cast<int>(corpus.size())))];
	for (int i = random.index(8); i >= 0; --i)
		if (input.empty() || random.index(8) == 0)
			input.push_back(static_cast<std::uint8_t>(random.index(256)));
		else
			input[static_cast<std::size_t>(random.index(static_cast<int>(input.size())))] =
				static_cast<std::uint8_t>(random.index(256));
	return input;
}

} // namespace

int main(int argc, char** argv)
{
	Session session;
	long runs = 0;
	std::uint64_t seed = 1;
	std::vector<std::filesystem::path> files;
	for (int i = 1; i < argc; ++i) {
		const std::string argument = argv[i];
		const auto value = [&] { return i + 1 < argc ? std::atol(argv[++i]) : 0; };
		if (argument == "--runs")
			runs = value();
		else if (argument == "--patience")
			patience = static_cast<int>(value());
		else if (argument == "--seed")
			seed = static_cast<std::uint64_t>(value());
		else if (argument == "--go-on")
			session.goOn();
		else if (std::filesystem::is_directory(argument))
			for (const auto& entry : std::filesystem::directory_iterator(argument))
				files.push_back(entry.path());
		else
			files.push_back(argument);
	}
	for (int number : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGILL, SIGVTALRM})
		signal(number, onSignal);

	std::vector<Input> corpus;
	std::sort(files.begin(), files.end());
	for (const auto& file : files) {
		corpus.push_back(readFile(file));
		if (!session.execute(corpus.back())) {
			std::printf("in %s\n", file.c_str());
			return 1;
		}
	}
	ricci::testing::Random random(seed);
	for (long i = 0; i < runs; ++i) {
		if (!session.execute(generate(corpus, random)))
			return 1;
		if (session.executions() % kBetweenReports == 0) {
			session.print();
			std::fflush(stdout);
		}
	}
	session.print();
	return session.defects() > 0;
}
