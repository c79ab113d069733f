// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/error_model.hpp"

#include "engine/core/error.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace sturz {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Priors. Orders: normal about one, the order of a front that is one particle thick; none is below
// a half or above two. Deviations: anything from a hundredth of the differences that were seen to
// several times them, each as likely in logarithms.
constexpr double order_mean = 1, order_deviation = 0.4;
constexpr std::array orders{0.5, 0.625, 0.75, 0.875, 1.0, 1.125, 1.25, 1.375, 1.5, 1.75, 2.0};
constexpr std::array scatter_orders{0.5, 0.75, 1.0, 1.25, 1.5};
constexpr std::array sizes{1.0 / 256, 1.0 / 128, 1.0 / 64, 1.0 / 32, 1.0 / 16,
                           1.0 / 8,   1.0 / 4,   1.0 / 2,  1.0,      2.0};
constexpr std::array bias_sizes{1.0 / 64, 1.0 / 16, 1.0 / 8, 1.0 / 4, 1.0 / 2, 1.0, 2.0, 4.0};
// What all members share of the scatter is about as large as their own part, or less.
constexpr std::array common_shares{0.1, 0.25, 0.5, 1.0, 1.5};
constexpr std::array map_sizes{0.02, 0.04, 0.06, 0.09, 0.13, 0.18, 0.25, 0.35,
                               0.5,  0.7,  1.0,  1.4,  2.0,  2.8,  4.0};

/// How well the law of distances between maps holds, in logarithms.
constexpr double distance_deviation = 0.15;

double order_prior(double order) {
  return -0.5 * std::pow((order - order_mean) / order_deviation, 2);
}

/// Differences of the members to their finest, in the unit `scale`.
struct Differences {
  std::vector<double> x;  // [n_spacings] spacing over the finest
  VectorXd mean;          // [n_spacings - 1]
  MatrixXd covariance;    // of the members, over n_members - 1
  double n = 0;
  double scale = 0;  // root mean square of all differences
  double noise = 0;
};

Differences differences_of(std::span<const double> spacings,
                           const std::vector<std::vector<double>>& values, double noise) {
  Differences d;
  const auto k = static_cast<Eigen::Index>(spacings.size() - 1);
  const std::size_t members = values.front().size();
  d.n = static_cast<double>(members);
  for (const double s : spacings) d.x.push_back(s / spacings.back());
  d.mean = VectorXd::Zero(k);
  d.covariance = MatrixXd::Zero(k, k);
  MatrixXd all(k, static_cast<Eigen::Index>(members));
  for (Eigen::Index l = 0; l < k; ++l)
    for (std::size_t m = 0; m < members; ++m)
      all(l, static_cast<Eigen::Index>(m)) =
          values[static_cast<std::size_t>(l)][m] - values.back()[m];
  d.scale = std::sqrt(all.squaredNorm() / static_cast<double>(all.size()));
  if (!(d.scale > 0)) return d;
  all /= d.scale;
  d.noise = noise / d.scale;
  d.mean = all.rowwise().mean();
  all.colwise() -= d.mean;
  if (members > 1) d.covariance = all * all.transpose() / (d.n - 1);
  return d;
}

/// Covariance of the differences to the finest of independent numbers with these variances.
MatrixXd to_finest(const VectorXd& variances) {
  const Eigen::Index k = variances.size() - 1;
  MatrixXd c = MatrixXd::Constant(k, k, variances[k]);
  for (Eigen::Index l = 0; l < k; ++l) c(l, l) += variances[l];
  return c;
}

/// What is asked about, as a weight of the bias, and the place of its spacing among those computed.
struct Target {
  double lift = 0;           // x^p of the spacing, less that of the finer one
  Eigen::Index level = -1;   // -1: was not computed
  double at = 0, finer = 0;  // variances of a number of unit deviation at both
};

/// Of a normal number with slope variance `along`, and independent numbers of these variances at
/// the levels: conditional mean weights and variance of the target, given differences with Cholesky
/// `v`.
struct Conditional {
  VectorXd weights;
  double variance = 0;
};
Conditional given(const Eigen::LLT<MatrixXd>& v, const VectorXd& lift, double along,
                  const VectorXd& variances, const Target& t, double at, double finer) {
  const Eigen::Index k = lift.size();
  VectorXd cross = along * t.lift * lift;
  if (t.level >= 0 && t.level < k) cross[t.level] += variances[t.level];
  if (t.level == k) cross.array() -= variances[k];
  Conditional c;
  c.weights = v.solve(cross);
  c.variance = std::max(0.0, along * t.lift * t.lift + at + finer - cross.dot(c.weights));
  return c;
}

