// SPDX-License-Identifier: Apache-2.0
#include "io/members/packs/pack_writer.hpp"

#include "io/files/atomic_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace sturz {
namespace fs = std::filesystem;

PackWriter::PackWriter(fs::path folder, PackName shard, std::uint64_t most_bytes_of_one)
    : folder_(std::move(folder)), name_(shard), most_bytes_(most_bytes_of_one) {
  name_.number = 0;
}

PackWriter::~PackWriter() { close(); }

void PackWriter::close() {
  if (descriptor_ < 0) return;
  if (dirty_) ::fdatasync(descriptor_);  // what fails here is found when the members are read
  ::close(descriptor_);
  descriptor_ = -1;
  dirty_ = false;
}

void PackWriter::fail(const char* what, int code) const { fail_to_write(what, path_, code); }

void PackWriter::open_next() {
  make_folder(folder_);
  do {
    ++name_.number;
    path_ = folder_ / pack_file_name(name_);
  } while (!open_this());
}

/// False: another process writes it, or it is long enough.
bool PackWriter::open_this() {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  const bool is_new = descriptor_ >= 0;
  if (!is_new) descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor_ < 0) fail("cannot create", errno);
  const bool locked = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
  // Where the file system knows no locks, only a pack of our own making is surely ours.
  const bool ours = locked || (errno != EWOULDBLOCK && is_new);
  if (ours) {
    const PackFile file(path_);
    end_ = look_through(file, {});
    const std::uint64_t size = file.size();
    if (size > end_ && ::ftruncate(descriptor_, static_cast<off_t>(end_)) != 0)
      fail("cannot cut off what was not finished in", errno);
  }
  if (!ours || end_ >= most_bytes_) {
    ::close(descriptor_);
    descriptor_ = -1;
    return false;
  }
  if (is_new) sync_folder(folder_);
  synced_ = std::chrono::steady_clock::now();
  return true;
}

void PackWriter::append(const MemberResult& result, const MemberOrigin& origin) {
  const std::vector<std::byte> record = encode_record(result, origin);
  if (descriptor_ >= 0 && end_ >= most_bytes_) close();
  if (descriptor_ < 0) open_next();
  std::size_t done = 0;
  while (done < record.size()) {
    constexpr std::size_t largest = std::size_t{1} << 26;
    const ssize_t n =
        ::pwrite(descriptor_, record.data() + done, std::min(record.size() - done, largest),
                 static_cast<off_t>(end_ + done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int code = errno;
      if (::ftruncate(descriptor_, static_cast<off_t>(end_)) != 0) close();  // to be cut off later
      fail("cannot write", code);
    }
    done += static_cast<std::size_t>(n);
  }
  end_ += record.size();
  dirty_ = true;
  if (std::chrono::steady_clock::now() - synced_ >= sync_every) sync();
}

void PackWriter::sync() {
  if (descriptor_ < 0 || !dirty_) return;
  if (::fdatasync(descriptor_) != 0) fail("cannot write", errno);
  dirty_ = false;
  synced_ = std::chrono::steady_clock::now();
}

}  // namespace sturz
