// SPDX-License-Identifier: Apache-2.0
#include "io/scenario/yaml_tree.hpp"

#include "io/files/plain_text.hpp"
#include "io/scenario/binary_text.hpp"
#include "scenarios/schema/value_text.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <exception>
#include <sstream>
#include <utility>

namespace sturz {
namespace {

/// Thrown out of the event handler: the rest of the text is not worth reading.
struct Stop : std::exception {};

/// Turns yaml-cpp's events into the tree. Refusals happen here, before anything is built.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(std::string source, std::vector<FileProblem>& problems)
      : source_(std::move(source)), problems_(problems) {}

  YamlNode take_root() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (std::exchange(started_, true))
      refuse(mark, "a second document (one file is one scene). Remove everything after '---'.");
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    no_anchor(mark, anchor);
    if (expects_key()) refuse(mark, "a key is missing before ':'.");
    YamlNode node;
    // The mark of an absent value lies on a later line: its key's place says more.
    node.at = open_.empty() || pending_.empty() || !has_pending() ? at(mark) : pending_.back().at;
    add(std::move(node));
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    refuse(mark, "an alias '*' (not allowed in scenario files). Write the value out.");
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    no_anchor(mark, anchor);
    no_tag(mark, tag);
    if (expects_key()) return add_key(mark, value);
    YamlNode node;
    node.kind = YamlNode::Kind::scalar;
    node.at = at(mark);
    node.text = value;
    node.quoted = tag == "!";
    add(std::move(node));
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, YamlNode::Kind::list);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, YamlNode::Kind::map);
  }
  void OnMapEnd() override { close(); }

 private:
  /// A key whose value has not come yet.
  struct Pending {
    std::string key;
    Position at;
    bool filled = false;
  };

  Position at(const YAML::Mark& mark) const { return {source_, mark.line + 1, mark.column + 1}; }

  [[noreturn]] void refuse(const YAML::Mark& mark, const std::string& message) {
    problems_.push_back({at(mark), message});
    throw Stop();
  }
  void no_anchor(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (anchor != 0)
      refuse(mark, "an anchor '&' (not allowed in scenario files). Write the value out.");
  }
  void no_tag(const YAML::Mark& mark, const std::string& tag) {
    if (!tag.empty() && tag != "?" && tag != "!")
      refuse(mark, "the tag " + quoted_text(tag) + " (not allowed in scenario files). Remove it.");
  }

  bool has_pending() const { return pending_.back().filled; }
  bool expects_key() const {
    return !open_.empty() && open_.back().kind == YamlNode::Kind::map && !has_pending();
  }

  void add_key(const YAML::Mark& mark, const std::string& key) {
    if (key == "<<")
      refuse(mark, "a merge key '<<' (not allowed in scenario files). Write the keys out.");
    pending_.back() = {key, at(mark), true};
  }

  void open(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
            YamlNode::Kind kind) {
    no_anchor(mark, anchor);
    no_tag(mark, tag);
    if (expects_key())
      refuse(mark, "a list or map as a key (keys are names). Is every bracket closed?");
    if (open_.size() >= max_yaml_depth)
      refuse(mark, "nested deeper than " + std::to_string(max_yaml_depth) +
                       " levels (no scenario needs that). Check brackets and indentation.");
    YamlNode node;
    node.kind = kind;
    node.at = at(mark);
    open_.push_back(std::move(node));
    pending_.emplace_back();
  }

  void close() {
    YamlNode node = std::move(open_.back());
    open_.pop_back();
    pending_.pop_back();
    add(std::move(node));
  }

  void add(YamlNode node) {
    if (open_.empty()) {
      root_ = std::move(node);
      return;
    }
    YamlNode& parent = open_.back();
    if (parent.kind == YamlNode::Kind::list) {
      parent.items.push_back(std::move(node));
      return;
    }
    Pending key = std::exchange(pending_.back(), {});
    if (const YamlEntry* first = parent.find(key.key))
      problems_.push_back({key.at, quoted_text(key.key) + " (stands here twice, first in line " +
                                       std::to_string(first->at.line) + "). Keep one of them."});
    else
      parent.entries.push_back({std::move(key.key), std::move(key.at), std::move(node)});
  }

  std::string source_;
  std::vector<FileProblem>& problems_;
  bool started_ = false;
  YamlNode root_;
  std::vector<YamlNode> open_;    ///< lists and maps that are not closed yet
  std::vector<Pending> pending_;  ///< one for each of them
};

