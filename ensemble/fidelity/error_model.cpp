// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/error_model.hpp"

#include "engine/core/error.hpp"
#include "ensemble/fidelity/error_grid.hpp"

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

// Priors of deviations: each as likely in logarithms. Those of members: anything from a hundredth
// of the differences that were seen to twice them.
constexpr std::array sizes{1.0 / 256, 1.0 / 128, 1.0 / 64, 1.0 / 32, 1.0 / 16,
                           1.0 / 8,   1.0 / 4,   1.0 / 2,  1.0,      2.0};
/// What all members share of the scatter is no more than this times their own part.
constexpr double most_common = 1.5;
/// The bias makes differences of no more than so many times those that were seen of the means.
constexpr double most_bias = 4;

/// Differences of the members to their finest, in the unit `scale`.
struct Differences {
  std::vector<double> x;  // [n_spacings] spacing over the finest
  VectorXd mean;          // [n_spacings - 1]
  MatrixXd covariance;    // of the members, over n_members - 1
  double n = 0;
  double scale = 0;  // root mean square of all differences
  double noise = 0;
  double of_means = 0;   // what the means differ by, with what their members' scatter may hide
  double scattered = 0;  // what the members' scatter alone makes of it
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
  const double of_mean = d.covariance.trace() / (d.n * static_cast<double>(k));
  d.scattered = std::sqrt(of_mean);
  d.of_means = std::sqrt(d.mean.squaredNorm() / static_cast<double>(k) + of_mean);
  return d;
}

/// Halves of `most` down to `least`, and zero in place of all that is less.
std::vector<double> halves(double most, double least) {
  std::vector<double> all;
  for (double size = most; size >= least; size /= 2) all.push_back(size);
  all.push_back(0);
  return all;
}

/// Covariance of the differences to the finest of independent numbers with these variances.
MatrixXd to_finest(const VectorXd& variances) {
  const Eigen::Index k = variances.size() - 1;
  MatrixXd c = MatrixXd::Constant(k, k, variances[k]);
  for (Eigen::Index l = 0; l < k; ++l) c(l, l) += variances[l];
  return c;
}

double log_determinant(const Eigen::LLT<MatrixXd>& v) {
  double sum = 0;
  const MatrixXd& l = v.matrixLLT();
  for (Eigen::Index i = 0; i < l.rows(); ++i) sum += 2 * std::log(l(i, i));
  return sum;
}

/// One value of the orders and of the members' own scatter.
struct Point {
  const Differences& d;
  std::vector<Target> targets;
  VectorXd lift;     // x^p - 1 of all but the finest
  VectorXd scatter;  // x^2q of all
  VectorXd own;      // variances of members' own numbers, with the noise
  double c2 = 0;     // that of the finest without it
  double prior = 0;  // logarithm
};

Point point_at(const Differences& d, std::vector<Target> targets, double p, double q, double own) {
  const auto levels = static_cast<Eigen::Index>(d.x.size());
  Point point{d, std::move(targets), VectorXd(levels - 1), VectorXd(levels), VectorXd(levels)};
  point.c2 = own * own;
  for (Eigen::Index l = 0; l < levels; ++l) {
    const double x = d.x[static_cast<std::size_t>(l)];
    if (l + 1 < levels) point.lift[l] = std::pow(x, p) - 1;
    point.scatter[l] = std::pow(x, 2 * q);
    point.own[l] = point.c2 * point.scatter[l] + d.noise * d.noise;
  }
  point.prior = order_prior(p) + order_prior(q);
  return point;
}

/// How the number that is asked about and the differences vary together, by what is drawn anew at
/// each spacing.
VectorXd shared_scatter(const Target& t, const VectorXd& variances) {
  const Eigen::Index k = variances.size() - 1;
  VectorXd shared = VectorXd::Zero(k);
  if (t.level >= 0 && t.level < k) shared[t.level] = variances[t.level];
  if (t.level == k) shared.setConstant(-variances[k]);
  return shared;
}

/// The members about their mean. What their slopes add to the covariance of the differences is a
/// multiple of lift lift': one decomposition serves all of them (Sherman and Morrison).
class Members {
 public:
  explicit Members(const Point& p)
      : p_(p),
        known_(to_finest(p.own)),
        by_lift_(known_.solve(p.lift)),
        log_determinant_(log_determinant(known_)),
        trace_(known_.solve(p.d.covariance).trace()),
        ll_(p.lift.dot(by_lift_)),
        lcl_(by_lift_.dot(p.d.covariance * by_lift_)) {}
  /// Of the sample covariance (Wishart), up to a constant.
  /// \param slope2 variance of the slopes
  double log_likelihood(double slope2) const {
    const double swell = 1 + slope2 * ll_;
    return -0.5 * (p_.d.n - 1) *
           (log_determinant_ + std::log(swell) + trace_ - slope2 * lcl_ / swell);
  }
  /// Mean squares of the members' distances from their mean.
  std::vector<double> squares(double slope2) const {
    const double noise2 = p_.d.noise * p_.d.noise, swell = 1 + slope2 * ll_;
    std::vector<double> all;
    for (const Target& t : p_.targets) {
      const VectorXd cross = slope2 * t.lift * p_.lift + shared_scatter(t, p_.own);
      const VectorXd weights =
          known_.solve(cross) - slope2 * by_lift_.dot(cross) / swell * by_lift_;
      const double variance = slope2 * t.lift * t.lift + p_.c2 * (t.at + t.finer) +
                              (t.finer > 0 ? 2 : 1) * noise2 - cross.dot(weights);
      all.push_back((p_.d.n - 1) / p_.d.n *
                    (weights.dot(p_.d.covariance * weights) + std::max(0.0, variance)));
    }
    return all;
  }

