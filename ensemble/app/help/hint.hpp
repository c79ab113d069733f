// SPDX-License-Identifier: Apache-2.0
/// What was meant by words that the command line does not know.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace sturz::app {

/// The command of that name, or nullptr.
const CLI::App* command_named(const CLI::App& program, const std::string& name);

/// One sentence on the first word that is no command, or no option of its command: the nearest one,
/// or the scenario key that it names, set with --set. Empty when there is nothing to say.
/// \param words  the command line without the program's name
std::string hint_on_words(const CLI::App& program, const std::vector<std::string>& words);

}  // namespace sturz::app
