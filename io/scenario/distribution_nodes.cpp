// SPDX-License-Identifier: Apache-2.0
#include "io/scenario/distribution_nodes.hpp"

#include "engine/core/error.hpp"
#include "scenarios/schema/suggest.hpp"

#include <algorithm>

namespace sturz {
namespace {

using Kind = Distribution::Kind;
using Names = std::vector<const char*>;

void assign(Distribution& d, const std::string& name, double value) {
  if (name == "min")
    d.min = value;
  else if (name == "max")
    d.max = value;
  else if (name == "mean")
    d.mean = value;
  else if (name == "sd")
    d.sd = value;
  else if (name == "median")
    d.median = value;
  else if (name == "sigma_ln")
    d.sigma_ln = value;
  else if (name == "mode")
    d.mode = value;
  else if (name == "alpha")
    d.alpha = value;
  else if (name == "beta")
    d.beta = value;
  else
    expect(false, "every parameter of a form has a place in Distribution");
}

bool contains(const Names& names, const std::string& name) {
  return std::any_of(names.begin(), names.end(), [&](const char* n) { return name == n; });
}

std::string form_text(const DistributionForm& form) {
  std::string text;
  if (!form.list.empty()) text.append("[").append(comma_separated(form.list)).append("]");
  if (!form.list.empty() && !form.required.empty()) text += " or ";
  if (!form.required.empty()) text.append("{").append(comma_separated(form.required)).append("}");
  if (!form.optional.empty()) text.append(", optional ").append(comma_separated(form.optional));
  return text;
}

/// {values: [..], weights: [..]}
bool read_discrete(const std::string& path, const YamlNode& node, Distribution& d,
                   FileProblems& problems) {
  bool good = true;
  for (const auto& entry : node.entries) {
    const auto numbers = read_numbers(path + "." + entry.key, entry.value, problems);
    good = good && numbers;
    if (numbers) (entry.key == "values" ? d.values : d.weights) = *numbers;
  }
  return good;
}

/// Unknown and missing names of {name: value}.
bool check_names(const std::string& path, const DistributionForm& form, const YamlNode& node,
                 FileProblems& problems) {
  bool good = true;
  std::vector<std::string> known(form.required.begin(), form.required.end());
  known.insert(known.end(), form.optional.begin(), form.optional.end());
  for (const auto& entry : node.entries) {
    if (contains(form.required, entry.key) || contains(form.optional, entry.key)) continue;
    const std::string near = nearest_name(entry.key, known);
    problems.push_back(
        {entry.at,
         path + "." + entry.key + " (unknown parameter of " + form.name + "). " +
             (near.empty() ? "It takes " + form_text(form) + "." : "Did you mean " + near + "?")});
    good = false;
  }
  for (const char* name : form.required) {
    const bool there = std::any_of(node.entries.begin(), node.entries.end(),
                                   [&](const YamlEntry& e) { return e.key == name; });
    if (there) continue;
    problems.push_back(
        {node.at, path + " (" + name + " is missing). It takes " + form_text(form) + "."});
    good = false;
  }
  return good;
}

bool read_map(const std::string& path, const DistributionForm& form, const YamlNode& node,
              Distribution& d, FileProblems& problems) {
  if (!check_names(path, form, node, problems)) return false;
  if (form.kind == Kind::discrete) return read_discrete(path, node, d, problems);
  bool good = true;
  for (const auto& entry : node.entries) {
    const auto value = read_number(path + "." + entry.key, entry.value, "a number", problems);
    good = good && value;
    if (value) assign(d, entry.key, *value);
  }
  return good;
}

bool read_list(const std::string& path, const DistributionForm& form, const YamlNode& node,
               Distribution& d, FileProblems& problems) {
  const auto numbers = read_numbers(path, node, problems);
  if (!numbers) return false;
  if (form.kind == Kind::table) {  // observations have no order of their own
    d.values = *numbers;
    std::sort(d.values.begin(), d.values.end());
    return true;
  }
  if (numbers->size() != form.list.size()) {
    add_mismatch(path, node, form_text(form), "", problems);
    return false;
  }
  for (std::size_t i = 0; i < numbers->size(); ++i) assign(d, form.list[i], (*numbers)[i]);
  return true;
}

const DistributionForm* find_form(const std::string& path, const YamlEntry& entry,
                                  FileProblems& problems) {
  std::vector<std::string> names;
  for (const auto& form : distribution_forms()) {
    if (entry.key == form.name) return &form;
    names.emplace_back(form.name);
  }
  const std::string near = nearest_name(entry.key, names);
  problems.push_back({entry.at, path + " = {" + entry.key + ": ...} (unknown distribution). " +
                                    (near.empty() ? "Known: " + comma_separated(names) + "."
                                                  : "Did you mean " + near + "?")});
  return nullptr;
}

}  // namespace

const std::vector<DistributionForm>& distribution_forms() {
  static const std::vector<DistributionForm> forms = {
      {"uniform", Kind::uniform, {"min", "max"}, {"min", "max"}, {}},
      {"log_uniform", Kind::log_uniform, {"min", "max"}, {"min", "max"}, {}},
      {"normal", Kind::normal, {}, {"mean", "sd"}, {"min", "max"}},
      {"truncated_normal", Kind::normal, {}, {"mean", "sd", "min", "max"}, {}},
      {"lognormal", Kind::lognormal, {}, {"median", "sigma_ln"}, {"min", "max"}},
      {"triangular", Kind::triangular, {"min", "mode", "max"}, {"min", "mode", "max"}, {}},
      {"beta", Kind::beta, {}, {"alpha", "beta", "min", "max"}, {}},
      {"discrete", Kind::discrete, {}, {"values"}, {"weights"}},
      {"table", Kind::table, {"observation", "observation", "..."}, {}, {}},
  };
  return forms;
}

std::optional<Distribution> read_distribution(const std::string& path, const YamlNode& node,
                                              FileProblems& problems) {
  if (node.entries.size() != 1) {
    add_mismatch(path, node, "a number or one distribution, {uniform: [a, b]}", "", problems);
    return std::nullopt;
  }
  const YamlEntry& entry = node.entries.front();
  const auto* form = find_form(path, entry, problems);
  if (!form) return std::nullopt;
  Distribution d;
  d.kind = form->kind;
  const std::string inner = path + "." + entry.key;
  const bool list = entry.value.kind == YamlNode::Kind::list && !form->list.empty();
  const bool map = entry.value.kind == YamlNode::Kind::map && !form->required.empty();
  if (!list && !map) {
    add_mismatch(inner, entry.value, form_text(*form), "", problems);
    return std::nullopt;
  }
  const bool good = list ? read_list(inner, *form, entry.value, d, problems)
                         : read_map(inner, *form, entry.value, d, problems);
  if (!good) return std::nullopt;
  return d;
}

}  // namespace sturz
