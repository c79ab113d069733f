// SPDX-License-Identifier: Apache-2.0
/// Turns finished results into one self-contained page.
///
/// The page needs no network and no other file. It carries its own policy in a meta element:
///   default-src 'none'; script-src 'sha256-..'; style-src 'sha256-..'; img-src data: blob:
/// A server that sends a policy of its own must allow the same (or 'unsafe-inline' for script and
/// style). Maps and charts need a browser from 2023 on (DecompressionStream); older ones, pages
/// printed, and builds without the script bundle show still figures instead.
#pragma once

#include "ensemble/sampling/design.hpp"
#include "reports/page/report_input.hpp"

#include <span>
#include <string>

namespace sturz {

/// The design's values of the finished members, one row each, for ReportInput::samples.
/// \throws SetupError naming the member that is not in the design
ReportTable sampled_values(const DesignTable& design, std::span<const MemberSummary> members);

/// The whole page as UTF-8 text. Never fails on strange results (no valid member, empty maps):
/// it says what is missing.
/// \throws std::logic_error if `samples` has rows that do not match `members`
std::string make_report(const ReportInput& input);

/// False when the library was built without the script bundle (still figures only).
bool report_has_script();

}  // namespace sturz
