// SPDX-License-Identifier: Apache-2.0
/// A report as a page for docs/studies.
#pragma once

#include "tests/bench/measure/table.hpp"

#include <string>

namespace sturz::bench {

/// Title, how the page is made, machine, notes, then one section for each table.
/// \param machine  of machine_facts()
std::string markdown_page(const Report&, const nlohmann::ordered_json& machine,
                          const std::string& command);

}  // namespace sturz::bench
