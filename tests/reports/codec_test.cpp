// SPDX-License-Identifier: Apache-2.0
#include "reports/figures/codec.hpp"

#include "reports/figures/png.hpp"
#include "reports/page/payload.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <string>

namespace sturz {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes from_base64(const std::string& text) {
  static const std::string alphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  Bytes out;
  std::uint32_t word = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    word = word << 6 | static_cast<std::uint32_t>(alphabet.find(c));
    if ((bits += 6) >= 8) out.push_back(static_cast<std::uint8_t>(word >> (bits -= 8)));
  }
  return out;
}

Bytes inflated(const Bytes& packed, std::size_t size) {
  Bytes out(size);
  uLongf n = size;
  EXPECT_EQ(uncompress(out.data(), &n, packed.data(), packed.size()), Z_OK);
  EXPECT_EQ(n, size);
  return out;
}

/// What the page's script does.
std::vector<std::uint16_t> unpacked(const PackedCodes& packed, std::size_t n, std::size_t cols) {
  const bool wide = packed.bits == 16;
  const Bytes bytes = inflated(from_base64(packed.data), wide ? 2 * n : n);
  std::vector<std::uint16_t> codes;
  for (std::size_t i = 0; i < n; ++i) {
    const int step = wide ? bytes[i] << 8 | bytes[n + i] : bytes[i];
    const int left = i % cols == 0 ? 0 : codes[i - 1];
    codes.push_back(static_cast<std::uint16_t>((left + step) & (wide ? 0xffff : 0xff)));
  }
  return codes;
}

TEST(ReportCodec, WritesBase64WithPadding) {
  const std::string text = "sturz";
  EXPECT_EQ(base64(Bytes(text.begin(), text.begin() + 3)), "c3R1");
  EXPECT_EQ(base64(Bytes(text.begin(), text.end())), "c3R1cno=");
  EXPECT_EQ(base64(Bytes(text.begin(), text.begin() + 1)), "cw==");
  EXPECT_EQ(base64({}), "");
}

TEST(ReportCodec, BringsSmallAndLargeCodesBack) {
  const std::vector<std::uint16_t> small{0, 255, 3, 254, 0, 1}, large{0, 65535, 256, 9, 40000, 1};
  const PackedCodes one = pack_codes(small, 3), two = pack_codes(large, 2);
  EXPECT_EQ(one.bits, 8);
  EXPECT_EQ(two.bits, 16);
  EXPECT_EQ(unpacked(one, 6, 3), small);
  EXPECT_EQ(unpacked(two, 6, 2), large);
}

double value_of(const Quantised& q, std::size_t i) {
  const double code = q.codes[i];
  return q.codes[i] == q.nodata ? nan_d : q.offset + q.factor * (q.square ? code * code : code);
}

TEST(ReportQuantise, KeepsSharesOfMembersExactly) {
  std::vector<float> shares;
  for (int k = 0; k <= 31; ++k) shares.push_back(static_cast<float>(k) / 31.0F);
  shares.push_back(nan_f);
  const Quantised q = quantise(shares, 31);
  for (int k = 0; k <= 31; ++k) EXPECT_EQ(q.codes[static_cast<std::size_t>(k)], k);
  EXPECT_TRUE(std::isnan(value_of(q, 32)));
  EXPECT_LT(q.nodata, 256);
}

TEST(ReportQuantise, KeepsMagnitudesToATenthOfAPercentOfTheLargest) {
  std::vector<float> values;
  for (int k = 0; k < 1000; ++k) values.push_back(1.7e6F * std::pow(k / 999.0F, 3.0F));
  const Quantised q = quantise(values, 20);
  ASSERT_TRUE(q.square);
  for (std::size_t k = 0; k < values.size(); ++k) {
    EXPECT_NEAR(value_of(q, k), values[k], 1.7e6 * 3e-4);
    if (values[k] > 0) {
      EXPECT_GT(value_of(q, k), 0) << "a touched cell must stay touched";
    }
  }
}

TEST(ReportQuantise, TakesNegativeValuesConstantsAndNothing) {
  const Quantised negative = quantise({-3, 0, 5.5F}, 4);
  EXPECT_NEAR(value_of(negative, 0), -3, 0.01);
  EXPECT_NEAR(value_of(negative, 2), 5.5, 0.01);
  for (const float high : {0.375F, 0.1F, 5.5F})  // no change stays no change
    EXPECT_EQ(value_of(quantise({-1, 0, high}, 0), 1), 0);
  EXPECT_NEAR(value_of(quantise({2.5F, 2.5F}, 0), 1), 2.5, 1e-6);
  EXPECT_NEAR(value_of(quantise({-2.5F, -2.5F}, 0), 1), -2.5, 1e-6);
  const Quantised nothing = quantise({nan_f, nan_f}, 7);
  EXPECT_TRUE(std::isnan(value_of(nothing, 0)));
}

TEST(ReportPng, HasRightChunksAndPixels) {
  const Bytes grey{10, 20, 30, 40, 50, 60};
  const Bytes png = grey_png(grey, 3, 2);
  ASSERT_GT(png.size(), 57U);
  EXPECT_EQ(std::string(png.begin() + 1, png.begin() + 4), "PNG");
  EXPECT_EQ(std::string(png.begin() + 12, png.begin() + 16), "IHDR");
  EXPECT_EQ(png[19], 3);
  EXPECT_EQ(png[23], 2);
  const std::size_t data = 8 + 25;  // signature, IHDR
  const std::size_t length = png[data + 2] << 8 | png[data + 3];
  EXPECT_EQ(std::string(png.begin() + data + 4, png.begin() + data + 8), "IDAT");
  const std::uint32_t crc = png[data + 8 + length] << 24 | png[data + 9 + length] << 16 |
                            png[data + 10 + length] << 8 | png[data + 11 + length];
  EXPECT_EQ(crc, crc32(0, png.data() + data + 4, static_cast<uInt>(length + 4)));
  const auto from = png.begin() + static_cast<std::ptrdiff_t>(data) + 8;
  const Bytes rows = inflated(Bytes(from, from + static_cast<std::ptrdiff_t>(length)), 8);
  EXPECT_EQ(rows, (Bytes{1, 10, 10, 10, 1, 40, 10, 10}));
}

}  // namespace
}  // namespace sturz
