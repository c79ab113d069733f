// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/measure/history.hpp"

#include "engine/core/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <tuple>
#include <utility>

namespace sturz::bench {
namespace {

using nlohmann::ordered_json;

/// A figure as one run of one machine found it.
struct Seen {
  std::string date, commit;
  double value = 0, low = 0, high = 0;
  bool more_is_better = true, busy = false;
};
using Series = std::map<std::tuple<std::string, std::string, std::string>, std::vector<Seen>>;

/// Others kept more than this many cores busy: ratios by the wall clock are then worth little.
constexpr double busy_cores = 0.1;

std::string machine_of(const ordered_json& line) {
  const ordered_json& m = line.at("machine");
  return fmt::format("{}, {} cores, {}", m.at("processor").get<std::string>(),
                     m.at("cores").get<int>(), m.at("instruction_set").get<std::string>());
}

/// What a file holds, and which of its lines are left out.
struct History {
  Series series;
  int records = 0;
  std::vector<std::string> left_out;  // "line 3 (cut off)"
};

/// A figure that was no number is written as null: it tells nothing, and its run still counts.
bool is_number(const ordered_json& figure) {
  return figure.at("value").is_number() && figure.at("low").is_number() &&
         figure.at("high").is_number();
}

/// All of a record or, by an exception, nothing.
void take(const ordered_json& line, int n, History& history) {
  const ordered_json& m = line.at("machine");
  const std::string command = fmt::format("{}{}", line.at("command").get<std::string>(),
                                          line.at("quick").get<bool>() ? " --quick" : "");
  std::vector<std::pair<Series::key_type, Seen>> found;
  std::vector<std::string> without;
  for (const ordered_json& f : line.at("figures")) {
    const std::string name = f.at("name").get<std::string>();
    if (!is_number(f)) {
      without.push_back(fmt::format("{} of line {} (not a number)", name, n));
      continue;
    }
    found.push_back(
        {{machine_of(line), command, name},
         {m.at("date").get<std::string>().substr(0, 10),
          m.at("commit").get<std::string>().substr(0, 7), f.at("value").get<double>(),
          f.at("low").get<double>(), f.at("high").get<double>(), f.at("more_is_better").get<bool>(),
          line.at("others_cores").get<double>() > busy_cores}});
  }
  for (auto& [key, seen] : found) history.series[key].push_back(std::move(seen));
  history.left_out.insert(history.left_out.end(), without.begin(), without.end());
  ++history.records;
}

History read(const std::string& text) {
  History history;
  std::istringstream in(text);
  int n = 0;
  for (std::string line; std::getline(in, line);) {
    ++n;
    if (line.empty()) continue;
    try {
      take(ordered_json::parse(line), n, history);
    } catch (const ordered_json::exception&) {
      // Only the last line has no end, where a writer was cut off.
      history.left_out.push_back(
          fmt::format("line {} ({})", n, in.eof() ? "cut off" : "no record of sturz_bench"));
    }
  }
  require(!history.series.empty(),
          fmt::format("no records ({}). Make one: sturz_bench throughput --history FILE",
                      history.left_out.empty() ? std::string("an empty history")
                                               : history.left_out.front()));
  return history;
}

/// One sentence on all that was left out; empty: nothing was.
std::string left_out_text(const History& history) {
  constexpr std::size_t most = 5;
  if (history.left_out.empty()) return {};
  std::string text = fmt::format("Left out, beside {} whole records: ", history.records);
  for (std::size_t i = 0; i < std::min(most, history.left_out.size()); ++i)
    text += (i > 0 ? ", " : "") + history.left_out[i];
  if (history.left_out.size() > most)
    text += fmt::format(" and {} more", history.left_out.size() - most);
  return text + ". Take them out, or leave them: the others count.";
}

/// What changed from one run to a later one, in words.
std::string verdict(const Seen& before, const Seen& last) {
  if (last.low <= before.high && before.low <= last.high) return "as before";
  const bool better = (last.value > before.value) == last.more_is_better;
  std::string words = better ? "better" : "worse";
  if (before.busy || last.busy) words += " (busy machine)";
  return words;
}

/// A figure that was taken once has no interval of its own.
Seen with_interval(Seen s) {
  constexpr double once = 0.05;
  if (s.low >= s.high) s.low = (1 - once) * s.value, s.high = (1 + once) * s.value;
  return s;
}

std::string shown(const Seen& s) {
  return fmt::format("{:.3g} [{:.3g}, {:.3g}], {} {}", s.value, s.low, s.high, s.date, s.commit);
}

}  // namespace

std::string history_line(const Report& report, const ordered_json& all) {
  ordered_json line;
  for (const char* key : {"machine", "command", "quick", "pairs", "load_before", "others_cores"})
    line[key] = all.at(key);
  line["figures"] = ordered_json::array();
  for (const Figure& f : report.figures)
    line["figures"].push_back({{"name", f.name},
                               {"value", f.value},
                               {"low", f.low},
                               {"high", f.high},
                               {"more_is_better", f.more_is_better}});
  return line.dump();
}

bool append_history(const std::string& file, const std::string& line) {
  // A record after one that was cut off begins a line of its own.
  std::ifstream before(file, std::ios::binary | std::ios::ate);
  bool cut = false;
  if (before && before.tellg() > 0) {
    before.seekg(-1, std::ios::end);
    cut = before.get() != '\n';
  }
  std::ofstream out(file, std::ios::app);
  out << (cut ? "\n" : "") << line << "\n";
  return static_cast<bool>(out.flush());
}

Report history_report(const std::string& text) {
  Report report;
  std::string machine;
  std::vector<Table> tables;
  const History history = read(text);
  for (const auto& [key, seen] : history.series) {
    const auto& [on, command, figure] = key;
    if (on != machine || tables.empty()) {
      machine = on;
      tables.emplace_back(fmt::format("history_{}", tables.size()), on,
                          std::vector<Column>{{"command", "command"},
                                              {"figure", "figure"},
                                              {"runs", "runs"},
                                              {"first", "first"},
                                              {"last", "last"},
                                              {"change", "change %"},
                                              {"since_first", "since the first"},
                                              {"since_before", "since the run before"}});
    }
    const bool one = seen.size() < 2;
    const Seen first = with_interval(seen.front()), last = with_interval(seen.back());
    const Seen before = with_interval(seen[one ? 0 : seen.size() - 2]);
    tables.back().add({cell(command), cell(figure), cell(seen.size()), cell(shown(first)),
                       cell(one ? "-" : shown(last)),
                       one ? cell("-") : cell(100 * (last.value / first.value - 1), 1),
                       cell(one ? "-" : verdict(first, last)),
                       cell(one ? "-" : verdict(before, last))});
  }
  report.tables = std::move(tables);
  report.notes = {
      "Better and worse: the 95 % intervals of the two runs do not meet (a figure that was taken "
      "once counts as good to 5 %). In the order of the file; "
      "machines are compared with themselves alone."};
  if (std::string left = left_out_text(history); !left.empty())
    report.notes.push_back(std::move(left));
  return report;
}

}  // namespace sturz::bench
