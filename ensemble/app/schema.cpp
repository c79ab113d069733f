// SPDX-License-Identifier: Apache-2.0
// sturz schema: the JSON Schema of scenario files, from the table that also validates them.
#include "ensemble/app/commands.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "io/files/text_files.hpp"
#include "io/scenario/json_schema.hpp"

#include <fmt/core.h>

namespace sturz::app {

int schema_command(const SchemaOptions& options, Console& console) {
  const std::string text = json_schema();
  if (options.out.empty())
    console.say(text);
  else
    write_text_atomic(options.out, text + "\n");
  return ok;
}

}  // namespace sturz::app
