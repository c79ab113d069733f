// SPDX-License-Identifier: Apache-2.0
#include "ensemble/calibration/calibration.hpp"

#include "engine/core/error.hpp"
#include "ensemble/calibration/next_members.hpp"
#include "ensemble/hazard/weighting/weighted_sample.hpp"
#include "ensemble/sampling/unit_cube.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace sturz {
namespace {

using Points = std::vector<std::vector<double>>;

/// Rows of the members alone that count, columns of the quantities alone that tell something.
struct Usable {
  std::vector<ObservedQuantity> observed;
  std::vector<std::vector<Observation>> members;
};

/// One value in all members that say it, and no bound that says otherwise.
bool is_constant(const CalibrationData& data, std::size_t q) {
  const Observation* first = nullptr;
  for (const auto& row : data.comparison.simulated.values) {
    const Observation& o = row[q];
    if (o.known != Known::exactly || !std::isfinite(o.value)) return false;
    if (first != nullptr && o.value != first->value) return false;
    first = &o;
  }
  return first != nullptr;
}

Usable usable(const CalibrationData& data, std::vector<std::string>& warnings) {
  const auto& [observed, simulated] = data.comparison;
  Usable u;
  u.members.resize(simulated.values.size());
  for (std::size_t q = 0; q < observed.size(); ++q) {
    if (simulated.values.size() > 1 && is_constant(data, q)) {
      warnings.push_back(fmt::format(
          "{} is {} {} in every member: it tells nothing of the uncertain values and is "
          "left out.",
          observed[q].name, simulated.values.front()[q].value, observed[q].unit));
      continue;
    }
    u.observed.push_back(observed[q]);
    for (std::size_t i = 0; i < u.members.size(); ++i)
      u.members[i].push_back(simulated.values[i][q]);
  }
  require(!u.observed.empty() || observed.empty(),
          "every observed quantity is one and the same in all members (they tell nothing of the "
          "uncertain values). Observe what depends on them, or widen the distributions.");
  return u;
}

std::string method_reason(const CalibrationSettings& settings, std::size_t n, std::size_t n_dims) {
  if (settings.method) return "as asked for";
  const std::size_t wanted = members_per_key * n_dims;
  return fmt::format("{} members for {} uncertain value{}, {} {} that an emulator wants", n, n_dims,
                     n_dims == 1 ? "" : "s", n >= wanted ? "not fewer than the" : "fewer than the",
                     wanted);
}

std::vector<DiscrepancyFound> discrepancies_of(const Likelihood& likelihood,
                                               const Posterior& posterior) {
  std::vector<DiscrepancyFound> all;
  const auto rows = resampled(posterior.weights, 200);
  for (std::size_t k = 0; k < likelihood.kinds().size(); ++k) {
    std::vector<double> sum(likelihood.nodes().size(), 0);
    for (const std::size_t i : rows) {
      const std::vector<double> p = likelihood.node_probabilities(k, posterior.simulated[i]);
      for (std::size_t j = 0; j < p.size(); ++j) sum[j] += p[j] / static_cast<double>(rows.size());
    }
    double mean = 0;
    for (std::size_t j = 0; j < sum.size(); ++j) mean += sum[j] * likelihood.nodes()[j];
    all.push_back({likelihood.kinds()[k].name, mean,
                   weighted_quantile(likelihood.nodes(), sum, 0.05),
                   weighted_quantile(likelihood.nodes(), sum, 0.95)});
  }
  return all;
}

/// A bound below the observation leaves the member possible, but in an emulator it stands for a
/// value, which then falls short.
void warn_of_bounds(Calibration& c) {
  for (std::size_t q = 0; q < c.emulators.size(); ++q) {
    const EmulatorReport& e = c.emulators[q];
    const ObservedQuantity& o = c.observed[q];
    if (e.n_bounds_used > 0 && e.lowest_bound_used < o.value)
      c.warnings.push_back(fmt::format(
          "{}: {} lower bounds teach its emulator as if they were values, the lowest {:.4g} below "
          "the observed {:.4g} {}: what such members would reach is not known, and the posterior "
          "is biased short. --method weights takes bounds as bounds; a larger terrain or a later "
          "end needs none.",
          e.quantity, e.n_bounds_used, e.lowest_bound_used, o.value, o.unit));
  }
}

/// Where values jump the observation may fit no side: it lies farther from both than the
/// measurement errs.
void warn_of_steps(Calibration& c) {
  for (std::size_t q = 0; q < c.emulators.size(); ++q) {
    if (!c.emulators[q].step) continue;
    const ValueStep& s = *c.emulators[q].step;
    const ObservedQuantity& o = c.observed[q];
    std::string text = fmt::format(
        "{} jumps: {} members give {:.4g} .. {:.4g} {}, {} give {:.4g} .. {:.4g}, and none what "
        "lies between. Each side has an emulator of its own, and the side is predicted with a "
        "probability ({:.0f} % of the members' sides are told by the others): one smooth emulator "
        "would expect what no member does.",
        o.name, s.n_below, s.least, s.below, o.unit, s.n_above, s.above, s.most, 100 * s.told);
    if (s.below + 2 * o.sd < o.value && o.value < s.above - 2 * o.sd)
      text += fmt::format(
          " The observed {:.4g} lies in the gap: only an error of the model explains it, "
          "whatever the uncertain values are. Look on the ground for what stops the members at "
          "{:.4g}, and compute more of them (--active).",
          o.value, s.below);
    c.warnings.push_back(std::move(text));
  }
}

void warn_of_emulators(Calibration& c) {
  for (const EmulatorReport& e : c.emulators) {
    if (e.q2 < poor_q2)
      c.warnings.push_back(
          fmt::format("the emulator of {} tells {:.0f} % of its variance (Q2 {:.2f}, from {} "
                      "members): what it does not know widens the posterior. More members, or "
                      "--active rounds, mend that.",
                      e.quantity, 100 * std::max(0.0, e.q2), e.q2, e.n_used));
    if (const auto lost = e.n_at_least + e.n_not_known; lost > 0)
      c.warnings.push_back(fmt::format(
          "{}: {} of {} members are cut off and do not teach the emulator ({} more of them do as "
          "lower bounds). Where they lie it goes on from the others.",
          e.quantity, lost - e.n_bounds_used, e.n_exact + lost, e.n_bounds_used));
  }
  const ChainSample& chains = *c.posterior.chains;
  const double worst = *std::max_element(chains.r_hat.begin(), chains.r_hat.end());
  if (!(worst <= most_r_hat))
    c.warnings.push_back(
        fmt::format("the chains do not agree (R-hat {:.2f}, above {}): take the posterior with "
                    "care.",
                    worst, most_r_hat));
}

void warn_of_posterior(Calibration& c) {
  if (c.posterior.effective_size < least_effective_members)
    c.warnings.push_back(
        fmt::format("the posterior is worth {:.1f} independent members, fewer than {}: its bounds "
                    "are rough. {}",
                    c.posterior.effective_size, least_effective_members,
                    c.posterior.method == PosteriorMethod::weights
                        ? "Compute more members, or use --method emulator."
                        : "Its chains moved badly."));
  if (c.posterior.censored_share > 0.05)
    c.warnings.push_back(
        fmt::format("{:.0f} % of the weight lies on members that are cut off: of them only bounds "
                    "were compared.",
                    100 * c.posterior.censored_share));
  for (const PredictedQuantity& p : c.check)
    if (p.below < 0.025 || p.below > 0.975)
      c.warnings.push_back(
          fmt::format("{} = {:.4g} {} is not explained: the posterior gives {:.4g} .. {:.4g}. The "
                      "model, the priors or the observation is wrong there.",
                      p.name, p.observed, p.unit, p.lower, p.upper));
}

/// One quantity after the other, and one event after the other.
void hold_out(Calibration& c, const Likelihood& likelihood,
              const std::function<Posterior(std::span<const std::size_t>)>& without,
              const std::vector<SimulatedRow>& prior) {
  c.held_out = held_out(
      likelihood, [&](std::size_t q) { return without(std::span(&q, 1)); }, prior);
  c.held_out.events = held_out_events(likelihood, without, prior);
}

void by_weights(Calibration& c, const CalibrationData& data, const Usable& u,
                const Likelihood& likelihood) {
  require(data.n_drawn == data.cube.size(),
          fmt::format("{} of {} members were not drawn from the prior but chosen (weights need "
                      "members that were drawn). Use --method emulator.",
                      data.cube.size() - data.n_drawn, data.cube.size()));
  c.posterior = weighted_members(likelihood, data.cube, u.members);
  const auto without = [&](std::span<const std::size_t> left_out) {
    Posterior p = c.posterior;
    std::vector<double> logs;
    for (const SimulatedRow& row : p.simulated)
      logs.push_back(likelihood.log_without(row, left_out));
    p.weights = normalised_weights(logs);
    require(!p.weights.empty(), "no member explains the observations without " +
                                    likelihood.observed()[left_out.front()].name +
                                    (left_out.size() > 1 ? " and the others of its event" : "") +
                                    ". Check them.");
    p.effective_size = effective_size(p.weights);
    return p;
  };
  hold_out(c, likelihood, without, c.posterior.simulated);
}

void by_emulator(Calibration& c, const CalibrationData& data, const Usable& u,
                 const Likelihood& likelihood, const CalibrationSettings& settings) {
  const std::size_t n_dims = data.keys.size();
  const EmulatorSet emulators(u.observed, data.cube, u.members);
  for (const QuantityEmulator& e : emulators.quantities()) c.emulators.push_back(e.report());
  c.posterior = emulated_posterior(likelihood, emulators, n_dims, settings.lengths, settings.seed);
  const auto without = [&](std::span<const std::size_t> left_out) {
    return emulated_posterior(likelihood, emulators, n_dims, settings.held_out_lengths,
                              settings.seed, left_out);
  };
  std::vector<SimulatedRow> prior;
  for (const auto& point : draw_unit_cube(Design::sobol, 512, n_dims, settings.seed))
    prior.push_back(emulators.at(point));
  hold_out(c, likelihood, without, prior);
  c.best = best_fit(likelihood, emulators, n_dims, settings.seed);
}

std::vector<double> weights_of_drawn(const CalibrationData& data, const Usable& u,
                                     const Likelihood& likelihood) {
  std::vector<double> logs;
  for (std::size_t i = 0; i < data.n_drawn; ++i)
    logs.push_back(likelihood.log_of(exact_row(u.members[i])));
  return normalised_weights(logs);
}

}  // namespace

