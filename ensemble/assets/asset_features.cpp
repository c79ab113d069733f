// SPDX-License-Identifier: Apache-2.0
// Risk of assets as a table with geometries.
#include "ensemble/assets/asset_risk.hpp"

#include <utility>

namespace sturz {
namespace {

/// Adds columns row by row of what they are made from.
class Columns {
 public:
  Columns(const Assets& assets, const RiskTable& risk, FeatureTable& out)
      : assets_(assets), risk_(risk), out_(out) {}

  template <class Value, class Get>
  void of_asset(std::string name, Get get) {
    std::vector<Value> values;
    for (const Asset& a : assets_.list) values.push_back(get(a));
    out_.columns.push_back({std::move(name), std::move(values)});
  }
  template <class Value, class Get>
  void of_risk(std::string name, Get get) {
    std::vector<Value> values;
    for (const AssetRisk& r : risk_.rows) values.push_back(get(r));
    out_.columns.push_back({std::move(name), std::move(values)});
  }
  void number(std::string name, double AssetRisk::*member) {
    of_risk<double>(std::move(name), [member](const AssetRisk& r) { return r.*member; });
  }
  void count(std::string name, std::int64_t AssetRisk::*member) {
    of_risk<std::int64_t>(std::move(name), [member](const AssetRisk& r) { return r.*member; });
  }
  void bounds(const std::string& suffix, ProbabilityBounds AssetRisk::*member) {
    of_risk<double>("probability_lower_" + suffix,
                    [member](const AssetRisk& r) { return (r.*member).lower; });
    of_risk<double>("probability_upper_" + suffix,
                    [member](const AssetRisk& r) { return (r.*member).upper; });
  }
  void quantiles(const std::string& what, const std::string& unit,
                 HitQuantiles AssetRisk::*member) {
    constexpr std::array<const char*, 3> names{"_q05_", "_q50_", "_q95_"};
    for (std::size_t i = 0; i < names.size(); ++i)
      of_risk<double>(what + names[i] + unit,
                      [member, i](const AssetRisk& r) { return (r.*member)[i]; });
  }
  void expected(const std::string& name, const std::string& unit,
                ExpectedValue AssetRisk::*member) {
    of_risk<double>(name + unit, [member](const AssetRisk& r) { return (r.*member).mean; });
    of_risk<double>(name + "_standard_error" + unit,
                    [member](const AssetRisk& r) { return (r.*member).standard_error; });
  }

 private:
  const Assets& assets_;
  const RiskTable& risk_;
  FeatureTable& out_;
};

}  // namespace

FeatureTable risk_features(const Assets& assets, const RiskTable& risk,
                           const std::string& crs_wkt) {
  FeatureTable out;
  out.name = "assets";
  out.crs_wkt = crs_wkt;
  for (const Asset& a : assets.list) out.wkb.push_back(a.wkb);
  Columns columns(assets, risk, out);
  columns.of_asset<std::string>("name", [](const Asset& a) { return a.name; });
  columns.of_risk<std::string>("place", [](const AssetRisk& r) { return to_string(r.place); });
  if (assets.has_classes)
    columns.of_asset<std::string>("class", [](const Asset& a) { return a.vulnerability_class; });
  const std::string unit = "_" + assets.value_unit;
  if (assets.has_values)
    columns.of_asset<double>("value" + unit, [](const Asset& a) { return a.value; });
  columns.count("valid_members", &AssetRisk::valid);
  columns.count("hit_members", &AssetRisk::hit);
  columns.count("not_known_members", &AssetRisk::not_known);
  columns.count("hit_cut_off_members", &AssetRisk::hit_cut_off);
  columns.number("probability", &AssetRisk::probability);
  columns.bounds("90", &AssetRisk::bounds_90);
  columns.bounds("95", &AssetRisk::bounds_95);
  columns.quantiles("thickness", "m", &AssetRisk::thickness_m);
  columns.quantiles("speed", "m_s", &AssetRisk::speed_m_s);
  columns.quantiles("pressure", "kpa", &AssetRisk::pressure_kpa);
  columns.quantiles("arrival", "s", &AssetRisk::arrival_s);
  if (assets.has_classes) columns.expected("expected_damage", "", &AssetRisk::damage);
  if (assets.has_classes && assets.has_values)
    columns.expected("expected_loss", unit, &AssetRisk::loss);
  columns.of_risk<std::string>("cut_off", [](const AssetRisk& r) { return r.cut_off; });
  return out;
}

}  // namespace sturz
