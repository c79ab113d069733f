// SPDX-License-Identifier: Apache-2.0
// sturz schema: the JSON Schema of scenario files and batch lists, from the tables that also
// validate them.
#include "ensemble/app/commands.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/grammar.hpp"
#include "io/batch/batch_schema.hpp"
#include "io/files/text_files.hpp"
#include "io/scenario/json_schema.hpp"

#include <fmt/core.h>

namespace sturz::app {
namespace {

struct Options {
  std::string out;     ///< file; empty: stdout
  bool batch = false;  ///< of batch lists
};

int schema(const Options& options, Console& console) {
  const std::string text = options.batch ? batch_schema() : json_schema();
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
  parser.add_flag("--batch", options.batch, "Of batch lists instead of scenario files");
  parser.add_option("-o,--out", options.out, "File instead of the screen")->type_name("FILE");
}

}  // namespace sturz::app
