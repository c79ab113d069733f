// SPDX-License-Identifier: Apache-2.0
/// YAML text as a tree of untyped text with positions. A plain subset: no anchors, aliases, merge
/// keys, tags or second documents, so that no input can make it grow, hang or change type.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sturz {

/// Where something was written. Line 0: the whole source.
struct Position {
  std::string source;        ///< file name, or "--set key.path" for an override
  int line = 0, column = 0;  ///< from 1

  /// "source:line:column", or "source" alone.
  std::string text() const;
};

struct YamlEntry;

/// One node; scalars stay text, their type is the reader's business.
struct YamlNode {
  enum class Kind { empty, scalar, list, map };
  Kind kind = Kind::empty;
  Position at;
  std::string text;                ///< scalar
  bool quoted = false;             ///< scalar in quotes or as a block of lines
  std::vector<YamlNode> items;     ///< list
  std::vector<YamlEntry> entries;  ///< map, in file order, keys unique

  const YamlEntry* find(const std::string& key) const;
  YamlEntry* find(const std::string& key);
  /// One line of flow YAML for messages, cut after about 60 characters.
  std::string shown() const;
};

struct YamlEntry {
  std::string key;
  Position at;
  YamlNode value;
};

/// Something wrong at a place.
struct FileProblem {
  Position at;
  std::string message;
};

inline constexpr std::size_t max_yaml_bytes = 65536;
inline constexpr int max_yaml_depth = 16;

/// Reads one document. Nothing is thrown for bad text: what is wrong is added to `problems`, and
/// without a usable tree the result is empty. Duplicate keys keep the first value.
std::optional<YamlNode> parse_yaml(std::string_view text, const std::string& source,
                                   std::vector<FileProblem>& problems);

}  // namespace sturz
