// SPDX-License-Identifier: Apache-2.0
// What a step costs, what an absent effect costs, how members scale.
#include "tests/bench/commands.hpp"
#include "tests/bench/measure/history.hpp"
#include "tests/bench/measure/machine.hpp"
#include "tests/bench/measure/markdown.hpp"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

namespace {

using sturz::bench::Options;
using sturz::bench::Report;

struct Command {
  const char* name;
  const char* help;
  Report (*run)(const Options&);
};

constexpr Command commands[] = {
    {"throughput", "Particle-updates per second of one core", sturz::bench::throughput},
    {"scaling", "Cost of a particle-update from 1k to 1M particles", sturz::bench::scaling},
    {"threads", "One member on one and on all processors", sturz::bench::threads},
    {"ensemble", "Members per hour and what the runner costs", sturz::bench::ensemble},
    {"absent-effects", "What effects cost that are not there", sturz::bench::absent_effects},
    {"liquid", "A dam break of liquid: particle-updates per second of one core",
     sturz::bench::liquid},
    {"merge", "Members in packs: written, read, merged", sturz::bench::merge},
    {"coupled", "Grains in a liquid: a step beside the steps of each alone", sturz::bench::coupled},
    {"hashes", "State hash of every shipped scene: what must not change", sturz::bench::hashes},
    {"hard", "Hard cases and random members against their bounds", sturz::bench::hard}};

/// Where the figures go besides the screen; empty: nowhere.
struct Files {
  std::string json, markdown, history;
};

void add_options(CLI::App& app, Options& o, Files& files) {
  app.add_option("--pairs", o.pairs, "Pairs or slices per figure")->check(CLI::Range(3, 201));
  app.add_option("--json", files.json,
                 "Write the figures as JSON to a file, or - for standard output");
  app.add_option("--markdown", files.markdown, "Write the tables as a Markdown page to a file");
  app.add_option("--history", files.history,
                 "Append the run's ratios to a file of JSON lines, one file a machine or more");
  app.add_flag("--quick", o.quick, "7 pairs and smaller scenes");
  app.add_option("--most", o.most, "Largest scene of scaling")->check(CLI::Range(2e3, 2e6));
  app.add_option("--threads", o.threads, "Threads or workers; 0: all")->check(CLI::Range(0, 256));
  app.add_option("--members", o.members, "Full-stress members; four times as many of columns")
      ->check(CLI::Range(1, 10000000));
  app.add_option("--cells", o.cells, "merge: edge of the grid")->check(CLI::Range(100, 20000));
  app.add_option("--folder", o.folder, "merge: where its packs lie meanwhile");
  app.add_option("--end-time", o.end_time_s, "Simulated time of a member [s]")
      ->check(CLI::Range(0.1, 1e4));
  app.add_flag("--full", o.full, "hard: all random members");
  app.add_option("--states", o.states, "hard: with which states of the grains")
      ->check(CLI::IsMember({"dense", "all", "both"}));
  app.add_option("--fail-below", o.fail_below,
                 "throughput: exit code 1 when dense / reference is less");
}

void print(const Report& report, std::ostream& out) {
  for (const auto& table : report.tables) out << "\n" << table.text();
  out << "\n";
  for (const auto& figure : report.figures)
    if (!figure.sentence.empty()) out << figure.sentence << "\n";
  for (const auto& note : report.notes) out << note << "\n";
}

/// \return whether it could be written; nothing is written where no file is named
bool write(const std::string& text, const std::string& file) {
  if (file.empty()) return true;
  if (file == "-") {
    std::cout << text;
    return true;
  }
  std::ofstream out(file);
  out << text;
  if (out.flush()) return true;
  std::cerr << file << ": cannot be written. Choose another file.\n";
  return false;
}

int run(const Command& command, const Options& options, const Files& files) {
  // With the figures on standard output, readers get the tables on the other one.
  std::ostream& out = files.json == "-" ? std::cerr : std::cout;
  nlohmann::ordered_json all = {{"machine", sturz::bench::machine_facts()}};
  const double load = sturz::bench::load_average();
  out << "sturz_bench " << command.name << ": " << all["machine"].dump() << "\n";
  if (all["machine"]["build_type"] != "Release") out << "warning: not a release build.\n";
  const std::string warning = sturz::bench::load_warning(load);
  if (!warning.empty()) out << warning << "\n";
  out.flush();

  const sturz::bench::Bystanders bystanders;
  const Report report = command.run(options);
  const double others = bystanders.others(), stolen = bystanders.stolen();
  print(report, out);
  out << fmt::format(
      "meanwhile others kept {:.2f} processors busy, the host took {:.2f}; "
      "load average before: {:.2f}\n",
      others, stolen, load);
  if (others > 0.1)
    out << "warning: not a quiet machine; do not trust figures by the wall clock.\n";
  all["load_before"] = load, all["others_cores"] = others, all["stolen_cores"] = stolen;
  all["command"] = command.name, all["pairs"] = options.pairs, all["quick"] = options.quick;
  for (const auto& table : report.tables) all[table.key()] = table.json();
  all["notes"] = report.notes;
  for (const auto& figure : report.figures) all["sentences"].push_back(figure.sentence);
  const std::string how =
      fmt::format("sturz_bench {}{}", command.name, options.full ? " --full" : "");
  if (!write(all.dump(2) + "\n", files.json) ||
      !write(sturz::bench::markdown_page(report, all["machine"], how), files.markdown))
    return 2;
  if (!files.history.empty() && !report.figures.empty() &&
      !sturz::bench::append_history(files.history, sturz::bench::history_line(report, all))) {
    std::cerr << files.history << ": cannot be written. Choose another file.\n";
    return 2;
  }
  if (report.failed) std::cerr << "a limit does not hold\n";
  return report.failed ? 1 : 0;
}

/// sturz_bench history FILE
int show_history(const std::string& file) {
  std::ifstream in(file);
  if (!in) {
    std::cerr << file << ": cannot be read. Make one: sturz_bench throughput --history FILE\n";
    return 2;
  }
  std::ostringstream text;
  text << in.rdbuf();
  print(sturz::bench::history_report(text.str()), std::cout);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  // As the program itself does: threads that wait sleep. OpenMP reads this before main starts.
  if (!std::getenv("OMP_WAIT_POLICY") && setenv("OMP_WAIT_POLICY", "passive", 1) == 0) {
    setenv("GOMP_SPINCOUNT", "1000", 0);
    execv("/proc/self/exe", argv);  // comes back only when it fails; then spinning it is
  }
  CLI::App app{"Times the scenes that the tests check."};
  app.require_subcommand(1);
  Options options;
  Files files;
  add_options(app, options, files);
  app.fallthrough();
  for (const Command& c : commands) app.add_subcommand(c.name, c.help);
  std::string kept;
  app.add_subcommand("history", "How the ratios of a history file moved")
      ->add_option("file", kept, "Written with --history")
      ->required();
  CLI11_PARSE(app, argc, argv);
  if (options.quick && app.count("--pairs") == 0) options.pairs = 7;
  try {
    if (app.got_subcommand("history")) return show_history(kept);
    for (const Command& c : commands)
      if (app.got_subcommand(c.name)) return run(c, options, files);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
  return 2;
}
