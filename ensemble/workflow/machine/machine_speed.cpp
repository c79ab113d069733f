// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/machine/machine_speed.hpp"

#include "engine/core/error.hpp"
#include "engine/core/thread_time.hpp"
#include "ensemble/workflow/version.hpp"
#include "io/files/text_files.hpp"
#include "io/site/scene_inputs.hpp"
#include "scenarios/assembly/assemble.hpp"

#include <nlohmann/json.hpp>

#include <fstream>
#include <string>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

/// 40 m x 20 m x 5 m of rock on a 30 degree plane of 200 m x 100 m around the origin: 4000
/// particles, or 3200 columns half a metre apart; a mid-size member.
Scenario reference_scene(const std::string& formulation) {
  const bool columns = formulation == to_string(Formulation::depth_averaged);
  Scenario s;
  s.title = "reference slide";
  s.terrain.synthetic = SyntheticTerrain{"plane", 5, {{"slope_deg", 30}}};
  s.release.box = ReleaseBox{{-60, -20}, {-10, 10}};
  s.release.thickness_m = Uncertain(5);
  s.grains.emplace();
  s.grains->friction.emplace();
  s.basal.friction_coefficient = Uncertain(0.3);
  s.formulation = from_word<Formulation>(formulation).value();
  s.numerics.spacing_m = columns ? 0.5 : 1;
  s.numerics.end_time_s = columns ? 8 : 1.5;
  if (s.formulation == Formulation::discrete) {  // 4600 grains, 1500 steps
    s.grains->diameter_m = Uncertain(1);
    s.numerics.end_time_s = 0.5;
  }
  s.numerics.stop_at_rest = false;
  s.hazard.cell_size_m = 5;
  return s;
}

double measure(const std::string& formulation) {
  const Scenario scene = reference_scene(formulation);
  const SceneInputs inputs = load_scene_inputs(scene);
  Simulation slide = assemble(scene, inputs, 0, 1);
  const double begin = thread_cpu_seconds();
  const MemberScalars s = slide.run().scalars;
  const double seconds = thread_cpu_seconds() - begin;
  expect(seconds > 0 && s.n_steps > 0, "the reference slide runs");
  return s.n_particles * s.n_steps / seconds;
}

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

/// What is stored for this machine and build.
nlohmann::json stored_speeds(const fs::path& file, const std::string& key) {
  std::ifstream in(file);
  auto all = nlohmann::json::parse(in, nullptr, false);
  if (all.is_object() && all.value("measured_on", "") == key) return all;
  return {{"measured_on", key}};
}

/// 0 when nothing that fits is stored.
double stored_speed(const fs::path& file, const std::string& key, const std::string& formulation) {
  return stored_speeds(file, key).value(formulation, 0.0);
}

}  // namespace

double updates_per_second(const std::string& formulation, const SpeedCache& cache) {
  const fs::path& file = cache.file;
  const std::string key = processor() + ", sturz " + version + " " + git_commit + " " + build_type;
  if (!cache.measure_again && !file.empty())
    if (const double speed = stored_speed(file, key, formulation); speed > 0) return speed;
  const double speed = measure(formulation);
  std::error_code failed;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), failed);
  if (!file.empty() && !failed) {
    try {
      nlohmann::json all = stored_speeds(file, key);
      all[formulation] = speed;
      write_text_atomic(file, all.dump(2) + "\n");
    } catch (const SetupError&) {
      // only a cache
    }
  }
  return speed;
}

}  // namespace sturz::workflow
