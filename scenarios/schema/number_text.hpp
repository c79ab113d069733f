// SPDX-License-Identifier: Apache-2.0
/// Numbers as text and back, the same in every locale and without loss.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sturz {

/// Shortest decimal text that reads back to the same double: "0.24", "491000", "1.5e-30".
/// Not finite: "nan", "inf", "-inf".
std::string number_text(double value);
/// Three significant digits, enough for a warning.
std::string short_number(double value);

/// The whole of `text` as a finite decimal number. Nothing else is accepted: no surrounding blanks,
/// no leading plus, no hexadecimal, no nan or inf, no unit, no decimal comma, no overflow.
std::optional<double> parse_number(std::string_view text);

/// The whole of `text` as a decimal integer, under the same rules.
std::optional<long long> parse_integer(std::string_view text);

}  // namespace sturz
