// SPDX-License-Identifier: Apache-2.0
// A scenario as YAML text.
#include "io/gdal/input_files.hpp"
#include "io/scenario/scenario_file.hpp"
#include "scenarios/schema/schema.hpp"
#include "scenarios/schema/value_text.hpp"

namespace sturz {
namespace {

namespace fs = std::filesystem;

/// Text that GDAL takes for something else than a file of ours: "NETCDF:...", "/vsicurl/...".
bool is_plain_relative(const std::string& path) {
  if (path.empty() || fs::path(path).is_absolute()) return false;
  const auto colon = path.find(':');
  return colon == std::string::npos || path.find('/') < colon;
}

/// The same file, seen from another directory.
std::string moved_path(const std::string& path, const fs::path& from, const fs::path& to) {
  if (to.empty() || path.empty()) return path;
  if (!is_plain_relative(path)) return anchored_gdal_name(path, from.string());
  const fs::path there = fs::absolute(from.empty() ? fs::path(".") : from) / path;
  return there.lexically_normal().lexically_proximate(fs::absolute(to).lexically_normal()).string();
}

/// Writes "block:" lines on the way down to each key.
class BlockWriter {
 public:
  void add(const std::string& path, const std::string& value) {
    std::size_t start = 0, depth = 0;
    for (std::size_t dot = path.find('.'); dot != std::string::npos;
         dot = path.find('.', start), ++depth) {
      const std::string name = path.substr(start, dot - start);
      if (depth >= open_.size() || open_[depth] != name) {
        open_.resize(depth);
        open_.push_back(name);
        text_ += std::string(2 * depth, ' ') + name + ":\n";
      }
      start = dot + 1;
    }
    open_.resize(depth);
    text_ += std::string(2 * depth, ' ') + path.substr(start) + ": " + value + "\n";
  }
  std::string text() const { return text_; }

 private:
  std::vector<std::string> open_;
  std::string text_;
};

}  // namespace

std::string write_scenario(const Scenario& scenario, const fs::path& for_directory) {
  BlockWriter writer;
  for (const auto& key : schema()) {
    KeyValue value = key.get(scenario);
    for_each_path(key, value, [&](std::string& path) {
      path = moved_path(path, scenario.directory, for_directory);
    });
    const std::string text = value_text(value);
    if (!text.empty()) writer.add(key.path, text);
  }
  return writer.text();
}

}  // namespace sturz
