// SPDX-License-Identifier: Apache-2.0
// What members in packs cost by step: written, read plainly, opened, merged.
#include "engine/core/error.hpp"
#include "ensemble/hazard/hazard_map.hpp"
#include "ensemble/hazard/stack_hash.hpp"
#include "ensemble/workflow/machine/cores.hpp"
#include "ensemble/workflow/machine/temporary_folder.hpp"
#include "io/members/member_file.hpp"
#include "io/members/member_store.hpp"
#include "io/members/packs/pack_writer.hpp"
#include "tests/bench/commands.hpp"
#include "tests/bench/measure/clocks.hpp"
#include "tests/support/made_up_flows.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace sturz::bench {
namespace fs = std::filesystem;
namespace {

struct Cost {
  double wall_s = 0, cpu_s = 0;
};

template <class Work>
Cost cost_of(Work work) {
  const double cpu = thread_seconds(), wall = wall_seconds();
  work();
  return {wall_seconds() - wall, thread_seconds() - cpu};
}

/// MB of this process: now, and the most since forget_peak().
double status_mb(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(key)) return std::stod(line.substr(key.size() + 1)) / 1024;
  return 0;
}
void forget_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

/// As the disk has them, not as memory remembers them.
void forget_cached(const std::vector<fs::path>& files) {
  for (const fs::path& file : files) {
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) continue;
    ::fdatasync(descriptor);
    ::posix_fadvise(descriptor, 0, 0, POSIX_FADV_DONTNEED);
    ::close(descriptor);
  }
}

void read_plainly(const std::vector<fs::path>& files) {
  std::vector<char> block(std::size_t{1} << 20);
  for (const fs::path& file : files) {
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    while (::read(descriptor, block.data(), block.size()) > 0) {
    }
    ::close(descriptor);
  }
}

/// Every map of every member, as a program reads them that wants them all.
void read_every_map(const MemberStore& store) {
  std::vector<float> values;
  for (std::size_t i = 0; i < store.members().size(); ++i)
    for (int l = 0; l < n_peak_layers; ++l) {
      const MemberSummary& m = store.members()[i];
      if (!is_kept(static_cast<PeakLayer>(l), m.censoring, m.scalars)) continue;
      values.resize(m.window.n_cells());
      store.read_part(i, static_cast<PeakLayer>(l), m.window, values);
    }
}

/// Swallows maps.
struct NoSink final : LayerSink {
  void begin(const LayerStack& /*about*/) override {}
  void put(std::size_t /*layer*/, std::size_t /*plane*/, const Window& /*window*/,
           std::span<const float> /*values*/) override {}
};

std::string merge(const fs::path& folder) {
  const MemberStore store(folder);
  NoSink nothing;
  HashingSink hashed(nothing);
  HazardContext context;
  context.memory_bytes = workflow::records_memory_bytes();  // as every command has it
  make_hazard_map(store, HazardSpec{}, context, hashed);
  return fmt::format("{:016x}", hashed.value());
}

class Steps {
 public:
  Steps(double bytes, int members) : bytes_(bytes), members_(members) {}
  void add(const char* step, const Cost& c, double peak_mb = 0) {
    table_.add({cell(step), cell(c.wall_s, 2), cell(c.cpu_s, 2), cell(1e6 * c.cpu_s / members_, 1),
                cell(bytes_ / 1e6 / c.wall_s, 0), cell(bytes_ / 1e6 / std::max(c.cpu_s, 1e-9), 0),
                cell(peak_mb, 0)});
  }
  Table table() const { return table_; }

 private:
  double bytes_;
  int members_;
  Table table_{"steps",
               "Members in packs, step by step",
               {{"step", "step"},
                {"wall_s", "wall s"},
                {"cpu_s", "CPU s"},
                {"cpu_us_per_member", "CPU us/member"},
                {"mb_per_s_wall", "MB/s wall"},
                {"mb_per_s_cpu", "MB/s CPU"},
                {"peak_mb", "peak MB"}}};
};

/// Members k of every n to pack k, as n shards write them.
Cost write_packs(const fs::path& folder, const Options& o, int shards) {
  return cost_of([&] {
    for (int k = 1; k <= shards; ++k) {
      PackWriter writer(folder, {k, shards});
      for (int m = k - 1; m < o.members; m += shards)
        writer.append(test::made_up_flow(m, o.cells), {"sha256:0", "0", "0"});
    }
  });
}

