// SPDX-License-Identifier: Apache-2.0
#include "ensemble/gauges/gauge_statistics.hpp"

#include "engine/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// A value lies between these; both the same where it is known.
struct Bounds {
  double low = 0, high = 0;
};

std::string number(double v) { return fmt::format("{:.6g}", v); }

double at_rank(std::vector<double> values, double fraction) {
  const auto n = static_cast<double>(values.size());
  const auto k =
      static_cast<std::size_t>(std::clamp(std::ceil(fraction * n - 1e-9) - 1, 0.0, n - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(k), values.end());
  return values[k];
}

Bounds quantile(const std::vector<Bounds>& all, double fraction) {
  std::vector<double> low, high;
  for (const Bounds& b : all) low.push_back(b.low), high.push_back(b.high);
  return {at_rank(std::move(low), fraction), at_rank(std::move(high), fraction)};
}

std::string arrival_text(const Bounds& b) {
  if (b.low == never) return "never";
  return fmt::format("{}{}", b.low == b.high ? "" : "> ", number(b.low));
}

std::string peak_text(const Bounds& b) {
  if (b.low == b.high) return b.low > 0 ? number(b.low) : "not reached";
  return b.low > 0 ? fmt::format(">= {}", number(b.low)) : "not known";
}

Bounds arrival_of(double arrival_s, double end_s, bool cut_off) {
  if (!std::isnan(arrival_s)) return {arrival_s, arrival_s};
  return {cut_off ? end_s : never, never};
}

Bounds peak_of(double peak, bool cut_off) {
  const double so_far = std::isnan(peak) ? 0 : peak;
  return {so_far, cut_off ? never : so_far};
}

/// In csv, as RFC 4180 has it.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

/// Value of a series at instant k of the common times; after its end as it was left, or nothing
/// more passes; NaN where that is not known.
template <class Values>
double value_at(const Values& values, std::size_t k, bool stays, bool cut_off) {
  // The last entry is the end, which is no multiple of the interval.
  if (k + 1 < values.size()) return values[k];
  if (cut_off) return std::numeric_limits<double>::quiet_NaN();
  return stays && !values.empty() ? static_cast<double>(values.back()) : 0;
}

struct Quantity {
  const char *name, *units;
};

}  // namespace

void GaugeStatistics::add(const GaugeResult& result, Censoring censoring) {
  if (result.empty()) return;
  if (!members_.empty())
    expect(result.points.size() == members_.front().result.points.size() &&
               result.lines.size() == members_.front().result.lines.size(),
           "all members have the same gauges");
  members_.push_back({result, is_moving(censoring)});
}

namespace {

/// Rows and bands of one gauge after the other.
template <class Members>
class Summary {
 public:
  using Seen = typename Members::value_type;

  Summary(const Members& members, GaugeFindings& out) : members_(members), out_(out) {
    for (const Seen& m : members_) longest_ = std::max(longest_, m.result.time_s.size());
  }

  template <class Value>
  void row(const std::string& gauge, const Quantity& quantity, bool arrival, Value value) {
    GaugeRow r{gauge, quantity.name, quantity.units, members_.size(), 0, 0, {}};
    std::vector<Bounds> all;
    for (const Seen& m : members_) {
      const double v = value(m.result);
      const bool seen = !std::isnan(v) && (arrival || v > 0);
      r.reached += seen;
      r.unknown += m.cut_off && !(arrival && seen);
      all.push_back(arrival ? arrival_of(v, m.result.time_s.back(), m.cut_off)
                            : peak_of(v, m.cut_off));
    }
    for (const double q : out_.quantiles)
      r.values.push_back(arrival ? arrival_text(quantile(all, q)) : peak_text(quantile(all, q)));
    out_.rows.push_back(std::move(r));
  }

  /// \param stays what is there at the end stays; else nothing more passes
  template <class Values>
  void band(const std::string& gauge, const Quantity& quantity, bool stays, Values values_of) {
    GaugeBand b{gauge, quantity.name, quantity.units, {}, {}, {}};
    b.values.resize(out_.quantiles.size());
    for (std::size_t k = 0; k < longest_; ++k) {
      std::vector<double> known;
      for (const Seen& m : members_)
        if (const double v = value_at(values_of(m.result), k, stays, m.cut_off); !std::isnan(v))
          known.push_back(v);
      b.time_s.push_back(members_.front().result.interval_s * static_cast<double>(k));
      b.members.push_back(known.size());
      for (std::size_t q = 0; q < out_.quantiles.size(); ++q)
        b.values[q].push_back(known.empty() ? std::numeric_limits<double>::quiet_NaN()
                                            : at_rank(known, out_.quantiles[q]));
    }
    out_.bands.push_back(std::move(b));
  }