/// Whether a tab stands before the first word of a line, counted from 0.
bool is_indented_by_tab(std::string_view text, int line) {
  std::size_t start = 0;
  for (int i = 0; i < line; ++i) {
    const std::size_t end = text.find('\n', start);
    if (end == std::string_view::npos) return false;
    start = end + 1;
  }
  const std::size_t word = text.find_first_not_of(" \t", start);
  return text.substr(start, word == std::string_view::npos ? word : word - start).find('\t') !=
         std::string_view::npos;
}

/// The YAML reader's own words, and what is behind those that users meet most.
/// \param line where it stopped, counted from 0
std::string unreadable_text(const std::string& message, std::string_view whole, int line) {
  const std::string text = "not readable as YAML (" + one_line(message, 120) + "). ";
  for (const int at : {line, line - 1})
    if (at >= 0 && is_indented_by_tab(whole, at))
      return text + "Line " + std::to_string(at + 1) +
             " is indented by a tab; YAML knows blanks only. Replace tabs by blanks.";
  if (message.find("illegal map value") != std::string::npos)
    return text +
           "A text with a colon and a blank in it must stand in quotes: title: \"North: second "
           "try\". Or is the indentation of this line wrong?";
  return text + "Check indentation, brackets and quotes.";
}

void append_shown(const YamlNode& node, std::string& text) {
  constexpr std::size_t enough = 60;
  if (text.size() > enough) return;
  switch (node.kind) {
    case YamlNode::Kind::empty:
      text += "(nothing)";
      return;
    case YamlNode::Kind::scalar:
      text += node.quoted ? quoted_text(node.text) : node.text;
      return;
    case YamlNode::Kind::list:
      text += '[';
      for (const auto& item : node.items) {
        if (&item != &node.items.front()) text += ", ";
        append_shown(item, text);
      }
      text += ']';
      return;
    case YamlNode::Kind::map:
      text += '{';
      for (const auto& entry : node.entries) {
        if (&entry != &node.entries.front()) text += ", ";
        text += entry.key + ": ";
        append_shown(entry.value, text);
      }
      text += '}';
  }
}

}  // namespace

std::string Position::text() const {
  if (line == 0) return source;
  return source + ":" + std::to_string(line) + ":" + std::to_string(column);
}

const YamlEntry* YamlNode::find(const std::string& key) const {
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [&](const YamlEntry& entry) { return entry.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

YamlEntry* YamlNode::find(const std::string& key) {
  return const_cast<YamlEntry*>(std::as_const(*this).find(key));
}

std::string YamlNode::shown() const {
  std::string line;
  append_shown(*this, line);
  return one_line(line, 64);
}

std::optional<YamlNode> parse_yaml(std::string_view text, const std::string& source,
                                   std::vector<FileProblem>& problems) {
  const Position whole{source, 0, 0};
  if (looks_binary(text)) {
    problems.push_back({whole, binary_words});
    return std::nullopt;
  }
  if (text.size() > max_yaml_bytes) {
    problems.push_back({whole, "is " + std::to_string(text.size()) +
                                   " bytes long (a scenario file may have 65536). Move large "
                                   "tables into files of their own."});
    return std::nullopt;
  }
  if (const auto bad = first_unreadable(text)) {
    problems.push_back(
        {{source, bad->line, bad->column},
         "a byte that is not UTF-8 text (" + bad->what + "). Save the file as plain UTF-8 text."});
    return std::nullopt;
  }
  std::istringstream stream{std::string(text)};
  TreeBuilder builder(source, problems);
  try {
    YAML::Parser parser(stream);
    const bool any = parser.HandleNextDocument(builder);
    if (!any) {
      problems.push_back({whole,
                          "is empty (a scenario needs terrain, release, grains or "
                          "a fluid, and numerics). Start from a shipped case."});
      return std::nullopt;
    }
    parser.HandleNextDocument(builder);  // a second one is refused
  } catch (const Stop&) {
    return std::nullopt;  // its problem is noted
  } catch (const YAML::Exception& e) {
    problems.push_back(
        {{source, e.mark.line + 1, e.mark.column + 1}, unreadable_text(e.msg, text, e.mark.line)});
    return std::nullopt;
  }
  return builder.take_root();
}

}  // namespace sturz
