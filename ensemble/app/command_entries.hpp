// SPDX-License-Identifier: Apache-2.0
/// The command table as plain data: what the manual page and the completion are written from.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace sturz::app {

struct OptionEntry {
  std::vector<std::string> names;    ///< "-o", "--out"; empty for an argument without a dash
  std::string positional;            ///< name of an argument without a dash, else empty
  std::string value;                 ///< what it takes: "FILE", "DIR", "INT"; empty for a flag
  std::string limits;                ///< what the parser accepts, in its words; may be empty
  std::vector<std::string> choices;  ///< the only words accepted, where there is such a list
  std::string help;
  bool required = false;
};

struct CommandEntry {
  std::string name, help;
  std::vector<OptionEntry> options;  ///< arguments without a dash first
};

struct CommandTable {
  std::string name, help, footer;
  std::vector<OptionEntry> options;  ///< of the program itself
  std::vector<CommandEntry> commands;
};

/// Everything that `--help` shows, in its order; hidden sub-commands stay hidden.
CommandTable command_table(const CLI::App&);

/// The words with `between` between them.
std::string joined(const std::vector<std::string>& words, const std::string& between);

}  // namespace sturz::app
