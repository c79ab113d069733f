// SPDX-License-Identifier: Apache-2.0
// From YAML text to a validated scenario: tree, overrides, key table, checks.
#include "io/scenario/scenario_file.hpp"
#include "io/scenario/scenario_material.hpp"
#include "io/scenario/scenario_overrides.hpp"
#include "io/scenario/scenario_values.hpp"
#include "scenarios/checks/validate.hpp"
#include "scenarios/schema/foreign_words.hpp"
#include "scenarios/schema/schema.hpp"
#include "scenarios/schema/suggest.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace sturz {
namespace {

/// More problems than this in one file are noise: it is no scenario.
constexpr std::size_t most_problems = 100;

/// Equal, or one lies inside the other: "grains" and "grains.friction".
bool related(const std::string& a, const std::string& b) {
  const auto inside = [](const std::string& inner, const std::string& outer) {
    return inner.starts_with(outer) && (inner.size() == outer.size() || inner[outer.size()] == '.');
  };
  return inside(a, b) || inside(b, a);
}

/// Walks the tree along the key table and fills a scenario.
class Reader {
 public:
  explicit Reader(std::vector<FileProblem>& problems) : problems_(problems) {}

  ScenarioFile file;

  void read_block(const std::string& block, const YamlNode& node) {
    for (const auto& entry : node.entries) {
      if (problems_.size() > most_problems) return;
      const std::string path = block.empty() ? entry.key : block + "." + entry.key;
      const bool dotted = entry.key.find('.') != std::string::npos;
      const KeyInfo* key = dotted ? nullptr : find_key(path);
      if (key)
        read_key(*key, entry.value);
      else if (!dotted && is_block(path))
        read_inner_block(path, entry.value);
      else
        report_unknown(block, path, entry);
    }
  }

  /// Problems of whole scenario, without those that only follow from what was misread.
  void validate_all(const std::string& name) {
    for (auto& problem : validate(file.scenario)) {
      const bool follows = std::any_of(failed_.begin(), failed_.end(), [&](const auto& path) {
        return related(path, problem.path) || problem.message.find(path) != std::string::npos;
      });
      if (!follows) problems_.push_back({position_of(problem.path, name), problem.message});
    }
  }

 private:
  void read_key(const KeyInfo& key, const YamlNode& node) {
    file.positions[key.path] = node.at;
    const std::size_t before = problems_.size();
    const KeyValue value = read_value(key, node, problems_);
    bool usable = problems_.size() == before;
    if (usable) {
      for (auto& problem : check_value(key, value))
        problems_.push_back({node.at, std::move(problem.message)});
      const auto* list = std::get_if<std::vector<double>>(&value);
      usable = !list || key.list_size == 0 || static_cast<int>(list->size()) == key.list_size;
    }
    if (usable) key.set(file.scenario, value);
    if (problems_.size() != before) failed_.push_back(key.path);
  }

  void read_inner_block(const std::string& path, const YamlNode& node) {
    file.positions[path] = node.at;
    for (const auto& block : optional_blocks())
      if (block.path == path) block.make(file.scenario);
    if (node.kind == YamlNode::Kind::map) return read_block(path, node);
    failed_.push_back(path);
    const std::string names = comma_separated(names_in_block(path));
    if (node.kind == YamlNode::Kind::empty)
      problems_.push_back(
          {node.at, path + " (has no keys). Give it some of " + names + ", or remove it."});
    else
      problems_.push_back(
          {node.at, path + " = " + node.shown() + " (must be a block of keys: " + names + ")."});
  }

  void report_unknown(const std::string& block, const std::string& path, const YamlEntry& entry) {
    failed_.push_back(path);
    if (entry.key.find('.') != std::string::npos) {
      problems_.push_back({entry.at, path + " (unknown key: a dot stands between blocks, not in a "
                                            "name). Write the blocks one inside the other."});
      return;
    }
    for (const auto& later : later_keys())
      if (later.path == path) {
        problems_.push_back(
            {entry.at, path + " (not available in this version: " + later.what + "). Remove it."});
        return;
      }
    const std::string advice = advice_on_foreign_word(path);
    problems_.push_back({entry.at, path + " (unknown key). " +
                                       (advice.empty() ? suggestion(block, entry.key) : advice)});
  }