/// One netCDF file each, of a few members: what packs stand in for.
void add_single_files(const fs::path& folder, int edge, Table& table) {
  constexpr int n = 200;
  const Cost write = cost_of([&] {
    for (int m = 0; m < n; ++m)
      write_member(folder, test::made_up_flow(m, edge), {"sha256:0", "0", "0"});
  });
  double bytes = 0;
  for (const auto& entry : fs::directory_iterator(folder))
    bytes += static_cast<double>(entry.file_size());
  const Cost open = cost_of([&] { const MemberStore store(folder); });
  const Cost all = cost_of([&] { merge(folder); });
  table.add({cell("own files"), cell(n), cell(bytes / n / 1e3, 1), cell(1e6 * write.cpu_s / n, 0),
             cell(1e6 * open.cpu_s / n, 0), cell(1e6 * all.cpu_s / n, 0)});
}

}  // namespace

Report merge(const Options& options) {
  Options o = options;
  if (o.quick) o.members = std::min(o.members, 2000);
  const workflow::TemporaryFolder scratch(o.folder);
  const fs::path folder = scratch.path() / "packs";
  const int shards = std::clamp(o.members / 1000, 1, 16);
  const Cost made = cost_of([&] {
    for (int m = 0; m < std::min(o.members, 500); ++m) test::made_up_flow(m, o.cells);
  });
  const double made_s = made.cpu_s / std::min(o.members, 500) * o.members;
  Cost written = write_packs(folder, o, shards);
  written.cpu_s -= made_s, written.wall_s -= made_s;
  const std::vector<fs::path> packs = packs_in(folder);
  double bytes = 0;
  for (const fs::path& pack : packs) bytes += static_cast<double>(fs::file_size(pack));

  Steps steps(bytes, o.members);
  steps.add("append", written);
  forget_cached(packs);
  const Cost cold = cost_of([&] { read_plainly(packs); });
  steps.add("read bytes, from disk", cold);
  const Cost warm = cost_of([&] { read_plainly(packs); });
  steps.add("read bytes, from memory", warm);
  forget_peak();
  const double before_mb = status_mb("VmRSS:");
  double store_mb = 0;
  Cost read_maps;
  const Cost opened = cost_of([&] {
    const MemberStore store(folder);
    store_mb = status_mb("VmRSS:") - before_mb;
    read_maps = cost_of([&] { read_every_map(store); });
  });
  const Cost open{opened.wall_s - read_maps.wall_s, opened.cpu_s - read_maps.cpu_s};
  steps.add("open: every checksum", open, store_mb);
  steps.add("read every map", read_maps);
  forget_cached(packs);
  forget_peak();
  std::string hash;
  const Cost merged_cold = cost_of([&] { hash = merge(folder); });
  steps.add("merge, from disk", merged_cold, status_mb("VmHWM:"));
  const Cost merged = cost_of([&] { hash = merge(folder); });
  steps.add("merge, from memory", merged);

  Table singles("layouts", "The same members in files of their own",
                {{"layout", "layout"},
                 {"members", "members"},
                 {"kb_per_member", "kB/member"},
                 {"write_us", "write us"},
                 {"open_us", "open us"},
                 {"merge_us", "open and merge us"}});
  singles.add({cell("packs"), cell(o.members), cell(bytes / o.members / 1e3, 1),
               cell(1e6 * written.cpu_s / o.members, 0), cell(1e6 * open.cpu_s / o.members, 0),
               cell(1e6 * merged.cpu_s / o.members, 0)});
  add_single_files(scratch.path() / "files", o.cells, singles);

  const double plain = open.cpu_s + read_maps.cpu_s;
  Table ratios("ratios", "Speed of the merge over that of plain reading",
               {{"plain", "plain reading"}, {"ratio", "ratio"}});
  ratios.add({cell("bytes from the disk, wall clock"), cell(cold.wall_s / merged_cold.wall_s, 3)});
  ratios.add({cell("bytes from memory, CPU"), cell(warm.cpu_s / merged.cpu_s, 3)});
  ratios.add({cell("members from memory: checked, every map, CPU"), cell(plain / merged.cpu_s, 3)});
  Report report;
  report.tables = {steps.table(), singles, ratios};
  report.tell("merge / reading every map", summarize({plain / merged.cpu_s}),
              fmt::format("A merge of {} members runs at {:.2f} of the speed of only reading and "
                          "checking them.",
                          o.members, plain / merged.cpu_s));
  report.notes = {
      fmt::format("{} members on {} x {} cells, {} packs, {:.2f} GB; hash of the maps {}.",
                  o.members, o.cells, o.cells, packs.size(), bytes / 1e9, hash),
      "Append is without the making of the members. Peak MB: of the whole process; of `open`: what "
      "the store holds. The merge opens the store, checks every byte, and makes all maps."};
  report.failed = o.fail_below > 0 && plain / merged.cpu_s < o.fail_below;
  return report;
}

}  // namespace sturz::bench
