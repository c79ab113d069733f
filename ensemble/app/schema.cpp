// SPDX-License-Identifier: Apache-2.0
// sturz schema: the JSON Schema of scenario files, from the table that also validates them.
#include "ensemble/app/commands.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/grammar.hpp"
#include "io/files/text_files.hpp"
#include "io/scenario/json_schema.hpp"

#include <fmt/core.h>

namespace sturz::app {
namespace {

struct Options {
  std::string out;  ///< file; empty: stdout
};

int schema(const Options& options, Console& console) {
  const std::string text = json_schema();
  if (options.out.empty())
    console.say(text);
  else
    write_text_atomic(options.out, text + "\n");
  return ok;
}

}  // namespace

void add_schema(Grammar& grammar) {
  auto [parser, options] = add_command(
      grammar, "schema", "Print the JSON Schema of scenario files, for editors", schema);
  parser.add_option("-o,--out", options.out, "File instead of the screen")->type_name("FILE");
}

}  // namespace sturz::app