  /// A sibling with nearly the same name, the same name elsewhere, or what is known here.
  static std::string suggestion(const std::string& block, const std::string& name) {
    const auto siblings = names_in_block(block);
    const std::string inner = block.empty() ? "" : block + ".";
    const std::string near = nearest_name(name, siblings);
    if (!near.empty()) return "Did you mean " + inner + near + "?";
    std::string elsewhere;  // the one nearest to the top
    const auto depth = [](const std::string& path) {
      return std::count(path.begin(), path.end(), '.');
    };
    for (const auto& key : schema())
      if (key.path.substr(key.path.rfind('.') + 1) == name &&
          (elsewhere.empty() || depth(key.path) < depth(elsewhere)))
        elsewhere = key.path;
    if (!elsewhere.empty()) return "Did you mean " + elsewhere + "?";
    return (block.empty() ? "Known: " : "Known in " + block + ": ") + comma_separated(siblings) +
           ".";
  }

  Position position_of(std::string path, const std::string& name) const {
    while (true) {
      const auto found = file.positions.find(path);
      if (found != file.positions.end()) return found->second;
      const auto dot = path.rfind('.');
      if (dot == std::string::npos) return {name, 0, 0};
      path.resize(dot);
    }
  }

  std::vector<FileProblem>& problems_;
  std::vector<std::string> failed_;  ///< paths that have a problem of their own
};

/// In the order of the file; what has no place in it comes first, overrides last.
[[noreturn]] void throw_all(std::vector<FileProblem> problems, const std::string& name) {
  std::stable_sort(problems.begin(), problems.end(), [&](const auto& a, const auto& b) {
    const auto place = [&](const FileProblem& p) {
      return std::tuple(p.at.source != name, p.at.line, p.at.column);
    };
    return place(a) < place(b);
  });
  std::vector<std::string> lines;
  for (const auto& problem : problems) {
    if (lines.size() == most_problems) {
      lines.push_back(name + ": and more problems. Mend these first.");
      break;
    }
    lines.push_back(problem.at.text() + ": " + problem.message);
  }
  throw ScenarioError(std::move(lines));
}

std::string lines_of(const std::vector<std::string>& problems) {
  std::string text;
  for (const auto& line : problems) text += (text.empty() ? "" : "\n") + line;
  return text;
}

}  // namespace

ScenarioError::ScenarioError(std::vector<std::string> problems)
    : SetupError(lines_of(problems)), problems_(std::move(problems)) {}

ScenarioFile read_scenario_file_text(std::string_view text, const std::string& name,
                                     const std::filesystem::path& directory,
                                     const std::vector<std::string>& overrides) {
  std::vector<FileProblem> problems;
  auto root = parse_yaml(text, name, problems);
  if (root && root->kind != YamlNode::Kind::map) {
    problems.push_back({root->at,
                        "must be a list of keys with values, like terrain: {...}. Start "
                        "from a shipped case."});
    root.reset();
  }
  if (!root) throw_all(std::move(problems), name);
  for (const auto& override_text : overrides) apply_override(*root, override_text, problems);
  add_material_values(*root);
  Reader reader(problems);
  reader.read_block("", *root);
  reader.validate_all(name);
  if (!problems.empty()) throw_all(std::move(problems), name);
  reader.file.scenario.directory = directory.string();
  return std::move(reader.file);
}

Scenario read_scenario_text(std::string_view text, const std::string& name,
                            const std::filesystem::path& directory,
                            const std::vector<std::string>& overrides) {
  return read_scenario_file_text(text, name, directory, overrides).scenario;
}

}  // namespace sturz
