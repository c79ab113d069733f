// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/batch/batch_state.hpp"

#include "io/files/io_error.hpp"
#include "io/files/text_files.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>

namespace sturz::workflow {
namespace {

using Json = nlohmann::ordered_json;

constexpr int format_version = 1;
constexpr std::array<const char*, 6> ends{"none",   "running", "interrupted",
                                          "failed", "done",    "too_many_failed"};

JobEnd end_from(const std::string& word) {
  for (std::size_t i = 0; i < ends.size(); ++i)
    if (word == ends[i]) return static_cast<JobEnd>(i);
  return JobEnd::none;
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
double number_from(const Json& value) { return value.is_number() ? value.get<double>() : nan_d; }

template <std::size_t n>
Json numbers(const std::array<double, n>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(number(value));
  return list;
}
template <std::size_t n>
void numbers_from(const Json& list, std::array<double, n>& values) {
  for (std::size_t i = 0; i < n; ++i) values[i] = number_from(list.at(i));
}

Json json_of(const BatchFigures& f) {
  Json assets = Json::array();
  for (const AssetChance& a : f.assets)
    assets.push_back({{"name", a.name}, {"probability", number(a.probability)}});
  return {{"planned", f.planned},
          {"finished", f.finished},
          {"valid", f.valid},
          {"censored", f.censored},
          {"runout_m", numbers(f.runout_m)},
          {"runout_at_least", f.at_least},
          {"area_m2", numbers(f.area_m2)},
          {"assets", assets},
          {"core_s", f.core_s},
          {"hazard_hash", f.hazard_hash}};
}

BatchFigures figures_from(const Json& all) {
  BatchFigures f;
  f.planned = all.at("planned").get<std::int64_t>();
  f.finished = all.at("finished").get<std::int64_t>();
  f.valid = all.at("valid").get<std::int64_t>();
  f.censored = all.at("censored").get<std::int64_t>();
  numbers_from(all.at("runout_m"), f.runout_m);
  f.at_least = all.at("runout_at_least").get<std::array<bool, 3>>();
  numbers_from(all.at("area_m2"), f.area_m2);
  for (const Json& a : all.at("assets"))
    f.assets.push_back({a.at("name").get<std::string>(), number_from(a.at("probability"))});
  f.core_s = all.at("core_s").get<double>();
  f.hazard_hash = all.at("hazard_hash").get<std::string>();
  return f;
}

Json json_of(const JobRecord& r) {
  Json stamps = Json::array();
  for (const FileStamp& s : r.stamps)
    stamps.push_back({s.path, s.bytes, s.inode, s.written_ns, s.changed_ns});
  Json all = {{"end", ends.at(static_cast<std::size_t>(r.end))},
              {"fingerprint", r.fingerprint},
              {"build", r.build},
              {"files", r.has_stamps ? stamps : Json(nullptr)},
              {"looked_ns", r.looked_ns},
              {"folder", r.folder},
              {"message", r.message},
              {"utilisation", number(r.utilisation)}};
  if (r.figures) all["figures"] = json_of(*r.figures);
  return all;
}

JobRecord record_from(const Json& all) {
  JobRecord r;
  r.end = end_from(all.at("end").get<std::string>());
  r.fingerprint = all.at("fingerprint").get<std::string>();
  r.build = all.at("build").get<std::string>();
  r.has_stamps = all.at("files").is_array();
  if (r.has_stamps)
    for (const Json& s : all.at("files"))
      r.stamps.push_back({s.at(0).get<std::string>(), s.at(1).get<std::uint64_t>(),
                          s.at(2).get<std::uint64_t>(), s.at(3).get<std::int64_t>(),
                          s.at(4).get<std::int64_t>()});
  r.looked_ns = all.at("looked_ns").get<std::int64_t>();
  r.folder = all.at("folder").get<std::string>();
  r.message = all.at("message").get<std::string>();
  r.utilisation = number_from(all.at("utilisation"));
  if (all.contains("figures")) r.figures = figures_from(all.at("figures"));
  return r;
}

}  // namespace

void BatchState::write(const std::filesystem::path& file) const {
  Json list = Json::object();
  for (const auto& [name, record] : jobs) list[name] = json_of(record);
  const Json all = {{"what", "what `sturz batch` remembers; delete it and all is looked at anew"},
                    {"format", format_version},
                    {"outlines_of", outlines_of},
                    {"jobs", list}};
  write_text_atomic(file, all.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

BatchState BatchState::read(const std::filesystem::path& file) {
  std::error_code failed;
  if (!std::filesystem::exists(file, failed)) return {};
  try {
    const Json all = Json::parse(read_text(file));
    if (all.at("format").get<int>() != format_version) return {};
    BatchState state;
    state.outlines_of = all.at("outlines_of").get<std::string>();
    for (const auto& [name, record] : all.at("jobs").items())
      state.jobs.emplace(name, record_from(record));
    return state;
  } catch (const Json::exception&) {
    return {};
  } catch (const IoError&) {
    return {};
  }
}

}  // namespace sturz::workflow