/// Log likelihood of a sample covariance over n - 1, and of a mean, up to constants.
double log_determinant(const Eigen::LLT<MatrixXd>& v) {
  double sum = 0;
  const MatrixXd& l = v.matrixLLT();
  for (Eigen::Index i = 0; i < l.rows(); ++i) sum += 2 * std::log(l(i, i));
  return sum;
}
double wishart(const Eigen::LLT<MatrixXd>& v, const MatrixXd& covariance, double n) {
  return -0.5 * (n - 1) * (log_determinant(v) + v.solve(covariance).trace());
}
double normal(const Eigen::LLT<MatrixXd>& v, const VectorXd& mean) {
  return -0.5 * (log_determinant(v) + mean.dot(v.solve(mean)));
}

/// Sums with weights that are known as logarithms only.
class Weighted {
 public:
  explicit Weighted(std::size_t n) : sums_(n, 0.0) {}
  /// \param add(sums, weight) adds what is to be averaged
  template <class Add>
  void take(double log_weight, Add&& add) {
    if (log_weight > most_) {
      const double shrink = std::exp(most_ - log_weight);
      for (double& s : sums_) s *= shrink;
      weight_ *= shrink;
      most_ = log_weight;
    }
    const double w = std::exp(log_weight - most_);
    if (w < 1e-9) return;
    add(sums_, w);
    weight_ += w;
  }
  double average(std::size_t i) const { return sums_[i] / weight_; }
  double log_total() const { return most_ + std::log(weight_); }

 private:
  std::vector<double> sums_;
  double weight_ = 0, most_ = -1e300;
};

/// One value of the orders and of the members' own scatter.
struct Point {
  const Differences& d;
  VectorXd lift;     // x^p - 1 of all but the finest
  VectorXd scatter;  // x^2q of all
  VectorXd own;      // variances of members' own numbers
  std::vector<Target> targets;
};

/// Squares of the members' distances from their mean.
Weighted over_slopes(const Point& p) {
  Weighted sum(p.targets.size());
  const MatrixXd own = to_finest(p.own);
  for (const double s : sizes) {
    const Eigen::LLT<MatrixXd> v(s * s * p.lift * p.lift.transpose() + own);
    sum.take(wishart(v, p.d.covariance, p.d.n), [&](std::vector<double>& sums, double w) {
      for (std::size_t i = 0; i < p.targets.size(); ++i) {
        const Target& t = p.targets[i];
        const double c2 = p.own[p.own.size() - 1] - p.d.noise * p.d.noise,
                     noise = p.d.noise * p.d.noise;
        const Conditional c = given(v, p.lift, s * s, p.own, t, c2 * t.at + noise,
                                    t.finer > 0 ? c2 * t.finer + noise : 0);
        sums[i] +=
            w * (p.d.n - 1) / p.d.n * (c.weights.dot(p.d.covariance * c.weights) + c.variance);
      }
    });
  }
  return sum;
}

/// Squares of the mean. That over many members has no scatter of its own left; one over as many as
/// there are has, at both spacings.
Weighted over_biases(const Point& p) {
  const std::size_t n_targets = p.targets.size();
  Weighted sum(n_targets);
  const double noise = p.d.noise * p.d.noise, c2 = p.own[p.own.size() - 1] - noise;
  for (const double share : common_shares) {
    const double g2 = share * share * c2;
    const VectorXd variances = g2 * p.scatter + p.own / p.d.n;
    const MatrixXd known = to_finest(variances);
    for (const double bias : bias_sizes) {
      const Eigen::LLT<MatrixXd> v(bias * bias * p.lift * p.lift.transpose() + known);
      sum.take(normal(v, p.d.mean), [&](std::vector<double>& sums, double w) {
        for (std::size_t i = 0; i < n_targets; ++i) {
          const Target& t = p.targets[i];
          const bool to_limit = !(t.finer > 0);
          const double left = to_limit ? 0 : 1 / p.d.n;
          const VectorXd seen = to_limit ? VectorXd(g2 * p.scatter) : variances;
          const Conditional c =
              given(v, p.lift, bias * bias, seen, t, g2 * t.at + left * (c2 * t.at + noise),
                    to_limit ? 0 : g2 * t.finer + left * (c2 * t.finer + noise));
          const double mean = c.weights.dot(p.d.mean);
          sums[i] += w * (mean * mean + c.variance);
        }
      });
    }
  }
  return sum;
}

std::vector<Target> targets_of(std::span<const double> spacings,
                               std::span<const ErrorQuestion> questions, double p, double q) {
  std::vector<Target> targets;
  for (const ErrorQuestion& question : questions) {
    Target t;
    const double x = question.spacing_m / spacings.back(), y = question.finer_m / spacings.back();
    t.lift = std::pow(x, p) - (y > 0 ? std::pow(y, p) : 0);
    t.at = std::pow(x, 2 * q);
    t.finer = y > 0 ? std::pow(y, 2 * q) : 0;
    const auto place = std::find(spacings.begin(), spacings.end(), question.spacing_m);
    if (place != spacings.end()) t.level = place - spacings.begin();
    targets.push_back(t);
  }
  return targets;
}

