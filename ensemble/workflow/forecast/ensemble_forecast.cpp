// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/forecast/ensemble_forecast.hpp"

#include "ensemble/workflow/cost_warnings.hpp"
#include "ensemble/workflow/machine/map_cost.hpp"

namespace sturz::workflow {
namespace {

/// A trial takes about a second of each of these [s].
constexpr double worth_trying_s = 10;

/// All members that may be computed: a stop rule may end before.
const DesignTable& design_of(const EnsembleJob& job) {
  return job.growth ? job.growth->whole : job.design;
}

std::int64_t members_to_do(const EnsembleJob& job) {
  return static_cast<std::int64_t>(job.to_do.size()) + design_of(job).n_members() -
         job.design.n_members();
}

/// Without a look at the scene; a member's own files and processes take their time however small
/// it is.
double rough_seconds(const EnsembleJob& job) {
  constexpr double least_member_s = 0.02, least_map_s = 0.03, opening_s = 0.003;
  return static_cast<double>(members_to_do(job)) *
             (job.scene.description.predicted_seconds + least_member_s) / job.workers +
         static_cast<double>(design_of(job).n_members()) * opening_s +
         map_planes(job.scene.scenario.hazard, job.scene.scenario.erosion.has_value(),
                    has_materials(job.scene.scenario)) *
             least_map_s;
}

}  // namespace

std::optional<Forecast> forecast_of(EnsembleJob& job, const SpeedCache& cache, double start_s,
                                    Observer& observer, CancelFlag cancel) {
  if (job.to_do.empty() || rough_seconds(job) < worth_trying_s) return std::nullopt;
  ForecastRequest request;
  request.design = &design_of(job);
  request.members = members_to_do(job);
  request.workers = job.workers;
  request.speed_cache = cache;
  request.start_s = start_s;
  request.cancel = cancel;
  Forecast f = forecast(job.scene, request);
  job.scene.description.predicted_seconds = f.member_s.likely;
  for (const std::string& warning :
       cost_warnings(job.scene, request.members, job.workers * job.threads, f.maps_s.likely))
    observer.warning(warning);
  return f;
}

}  // namespace sturz::workflow
