// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/results/hazard_file.hpp"

#include "ensemble/hazard/stack_hash.hpp"
#include "ensemble/workflow/version.hpp"
#include "io/netcdf/netcdf_layers.hpp"

#include <fmt/core.h>

namespace sturz::workflow {

HazardContext hazard_context(const Manifest& manifest, const Scenario& scenario,
                             const DesignTable& design) {
  HazardContext context;
  context.spacing_m = manifest.spacing_m;
  context.n_planned = design.n_members();
  // Without a date: the same members make the same bytes. manifest.json has the date.
  context.attributes = {{"title", scenario.title.empty() ? "Landslide hazard" : scenario.title},
                        {"source", fmt::format("sturz {} ({})", version, git_commit)},
                        {"history", fmt::format("sturz {}", manifest.command)},
                        {"censored_members", manifest.censored},
                        {"design", fmt::format("{}, {} members, seed {}", to_string(design.design),
                                               design.n_members(), design.seed)}};
  if (manifest.stop) context.attributes.emplace_back("stop_rule", stop_text(*manifest.stop));
  return context;
}

std::string write_hazard(const std::filesystem::path& file, const MemberStore& store,
                         const HazardSpec& spec, const HazardContext& context) {
  LayersFileWriter writer(file);
  HashingSink hashed(writer);
  make_hazard_map(store, spec, context, hashed);
  context.cancel.check();
  writer.commit();
  return fmt::format("{:016x}", hashed.value());
}

}  // namespace sturz::workflow
