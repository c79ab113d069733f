// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/batch/old_results.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/batch/plan.hpp"
#include "ensemble/workflow/folder/folder_lock.hpp"

#include <fmt/core.h>

namespace sturz::workflow {
namespace fs = std::filesystem;

std::string point_to(const fs::path& base, const fs::path& folder) {
  std::error_code failed;
  const fs::path target = folder.filename();  // both lie side by side and move together
  const fs::file_status there = fs::symlink_status(base, failed);
  if (fs::is_symlink(there)) {
    if (fs::read_symlink(base, failed) == target) return {};
  } else if (fs::exists(there)) {
    return fmt::format("{} is something else than a link that this program made", base.string());
  }
  fs::path part = base;
  part += ".link.part";
  fs::remove(part, failed);
  fs::create_directory_symlink(target, part, failed);
  if (!failed) fs::rename(part, base, failed);
  if (!failed) return {};
  std::error_code ignored;
  fs::remove(part, ignored);
  return fmt::format("{} cannot be a link ({})", base.string(), failed.message());
}

std::vector<fs::path> remove_old_results(const fs::path& base, const fs::path& current, int keep) {
  std::vector<fs::path> removed;
  int others = keep - 1;
  for (const fs::path& folder : results_of(base)) {
    if (folder == current || others-- > 0) continue;
    try {
      const auto lock = FolderLock::alone({folder}, "removing old results");
      // Without its manifest it is no result any more, should this be cut short.
      fs::remove(OutputFolder{folder}.manifest());
      fs::remove_all(folder);
      removed.push_back(folder);
    } catch (const SetupError&) {  // a process works there: with the next call
    } catch (const fs::filesystem_error&) {
    }
  }
  return removed;
}

}  // namespace sturz::workflow
