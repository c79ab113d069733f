// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/inflow/inflow_plan.hpp"

#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"
#include "engine/core/random.hpp"
#include "scenarios/assembly/inflow/source_geometry.hpp"
#include "scenarios/assembly/reach.hpp"
#include "scenarios/schema/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

/// Columns of a small discharge are no thinner than this part of those of the largest: many thin
/// ones would cost and tell nothing.
constexpr double least_share = 0.1;
constexpr double most_columns = 5e6;
/// Keeps the words of inflows apart from those of the release.
constexpr std::uint64_t inflow_key_mask = 0x696e666c6f77ULL;

double value_or(const std::optional<Uncertain>& u, double otherwise) {
  return u ? u->value : otherwise;
}

RandomWords words(const Scenario& s, std::size_t source, std::uint32_t k, std::int64_t member) {
  const auto m = static_cast<std::uint64_t>(member);
  return random_words(s.ensemble.seed ^ inflow_key_mask,
                      {k, static_cast<std::uint32_t>(source), static_cast<std::uint32_t>(m >> 32),
                       static_cast<std::uint32_t>(m)});
}

/// One source of one member.
class SourceColumns {
 public:
  SourceColumns(const Scenario& s, const SceneInputs& in, const Terrain& bed, std::size_t i,
                std::int64_t member)
      : scenario_(s),
        spec_(s.inflow[i]),
        source_(in.inflow[i]),
        bed_(bed),
        index_(i),
        member_(member),
        volume_(source_.hydrograph),
        geometry_(source_, bed,
                  spec_.direction_deg ? std::optional(spec_.direction_deg->value) : std::nullopt),
        factor_(value_or(spec_.discharge_factor, 1)),
        start_s_(value_or(spec_.start_time_s, 0)),
        speed_(value_or(spec_.speed_m_s, std::numeric_limits<double>::quiet_NaN())) {
    peak_m3_ = column_volume(source_.hydrograph.peak_m3_s());
  }

  void add_to(InflowPlan& plan, const std::function<double(double)>& density) {
    const double all = factor_ * volume_.total_m3();
    require(all < most_columns * least_share * peak_m3_,
            source_.label + ": would make more than 5e6 columns of " +
                short_number(scenario_.numerics.spacing_m) +
                " m. Use a larger numerics.spacing_m.");
    const double offset =
        unit_from(words(scenario_, index_, std::numeric_limits<std::uint32_t>::max(), member_)[0]);
    double before = 0;
    for (std::uint32_t k = 0; before < all; ++k) {
      // By the discharge at its middle, which its volume decides.
      double size = column_volume(discharge_when(before));
      size = column_volume(discharge_when(before + 0.5 * size));
      const bool last = all - before < 1.5 * size;
      if (last) size = all - before;
      plan.columns.push_back(column(k, before + 0.5 * size, size, offset, density));
      before += size;
      if (last) break;
    }
    plan.volume_m3 += all;
    plan.narrowest_m = std::min(plan.narrowest_m, geometry_.width_m());
    plan.peak_m3_s = std::max(plan.peak_m3_s, factor_ * source_.hydrograph.peak_m3_s());
    const InflowDepth most = depth(source_.hydrograph.peak_m3_s());
    plan.most_thickness_m = std::max(plan.most_thickness_m, most.thickness_m);
    plan.most_speed_m_s = std::max(plan.most_speed_m_s, most.speed_m_s);
  }

 private:
  InflowDepth depth(double unscaled_m3_s) const {
    return inflow_depth(factor_ * unscaled_m3_s / geometry_.width_m(), speed_, standard_gravity);
  }
  /// One spacing wide and long on the map; at least a share of the peak's.
  double column_volume(double unscaled_m3_s) const {
    const double dx = scenario_.numerics.spacing_m;
    const double size = dx * dx * depth(unscaled_m3_s).thickness_m / geometry_.level();
    return std::max(size, least_share * peak_m3_);
  }
  double discharge_when(double entered_m3) const {
    return source_.hydrograph.discharge(volume_.time_of(entered_m3 / factor_));
  }

  TimedArrival column(std::uint32_t k, double middle_m3, double volume, double offset,
                      const std::function<double(double)>& density) {
    const double t = volume_.time_of(middle_m3 / factor_);
    const InflowDepth flow = depth(source_.hydrograph.discharge(t));
    auto [at, way] = geometry_.place(k, offset);
    const RandomWords w = words(scenario_, index_, k, member_);
    const double amplitude = scenario_.numerics.jitter * scenario_.numerics.spacing_m;
    const Vec2 moved = at + amplitude * Vec2(2 * unit_from(w[0]) - 1, 2 * unit_from(w[1]) - 1);
    if (bed_.inside(moved.x(), moved.y())) at = moved;
    require(bed_.inside(at.x(), at.y()),
            source_.label + ": enters where the ground is not known (x " + number_text(at.x()) +
                ", y " + number_text(at.y()) + "). Move it or fill the terrain there.");
    TimedArrival c;
    c.time_s = start_s_ + t;
    c.arrival.position = Vec3(at.x(), at.y(), bed_.height(at.x(), at.y()));
    c.arrival.velocity =
        speed_ == 0 ? Vec3(0, 0, 0) : Vec3(flow.speed_m_s * way.x(), flow.speed_m_s * way.y(), 0);
    c.arrival.volume = volume;
    c.arrival.thickness = volume / (scenario_.numerics.spacing_m * scenario_.numerics.spacing_m);
    c.arrival.solid_fraction = source_.hydrograph.solids(t);
    c.arrival.mass = density(c.arrival.solid_fraction) * volume;
    return c;
  }

