// SPDX-License-Identifier: Apache-2.0
#include "io/members/member_numbers.hpp"

#include "io/members/member_file.hpp"
#include "io/members/packs/pack_file.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <system_error>

namespace sturz {
namespace fs = std::filesystem;
namespace {

/// The member's number if the name is one that member_file_name makes.
std::optional<std::int64_t> number_of(const fs::path& file) {
  const std::string stem = file.stem().string();
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), number);
  if (error != std::errc{} || end != stem.data() + stem.size()) return std::nullopt;
  if (file.filename() != member_file_name(number)) return std::nullopt;
  return number;
}

}  // namespace

std::vector<std::int64_t> member_files_in(const fs::path& folder) {
  std::vector<std::int64_t> numbers;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (const auto number = number_of(entry.path())) numbers.push_back(*number);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

std::vector<std::int64_t> member_numbers_in(const fs::path& folder) {
  std::vector<std::int64_t> numbers = member_files_in(folder);
  PackVisitor visitor;
  visitor.record = [&](const RecordHead& head, std::uint64_t /*offset*/) {
    numbers.push_back(head.member);
  };
  for (const fs::path& pack : packs_in(folder)) look_through(PackFile(pack), visitor);
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

}  // namespace sturz
