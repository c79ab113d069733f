// SPDX-License-Identifier: Apache-2.0
#include "ensemble/calibration/likelihood.hpp"

#include "engine/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>

namespace sturz {
namespace {

constexpr double minus_infinity = -std::numeric_limits<double>::infinity();
constexpr int n_nodes = 48;

double log_normal_density(double x, double variance) {
  return -0.5 * (x * x / variance + std::log(2 * std::numbers::pi * variance));
}

double normal_below(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

bool is_among(std::span<const std::size_t> some, std::size_t q) {
  return std::find(some.begin(), some.end(), q) != some.end();
}

/// Without underflow far below: the first term of the tail's expansion.
double log_normal_below(double z) {
  if (z > -30) return std::log(normal_below(z));
  return -0.5 * z * z - std::log(-z * std::sqrt(2 * std::numbers::pi));
}

double log_sum_of(std::span<const double> logs) {
  const double most = *std::max_element(logs.begin(), logs.end());
  if (!std::isfinite(most)) return most;
  double sum = 0;
  for (const double l : logs) sum += std::exp(l - most);
  return most + std::log(sum);
}

void check(const ObservedQuantity& q) {
  require(std::isfinite(q.value),
          fmt::format("{}: the observed value is not a finite number. Correct it.", q.name));
  require(std::isfinite(q.sd) && q.sd > 0,
          fmt::format("{}: sd = {} {} (a measurement needs a standard deviation above 0, or one "
                      "member would explain it with certainty). Give what the measurement is "
                      "worth.",
                      q.name, q.sd, q.unit));
}

struct Spread {
  double least = 0, most = 0, least_size = 0;
};

/// Of the observed value and what members give for it.
Spread spread_of(const ObservedQuantity& observed,
                 std::span<const std::vector<Observation>> members, std::size_t q) {
  Spread s{observed.value, observed.value, std::numeric_limits<double>::infinity()};
  for (const auto& row : members) {
    const Observation& o = row[q];
    if (o.known == Known::not_at_all || !std::isfinite(o.value)) continue;
    s.least = std::min(s.least, o.value);
    s.most = std::max(s.most, o.value);
    if (o.known == Known::exactly) s.least_size = std::min(s.least_size, std::abs(o.value));
  }
  return s;
}

}  // namespace

std::string kind_of_quantity(const std::string& name) {
  std::string kind;
  for (const char c : name.substr(name.rfind('/') + 1)) {
    if (std::isdigit(static_cast<unsigned char>(c)) != 0 && (kind.empty() || kind.back() == '_'))
      continue;  // "_3_" counts, the 2 of "m2" says what it is
    if (c == '_' && !kind.empty() && kind.back() == '_') continue;
    kind += c;
  }
  return kind;
}

std::string event_of_quantity(const std::string& name) {
  const std::size_t slash = name.rfind('/');
  return slash == std::string::npos ? "" : name.substr(0, slash);
}

SimulatedRow exact_row(std::span<const Observation> member) {
  SimulatedRow row;
  for (const Observation& o : member)
    row.push_back({o.value, 0, std::isfinite(o.value) ? o.known : Known::not_at_all});
  return row;
}

Likelihood::Likelihood(std::vector<ObservedQuantity> observed,
                       std::span<const std::vector<Observation>> members, double relative_sd)
    : observed_(std::move(observed)), relative_sd_(relative_sd) {
  require(!observed_.empty(),
          "nothing was observed (there is nothing to calibrate with). Give the "
          "scene an `observation` block.");
  require(std::isfinite(relative_sd) && relative_sd >= 0,
          fmt::format("discrepancy {} (must be 0 or more: a share of the observed value).",
                      relative_sd));
  for (std::size_t q = 0; q < observed_.size(); ++q) {
    check(observed_[q]);
    const Spread s = spread_of(observed_[q], members, q);
    const double sd = observed_[q].sd;
    range_.push_back(std::max(s.most - s.least, 6 * sd));
    const double of_zero = std::isfinite(s.least_size) ? s.least_size / default_discrepancy : sd;
    scale_.push_back(
        std::max(observed_[q].value != 0 ? std::abs(observed_[q].value) : of_zero, sd));
    const std::string name = kind_of_quantity(observed_[q].name);
    auto kind =
        std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& k) { return k.name == name; });
    if (kind == kinds_.end()) kind = kinds_.insert(kinds_.end(), {name, {}});
    kind->quantities.push_back(q);
  }
  // The middle of 48 steps up to four scales; the half-normal has 6e-5 beyond.
  const int n = relative_sd > 0 ? n_nodes : 1;
  double sum = 0;
  for (int j = 0; j < n; ++j) {
    const double z = relative_sd > 0 ? 4 * (j + 0.5) / n : 0;
    nodes_.push_back(z * relative_sd);
    log_weights_.push_back(-0.5 * z * z);
    sum += std::exp(-0.5 * z * z);
  }
  for (double& w : log_weights_) w -= std::log(sum);
}

