// SPDX-License-Identifier: Apache-2.0
/// The members of a folder that were finished last: what comes next takes about as long as they.
#pragma once

#include "io/members/member_store.hpp"

#include <cstddef>
#include <vector>

namespace sturz::workflow {

/// Where a stored member stands among those of its folder.
struct WrittenMember {
  std::size_t index = 0;   ///< in MemberStore::members()
  double written_s = 0;    ///< when its file was written last, by any clock
  std::size_t behind = 0;  ///< members that stand behind it in the same file
};

/// The n that were written last. Only a pack's last record is known to be as young as the pack:
/// files that were written to `old_s` or longer before the youngest one are left aside as far as
/// there are enough others, and packs that grow side by side are taken from alike. \return indices,
/// the youngest first
std::vector<std::size_t> written_last(std::vector<WrittenMember> members, std::size_t n,
                                      double old_s = 900);

std::vector<std::size_t> written_last(const MemberStore&, std::size_t n);

}  // namespace sturz::workflow