PosteriorMethod chosen_method(std::size_t n_members, std::size_t n_dims) {
  return n_members >= members_per_key * n_dims ? PosteriorMethod::emulator
                                               : PosteriorMethod::weights;
}

namespace {

void check(const CalibrationData& data) {
  const auto& simulated = data.comparison.simulated;
  expect(data.cube.size() == simulated.values.size(), "a point of the prior for each member");
  require(!data.keys.empty(),
          "no value is uncertain (there is nothing to calibrate). Give a key a "
          "distribution, such as basal.friction_coefficient: {uniform: [0.1, "
          "0.5]}.");
  require(!data.cube.empty(),
          "no valid member (there is nothing to learn from). Their reasons are "
          "in members.csv.");
}

}  // namespace

std::vector<std::vector<double>> points_to_compute(const CalibrationData& data,
                                                   const CalibrationSettings& settings,
                                                   std::size_t n) {
  check(data);
  std::vector<std::string> ignored;
  const Usable u = usable(data, ignored);
  const Likelihood likelihood(u.observed, u.members, settings.discrepancy);
  const EmulatorSet emulators(u.observed, data.cube, u.members);
  const Posterior posterior =
      emulated_posterior(likelihood, emulators, data.keys.size(), settings.lengths, settings.seed);
  return next_members(likelihood, emulators, posterior, n);
}

Calibration calibrate(const CalibrationData& data, const CalibrationSettings& settings) {
  check(data);
  Calibration c;
  const Usable u = usable(data, c.warnings);
  const Likelihood likelihood(u.observed, u.members, settings.discrepancy);
  c.observed = u.observed;
  c.reason = method_reason(settings, data.cube.size(), data.keys.size());
  const PosteriorMethod method =
      settings.method.value_or(chosen_method(data.cube.size(), data.keys.size()));
  if (method == PosteriorMethod::weights)
    by_weights(c, data, u, likelihood);
  else
    by_emulator(c, data, u, likelihood, settings);
  c.member_weights = weights_of_drawn(data, u, likelihood);
  c.discrepancies = discrepancies_of(likelihood, c.posterior);
  const Copula copula(data.keys, data.correlation);
  c.identifiability = identifiability_of(c.posterior, data.correlation.empty() ? nullptr : &copula);
  c.check = predictive_check(likelihood, c.posterior);
  if (c.posterior.chains) {
    warn_of_emulators(c);
    warn_of_bounds(c);
    warn_of_steps(c);
  }
  warn_of_posterior(c);
  return c;
}

}  // namespace sturz
