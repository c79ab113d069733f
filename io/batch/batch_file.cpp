// SPDX-License-Identifier: Apache-2.0
#include "io/batch/batch_file.hpp"

#include "engine/core/error.hpp"
#include "io/batch/batch_keys.hpp"
#include "io/batch/batch_values.hpp"
#include "io/files/text_files.hpp"
#include "io/scenario/node_texts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <span>
#include <tuple>

namespace sturz {
namespace {

const BatchKey* find_key(std::span<const BatchKey> keys, const std::string& name) {
  const auto found =
      std::find_if(keys.begin(), keys.end(), [&](const BatchKey& k) { return name == k.name; });
  return found == keys.end() ? nullptr : &*found;
}

std::vector<std::string> names_of(std::span<const BatchKey> keys) {
  std::vector<std::string> names;
  for (const BatchKey& key : keys) names.emplace_back(key.name);
  return names;
}

/// "a-0123abcd" would be taken for results of "a".
bool ends_like_results(const std::string& text) {
  constexpr std::size_t digits = 8;
  return text.size() > digits && text[text.size() - digits - 1] == '-' &&
         text.find_first_not_of("0123456789abcdef", text.size() - digits) == std::string::npos;
}

bool is_name(const std::string& text) {
  return !text.empty() && text.size() <= 100 && text.front() != '.' && text.front() != '-' &&
         std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                  c == '.' || c == '_' || c == '-';
         });
}

class BatchReader {
 public:
  explicit BatchReader(FileProblems& problems) : problems_(problems) {}

  BatchSpec read(const YamlNode& root) {
    if (root.kind != YamlNode::Kind::map) {
      add_mismatch("the list", root, "keys, jobs first", "", problems_);
      return std::move(spec_);
    }
    if (const YamlEntry* defaults = root.find("defaults"))
      read_job("defaults", defaults->value, defaults_, true);
    for (const YamlEntry& entry : root.entries) read_key(entry);
    if (root.find("jobs") == nullptr)
      problems_.push_back({root.at,
                           "jobs (is missing). Add jobs: [{name: north, scenario: "
                           "north.yaml}]."});
    return std::move(spec_);
  }

 private:
  void read_key(const YamlEntry& entry) {
    const BatchKey* key = find_key(batch_keys, entry.key);
    if (key == nullptr)
      return problems_.push_back(
          {entry.at, unknown_text("the list", entry.key, names_of(batch_keys))});
    const YamlNode& node = entry.value;
    if (entry.key == "jobs") read_jobs(node);
    if (entry.key == "results")
      keep(read_text(entry.key, "a folder", node, problems_), spec_.results);
    if (entry.key == "max_workers")
      keep(read_whole(entry.key, *key, node, problems_), spec_.max_workers);
    if (entry.key == "between")
      if (const auto window = read_window(entry.key, node, problems_)) spec_.between = window;
    if (entry.key == "wait") keep(read_flag(entry.key, node, problems_), spec_.wait);
    if (entry.key == "stop_file")
      keep(read_text(entry.key, "a file name", node, problems_), spec_.stop_file);
    if (entry.key == "nice") keep(read_whole(entry.key, *key, node, problems_), spec_.nice);
    if (entry.key == "min_free_disk_gb")
      keep(read_amount(entry.key, *key, node, problems_), spec_.min_free_disk_gb);
    if (entry.key == "max_memory_gb")
      keep(read_amount(entry.key, *key, node, problems_), spec_.max_memory_gb);
    if (entry.key == "keep") keep(read_whole(entry.key, *key, node, problems_), spec_.keep);
  }

  template <class Value>
  static void keep(const std::optional<Value>& read, Value& to) {
    if (read) to = *read;
  }

  void read_jobs(const YamlNode& node) {
    if (node.kind != YamlNode::Kind::list || node.items.empty())
      return add_mismatch("jobs", node, "a list of {name: north, scenario: north.yaml}", "",
                          problems_);
    if (node.items.size() > most_jobs)
      problems_.push_back({node.at, fmt::format("jobs (has {} entries, at most {} are read). Make "
                                                "several lists.",
                                                node.items.size(), most_jobs)});
    std::map<std::string, Position> names;
    for (std::size_t i = 0; i < std::min<std::size_t>(node.items.size(), most_jobs); ++i) {
      BatchEntry job = defaults_;
      read_job(fmt::format("jobs[{}]", i), node.items[i], job, false);
      const auto [first, is_new] = names.emplace(job.name, job.at);
      if (!is_new && !job.name.empty())
        problems_.push_back({job.at, fmt::format("{}.name = {} (is also that of the job in line "
                                                 "{}). Results go by the name.",
                                                 job.path, job.name, first->second.line)});
      spec_.jobs.push_back(std::move(job));
    }
  }

