// SPDX-License-Identifier: Apache-2.0
/// Constants of nature that several folders compute with.
#pragma once

namespace sturz {

inline constexpr double standard_gravity = 9.81;  ///< [m s-2]; three digits, as the field uses it

}  // namespace sturz
