// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/command_entries.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <string_view>

namespace sturz::app {
namespace {

/// "{a,b}" -> a, b; empty for anything else.
std::vector<std::string> choices_of(std::string_view limits) {
  if (limits.size() < 2 || limits.front() != '{' || limits.back() != '}') return {};
  return CLI::detail::split(std::string(limits.substr(1, limits.size() - 2)), ',');
}

OptionEntry option_entry(const CLI::Option& option) {
  OptionEntry entry;
  for (const std::string& name : option.get_snames()) entry.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) entry.names.push_back("--" + name);
  if (option.get_positional()) entry.positional = option.get_name(true);
  if (option.get_expected_max() > 0) {
    // CLI11 keeps both in one text: "INT:INT in [1 - 8]", "TEXT:{a,b}".
    const std::string type = option.get_type_name();
    const std::size_t colon = std::min(type.find(':'), type.size());
    entry.value = type.substr(0, colon);
    entry.limits = type.substr(std::min(colon + 1, type.size()));
    entry.choices = choices_of(entry.limits);
  }
  entry.help = option.get_description();
  entry.required = option.get_required();
  return entry;
}

std::vector<OptionEntry> option_entries(const CLI::App& app) {
  std::vector<OptionEntry> entries;
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty()) entries.push_back(option_entry(*option));
  std::stable_partition(entries.begin(), entries.end(),
                        [](const OptionEntry& e) { return !e.positional.empty(); });
  return entries;
}

}  // namespace

CommandTable command_table(const CLI::App& app) {
  CommandTable table{
      app.get_name(), app.get_description(), app.get_footer(), option_entries(app), {}};
  const auto shown = [](const CLI::App* command) { return !command->get_group().empty(); };
  for (const CLI::App* command : app.get_subcommands(shown))
    table.commands.push_back(
        {command->get_name(), command->get_description(), option_entries(*command)});
  return table;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

}  // namespace sturz::app