  const Scenario& scenario_;
  const InflowSpec& spec_;
  const InflowSource& source_;
  const Terrain& bed_;
  std::size_t index_;
  std::int64_t member_;
  HydrographVolume volume_;
  SourceGeometry geometry_;
  double factor_, start_s_, speed_;
  double peak_m3_ = 0;  ///< of a column at the largest discharge
};

void sum_up(InflowPlan& plan) {
  plan.first_s = plan.columns.front().time_s, plan.last_s = plan.columns.back().time_s;
  double volume = 0;
  for (const TimedArrival& c : plan.columns) {
    const Arrival& a = c.arrival;
    volume += a.volume;
    plan.x_m += a.volume * a.position.x(), plan.y_m += a.volume * a.position.y();
    plan.mass_kg += a.mass;
    plan.fall_kg_m += a.mass * a.position.z();
    plan.energy_j += 0.5 * a.mass * a.velocity.squaredNorm();
    const double top = a.position.z() + a.thickness;
    if (top > plan.top_m)
      plan.top_m = top, plan.top_x_m = a.position.x(), plan.top_y_m = a.position.y();
  }
  plan.x_m /= volume, plan.y_m /= volume;
}

}  // namespace

InflowDepth inflow_depth(double per_width, double speed, double gravity) {
  if (!(per_width > 0)) return {0, std::isnan(speed) ? 0 : speed};
  const double critical = std::cbrt(gravity * per_width);
  if (std::isnan(speed)) return {per_width / critical, critical};
  return {per_width / (speed > 0 ? speed : critical), speed};
}

InflowPlan plan_inflow(const Scenario& s, const SceneInputs& in, const Terrain& bed,
                       const std::function<double(double)>& density, std::int64_t member) {
  InflowPlan plan;
  for (std::size_t i = 0; i < in.inflow.size(); ++i)
    SourceColumns(s, in, bed, i, member).add_to(plan, density);
  if (plan.columns.empty()) return plan;
  std::stable_sort(plan.columns.begin(), plan.columns.end(),
                   [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  sum_up(plan);
  return plan;
}

double available_energy(const InflowPlan& plan, double lowest_m) {
  if (plan.empty()) return 0;
  return standard_gravity * (plan.fall_kg_m - plan.mass_kg * lowest_m) + plan.energy_j;
}

Window cells_below(const InflowSource& source, const Grid& whole) {
  Window under;
  for (const auto* parts : {&source.lines, &source.rings})
    for (const auto& corners : *parts)
      for (const Vec2& p : corners) {
        const int row = std::clamp(whole.row_of(p.y()), 0, whole.n_rows - 1);
        const int col = std::clamp(whole.col_of(p.x()), 0, whole.n_cols - 1);
        under = joined(under, {row, col, 1, 1});
      }
  return under.n_cells() > 0 ? widened(under, 1, whole) : under;
}

double greatest_head(const InflowSpec& spec, const InflowSource& source) {
  double length = 0;
  for (const auto& corners : source.lines)
    for (std::size_t i = 0; i + 1 < corners.size(); ++i)
      length += (corners[i + 1] - corners[i]).norm();
  Vec2 low(1e300, 1e300), high(-1e300, -1e300);
  for (const auto& ring : source.rings)
    for (const Vec2& p : ring) low = low.cwiseMin(p), high = high.cwiseMax(p);
  if (!source.rings.empty()) length = (high - low).minCoeff();
  const double factor = spec.discharge_factor ? drawn_range(*spec.discharge_factor).second : 1;
  const double q = factor * source.hydrograph.peak_m3_s() / std::max(length, 1e-3);
  if (!spec.speed_m_s) return 1.5 * std::cbrt(q * q / standard_gravity);
  const auto [slow, fast] = drawn_range(*spec.speed_m_s);
  const double deepest = slow > 0 ? q / slow : std::cbrt(q * q / standard_gravity);
  return std::max(deepest, std::cbrt(q * q / standard_gravity)) +
         fast * fast / (2 * standard_gravity);
}

std::string inflow_text(const Scenario& s, const InflowPlan& plan) {
  return "`inflow`: " + std::to_string(s.inflow.size()) +
         (s.inflow.size() == 1 ? " source, " : " sources, ") + short_number(plan.volume_m3) +
         " m3 from " + short_number(plan.first_s) + " to " + short_number(plan.last_s) +
         " s, at most " + short_number(plan.peak_m3_s) + " m3/s (" +
         short_number(plan.most_thickness_m) + " m thick at " + short_number(plan.most_speed_m_s) +
         " m/s), " + std::to_string(plan.columns.size()) + " columns";
}

}  // namespace sturz
