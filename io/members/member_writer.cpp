// SPDX-License-Identifier: Apache-2.0
#include "io/members/member_writer.hpp"

#include "io/members/member_file.hpp"

#include <utility>

namespace sturz {
namespace fs = std::filesystem;
namespace {

class FileWriter final : public MemberWriter {
 public:
  explicit FileWriter(fs::path folder) : folder_(std::move(folder)) {}
  void write(const MemberResult& result, const MemberOrigin& origin) override {
    write_member(folder_, result, origin);
  }
  void sync() override {}  // each file has been

 private:
  fs::path folder_;
};

class PackedWriter final : public MemberWriter {
 public:
  PackedWriter(fs::path folder, PackName shard) : packs_(std::move(folder), shard) {}
  void write(const MemberResult& result, const MemberOrigin& origin) override {
    packs_.append(result, origin);
  }
  void sync() override { packs_.sync(); }

 private:
  PackWriter packs_;
};

}  // namespace

MemberLayout layout_of(const fs::path& folder, std::int64_t planned) {
  if (!packs_in(folder).empty()) return MemberLayout::packs;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().extension() == ".nc") return MemberLayout::files;
  return planned > most_member_files ? MemberLayout::packs : MemberLayout::files;
}

std::unique_ptr<MemberWriter> member_writer(const fs::path& folder, MemberLayout layout,
                                            PackName shard) {
  if (layout == MemberLayout::packs) return std::make_unique<PackedWriter>(folder, shard);
  return std::make_unique<FileWriter>(folder);
}

}  // namespace sturz
