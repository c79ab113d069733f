// SPDX-License-Identifier: Apache-2.0
#include "io/members/packs/pack_file.hpp"

#include "io/files/io_error.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <string_view>

namespace sturz {
namespace fs = std::filesystem;
namespace {

/// Takes a whole number off the front of a text; false when there is none.
bool take(std::string_view& text, int& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{}) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}
bool take(std::string_view& text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  return true;
}

/// Finds where records go on behind bytes that are no whole record.
class Search {
 public:
  Search(const PackFile& file, const PackVisitor& visitor)
      : file_(file), visitor_(visitor), size_(file.size()) {}

  /// The next byte at or behind `from` where a sound head begins; the file's end when none does.
  /// Tells the damage from `begin` on, a part for each tail that it holds. \param member whose
  /// bytes they are at first, where that is known
  std::uint64_t next_head(std::uint64_t begin, std::uint64_t from,
                          std::optional<std::int64_t> member) {
    begin_ = begin, member_ = member;
    std::vector<std::byte> bytes(block + overlap);
    for (std::uint64_t at = from; at < size_; at += block) {
      const std::span all(bytes.data(), std::min<std::uint64_t>(bytes.size(), size_ - at));
      file_.read(at, all);
      for (std::size_t i = 0; i < std::min(all.size(), block); ++i) {
        if (at + i < begin_) continue;  // within a tail
        if (head_at(all.subspan(i))) {
          tell(at + i);
          return at + i;
        }
        if (const auto tail = tail_at(all.subspan(i))) found(*tail, at + i);
      }
    }
    tell(size_);
    return size_;
  }

 private:
  static constexpr std::size_t block = std::size_t{1} << 16, overlap = RecordHead::n_bytes;

  void found(const RecordTail& tail, std::uint64_t at) {
    if (member_ && *member_ != tail.member) tell(at);
    member_ = tail.member;
    tell(at + RecordHead::tail_bytes);
  }
  void tell(std::uint64_t end) {
    if (end > begin_ && visitor_.damage) visitor_.damage(member_, begin_, end - begin_);
    begin_ = end;
    member_.reset();
  }

  const PackFile& file_;
  const PackVisitor& visitor_;
  std::uint64_t size_, begin_ = 0;
  std::optional<std::int64_t> member_;
};

bool has_tail(const PackFile& file, const RecordHead& head, std::uint64_t at) {
  std::array<std::byte, RecordHead::tail_bytes> bytes{};
  file.read(at + head.total - bytes.size(), bytes);
  const auto tail = tail_at(bytes);
  return tail && tail->belongs_to(head);
}

}  // namespace

std::string pack_file_name(const PackName& name) {
  return fmt::format("{}_of_{}.{:03d}.pack", name.k, name.n, name.number);
}

std::optional<PackName> pack_named(const fs::path& file) {
  const std::string name = file.filename().string();
  std::string_view left = name;
  PackName found;
  const bool fits = take(left, found.k) && take(left, "_of_") && take(left, found.n) &&
                    take(left, ".") && take(left, found.number) && left == ".pack" &&
                    found.k >= 1 && found.k <= found.n && found.number >= 1 &&
                    name == pack_file_name(found);
  return fits ? std::optional(found) : std::nullopt;
}

std::vector<fs::path> packs_in(const fs::path& folder) {
  std::vector<std::pair<PackName, fs::path>> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (const auto name = pack_named(entry->path())) found.emplace_back(*name, entry->path());
  std::sort(found.begin(), found.end());
  std::vector<fs::path> paths;
  for (auto& [name, path] : found) paths.push_back(std::move(path));
  return paths;
}

PackFile::PackFile(fs::path path)
    : path_(std::move(path)), descriptor_(::open(path_.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (descriptor_ < 0)
    throw IoError(fmt::format("cannot read {} ({}). Check its permissions.", path_.string(),
                              std::strerror(errno)));
}

PackFile::~PackFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::uint64_t PackFile::size() const {
  struct stat about {};
  if (::fstat(descriptor_, &about) != 0)
    throw IoError(fmt::format("cannot read {} ({}). Check its permissions.", path_.string(),
                              std::strerror(errno)));
  return static_cast<std::uint64_t>(about.st_size);
}

void PackFile::read(std::uint64_t offset, std::span<std::byte> out) const {
  while (!out.empty()) {
    const ssize_t n = ::pread(descriptor_, out.data(), out.size(), static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0)
      throw IoError(
          fmt::format("{}: cannot be read at byte {} ({}). Run the command that wrote it "
                      "again.",
                      path_.string(), offset, n == 0 ? "it ends there" : std::strerror(errno)));
    out = out.subspan(static_cast<std::size_t>(n));
    offset += static_cast<std::uint64_t>(n);
  }
}

std::string PackFile::record_name(std::int64_t member, std::uint64_t offset) const {
  return fmt::format("{}, member {} at byte {}", path_.string(), member, offset);
}

std::uint64_t look_through(const PackFile& file, const PackVisitor& visitor) {
  Search search(file, visitor);
  std::array<std::byte, RecordHead::n_bytes> bytes{};
  const std::uint64_t size = file.size();
  std::uint64_t at = 0, sound_end = 0;
  while (at < size) {
    std::optional<RecordHead> head;
    if (size - at >= bytes.size()) {
      file.read(at, bytes);
      head = head_at(bytes);
    }
    if (!head) {
      at = search.next_head(at, at + 1, std::nullopt);
      continue;
    }
    if (head->total > size - at || !has_tail(file, *head, at)) {
      at = search.next_head(at, at + bytes.size(), head->member);
      continue;
    }
    if (visitor.record) visitor.record(*head, at);
    at += head->total;
    sound_end = at;
  }
  return sound_end;
}

}  // namespace sturz
