// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/folder/lock_file.hpp"

#include "engine/core/error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/io_error.hpp"
#include "io/files/text_files.hpp"
#include "io/files/unfinished.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace sturz::workflow {
namespace fs = std::filesystem;
using json = nlohmann::ordered_json;
namespace {

std::string text_of(const LockHolder& holder) {
  const ProcessIdentity& p = holder.process;
  const json all = {{"what", "a process of sturz works in this folder; see `since` and `host`"},
                    {"host", p.host},
                    {"pid", p.pid},
                    {"since", holder.since},
                    {"purpose", holder.purpose},
                    {"brief", holder.brief},
                    {"machine", p.machine},
                    {"boot", p.boot},
                    {"pids", p.pids},
                    {"start", p.start},
                    {"job", p.job},
                    {"restarts", p.restarts},
                    {"beat_s", holder.beat_s},
                    {"workers", holder.workers},
                    {"token", holder.token}};
  return all.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

/// Nothing when that is not the text of a lock.
std::optional<LockHolder> parsed(const std::string& text) {
  try {
    const json all = json::parse(text);
    LockHolder h;
    ProcessIdentity& p = h.process;
    p.host = all.at("host").get<std::string>();
    p.pid = all.at("pid").get<std::int64_t>();
    p.machine = all.at("machine").get<std::string>();
    p.boot = all.at("boot").get<std::string>();
    p.pids = all.at("pids").get<std::string>();
    p.start = all.at("start").get<std::uint64_t>();
    h.since = all.at("since").get<std::string>();
    h.purpose = all.at("purpose").get<std::string>();
    h.brief = all.at("brief").get<bool>();
    h.token = all.at("token").get<std::string>();
    p.job = all.value("job", "");  // older versions know nothing of these
    p.restarts = all.value("restarts", std::int64_t{0});
    h.beat_s = all.value("beat_s", 0.0);
    h.workers = all.value("workers", 0);
    // It becomes part of a file's name.
    if (h.token.empty() || h.token.find_first_not_of("0123456789abcdef") != std::string::npos)
      return std::nullopt;
    return h;
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

/// How long a lock has not been touched, by the file system's own clock: that of a file which is
/// made beside it now [s]. Below zero when that clock was set back.
double silent_seconds(const fs::path& file) {
  AtomicFile now(file);
  now.write(std::as_bytes(std::span("now")));
  const auto touched = last_touch(file), written = last_touch(now.part());
  if (!touched || !written) return 0;
  return std::chrono::duration<double>(*written - *touched).count();
}

bool is_gone(const fs::path& file, const LockHolder& holder) {
  if (replaces(holder.process)) return true;
  const Liveness known = liveness_of(holder.process);
  if (known != Liveness::unknown) return known == Liveness::gone;
  return holder.beat_s > 0 && silent_seconds(file) > holder.silence_s();
}

/// True when `file` is `text` now, made by us; false when something has that name already.
bool create_whole(const fs::path& file, const std::string& text) {
  AtomicFile part(file);  // never committed: the link below gives it the name, if that is free
  part.write(std::as_bytes(std::span(text)));
  if (const int written = ::open(part.part().c_str(), O_RDONLY | O_CLOEXEC); written >= 0) {
    ::fsync(written);  // a lock without text after a power loss could not be judged
    ::close(written);
  }
  if (::link(part.part().c_str(), file.c_str()) == 0) return true;
  const int code = errno;
  struct stat about {};  // NFS may have done it and lost the answer
  if (::stat(part.part().c_str(), &about) == 0 && about.st_nlink == 2) return true;
  if (code == EEXIST) return false;
  // File systems without hard links: the name first, then the text.
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0 && errno == EEXIST) return false;
  const bool done = descriptor >= 0 && ::write(descriptor, text.data(), text.size()) ==
                                           static_cast<ssize_t>(text.size());
  const int why = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (done) return true;
  if (descriptor >= 0) ::unlink(file.c_str());
  throw IoError(fmt::format("cannot write {} ({}). Choose another folder.", file.string(),
                            std::strerror(why)));
}

/// True when the lock of a process that is gone is ours now.
bool take_over(const fs::path& file, const LockHolder& stale, const LockHolder& mine) {
  fs::path claim = file;
  claim += "." + stale.token;
  if (!create_whole(claim, text_of(mine))) {
    if (const auto other = holder_in(claim); other && is_gone(claim, *other))
      ::unlink(claim.c_str());  // killed in here; the next look begins anew
    return false;
  }
  const auto now = holder_in(file);
  const bool still_there = now && now->token == stale.token;
  if (still_there) write_text_atomic(file, text_of(mine));
  ::unlink(claim.c_str());
  return still_there;
}

}  // namespace

std::optional<LockHolder> holder_in(const fs::path& file) {
  constexpr int tries = 20;  // without hard links a lock is empty for a moment
  for (int i = 0; i < tries; ++i) {
    try {
      if (auto holder = parsed(read_text(file))) return holder;
    } catch (const IoError&) {
      struct stat about {};
      if (::lstat(file.c_str(), &about) != 0 && errno == ENOENT) return std::nullopt;
      // Another process may have made it only since the reading failed.
      if (i + 1 == tries) throw;
    }
    ::usleep(20000);
  }
  throw SetupError(
      fmt::format("{}: not a lock that sturz wrote, or damaged (it says who works in "
                  "the folder). Delete it when no process does.",
                  file.string()));
}

std::optional<std::chrono::nanoseconds> last_touch(const fs::path& file) {
  struct stat about {};
  if (::stat(file.c_str(), &about) != 0) return std::nullopt;
  return std::chrono::seconds(about.st_mtim.tv_sec) +
         std::chrono::nanoseconds(about.st_mtim.tv_nsec);
}

std::optional<LockHolder> live_holder(const fs::path& file) {
  auto holder = holder_in(file);
  if (holder && is_gone(file, *holder)) holder.reset();
  return holder;
}

std::optional<LockHolder> take_lock(const fs::path& file, const LockHolder& mine) {
  constexpr int tries = 100;  // each fails only when another process was faster in between
  for (int i = 0; i < tries; ++i) {
    const auto holder = holder_in(file);  // looking is cheap: many shards may wait for one lock
    if (!holder) {
      if (!create_whole(file, text_of(mine))) continue;  // another one was faster
      remember_unfinished(file);                         // not before: it may be of another process
      return std::nullopt;
    }
    if (!is_gone(file, *holder)) return holder;
    if (take_over(file, *holder, mine)) {
      remember_unfinished(file);
      return std::nullopt;
    }
    ::usleep(1000);
  }
  throw SetupError(
      fmt::format("{} changes hands all the time (several processes want the folder). "
                  "Try again.",
                  file.string()));
}

void rewrite_lock(const fs::path& file, const LockHolder& mine) {
  if (const auto holder = holder_in(file); holder && holder->token == mine.token)
    write_text_atomic(file, text_of(mine));
}

void drop_lock(const fs::path& file, const std::string& token) noexcept {
  try {
    forget_unfinished(file);
    if (const auto holder = holder_in(file); holder && holder->token == token)
      ::unlink(file.c_str());
  } catch (...) {  // it stays, and is stale once this process has ended
  }
}

std::string holder_text(const LockHolder& holder) {
  return fmt::format("process {} on {} since {} ({})", holder.process.pid, holder.process.host,
                     holder.since, holder.purpose);
}

}  // namespace sturz::workflow
