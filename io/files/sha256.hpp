// SPDX-License-Identifier: Apache-2.0
/// SHA-256 of bytes as they come. Included by .cpp files and by readers that hash while they read.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace sturz {

class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;
  Sha256(Sha256&&) noexcept;
  Sha256& operator=(Sha256&&) noexcept;

  void add(std::span<const char> bytes);
  void add_text(std::string_view text) { add(std::span(text.data(), text.size())); }
  /// The numbers' bits; every NaN counts as the same one, and -0 as 0.
  void add_values(std::span<const double> values);
  /// 64 hexadecimal digits. Nothing may be added afterwards.
  std::string hex();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sturz
