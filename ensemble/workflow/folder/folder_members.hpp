// SPDX-License-Identifier: Apache-2.0
/// The members of a folder that belong to its ensemble, and nothing else.
#pragma once

#include "ensemble/sampling/design.hpp"
#include "ensemble/workflow/folder/manifest.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"
#include "ensemble/workflow/observer.hpp"
#include "io/members/member_store.hpp"

#include <cstdint>
#include <functional>
#include <string>

namespace sturz::workflow {

/// What this program writes into a member of the folder.
MemberOrigin origin_of(const Manifest&, const DesignTable&, std::int64_t member);

/// Members whose file is whole, that were computed from this scene and their row of the design, by
/// a program that the manifest knows. The others are named in problems() and count as absent.
/// \param wanted only these are looked at; empty: all \param shard to which all wanted ones belong
/// \throws Cancelled
MemberStore members_of(const OutputFolder&, const Manifest&, const DesignTable&,
                       std::function<bool(std::int64_t)> wanted = {}, CancelFlag cancel = {},
                       PackName shard = {});

/// Warns of each problem, of many only the first few and their number.
/// \param consequence what follows from it, a sentence
void warn_of_problems(const MemberStore&, const std::string& consequence, Observer&);

/// Warns when programs of several versions computed members of the folder.
void warn_of_builds(const Manifest&, Observer&);

/// "3 of 6 members are missing (1, 3, 5)", at most twenty named; empty when none is.
std::string what_is_missing(const MemberStore&, std::int64_t planned);

/// Of the numbers and final states of all members, and of how many there will be: tells whether
/// maps are of these.
std::string members_hash(const MemberStore&, std::int64_t planned);

}  // namespace sturz::workflow
