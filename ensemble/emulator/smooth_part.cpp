// SPDX-License-Identifier: Apache-2.0
#include "ensemble/emulator/smooth_part.hpp"

#include "engine/core/error.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

using Points = std::vector<std::vector<double>>;

bool has_process(const Points& points, std::span<const double> values, std::size_t over_dims) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return points.size() >= points.front().size() + over_dims && *least < *most;
}

}  // namespace

SmoothPart::SmoothPart(const Points& points, std::span<const double> values) {
  expect(!points.empty() && points.size() == values.size(), "one value per point, one at least");
  if (has_process(points, values, points_over_dims))
    process_ = GaussianProcess::fitted(points, values);
  else
    take_mean(values);
}

SmoothPart::SmoothPart(const Points& points, std::span<const double> values,
                       const SmoothPart& like) {
  expect(!points.empty() && points.size() == values.size(), "one value per point, one at least");
  if (like.process_ && has_process(points, values, 2))
    process_.emplace(points, values, like.process_->scales());
  else
    take_mean(values);
}

void SmoothPart::take_mean(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  double squares = 0;
  for (const double v : values) mean_.mean += v / n;
  for (const double v : values) squares += (v - mean_.mean) * (v - mean_.mean);
  mean_.noise = n > 1 ? squares / (n - 1) : 0;
  mean_.variance = mean_.noise / n;
  const double limit = 1.959963984540054 * std::sqrt(mean_.noise + mean_.variance);
  double covered = 0, errors = 0;
  for (const double v : values) {
    const double others = n > 1 ? (n * mean_.mean - v) / (n - 1) : v;
    left_out_.predicted.push_back(others);
    errors += (v - others) * (v - others);
    covered += std::abs(v - others) <= limit;
  }
  left_out_.q2 = squares > 0 ? 1 - errors / squares : 1;
  left_out_.coverage95 = covered / n;
}

GaussianPrediction SmoothPart::at(std::span<const double> point) const {
  return process_ ? process_->at(point) : mean_;
}

double SmoothPart::mean_at(std::span<const double> point) const {
  return process_ ? process_->mean_at(point) : mean_.mean;
}

const LeaveOneOut& SmoothPart::leave_one_out() const {
  return process_ ? process_->leave_one_out() : left_out_;
}

SmoothPart SmoothPart::with_point(std::span<const double> point) const {
  return process_ ? SmoothPart(process_->with_point(point)) : *this;
}

}  // namespace sturz
