// SPDX-License-Identifier: Apache-2.0
/// Lines and tables that fit the terminal.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sturz::app {

/// Columns of the terminal behind a stream.
/// \return 0 where there is no terminal: nothing is to be folded then
int columns_of(int stream);
/// The same for help, which the variable COLUMNS folds in a pipe, too.
int help_columns(int stream);

/// The line folded at blanks, its rest under where its last wide gap ended ("name    text") or two
/// blanks further in. Words wider than the terminal (paths) stay whole.
/// \param columns  0: as it is
/// \param hang  where its rest begins instead
std::string folded(std::string_view line, int columns, std::optional<int> hang = {});

/// Rows of cells as aligned lines; the first row is the head. What does not fit beside comes
/// below, in a table of its own with the same first column.
/// \param columns  0: no limit
std::vector<std::string> fitted_table(const std::vector<std::vector<std::string>>& rows,
                                      int columns);

}  // namespace sturz::app
