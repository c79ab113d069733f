// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/region/region_record.hpp"

#include "ensemble/workflow/folder/manifest.hpp"
#include "ensemble/workflow/region/region_folder.hpp"
#include "io/batch/scene_files.hpp"
#include "io/files/checksum.hpp"
#include "io/files/io_error.hpp"
#include "io/files/text_files.hpp"
#include "io/members/member_numbers.hpp"
#include "io/scenario/scenario_file.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <system_error>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

fs::path file_of(const OutputFolder& region, const Shard& shard) {
  return region.root / (shard.n > 1 ? fmt::format("finished_{}_of_{}.json", shard.k, shard.n)
                                    : std::string("finished.json"));
}

std::vector<fs::path> files_in(const OutputFolder& region) {
  static const std::regex form(R"(finished(_\d+_of_\d+)?\.json)");
  std::vector<fs::path> files;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(region.root, failed))
    if (std::regex_match(entry.path().filename().string(), form)) files.push_back(entry.path());
  return files;
}

Json json_of(const std::vector<FileStamp>& stamps) {
  Json list = Json::array();
  for (const FileStamp& s : stamps)
    list.push_back({s.path, s.bytes, s.inode, s.written_ns, s.changed_ns});
  return list;
}

}  // namespace

RegionRecord::RegionRecord(const OutputFolder& region, const std::string& design_hash,
                           const Shard& shard)
    : region_(region), shard_(shard), looked_ns_(now_ns()) {
  const Scenario scenario = read_scenario(region.scenario());
  of_ = text_checksum(fmt::format("{}\n{}\n{}\n{}", fs::absolute(region.root).string(),
                                  write_scenario(scenario), design_hash, build_text(this_build())));
  stamps_ = stamps_of(scenario);
  if (!stamps_) return;
  for (const fs::path& file : files_in(region)) take(file);
}

/// Damaged, of another time, or written while a file was fresh: it says nothing.
void RegionRecord::take(const fs::path& file) {
  try {
    const Json all = Json::parse(read_text(file));
    const auto looked_ns = all.at("looked_ns").get<std::int64_t>();
    if (all.at("of").get<std::string>() != of_ || all.at("files") != json_of(*stamps_)) return;
    if (std::any_of(stamps_->begin(), stamps_->end(),
                    [&](const FileStamp& s) { return is_fresh(s, looked_ns); }))
      return;
    for (const Json& name : all.at("sources")) finished_.insert(name.get<std::string>());
  } catch (const Json::exception&) {
  } catch (const IoError&) {
  }
}

bool RegionRecord::is_finished(const std::string& source, std::int64_t members_per_source) const {
  if (!finished_.contains(source)) return false;
  const OutputFolder folder = source_folder(region_, source);
  std::error_code failed;
  for (const fs::path& file : {folder.manifest(), folder.scenario(), folder.design()})
    if (!fs::exists(file, failed)) return false;
  try {
    const auto n = static_cast<std::int64_t>(member_numbers_in(folder.members()).size());
    return n == members_per_source;
  } catch (const IoError&) {
    return false;  // a pack that cannot be read: who opens the source says so
  }
}

void RegionRecord::write() const {
  if (!stamps_) return;
  const Json all = {
      {"what", "sources that are finished; delete it and each of them is looked at anew"},
      {"of", of_},
      {"looked_ns", looked_ns_},
      {"files", json_of(*stamps_)},
      {"sources", finished_}};
  write_text_atomic(file_of(region_, shard_),
                    all.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

void forget_finished_sources(const OutputFolder& region) {
  std::error_code ignored;
  for (const fs::path& file : files_in(region)) fs::remove(file, ignored);
}

}  // namespace sturz::workflow
