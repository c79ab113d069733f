// SPDX-License-Identifier: Apache-2.0
/// Where a member comes from: what must agree before members make a map together.
#pragma once

#include <string>

namespace sturz {

struct MemberOrigin {
  std::string scene_hash;      ///< of everything that the member was computed from
  std::string engine_version;  ///< of the program that computed it
  std::string engine_commit;
  bool operator==(const MemberOrigin&) const = default;
};

}  // namespace sturz
