// SPDX-License-Identifier: Apache-2.0
/// Ratios of earlier runs, a JSON line each, and how they moved.
#pragma once

#include "tests/bench/measure/table.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace sturz::bench {

/// One line for a history file: when, where, which code, and the report's figures.
/// \param all  what `--json` writes: command, quick, machine, load
std::string history_line(const Report&, const nlohmann::ordered_json& all);

/// Appends a line; a file that is not there is begun.
/// \return whether it could be written
bool append_history(const std::string& file, const std::string& line);

/// A row per machine, command and figure: how often, first, before, last, and whether it moved by
/// more than the intervals of both. A machine is its processor, cores and instruction set.
/// \param text  of a history file
/// Lines that are no record, and figures that are no number, are left out and named in one note.
/// \raises SetupError when no record is left
Report history_report(const std::string& text);

}  // namespace sturz::bench