void check(std::span<const double> spacings, const std::vector<std::vector<double>>& values) {
  expect(!spacings.empty() && spacings.size() == values.size(), "a column per spacing");
  expect(std::is_sorted(spacings.rbegin(), spacings.rend()) && spacings.back() > 0,
         "spacings descend");
  for (const auto& level : values)
    expect(level.size() == values.front().size() && !level.empty(), "the same members");
}

}  // namespace

std::vector<ExpectedSize> expected_sizes(std::span<const double> spacings_m,
                                         const std::vector<std::vector<double>>& values,
                                         double noise, std::span<const ErrorQuestion> questions) {
  check(spacings_m, values);
  std::vector<ExpectedSize> found(questions.size());
  if (spacings_m.size() < 2) return found;
  const Differences d = differences_of(spacings_m, values, noise);
  if (!(d.scale > 0)) {  // nothing depends on the spacing
    for (ExpectedSize& e : found) e = {noise, 0};
    return found;
  }
  const auto levels = static_cast<Eigen::Index>(spacings_m.size());
  Weighted all(2 * questions.size());
  for (const double p : orders)
    for (const double q : scatter_orders)
      for (const double own : sizes) {
        Point point{d, VectorXd(levels - 1), VectorXd(levels), VectorXd(levels),
                    targets_of(spacings_m, questions, p, q)};
        for (Eigen::Index l = 0; l < levels; ++l) {
          const double x = d.x[static_cast<std::size_t>(l)];
          if (l + 1 < levels) point.lift[l] = std::pow(x, p) - 1;
          point.scatter[l] = std::pow(x, 2 * q);
          point.own[l] = own * own * point.scatter[l] + d.noise * d.noise;
        }
        const Weighted slopes = over_slopes(point), biases = over_biases(point);
        all.take(slopes.log_total() + biases.log_total() + order_prior(p) + order_prior(q),
                 [&](std::vector<double>& sums, double w) {
                   for (std::size_t i = 0; i < questions.size(); ++i) {
                     sums[i] += w * std::sqrt(slopes.average(i) + biases.average(i));
                     sums[questions.size() + i] += w * std::sqrt(biases.average(i));
                   }
                 });
      }
  for (std::size_t i = 0; i < questions.size(); ++i)
    found[i] = {d.scale * all.average(i), d.scale * all.average(questions.size() + i)};
  return found;
}

std::vector<double> expected_distances(std::span<const double> spacings_m,
                                       const std::vector<std::vector<double>>& distances,
                                       double noise, std::span<const ErrorQuestion> questions) {
  check(spacings_m, distances);
  std::vector<double> found(questions.size(), nan_d);
  const std::size_t n = spacings_m.size();
  double squares = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) squares += distances[i][j] * distances[i][j];
  const double scale = std::sqrt(2 * squares / static_cast<double>(n * (n - 1)));
  if (n < 2 || !std::isfinite(scale)) return found;
  if (!(scale > 0)) {
    std::fill(found.begin(), found.end(), noise);
    return found;
  }
  const double floor2 = noise * noise;
  const auto size_of = [&](const Target& t, double bias, double scatter) {
    return std::sqrt(std::pow(scale * bias * t.lift, 2) +
                     std::pow(scale * scatter, 2) * (t.at + t.finer) + floor2);
  };
  std::vector<ErrorQuestion> pairs;
  std::vector<double> seen;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) {
      pairs.push_back({spacings_m[i], spacings_m[j]});
      seen.push_back(std::max(distances[i][j], 1e-3 * scale));
    }
  Weighted all(questions.size());
  for (const double p : orders)
    for (const double q : scatter_orders) {
      const std::vector<Target> known = targets_of(spacings_m, pairs, p, q);
      const std::vector<Target> asked = targets_of(spacings_m, questions, p, q);
      for (const double bias : map_sizes)
        for (const double scatter : map_sizes) {
          double fit = order_prior(p) + order_prior(q);
          for (std::size_t k = 0; k < known.size(); ++k)
            fit -= 0.5 * std::pow(std::log(seen[k] / size_of(known[k], bias, scatter)) /
                                      distance_deviation,
                                  2);
          all.take(fit, [&](std::vector<double>& sums, double w) {
            for (std::size_t k = 0; k < asked.size(); ++k)
              sums[k] += w * size_of(asked[k], bias, scatter);
          });
        }
    }
  for (std::size_t k = 0; k < questions.size(); ++k) found[k] = all.average(k);
  return found;
}

}  // namespace sturz
