// SPDX-License-Identifier: Apache-2.0
#include "reports/page/page_head.hpp"

#include "reports/figures/codec.hpp"
#include "reports/page/bundle.hpp"
#include "reports/page/text.hpp"
#include "reports/texts/text_table.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <vector>

namespace sturz {

std::string policy_hash(std::string_view hex) {
  std::vector<std::uint8_t> bytes(hex.size() / 2);
  for (std::size_t i = 0; i < bytes.size(); ++i)
    std::from_chars(hex.data() + 2 * i, hex.data() + 2 * i + 2, bytes[i], 16);
  return "'sha256-" + base64(bytes) + "'";
}

std::string page_head(const std::string& title, const std::string& script) {
  return fmt::format(
             "<!doctype html>\n<html lang=\"{}\">\n<head>\n<meta charset=\"utf-8\">\n"
             "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
             "script-src {}; style-src {}; img-src data: blob:\">\n"
             "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
             "<meta name=\"color-scheme\" content=\"light dark\">\n"
             "<meta name=\"generator\" content=\"sturz\">\n<title>{}</title>\n<style>",
             page_language(), script, policy_hash(bundled_style_sha256()), html_escape(title)) +
         std::string(bundled_style()) + "</style>\n</head>\n";
}

}  // namespace sturz
