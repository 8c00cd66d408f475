// SPDX-License-Identifier: GPL-3.0-or-later
// What the user reads of a failure. The algorithm throws its errors as data; here they become
// sentences that name the filters of MeshLab and the parameters of the plugin. A parameter stands there by its
// id in braces: bridge.cpp puts the name that the user knows in its place.
#ifndef FILTER_RICCI_ERROR_SENTENCES_H
#define FILTER_RICCI_ERROR_SENTENCES_H

#include <ricci/error.h>

#include <stdexcept>
#include <string>

namespace filter_ricci {

/// A run that the plugin itself refuses. what() is one or more full sentences for the user.
class Refusal : public std::runtime_error
{
	using std::runtime_error::runtime_error;
};

/// One or more full sentences: the problem, how many or which elements, and what to do about it. Of
/// several components the one that failed is named first. UTF-8, never with a decimal comma.
std::string sentence(const ricci::Error& error);

/// Of a value that a parameter cannot have, and what to use: a noun.
std::string unusable(const std::string& value, const char* parameter, const std::string& use);

/// The exception being handled as a sentence for the user. Call it inside a catch block only.
std::string currentErrorSentence();

} // namespace filter_ricci

#endif