double Likelihood::spread(std::size_t q) const {
  return std::hypot(observed_[q].sd, discrepancy_sd(q, relative_sd_));
}

const Likelihood::Kind& Likelihood::kind_of(std::size_t q) const {
  return *std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& k) {
    return std::find(k.quantities.begin(), k.quantities.end(), q) != k.quantities.end();
  });
}

double Likelihood::log_density(const SimulatedValue& simulated, std::size_t q, double t) const {
  if (simulated.known == Known::not_at_all) return -std::log(range_[q]);
  const double sd = sd_about(simulated.variance, q, t);
  const double off = observed_[q].value - simulated.value;
  if (simulated.known != Known::exactly) return log_normal_below(off / sd) - std::log(range_[q]);
  const double likely = log_normal_density(off, sd * sd);
  if (!(simulated.other_share > 0)) return likely;
  const double other_sd = sd_about(simulated.other_variance, q, t);
  const double sides[] = {
      std::log1p(-simulated.other_share) + likely,
      std::log(simulated.other_share) +
          log_normal_density(observed_[q].value - simulated.other_value, other_sd * other_sd)};
  return log_sum_of(sides);
}

double Likelihood::sd_about(double variance, std::size_t q, double t) const {
  const double of_model = discrepancy_sd(q, t);
  return std::sqrt(observed_[q].sd * observed_[q].sd + variance + of_model * of_model);
}

template <class Counts>
std::vector<double> Likelihood::log_nodes(std::span<const SimulatedValue> simulated,
                                          const Kind& kind, Counts counts) const {
  std::vector<double> logs = log_weights_;
  for (const std::size_t q : kind.quantities) {
    if (!counts(q)) continue;
    for (std::size_t j = 0; j < logs.size(); ++j)
      logs[j] += log_density(simulated[q], q, nodes_[j]);
  }
  return logs;
}

template <class Counts>
double Likelihood::log_sum(std::span<const SimulatedValue> simulated, const Kind& kind,
                           Counts counts) const {
  return log_sum_of(log_nodes(simulated, kind, counts));
}

double Likelihood::log_of(std::span<const SimulatedValue> simulated) const {
  double sum = 0;
  for (const Kind& kind : kinds_) sum += log_sum(simulated, kind, [](std::size_t) { return true; });
  return sum;
}

double Likelihood::log_without(std::span<const SimulatedValue> simulated,
                               std::size_t left_out) const {
  return log_without(simulated, std::span(&left_out, 1));
}

double Likelihood::log_without(std::span<const SimulatedValue> simulated,
                               std::span<const std::size_t> left_out) const {
  double sum = 0;
  for (const Kind& kind : kinds_)
    sum += log_sum(simulated, kind, [&](std::size_t q) { return !is_among(left_out, q); });
  return sum;
}

double Likelihood::log_of_one(std::span<const SimulatedValue> simulated, std::size_t which) const {
  return log_sum(simulated, kind_of(which), [&](std::size_t q) { return q == which; });
}

std::vector<double> Likelihood::node_probabilities(
    std::size_t kind, std::span<const SimulatedValue> simulated) const {
  std::vector<double> p = log_nodes(simulated, kinds_[kind], [](std::size_t) { return true; });
  const double sum = log_sum_of(p);
  for (double& v : p)
    v = sum == minus_infinity ? 1.0 / static_cast<double>(p.size()) : std::exp(v - sum);
  return p;
}

double Likelihood::below(std::span<const SimulatedValue> simulated, std::size_t q, double level,
                         bool with_itself) const {
  const std::span<const std::size_t> itself(&q, 1);
  return below(simulated, q, level, itself.first(with_itself ? 0 : 1));
}

double Likelihood::below(std::span<const SimulatedValue> simulated, std::size_t q, double level,
                         std::span<const std::size_t> left_out) const {
  const std::vector<double> logs = log_nodes(
      simulated, kind_of(q), [&](std::size_t other) { return !is_among(left_out, other); });
  const double sum = log_sum_of(logs);
  SimulatedValue s = simulated[q];
  if (s.known == Known::not_at_all) s.value = observed_[q].value - range_[q] / 2;  // anywhere
  if (s.known != Known::exactly) {  // even over the range: its middle and its variance
    s.value += range_[q] / 2;
    s.variance += range_[q] * range_[q] / 12;
  }
  double probability = 0;
  for (std::size_t j = 0; j < nodes_.size(); ++j) {
    double below = normal_below((level - s.value) / sd_about(s.variance, q, nodes_[j]));
    if (s.other_share > 0)
      below = (1 - s.other_share) * below +
              s.other_share *
                  normal_below((level - s.other_value) / sd_about(s.other_variance, q, nodes_[j]));
    probability += std::exp(logs[j] - sum) * below;
  }
  return probability;
}

}  // namespace sturz
