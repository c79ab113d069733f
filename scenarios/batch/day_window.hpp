// SPDX-License-Identifier: Apache-2.0
/// A part of every day in which a shared machine may be used.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sturz {

/// Minutes since midnight by the machine's clock, 0..1439; [from, to), over midnight where to <
/// from.
struct DayWindow {
  int from_min = 0, to_min = 0;
  bool operator==(const DayWindow&) const = default;
};

/// "20:00-06:00"; nothing for any other text, and where both ends are the same.
std::optional<DayWindow> parse_day_window(std::string_view text);
/// "20:00-06:00".
std::string day_window_text(const DayWindow&);

/// \param minute of the day, 0..1439
bool is_open(const DayWindow&, int minute);
/// Minutes from `minute` until it opens; 0 while it is open.
int minutes_until_open(const DayWindow&, int minute);

}  // namespace sturz