 private:
  const Members& members_;
  GaugeFindings& out_;
  std::size_t longest_ = 0;
};

template <class Members>
void add_point(Summary<Members>& s, const std::string& name, std::size_t k) {
  const auto peak = [k](GaugePeak PointSeries::*field) {
    return [k, field](const GaugeResult& g) { return (g.points[k].*field).value; };
  };
  const auto series = [k](std::vector<float> PointSeries::*field) {
    return [ k, field ](const GaugeResult& g) -> const auto& { return g.points[k].*field; };
  };
  s.row(name, {"arrival", "s"}, true, [k](const GaugeResult& g) { return g.points[k].arrival_s; });
  s.row(name, {"peak_thickness", "m"}, false, peak(&PointSeries::thickness));
  s.row(name, {"peak_speed", "m s-1"}, false, peak(&PointSeries::speed));
  s.row(name, {"peak_momentum_flux", "N m-1"}, false, peak(&PointSeries::momentum_flux));
  s.band(name, {"thickness", "m"}, true, series(&PointSeries::thickness_m));
  s.band(name, {"speed", "m s-1"}, true, series(&PointSeries::speed_m_s));
}

template <class Members>
void add_line(Summary<Members>& s, const std::string& name, std::size_t k) {
  s.row(name, {"arrival", "s"}, true, [k](const GaugeResult& g) { return g.lines[k].arrival_s; });
  s.row(name, {"peak_discharge", "m3 s-1"}, false,
        [k](const GaugeResult& g) { return g.lines[k].discharge.value; });
  s.row(name, {"volume", "m3"}, false, [k](const GaugeResult& g) { return g.lines[k].total_m3; });
  s.band(
      name, {"discharge", "m3 s-1"},
      false, [k](const GaugeResult& g) -> const auto& { return g.lines[k].discharge_m3_s; });
}

}  // namespace

GaugeFindings GaugeStatistics::findings(std::vector<double> quantiles, bool one_member) const {
  GaugeFindings out;
  out.quantiles = std::move(quantiles);
  out.one_member = one_member;
  if (members_.empty()) return out;
  const GaugeResult& first = members_.front().result;
  Summary summary(members_, out);
  for (std::size_t k = 0; k < first.points.size(); ++k) add_point(summary, first.points[k].name, k);
  for (std::size_t k = 0; k < first.lines.size(); ++k) add_line(summary, first.lines[k].name, k);
  return out;
}

std::string quantile_name(const GaugeFindings& f, std::size_t k) {
  return f.one_member ? "value" : fmt::format("q{:02.0f}", 100 * f.quantiles[k]);
}

std::string gauges_csv(const GaugeFindings& f) {
  std::string text = "gauge,quantity,units,members,reached,unknown";
  for (std::size_t k = 0; k < f.quantiles.size(); ++k) text.append(",").append(quantile_name(f, k));
  text += '\n';
  for (const GaugeRow& r : f.rows) {
    text += fmt::format("{},{},{},{},{},{}", quoted(r.gauge), r.quantity, r.units, r.members,
                        r.reached, r.unknown);
    for (const std::string& v : r.values) text.append(",").append(quoted(v));
    text += '\n';
  }
  return text;
}

std::string gauge_series_csv(const GaugeFindings& f) {
  std::string text = "gauge,quantity,units,time_s,members";
  for (std::size_t k = 0; k < f.quantiles.size(); ++k) text.append(",").append(quantile_name(f, k));
  text += '\n';
  for (const GaugeBand& b : f.bands)
    for (std::size_t i = 0; i < b.time_s.size(); ++i) {
      text += fmt::format("{},{},{},{:.10g},{}", quoted(b.gauge), b.quantity, b.units, b.time_s[i],
                          b.members[i]);
      for (const auto& values : b.values)
        text += std::isnan(values[i]) ? "," : fmt::format(",{:.7g}", values[i]);
      text += '\n';
    }
  return text;
}

}  // namespace sturz
