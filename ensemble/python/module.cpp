// SPDX-License-Identifier: Apache-2.0
// The module `_sturz`: the workflow's Evaluator for Python. The package `sturz` has what people
// use.
#include "engine/core/error.hpp"
#include "ensemble/python/fork_guard.hpp"
#include "ensemble/python/result_views.hpp"
#include "ensemble/workflow/evaluation/evaluator.hpp"
#include "ensemble/workflow/version.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <atomic>
#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace sturz::python {
namespace {

namespace py = pybind11;
using workflow::Evaluator;

/// Looks for Ctrl-C and tells the caller's function; runs without the lock of the interpreter
/// except there.
class Listener {
 public:
  explicit Listener(py::object told) : told_(std::move(told)) {}

  const std::atomic<bool>& cancel() const { return cancel_; }
  /// What Python raised ends the member; rethrow() raises it once the engine has come back.
  void hear(const Progress& p) {
    const py::gil_scoped_acquire interpreter;
    try {
      tell(p);
    } catch (...) {
      raised_ = std::current_exception();
      cancel_.store(true);
    }
  }
  void rethrow() const {
    if (raised_) std::rethrow_exception(raised_);
  }

 private:
  void tell(const Progress& p) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (told_.is_none()) return;
    py::dict now;
    now["time_s"] = p.time_s;
    now["end_time_s"] = p.end_time_s;
    now["front_travel_m"] = p.front_travel_m;
    now["kinetic_energy_j"] = p.kinetic_energy_j;
    now["max_speed_m_s"] = p.max_speed_m_s;
    now["steps"] = p.n_steps;
    now["particles"] = p.n_particles;
    if (told_(now).is(py::bool_(false))) cancel_.store(true);
  }

  py::object told_;  ///< callable that may return False to cancel, or None
  std::atomic<bool> cancel_{false};
  std::exception_ptr raised_;
};

std::shared_ptr<MemberResult> run(Evaluator& evaluator, const std::vector<double>& values,
                                  const py::object& on_progress) {
  const Computing computing;
  if (const int n = threads_here(evaluator.threads()); n != evaluator.threads())
    evaluator.set_threads(n);
  Listener listener(on_progress);
  std::shared_ptr<MemberResult> result;
  {
    const py::gil_scoped_release others_may_run;
    result = std::make_shared<MemberResult>(evaluator.evaluate(
        values, listener.cancel(), [&listener](const Progress& p) { listener.hear(p); }));
  }
  listener.rethrow();
  return result;
}

std::unique_ptr<Evaluator> load(const std::string& file, const std::vector<std::string>& overrides,
                                int threads, int workers) {
  require_whole_process();
  workflow::EvaluatorRequest request;
  request.scene = {file, overrides, {}, false};
  request.threads = threads;
  request.workers = workers;
  return std::make_unique<Evaluator>(request);
}

std::vector<std::vector<std::string>> keys(const Evaluator& evaluator) {
  std::vector<std::vector<std::string>> all;
  for (const UncertainKey& key : evaluator.keys()) all.push_back({key.path, key.units});
  return all;
}

}  // namespace
}  // namespace sturz::python

namespace py = pybind11;

PYBIND11_MODULE(_sturz, m) {
  using namespace sturz;
  m.doc() = "One member of a sturz scene in this process; use it through the package sturz.";
  python::watch_forks();
  m.attr("version") = workflow::version;
  m.attr("commit") = workflow::git_commit;
  py::register_exception<SetupError>(m, "SetupError", PyExc_ValueError);
  python::add_result(m);
  py::class_<workflow::Evaluator>(m, "Evaluator")
      .def(py::init(&python::load), py::arg("file"), py::arg("overrides"), py::arg("threads"),
           py::arg("workers"))
      .def_property_readonly("keys", &python::keys)
      .def_property_readonly("medians", &workflow::Evaluator::medians)
      .def_property_readonly("threads", &workflow::Evaluator::threads)
      .def_property_readonly(
          "warnings", [](const workflow::Evaluator& e) { return e.scene().description.warnings; })
      .def("run", &python::run, py::arg("values"), py::arg("on_progress"));
}
