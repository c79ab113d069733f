// SPDX-License-Identifier: Apache-2.0
/// What tells whether an input is still the one that a result was made from: a hash of what was
/// read, not of the bytes of files. Another compression, other tiles or a statistics sidecar change
/// nothing; another value, corner, thickness or coordinate system does.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace sturz {

struct InputIdentity {
  std::string role;   ///< scenario key that names it: "terrain.raster"; what is compared by
  std::string file;   ///< as the scenario's folder calls it; not compared
  std::string shape;  ///< grid or features and the coordinate system, in words; never changes
  /// Hash of each part that was read: for a raster, blocks "row/column" of 256 x 256 cells, and
  /// parts of such blocks at the edge of a window "row/column rows a-b columns c-d"; for polygons
  /// the one part "features". A window that grows adds parts and changes none.
  std::map<std::string, std::string> parts;
  bool operator==(const InputIdentity&) const = default;
};

/// Parts of an input of `before` that `now` has not read: it is to read them, to be compared.
std::vector<std::string> parts_to_read(const InputIdentity& now,
                                       const std::vector<InputIdentity>& before);

/// What differs, one sentence for each input that does: named in one and not in the other, another
/// shape, other values in a part that both have read, or a part of `before` that `now` has not
/// read. Parts that only `now` has read do not differ.
std::vector<std::string> input_differences(const std::vector<InputIdentity>& before,
                                           const std::vector<InputIdentity>& now);

/// `now`, with the parts that `before` has read of the same inputs.
std::vector<InputIdentity> with_known_parts(std::vector<InputIdentity> now,
                                            const std::vector<InputIdentity>& before);

/// One line for people: the shape and a hash over all parts' hashes.
std::string identity_text(const InputIdentity&);

}  // namespace sturz
