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

void take(const ordered_json& line, Series& series) {
  const ordered_json& m = line.at("machine");
  const std::string command = fmt::format("{}{}", line.at("command").get<std::string>(),
                                          line.at("quick").get<bool>() ? " --quick" : "");
  for (const ordered_json& f : line.at("figures"))
    series[{machine_of(line), command, f.at("name").get<std::string>()}].push_back(
        {m.at("date").get<std::string>().substr(0, 10),
         m.at("commit").get<std::string>().substr(0, 7), f.at("value").get<double>(),
         f.at("low").get<double>(), f.at("high").get<double>(), f.at("more_is_better").get<bool>(),
         line.at("others_cores").get<double>() > busy_cores});
}

Series read(const std::string& text) {
  Series series;
  std::istringstream in(text);
  int n = 0;
  for (std::string line; std::getline(in, line);) {
    ++n;
    if (line.empty()) continue;
    try {
      take(ordered_json::parse(line), series);
    } catch (const ordered_json::exception& problem) {
      throw SetupError(
          fmt::format("line {}: no record of sturz_bench ({}). Take the line out, or "
                      "begin another file.",
                      n, problem.what()));
    }
  }
  require(!series.empty(),
          "no records (an empty history). Make one: sturz_bench throughput "
          "--history FILE");
  return series;
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
  std::ofstream out(file, std::ios::app);
  out << line << "\n";
  return static_cast<bool>(out.flush());
}

Report history_report(const std::string& text) {
  Report report;
  std::string machine;
  std::vector<Table> tables;
  for (auto& [key, seen] : read(text)) {
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
  return report;
}

}  // namespace sturz::bench
