// SPDX-License-Identifier: GPL-3.0-or-later
#include "ricci_c.h"

#include "filter_text.h"
#include "run.h"

#include "bridge.h"

#include <ricci/numerics/sparse_cholesky.h>

#include <new>
#include <stdexcept>
#include <string>
#include <utility>

using filter_ricci::LibraryRun;
using filter_ricci::Misuse;

/// What the caller holds.
struct ricci_run : LibraryRun
{
	using LibraryRun::LibraryRun;

	std::string sentence;
	const char* message = ""; ///< into the sentence, unless there was no memory for one
};

namespace {

/// \p code for the exception being handled, and its sentence.
int32_t failed(ricci_run& run, int32_t code) noexcept
{
	try {
		run.sentence = filter_ricci::failure(run.filter());
		run.message = run.sentence.c_str();
	}
	catch (...) {
		run.message = "There is not enough memory for this mesh. The mesh is unchanged.";
	}
	return code;
}

/// What \p action(the run) comes to. No exception leaves it.
template<class Action>
int32_t guarded(ricci_run* run, Action action) noexcept
{
	if (run == nullptr)
		return RICCI_MISUSE;
	run->message = "";
	try {
		action(*run);
		return RICCI_OK;
	}
	catch (const Misuse&) {
		return failed(*run, RICCI_MISUSE);
	}
	catch (const filter_ricci::Refusal&) {
		return failed(*run, RICCI_REFUSED);
	}
	catch (const ricci::Cancelled&) {
		return failed(*run, RICCI_CANCELLED);
	}
	catch (const ricci::TimeOut&) {
		return failed(*run, RICCI_TIMED_OUT);
	}
	catch (const ricci::InternalError&) {
		return failed(*run, RICCI_FAILED);
	}
	catch (const ricci::Error&) {
		return failed(*run, RICCI_REFUSED);
	}
	catch (const std::bad_alloc&) {
		return failed(*run, RICCI_NO_MEMORY);
	}
	catch (...) {
		return failed(*run, RICCI_FAILED);
	}
}

const char* text(const char* given)
{
	return given == nullptr ? throw Misuse("A text is null: give one, or \"\".") : given;
}

} // namespace

int32_t ricci_c_version(void)
{
	return RICCI_C_VERSION;
}

const char* ricci_library_version(void)
{
	return RICCI_LIBRARY_VERSION;
}

const char* ricci_solver(void)
{
	return ricci::SparseCholesky::name();
}

const char* ricci_description(void)
{
	try {
		static const std::string descriptions = filter_ricci::filterDescriptions();
		return descriptions.c_str();
	}
	catch (...) {
		return nullptr;
	}
}

ricci_run* ricci_create(int32_t filter)
{
	if (filter != RICCI_EUCLIDEAN && filter != RICCI_HYPERBOLIC)
		return nullptr;
	try {
		return new ricci_run(
			filter == RICCI_EUCLIDEAN ? filter_ricci::Euclidean : filter_ricci::Hyperbolic);
	}
	catch (...) {
		return nullptr;
	}
}

void ricci_free(ricci_run* run)
{
	delete run;
}

int32_t ricci_set_parameter(ricci_run* run, const char* name, const char* value)
{
	return guarded(run, [&](LibraryRun& r) { r.setParameter(text(name), text(value)); });
}

int32_t ricci_set_array(ricci_run* run, const char* name, const ricci_array* array)
{
	return guarded(run, [&](LibraryRun& r) { r.setArray(text(name), array); });
}

int32_t ricci_set_text(ricci_run* run, const char* name, const char* value)
{
	return guarded(run, [&](LibraryRun& r) { r.setText(text(name), text(value)); });
}

int32_t ricci_add_picture(ricci_run* run, const char* name, const ricci_array* picture)
{
	return guarded(run, [&](LibraryRun& r) { r.addPicture(text(name), picture); });
}

int32_t ricci_set_listener(ricci_run* run, ricci_listener listener, void* context)
{
	return guarded(run, [&](LibraryRun& r) { r.setListener(listener, context); });
}

int32_t ricci_execute(ricci_run* run)
{
	return guarded(run, [](LibraryRun& r) { r.execute(); });
}

const char* ricci_message(const ricci_run* run)
{
	return run == nullptr ? "There is no run." : run->message;
}

int64_t ricci_output_count(const ricci_run* run)
{
	return run == nullptr ? 0 : static_cast<int64_t>(run->outputs().size());
}

const char* ricci_output_name(const ricci_run* run, int64_t number)
{
	if (number < 0 || number >= ricci_output_count(run))
		return nullptr;
	return run->outputs()[static_cast<std::size_t>(number)].name.c_str();
}

int32_t ricci_output(const ricci_run* run, const char* name, ricci_array* output)
{
	if (run == nullptr || name == nullptr || output == nullptr)
		return RICCI_MISUSE;
	for (const LibraryRun::Array& array : run->outputs())
		if (array.name == name) {
			*output = array.shape;
			output->data = array.bytes.data();
			return RICCI_OK;
		}
	return RICCI_MISUSE;
}
