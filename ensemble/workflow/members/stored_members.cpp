// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/members/stored_members.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/folder/folder_members.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"
#include "io/members/member_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

MemberStore open_store(const fs::path& folder, const MemberFilter& filter, Observer& observer,
                       CancelFlag cancel) {
  const OutputFolder results{folder};
  std::error_code ignored;
  require(fs::is_directory(results.members(), ignored),
          fmt::format("{}: holds no members (no folder {}). Name a folder that `sturz ensemble` "
                      "wrote.",
                      folder.string(), results.members().string()));
  MemberStore store(results.members(), filter, cancel);
  warn_of_problems(store, "It counts as missing.", observer);
  return store;
}

}  // namespace

MemberStore open_members(const fs::path& folder, Observer& observer, CancelFlag cancel) {
  return open_store(folder, {}, observer, cancel);
}

StoredMembers stored_members(const fs::path& folder, Observer& observer, CancelFlag cancel) {
  const MemberStore store = open_members(folder, observer, cancel);
  StoredMembers found;
  std::map<fs::path, std::int64_t> packs;
  for (std::size_t i = 0; i < store.members().size(); ++i) {
    ++found.n_members;
    found.n_failed += !is_valid(store.members()[i].outcome);
    const fs::path file = store.file_of(i);
    if (pack_named(file))
      ++packs[file];
    else
      ++found.n_files;
  }
  found.n_damaged = static_cast<std::int64_t>(store.problems().size());
  found.packs.assign(packs.begin(), packs.end());
  return found;
}

std::vector<fs::path> extract_members(const ExtractRequest& request, Observer& observer,
                                      CancelFlag cancel) {
  MemberFilter filter;
  filter.wanted = [&](std::int64_t member) {
    return std::any_of(request.members.begin(), request.members.end(),
                       [&](const MemberRange& r) { return member >= r.first && member <= r.last; });
  };
  const MemberStore store = open_store(request.folder, filter, observer, cancel);
  const auto& members = store.members();
  const auto is_there = [&](std::int64_t k) {
    const auto at = std::lower_bound(
        members.begin(), members.end(), k,
        [](const MemberSummary& m, std::int64_t wanted) { return m.member < wanted; });
    return at != members.end() && at->member == k;
  };
  for (const MemberRange& range : request.members)
    for (std::int64_t k = range.first; k <= range.last; ++k)
      require(is_there(k),
              fmt::format("{}: holds no member {} (not computed, or damaged). `sturz members {}` "
                          "says what is there.",
                          request.folder.string(), k, request.folder.string()));
  const fs::path out = request.out.empty() ? request.folder / "extracted" : request.out;
  std::vector<fs::path> files;
  for (std::size_t i = 0; i < members.size(); ++i) {
    cancel.check();
    MemberOrigin origin;
    const MemberResult result = store.result(i, origin);
    write_member(out, result, origin);
    files.push_back(out / member_file_name(result.member));
  }
  return files;
}

}  // namespace sturz::workflow
