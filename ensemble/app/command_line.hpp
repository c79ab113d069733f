// SPDX-License-Identifier: Apache-2.0
/// The grammar of the command line: words in, one sub-command with its options out.
#pragma once

namespace sturz::app {

/// Parses, runs the chosen sub-command and returns the process's exit code. Never throws.
int command_line(int argc, char** argv);

}  // namespace sturz::app
