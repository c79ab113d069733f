// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/help/man_page.hpp"

#include <fmt/core.h>

#include <regex>

namespace sturz::app {
namespace {

/// Text as troff reads it: real hyphens (so that options can be copied), and no line that begins
/// with a macro's dot or quote.
std::string plain(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n'))
      out += std::string("\\&") + c;
    else
      out += c;
  }
  return out;
}

std::string bold(const std::string& text) { return "\\fB" + plain(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + plain(text) + "\\fR"; }

std::string sentence(const std::string& text) {
  const bool ends = !text.empty() && (text.back() == '.' || text.back() == '?');
  return plain(text) + (ends ? "" : ".");
}

/// "FILE" for an argument called "scenario" would hide what it is: the name stands, the kind
/// follows.
std::string heading(const OptionEntry& option) {
  if (!option.positional.empty())
    return italic(option.positional) +
           (option.value.empty() ? "" : " (" + plain(option.value) + ")");
  std::string text;
  for (const std::string& name : option.names) text += (text.empty() ? "" : ", ") + bold(name);
  return option.value.empty() ? text : text + " " + italic(option.value);
}

/// CLI11's words for what a validator accepts, as a sentence of their own.
std::string limits_sentence(const OptionEntry& option) {
  if (!option.choices.empty()) return " One of: " + plain(joined(option.choices, ", ")) + ".";
  if (option.limits == "POSITIVE") return " Greater than zero.";
  static const std::regex range(R"(\w+ in \[(\S+) - (\S+)\])");
  if (std::smatch found; std::regex_match(option.limits, found, range))
    return plain(fmt::format(" From {} to {}.", found.str(1), found.str(2)));
  return option.limits.empty() ? "" : fmt::format(" Accepted: {}.", plain(option.limits));
}

std::string entry(const OptionEntry& option) {
  return fmt::format(".TP\n{}\n{}{}\n", heading(option), sentence(option.help),
                     limits_sentence(option));
}

std::string usage(const std::string& program, const CommandEntry& command) {
  std::string line = fmt::format(".B {} {}\n", plain(program), plain(command.name));
  for (const OptionEntry& option : command.options)
    if (!option.positional.empty())
      line += option.required ? fmt::format(".I {}\n", plain(option.positional))
                              : fmt::format(".RI [ {} ]\n", plain(option.positional));
  return line + ".RI [ options ]\n";
}

constexpr const char* files = R"(.SH FILES
.TP
.I scenario.yaml
One scene: ground, source, material, bed, numerics, ensemble, thresholds. The user guide lists all
keys; \fBsturz schema\fR prints them for editors.
.TP
.I out/NAME
Results, unless \fB\-o\fR says otherwise: look at \fIreport.html\fR first.
.TP
.I ../share/sturz/cases
Shipped cases, found from where the program itself lies.
.TP
.I $XDG_CACHE_HOME/sturz/speed.json
The measured speed of this machine, for forecasts.
)";

constexpr const char* examples = R"(.SH EXAMPLES
.nf
sturz cases                                 # what is shipped
sturz cases zhangjiawan                     # a copy in ./zhangjiawan
sturz describe zhangjiawan/scenario.yaml    # what will be computed, and how long it takes
sturz ensemble zhangjiawan/scenario.yaml \-n 64 \-o out/first
.fi
)";

}  // namespace

std::string man_page(const CommandTable& table, const std::string& version) {
  std::string text = fmt::format(
      ".\\\" Written from the program's command table; do not edit.\n"
      ".TH {} 1 \"\" \"{} {}\" \"User commands\"\n"
      // Ragged lines without hyphenation: nothing to copy is ever torn apart.
      ".ad l\n.nh\n",
      "STURZ", table.name, version);
  // "sturz: from a to b" -> the page's one-line summary
  const std::size_t colon = table.help.find(": ");
  const std::string summary =
      colon == std::string::npos ? table.help : table.help.substr(colon + 2);
  text += fmt::format(".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n", plain(table.name), plain(summary));
  for (const CommandEntry& command : table.commands)
    text += usage(table.name, command) + (&command == &table.commands.back() ? "" : ".br\n");
  text +=
      ".SH DESCRIPTION\nRuns many simulations of a landslide over a terrain, one for each draw of "
      "the uncertain\nparameters, and writes maps: how likely a place is reached, how thick, how "
      "fast, and when.\n.SH OPTIONS\n";
  for (const OptionEntry& option : table.options) text += entry(option);
  text += ".SH COMMANDS\n";
  for (const CommandEntry& command : table.commands) {
    text += fmt::format(".SS {} {}\n{}\n", plain(table.name), plain(command.name),
                        sentence(command.help));
    for (const OptionEntry& option : command.options) text += entry(option);
  }
  text += fmt::format(".SH EXIT STATUS\n{}\n", plain(table.footer));
  text += files;
  text += examples;
  return text +
         ".SH SEE ALSO\nThe user guide beside this page: share/doc/sturz/docs/user_guide.md.";
}

}  // namespace sturz::app
