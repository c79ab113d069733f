// SPDX-License-Identifier: Apache-2.0
#include "io/files/atomic_file.hpp"

#include "engine/core/hash.hpp"
#include "io/files/io_error.hpp"
#include "io/files/unfinished.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <regex>
#include <string>
#include <vector>

namespace sturz {
namespace fs = std::filesystem;
namespace {

/// Host, process, time and a counter: two writers of one target never share a part file.
std::string unique_part_suffix() {
  static std::atomic<std::uint64_t> counter{0};
  char host[256] = {};
  gethostname(host, sizeof host - 1);
  const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
  const std::string text = fmt::format("{}/{}/{}/{}", host, getpid(), now, ++counter);
  return fmt::format(".{:016x}.part", hash_of(std::span(text)));
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// A link stays a link: what it points to is replaced.
fs::path follow_links(const fs::path& target) {
  std::error_code ignored;
  if (!fs::is_symlink(target, ignored)) return target;
  const fs::path resolved = fs::weakly_canonical(target, ignored);
  return ignored ? target : resolved;
}

/// Names of 255 bytes are the most that file systems take: a long one gives way to the suffix.
fs::path part_of(const fs::path& target) {
  constexpr std::size_t longest_name = 255;
  const std::string suffix = unique_part_suffix();
  const std::string name = target.filename().string();
  return target.parent_path() /
         (name.size() + suffix.size() > longest_name ? suffix : name + suffix);
}

bool is_part(const std::string& name) {
  static const std::regex made_here(R"(.*\.[0-9a-f]{16}\.part)");
  return std::regex_match(name, made_here);
}

/// What the user can do about it.
const char* cure_of(int code) {
  switch (code) {
    case EACCES:
    case EPERM:
    case EROFS:
      return "Give yourself the right to write there, or choose another folder";
    case ENAMETOOLONG:
      return "Choose a shorter name";
    case ELOOP:
      return "Its links lead in a circle: choose another name";
    case EFBIG:
      return "A limit on the size of files is set (ulimit -f), or the disk's format has one: lift "
             "it, or choose another folder";
    default:
      return "Make room or choose another folder";
  }
}

std::string free_space_text(const fs::path& folder) {
  std::error_code error;
  const auto space = fs::space(folder, error);
  if (error) return "";
  return fmt::format("; {:.1f} MB free in {}", static_cast<double>(space.available) / 1e6,
                     folder.string());
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& target) : target_(follow_links(target)) {
  std::error_code ignored;
  if (fs::exists(target_, ignored) && !fs::is_regular_file(target_, ignored))
    throw IoError(
        fmt::format("cannot write {} (a folder or device has this name). Choose another name.",
                    target_.string()));
  part_ = part_of(target_);
  remember_unfinished(part_);
  descriptor_ = ::open(part_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor_ < 0) {
    const int code = errno;
    forget_unfinished(part_);
    fail("cannot create", code);
  }
}

AtomicFile::~AtomicFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  ::unlink(part_.c_str());
  forget_unfinished(part_);
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  constexpr std::size_t largest = std::size_t{1} << 26;
  while (!bytes.empty()) {
    const ssize_t done = ::write(descriptor_, bytes.data(), std::min(bytes.size(), largest));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) fail("cannot write", errno);
    bytes = bytes.subspan(static_cast<std::size_t>(done));
  }
}

void AtomicFile::commit() {
  if (::fsync(descriptor_) != 0) fail("cannot write", errno);
  if (::rename(part_.c_str(), target_.c_str()) != 0) fail("cannot rename the part file to", errno);
  forget_unfinished(part_);
  // A late error of close() would come too late to matter: fsync has passed.
  ::close(descriptor_);
  descriptor_ = -1;
  sync_folder(folder_of(target_));
}

void sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;  // some network folders cannot be opened; the rename stands
  ::fsync(descriptor);
  ::close(descriptor);
}

void AtomicFile::fail(const char* what, int code) const { fail_to_write(what, target_, code); }

void fail_to_write(const char* what, const fs::path& target, int code) {
  const fs::path folder = folder_of(target);
  if (code == ENOENT)
    throw IoError(fmt::format("{} {} (there is no folder {}). Make it first.", what,
                              target.string(), folder.string()));
  const bool about_space = code == ENOSPC || code == EDQUOT || code == EIO;
  throw IoError(fmt::format("{} {} ({}{}). {}; files already there are unharmed.", what,
                            target.string(), code == 0 ? "the disk refuses" : std::strerror(code),
                            about_space || code == 0 ? free_space_text(folder) : "",
                            cure_of(code)));
}

void write_bytes_atomic(const fs::path& target, std::span<const std::byte> bytes) {
  AtomicFile file(target);
  file.write(bytes);
  file.commit();
}

void make_folder(const fs::path& folder) {
  std::error_code error, ignored;
  fs::create_directories(folder, error);
  if (!error || fs::is_directory(folder, ignored)) return;
  throw IoError(fmt::format("cannot make the folder {} ({}). Choose another output folder.",
                            folder.string(), error.message()));
}

void remove_part_files(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> found;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (is_part(entry->path().filename().string())) found.push_back(entry->path());
  for (const fs::path& part : found) ::unlink(part.c_str());  // never a folder
}

}  // namespace sturz
