// SPDX-License-Identifier: Apache-2.0
/// The head of every page: its policy and style.
#pragma once

#include <string>
#include <string_view>

namespace sturz {

/// 'sha256-<base64>' as a Content-Security-Policy wants it, of hexadecimal digits.
std::string policy_hash(std::string_view hex);

/// From the doctype to the end of the head. \param title plain text
/// \param script what the policy says of scripts: policy_hash() or 'none', with its quotes
std::string page_head(const std::string& title, const std::string& script);

}  // namespace sturz
