// SPDX-License-Identifier: Apache-2.0
/// Plain numbers and texts one after the other, little-endian; the reader believes no length.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace sturz {

static_assert(std::endian::native == std::endian::little, "packs hold numbers as x86 and ARM do");

/// Bytes that are no member's; says what is wrong with them, not where they lie.
class BadRecord : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ByteWriter {
 public:
  template <class T>
  requires std::is_arithmetic_v<T>
  void put(T value) { values(std::span<const T>(&value, 1)); }
  void text(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    values(std::span<const char>(text.data(), text.size()));
  }
  /// Without their number.
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void values(std::span<const T> values) {
    const auto raw = std::as_bytes(values);
    bytes_.insert(bytes_.end(), raw.begin(), raw.end());
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void list(const std::vector<T>& all) {
    put(static_cast<std::uint64_t>(all.size()));
    values(std::span<const T>(all));
  }
  void pad(std::size_t to) {
    while (bytes_.size() % to != 0) bytes_.push_back(std::byte{0});
  }
  std::size_t size() const { return bytes_.size(); }
  std::span<const std::byte> bytes() const { return bytes_; }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

/// Every read is checked against what is left. \throws BadRecord
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : left_(bytes) {}

  template <class T>
  requires std::is_arithmetic_v<T> T get() {
    T value;
    values(std::span<T>(&value, 1));
    return value;
  }
  std::string text() {
    const auto n = get<std::uint32_t>();
    need(n);
    std::string text(reinterpret_cast<const char*>(left_.data()), n);
    left_ = left_.subspan(n);
    return text;
  }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void values(std::span<T> out) {
    need(out.size_bytes());
    if (!out.empty()) std::memcpy(out.data(), left_.data(), out.size_bytes());
    left_ = left_.subspan(out.size_bytes());
  }
  template <class T>
  requires std::is_arithmetic_v<T> std::vector<T> list() {
    const auto n = get<std::uint64_t>();
    if (n > left_.size() / sizeof(T)) throw BadRecord("a list is longer than its record");
    std::vector<T> out(n);
    values(std::span<T>(out));
    return out;
  }
  std::size_t left() const { return left_.size(); }

 private:
  void need(std::size_t n) const {
    if (n > left_.size()) throw BadRecord("it ends too early");
  }
  std::span<const std::byte> left_;
};

}  // namespace sturz
