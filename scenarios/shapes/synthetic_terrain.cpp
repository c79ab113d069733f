// SPDX-License-Identifier: Apache-2.0
#include "scenarios/shapes/synthetic_terrain.hpp"

#include "engine/core/error.hpp"
#include "scenarios/checks/validate.hpp"
#include "scenarios/schema/number_text.hpp"
#include "scenarios/schema/schema.hpp"
#include "scenarios/schema/suggest.hpp"
#include "scenarios/shapes/shape.hpp"

namespace sturz {
namespace {

/// An explicit list: a newcomer finds every shape here.
const std::vector<shapes::Shape>& all_shapes() {
  static const std::vector<shapes::Shape> all = {
      shapes::plane(), shapes::bowl(),        shapes::step(),      shapes::flume(),
      shapes::ramp(),  shapes::zhangjiawan(), shapes::shuicheng(), shapes::debris_flume(),
  };
  return all;
}

const shapes::Shape* find_shape(const std::string& name) {
  for (const auto& shape : all_shapes())
    if (shape.name == name) return &shape;
  return nullptr;
}

}  // namespace

std::vector<std::string> synthetic_shapes() {
  std::vector<std::string> names;
  for (const auto& shape : all_shapes()) names.emplace_back(shape.name);
  return names;
}

bool brings_source(const std::string& shape) {
  const auto* found = find_shape(shape);
  return found && found->brings_source;
}

std::vector<ShapeParameter> shape_parameters(const std::string& shape) {
  const auto* found = find_shape(shape);
  require(found, "terrain.synthetic = " + shape + " (unknown shape).");
  return found->parameters;
}

SyntheticScene make_synthetic(const SyntheticTerrain& terrain) {
  std::string problems;
  for (const auto& problem : check_value(*find_key("terrain.synthetic"), terrain))
    problems += (problems.empty() ? "" : "\n") + problem.message;
  require(problems.empty(), problems);
  const auto& shape = *find_shape(terrain.shape);
  shapes::Numbers numbers;
  for (const auto& parameter : shape.parameters) numbers[parameter.name] = parameter.default_value;
  for (const auto& [name, value] : terrain.parameters) numbers[name] = value;
  return shape.build(numbers, terrain.cell_size_m);
}

}  // namespace sturz