 private:
  const Point& p_;
  Eigen::LLT<MatrixXd> known_;
  VectorXd by_lift_;
  double log_determinant_, trace_, ll_, lcl_;
};

/// The mean, with a scatter that all members share. Bias and the mean of the members' slopes add
/// multiples of lift lift' too.
class Means {
 public:
  Means(const Point& p, double common2) : p_(p) {
    const VectorXd shared = common2 * p.scatter, drawn = shared + p.own / p.d.n;
    const Eigen::LLT<MatrixXd> known(to_finest(drawn));
    const VectorXd by_lift = known.solve(p.lift), by_mean = known.solve(p.d.mean);
    log_determinant_ = log_determinant(known);
    ll_ = p.lift.dot(by_lift);
    lm_ = p.lift.dot(by_mean);
    mm_ = p.d.mean.dot(by_mean);
    for (const Target& t : p.targets) {
      // Very many members have no scatter of their own left; as many as there are have, at both
      // spacings.
      const bool to_limit = !(t.finer > 0);
      const VectorXd u = shared_scatter(t, to_limit ? shared : drawn);
      Scatter s{u.dot(by_lift), u.dot(by_mean), common2 * (t.at + t.finer)};
      if (!to_limit) s.alone += (p.c2 * (t.at + t.finer) + 2 * p.d.noise * p.d.noise) / p.d.n;
      s.alone -= u.dot(known.solve(u));
      scatter_.push_back(s);
    }
  }
  /// Of the means of the differences (normal), up to a constant.
  /// \param along variance of bias and mean slope together
  double log_likelihood(double along) const {
    const double swell = 1 + along * ll_;
    return -0.5 * (log_determinant_ + std::log(swell) + mm_ - along * lm_ * lm_ / swell);
  }
  /// No bias makes the means more likely than this.
  double most_likely() const { return -0.5 * log_determinant_; }
  /// Mean square of the i-th number that is asked about, given the differences.
  /// \param bias2 variance of the bias \param slope2 of the members' slopes
  double square(std::size_t i, double bias2, double slope2) const {
    const Target& t = p_.targets[i];
    const Scatter& s = scatter_[i];
    const double along = bias2 + slope2 / p_.d.n, swell = 1 + along * ll_;
    // The slopes of very many members are zero in the mean.
    const double asked = (t.finer > 0 ? along : bias2) * t.lift;
    const double mean = s.mean + (asked - along * s.lift) * lm_ / swell;
    const double variance = asked * t.lift + s.alone - asked * asked * ll_ / swell -
                            2 * asked * s.lift / swell + along * s.lift * s.lift / swell;
    return mean * mean + std::max(0.0, variance);
  }

 private:
  struct Scatter {
    double lift, mean, alone;
  };
  const Point& p_;
  double log_determinant_ = 0, ll_ = 0, lm_ = 0, mm_ = 0;
  std::vector<Scatter> scatter_;
};

/// Sizes, not squares, are averaged over the deviations that are not known: two or three
/// differences of means exclude no large one for certain, and in a mean of squares what is hardly
/// possible outweighs what is likely.
void add_point(const Point& p, Weighted& all) {
  const std::size_t n = p.targets.size();
  const double own = std::sqrt(p.c2), finest = std::sqrt(p.own[p.own.size() - 1] / p.d.n);
  const double unit = std::sqrt(static_cast<double>(p.lift.size())) / p.lift.norm();
  const std::vector<double> biases = halves(most_bias * unit * p.d.of_means,
                                            unit * std::max(p.d.scattered / 4, p.d.of_means / 64));
  const Members members(p);
  std::vector<Means> means{Means(p, 0)};
  const double most_likely = means.front().most_likely();
  for (const double slope : sizes) {
    const double slope2 = slope * slope, known = p.prior + members.log_likelihood(slope2);
    if (all.is_nothing(known + most_likely)) continue;
    if (means.size() == 1)
      for (const double common : halves(most_common * own, 0.5 * finest))
        if (common > 0) means.emplace_back(p, common * common);
    const std::vector<double> squares = members.squares(slope2);
    for (const Means& m : means)
      for (const double bias : biases) {
        const double bias2 = bias * bias;
        all.take(known + m.log_likelihood(bias2 + slope2 / p.d.n),
                 [&](std::vector<double>& sums, double w) {
                   for (std::size_t i = 0; i < n; ++i) {
                     const double of_mean = m.square(i, bias2, slope2);
                     sums[i] += w * std::sqrt(squares[i] + of_mean);
                     sums[n + i] += w * std::sqrt(of_mean);
                   }
                 });
      }
  }
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
  Weighted all(2 * questions.size());
  for (const double p : orders)
    for (const double q : scatter_orders)
      for (const double own : sizes)
        add_point(point_at(d, targets_of(spacings_m, questions, p, q), p, q, own), all);
  for (std::size_t i = 0; i < questions.size(); ++i)
    found[i] = {d.scale * all.average(i), d.scale * all.average(questions.size() + i)};
  return found;
}

}  // namespace sturz
