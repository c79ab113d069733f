// SPDX-License-Identifier: Apache-2.0
#include "ensemble/python/result_views.hpp"

#include <fmt/core.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace sturz::python {
namespace {

namespace py = pybind11;
using Held = std::shared_ptr<MemberResult>;

/// The layer without a copy, [window.n_rows][window.n_cols], read-only; it keeps the result alive.
py::array view(const Held& result, const std::vector<float>& layer) {
  const Window& w = result->window;
  py::array array(py::dtype::of<float>(), {w.n_rows, w.n_cols}, layer.data(), py::cast(result));
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::dict peaks(const Held& result) {
  py::dict all;
  for (int k = 0; k < n_peak_layers; ++k) {
    const std::vector<float>& layer = result->layers[static_cast<std::size_t>(k)];
    if (!layer.empty()) all[info(static_cast<PeakLayer>(k)).name] = view(result, layer);
  }
  return all;
}

/// {name: (long name, units, value of an untouched cell)} of the layers that the result has.
py::dict layer_infos(const MemberResult& result) {
  py::dict all;
  for (int k = 0; k < n_peak_layers; ++k)
    if (!result.layers[static_cast<std::size_t>(k)].empty()) {
      const PeakLayerInfo& i = info(static_cast<PeakLayer>(k));
      all[i.name] = py::make_tuple(i.long_name, i.units, i.untouched);
    }
  return all;
}

py::dict scalars(const MemberResult& result) {
  py::dict all;
  for (const ScalarInfo& scalar : scalar_table())
    if (!scalar.sparse || !std::isnan(result.scalars.*scalar.field))
      all[scalar.name] = result.scalars.*scalar.field;
  return all;
}

py::dict grid(const MemberResult& result) {
  const Grid& g = result.grid;
  py::dict all;
  all["n_rows"] = g.n_rows;
  all["n_cols"] = g.n_cols;
  all["west_m"] = g.west_m;
  all["north_m"] = g.north_m;
  all["cell_m"] = g.cell_m;
  all["crs_wkt"] = g.crs_wkt;
  return all;
}

}  // namespace

void add_result(py::module_& m) {
  py::class_<MemberResult, Held>(m, "Result")
      .def_property_readonly(
          "outcome", [](const MemberResult& r) { return std::string(to_string(r.outcome)); })
      .def_property_readonly("valid", [](const MemberResult& r) { return is_valid(r.outcome); })
      .def_property_readonly(
          "censored", [](const MemberResult& r) { return std::string(to_string(r.censoring)); })
      .def_readonly("reason", &MemberResult::reason)
      .def_readonly("formulation", &MemberResult::formulation)
      .def_readonly("warnings", &MemberResult::warnings)
      .def_property_readonly(
          "state_hash", [](const MemberResult& r) { return fmt::format("{:016x}", r.state_hash); })
      .def_property_readonly("scalars", scalars)
      .def_property_readonly("grid", grid)
      .def_property_readonly("window",
                             [](const MemberResult& r) {
                               return py::make_tuple(r.window.row0, r.window.col0, r.window.n_rows,
                                                     r.window.n_cols);
                             })
      .def_property_readonly("peaks", peaks)
      .def_property_readonly("layer_infos", layer_infos);
}

}  // namespace sturz::python
