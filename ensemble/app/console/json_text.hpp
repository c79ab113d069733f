// SPDX-License-Identifier: Apache-2.0
/// Results for machines as one line of JSON.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace sturz::app {

/// One line. Names of files are bytes and JSON is UTF-8: what is not is replaced.
template <class Json>
std::string json_text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace sturz::app
