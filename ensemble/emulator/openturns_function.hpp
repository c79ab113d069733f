// SPDX-License-Identifier: Apache-2.0
/// A function of ours as OpenTURNS wants to have it.
#pragma once

#include <openturns/EvaluationImplementation.hxx>
#include <openturns/Function.hxx>

#include <algorithm>
#include <functional>
#include <span>
#include <utility>

namespace sturz {

/// Any function of n numbers that gives one. What it refers to must outlive every copy.
class ScalarEvaluation final : public OT::EvaluationImplementation {
 public:
  using Call = std::function<double(std::span<const double>)>;
  ScalarEvaluation(std::size_t n, Call call) : n_(n), call_(std::move(call)) {
    setInputDescription(OT::Description::BuildDefault(n, "x"));
    setOutputDescription(OT::Description::BuildDefault(1, "y"));
  }
  ScalarEvaluation* clone() const override { return new ScalarEvaluation(*this); }
  OT::UnsignedInteger getInputDimension() const override { return n_; }
  OT::UnsignedInteger getOutputDimension() const override { return 1; }
  OT::Bool isParallel() const override { return false; }
  OT::Point operator()(const OT::Point& point) const override {
    return OT::Point(1, call_(std::span<const double>(point.data(), point.getSize())));
  }
  using OT::EvaluationImplementation::operator();

 private:
  std::size_t n_;
  Call call_;
};

inline OT::Point openturns_point(std::span<const double> values) {
  OT::Point point(values.size());
  std::copy(values.begin(), values.end(), point.begin());
  return point;
}

inline OT::Function openturns_function(std::size_t n, ScalarEvaluation::Call call) {
  return {ScalarEvaluation(n, std::move(call))};
}

}  // namespace sturz
