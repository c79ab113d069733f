// SPDX-License-Identifier: Apache-2.0
/// Words that people of the field bring along from other programs and from papers.
#pragma once

#include <string>

namespace sturz {

/// What to write in the place of an unknown key, or that there is nothing like it, as the end of a
/// message: "(unknown key). Use basal.turbulent_coefficient_m_s2 ...". Empty when the word is not
/// known.
/// \param path dotted path as the file has it, e.g. "basal.xi"
std::string advice_on_foreign_word(const std::string& path);

}  // namespace sturz
