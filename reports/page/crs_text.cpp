// SPDX-License-Identifier: Apache-2.0
#include "reports/page/crs_text.hpp"

#include "reports/texts/text_table.hpp"

#include <cstddef>

namespace sturz {
namespace {

/// "EPSG:32633" where the whole system, not only a part of it, has a code: the last thing in
/// its WKT.
std::string epsg_code(const std::string& wkt) {
  const std::size_t at = wkt.rfind("\"EPSG\",");
  if (at == std::string::npos) return {};
  const std::size_t from = wkt.find_first_of("0123456789", at);
  const std::size_t to = wkt.find_first_not_of("0123456789", from);
  if (from == std::string::npos || to == std::string::npos) return {};
  std::size_t closed = 0;
  for (std::size_t i = to; i < wkt.size(); ++i) closed += wkt[i] == ']';
  return closed == 2 ? "EPSG:" + wkt.substr(from, to - from) : "";
}

/// The first quoted text.
std::string own_name(const std::string& wkt) {
  const std::size_t open = wkt.find('"');
  if (open == std::string::npos) return tr("map.local");
  return wkt.substr(open + 1, wkt.find('"', open + 1) - open - 1);
}

}  // namespace

std::string crs_name(const std::string& wkt) {
  const std::string code = epsg_code(wkt);
  return code.empty() ? own_name(wkt) : own_name(wkt) + " (" + code + ")";
}

std::string system_text(const std::string& wkt) {
  const std::string code = epsg_code(wkt);
  return code.empty() ? own_name(wkt) : code;
}

}  // namespace sturz