  void read_job(const std::string& path, const YamlNode& node, BatchEntry& job, bool is_default) {
    job.path = path;
    job.at = node.at;
    if (node.kind != YamlNode::Kind::map)
      return add_mismatch(path, node, "keys, such as {name: north, scenario: north.yaml}", "",
                          problems_);
    for (const YamlEntry& entry : node.entries) {
      const BatchKey* key = find_key(job_keys, entry.key);
      if (key == nullptr || (is_default && !is_for_defaults(*key)))
        problems_.push_back({entry.at, unknown_text(path, entry.key, names_of(job_keys))});
      else
        read_job_key(path + "." + entry.key, *key, entry.value, job);
    }
    if (is_default) return;
    if (node.find("name") == nullptr)
      problems_.push_back({node.at, path + " (name is missing). Add it."});
    if (job.scenario.empty() && node.find("scenario") == nullptr)
      problems_.push_back({node.at, path + " (scenario is missing). Add it, or to defaults."});
    if (job.single_run && job.members > 0)
      problems_.push_back({node.at, path + " (mode: run has no members). Remove one of them."});
  }

  void read_job_key(const std::string& path, const BatchKey& key, const YamlNode& node,
                    BatchEntry& job) {
    const std::string_view name = key.name;
    if (name == "name") read_name(path, node, job);
    if (name == "scenario") {
      keep(read_text(path, file_name, node, problems_), job.scenario);
      job.scenario_at = node.at;
    }
    if (name == "folder") {
      keep(read_text(path, "a folder", node, problems_), job.folder);
      job.folder_at = node.at;
    }
    if (name == "mode") keep(read_mode(path, node, problems_), job.single_run);
    if (name == "members") keep(read_whole(path, key, node, problems_), job.members);
    if (name == "features") {
      job.each_feature = false;
      job.features.clear();
      read_features(path, node, job, problems_);
    }
    if (name == "set")
      for (BatchValue& value : read_changes(path, node, problems_)) put(job.set, std::move(value));
  }

  void read_name(const std::string& path, const YamlNode& node, BatchEntry& job) {
    const auto text = read_text(path, "a name", node, problems_);
    if (!text) return;
    job.name = *text;
    if (ends_like_results(*text))
      problems_.push_back({node.at, fmt::format("{} = {} (ends as a folder of results does, in '-' "
                                                "and eight hexadecimal digits). Choose another.",
                                                path, *text)});
    if (!is_name(*text))
      problems_.push_back({node.at, fmt::format("{} = {} (must be letters, digits, '.', '_' and "
                                                "'-', at most 100 of them: folders are called so).",
                                                path, node.shown())});
  }

  /// In the place of a default of the same key.
  static void put(std::vector<BatchValue>& set, BatchValue value) {
    const auto same = std::find_if(set.begin(), set.end(),
                                   [&](const BatchValue& v) { return v.key == value.key; });
    if (same != set.end()) set.erase(same);
    set.push_back(std::move(value));
  }

  FileProblems& problems_;
  BatchSpec spec_;
  BatchEntry defaults_;
};

}  // namespace

BatchSpec parse_batch(std::string_view text, const std::string& name,
                      std::vector<std::string>& problems) {
  FileProblems found;
  BatchSpec spec;
  if (const auto root = parse_yaml(text, name, found)) spec = BatchReader(found).read(*root);
  spec.source = name;
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return std::tuple(a.at.line, a.at.column) < std::tuple(b.at.line, b.at.column);
  });
  for (const FileProblem& p : found)
    problems.push_back(fmt::format("{}: {}", p.at.text(), p.message));
  std::erase_if(spec.jobs,
                [](const BatchEntry& job) { return job.name.empty() || job.scenario.empty(); });
  return spec;
}

BatchSpec parse_batch(std::string_view text, const std::string& name) {
  std::vector<std::string> problems;
  BatchSpec spec = parse_batch(text, name, problems);
  require(problems.empty(), fmt::format("{}", fmt::join(problems, "\n")));
  return spec;
}

BatchSpec read_batch(const std::filesystem::path& file, std::vector<std::string>& problems) {
  return parse_batch(sturz::read_text(file), file.string(), problems);
}

}  // namespace sturz
