// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/help/hint.hpp"

#include "scenarios/schema/schema.hpp"
#include "scenarios/schema/suggest.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>

namespace sturz::app {
namespace {

std::vector<std::string> commands_of(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({}))
    if (!command->get_group().empty()) names.push_back(command->get_name());
  return names;
}

/// "--workers", "-n" ... of a command.
std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options({})) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

/// The key whose last part fits: numerics.spacing_m for "spacing-m".
template <class Fits>
std::string key_where(Fits fits) {
  for (const KeyInfo& key : schema())
    if (fits(key.path.substr(key.path.rfind('.') + 1))) return key.path;
  return {};
}

std::string as_key(std::string word) {
  std::replace(word.begin(), word.end(), '-', '_');
  return word;
}

std::string hint_on_option(const CLI::App& command, const std::string& word,
                           const std::string& next) {
  const std::size_t equals = word.find('=');
  const std::string name = word.substr(0, equals);
  const std::string wanted = as_key(name.substr(name.find_first_not_of('-')));
  std::string key = key_where([&](const std::string& last) { return last == wanted; });
  if (key.empty()) {
    const std::string near = nearest_name(name, options_of(command));
    if (!near.empty()) return fmt::format("Did you mean {}?", near);
    if (wanted.size() > 2)
      key = key_where([&](const std::string& last) { return last.starts_with(wanted); });
  }
  if (key.empty()) return {};
  const std::string value = equals != std::string::npos      ? word.substr(equals + 1)
                            : next.empty() || next[0] == '-' ? "VALUE"
                                                             : next;
  return fmt::format("{} is a value of the scenario: --set {}={}", name, key, value);
}

}  // namespace

const CLI::App* command_named(const CLI::App& program, const std::string& name) {
  for (const CLI::App* command : program.get_subcommands({}))
    if (command->get_name() == name) return command;
  return nullptr;
}

std::string hint_on_words(const CLI::App& program, const std::vector<std::string>& words) {
  if (words.empty() || words[0].empty()) return {};
  const CLI::App* command = command_named(program, words[0]);
  if (command == nullptr) {
    if (words[0][0] == '-') return {};
    const std::string near = nearest_name(words[0], commands_of(program));
    return fmt::format("There is no command '{}'. {}", words[0],
                       near.empty()
                           ? fmt::format("Commands: {}.", comma_separated(commands_of(program)))
                           : fmt::format("Did you mean {}?", near));
  }
  const std::vector<std::string> known = options_of(*command);
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::string name = words[i].substr(0, words[i].find('='));
    if (name.size() < 2 || name[0] != '-' || name.find_first_not_of('-') == std::string::npos)
      continue;
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    if (name[1] != '-' && std::isdigit(static_cast<unsigned char>(name[1]))) continue;
    std::string hint = hint_on_option(*command, words[i], i + 1 < words.size() ? words[i + 1] : "");
    if (!hint.empty()) return hint;
  }
  return {};
}

}  // namespace sturz::app
