// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/bash_completion.hpp"

#include <fmt/core.h>

namespace sturz::app {
namespace {

// The parts that no table changes. `kind` says what the word under the cursor may be: one or more
// of the value names of the table (SCENARIO, FILE, DIR, CASE), or nothing.
constexpr const char* head =
    R"bash(# Completion of sturz for bash, written from the program's command table; do not edit.

# Names of the shipped cases: asked of the program that is being typed, so they fit its version.
_sturz_cases() {
  "${COMP_WORDS[0]}" cases 2>/dev/null | sed -n 's/^  \([^ ]*\).*/\1/p'
}

_sturz_fill() {  # KIND WORDS CURRENT
  local kind=$1 words=$2 current=$3
  mapfile -t COMPREPLY < <(
    [ -n "$words" ] && compgen -W "$words" -- "$current"
    case $kind in
      *SCENARIO*)
        compgen -d -- "$current"
        compgen -f -X '!*.yaml' -- "$current"
        compgen -f -X '!*.yml' -- "$current"
        ;;
      *FILE*) compgen -f -- "$current" ;;
      *DIR*) compgen -d -- "$current" ;;
      *CASE*) compgen -W "$(_sturz_cases)" -- "$current" ;;
    esac
  )
  # Directories get a slash, blanks in names a backslash; outside of a completion this says no.
  case $kind in
    *SCENARIO* | *FILE* | *DIR*) compopt -o filenames 2>/dev/null ;;
  esac
}

_sturz() {
  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
  local command='' kind='' words='' options='' i
  # bash takes --out=x apart into three words
  if [ "$current" = = ]; then
    current=''
  elif [ "$before" = = ]; then
    before=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  for ((i = 1; i < COMP_CWORD; i++)); do
    case ${COMP_WORDS[i]} in
      -*) ;;
      *) command=${COMP_WORDS[i]}; break ;;
    esac
  done
  case $command in
)bash";

constexpr const char* tail = R"bash(    *) COMPREPLY=(); return ;;
  esac
  case $current in
    -*) _sturz_fill '' "$options" "$current" ;;
    *) _sturz_fill "$kind" "$words" "$current" ;;
  esac
}
complete -F _sturz sturz)bash";

std::string assignments(const OptionEntry& option, const std::vector<std::string>& shapes) {
  std::vector<std::string> words = option.choices;
  if (option.value.find("SHAPE") != std::string::npos) words = shapes;
  return fmt::format("kind='{}' words='{}'", option.value, joined(words, " "));
}

std::string option_words(const std::vector<OptionEntry>& options) {
  std::vector<std::string> words;
  for (const OptionEntry& option : options)
    words.insert(words.end(), option.names.begin(), option.names.end());
  return joined(words, " ");
}

std::string command_case(const CommandEntry& command, const std::vector<std::string>& shapes) {
  std::string text = fmt::format("    {})\n      options='{}'\n      case $before in\n",
                                 command.name, option_words(command.options));
  std::string otherwise;
  for (const OptionEntry& option : command.options) {
    if (!option.positional.empty())
      otherwise = assignments(option, shapes);
    else if (!option.value.empty())
      text += fmt::format("        {}) {} ;;\n", joined(option.names, " | "),
                          assignments(option, shapes));
  }
  if (!otherwise.empty()) text += fmt::format("        *) {} ;;\n", otherwise);
  return text + "      esac\n      ;;\n";
}

}  // namespace

std::string bash_completion(const CommandTable& table, const std::vector<std::string>& shapes) {
  std::vector<std::string> names;
  for (const CommandEntry& command : table.commands) names.push_back(command.name);
  std::string text = head;
  text += fmt::format("    '')\n      options='{}' words='{}'\n      ;;\n",
                      option_words(table.options), joined(names, " "));
  for (const CommandEntry& command : table.commands) text += command_case(command, shapes);
  return text + tail;
}

}  // namespace sturz::app
