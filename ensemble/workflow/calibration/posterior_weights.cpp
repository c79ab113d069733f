// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/calibration/posterior_weights.hpp"

#include "engine/core/error.hpp"
#include "io/files/text_files.hpp"
#include "scenarios/schema/number_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <sstream>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void damaged(const fs::path& file, const std::string& why) {
  throw SetupError(fmt::format("{} is damaged ({}). Calibrate again.", file.string(), why));
}

/// Hashes of the ensembles whose members were weighed: one, or one for each event.
std::set<std::string> weighed_members(const fs::path& file) {
  try {
    const auto all = nlohmann::json::parse(read_text(file));
    std::set<std::string> hashes{all.at("members_hash").get<std::string>()};
    for (const auto& event : all.value("events", nlohmann::json::array()))
      hashes.insert(event.at("members_hash").get<std::string>());
    return hashes;
  } catch (const nlohmann::json::exception&) {
    damaged(file, "it does not say of which members it is");
  }
}

std::map<std::int64_t, double> read_weights(const fs::path& file) {
  std::map<std::int64_t, double> weights;
  std::istringstream lines(read_text(file));
  std::string line;
  std::getline(lines, line);
  if (line != "member,weight") damaged(file, "its first line is not 'member,weight'");
  while (std::getline(lines, line)) {
    const std::size_t comma = std::min(line.find(','), line.size());
    const auto member = parse_integer(line.substr(0, comma));
    const auto weight = parse_number(line.substr(std::min(comma + 1, line.size())));
    if (!member || !weight || *weight < 0) damaged(file, fmt::format("line '{}'", line));
    if (!weights.emplace(*member, *weight).second)
      damaged(file, fmt::format("member {} stands twice", *member));
  }
  return weights;
}

}  // namespace

std::vector<double> posterior_weights(const fs::path& calibration, const std::string& of,
                                      std::span<const MemberSummary> members) {
  const fs::path file = calibration / "weights.csv", about = calibration / "posterior.json";
  require(fs::exists(file) && fs::exists(about),
          fmt::format("{} holds no weights of members (weights.csv or posterior.json is missing). "
                      "Name the folder that `sturz calibrate` wrote.",
                      calibration.string()));
  require(weighed_members(about).contains(of),
          fmt::format("{} weighs other members than those of this ensemble. Calibrate again.",
                      calibration.string()));
  const std::map<std::int64_t, double> all = read_weights(file);
  std::vector<double> weights;
  double sum = 0;
  for (const MemberSummary& m : members) {
    if (!is_valid(m.outcome)) continue;
    const auto found = all.find(m.member);
    if (found == all.end()) damaged(file, fmt::format("member {} has no weight", m.member));
    weights.push_back(found->second);
    sum += found->second;
  }
  if (!(sum > 0)) damaged(file, "the weights add up to 0");
  for (double& w : weights) w /= sum;
  return weights;
}

}  // namespace sturz::workflow
