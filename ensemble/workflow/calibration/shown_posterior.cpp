// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/calibration/shown_posterior.hpp"

#include "engine/core/error.hpp"
#include "ensemble/sampling/design.hpp"
#include "io/files/checksum.hpp"
#include "io/files/text_files.hpp"
#include "scenarios/schema/schema.hpp"
#include "scenarios/schema/value_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

double number(const Json& value) {
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

void read_three(const Json& from, double (&to)[3]) {
  to[0] = number(from.at("p5"));
  to[1] = number(from.at("median"));
  to[2] = number(from.at("p95"));
}

std::string origin_of(const Json& all) {
  const Json& sample = all.at("sample");
  const Json& at = all.at("found_at");
  const auto chosen = sample.at("members_chosen").get<std::int64_t>();
  const bool chains = sample.contains("chains");
  return fmt::format(
      "By {} ({}), from {} members{}; {} {:.0f} independent {}. Found in {} at a spacing of "
      "{:.4g} m: the values belong to these.",
      sample.at("method").get<std::string>(), sample.at("reason").get<std::string>(),
      sample.at("members_drawn").get<std::int64_t>(),
      chosen > 0 ? fmt::format(" and {} chosen ones", chosen) : "", chains ? "chains of" : "worth",
      number(sample.at("effective_size")), chains ? "draws" : "members",
      at.at("formulation").get<std::string>(), number(at.at("spacing_m")));
}

void read_quantities(const Json& all, PosteriorShown& shown) {
  for (const Json& q : all.at("predictive_check")) {
    PosteriorShown::Quantity one;
    one.name = q.at("name");
    one.unit = q.at("unit");
    one.observed = number(q.at("observed"));
    read_three(q, one.check);
    one.ends_at_zero = q.value("ends_at_least", false);
    shown.quantities.push_back(std::move(one));
  }
  const Json& held = all.at("held_out");
  if (!held.is_object()) return;
  std::size_t place = 0;
  for (const Json& q : held.at("quantities")) {
    if (place >= shown.quantities.size()) break;
    shown.quantities[place].has_held_out = true;
    read_three(q, shown.quantities[place++].held_out);
  }
  for (const Json& r : held.at("reliability"))
    shown.reliability.emplace_back(number(r.at("nominal")), number(r.at("inside")));
}

PosteriorShown::Quantity* quantity_named(PosteriorShown& shown, const std::string& name) {
  for (PosteriorShown::Quantity& q : shown.quantities)
    if (q.name == name) return &q;
  return nullptr;
}

void read_best(const Json& all, PosteriorShown& shown) {
  if (!all.at("best_fit").is_array()) return;
  for (const Json& b : all.at("best_fit")) {
    PosteriorShown::Quantity* const q = quantity_named(shown, b.at("name").get<std::string>());
    if (q == nullptr) continue;
    q->best_expected = number(b.at("emulated"));
    if (!b.contains("computed_is")) continue;
    q->best_member = number(b.at("computed"));
    const auto is = b.at("computed_is").get<std::string>();
    if (is != "known") q->best_computed = is;
  }
}

void read_emulators(const Json& all, PosteriorShown& shown) {
  for (const Json& e : all.at("emulators")) {
    PosteriorShown::Quantity* const q = quantity_named(shown, e.at("quantity").get<std::string>());
    if (q == nullptr) continue;
    q->q2 = number(e.at("q2"));
    q->has_step = e.contains("step") && e.at("step").is_object();
  }
}

void read_discrepancy(const Json& all, PosteriorShown& shown) {
  const Json& from = all.at("discrepancy");
  shown.discrepancy_scale = number(from.at("prior_scale"));
  for (const Json& d : from.at("found"))
    shown.discrepancies.push_back({d.at("kind").get<std::string>(), number(d.at("mean")),
                                   number(d.at("p5")), number(d.at("p95"))});
}

PosteriorShown read(const Json& all) {
  PosteriorShown shown;
  shown.origin = origin_of(all);
  for (const Json& k : all.at("keys")) {
    PosteriorShown::Key key;
    read_three(k.at("prior"), key.before);
    read_three(k.at("posterior"), key.after);
    key.variance_removed = number(k.at("variance_removed"));
    if (k.contains("best_fit")) key.best = number(k.at("best_fit"));
    shown.keys.push_back(key);
  }
  read_quantities(all, shown);
  read_best(all, shown);
  read_emulators(all, shown);
  read_discrepancy(all, shown);
  for (const Json& r : all.at("identifiability").at("ridges"))
    shown.ridges.push_back(fmt::format(
        "Ridge: {} and {} (correlation {:.2f}). The observations know a combination of them, not "
        "each.",
        r.at("keys").at(0).get<std::string>(), r.at("keys").at(1).get<std::string>(),
        number(r.at("correlation"))));
  for (const Json& w : all.at("warnings")) shown.warnings.push_back(w.get<std::string>());
  return shown;
}

std::optional<PosteriorShown> read_files(const fs::path& json, const fs::path& csv,
                                         const std::string& members,
                                         const std::string& observation) {
  try {
    const Json all = Json::parse(read_text(json));
    if (all.at("members_hash").get<std::string>() != members ||
        all.at("observation_hash").get<std::string>() != observation)
      return {};
    PosteriorShown shown = read(all);
    const DesignTable rows = from_csv(read_text(csv));
    require(rows.keys.size() == shown.keys.size(),
            csv.string() + " and posterior.json are not of one calibration. Calibrate again.");
    shown.rows = {rows.keys, rows.units, rows.values};
    return shown;
  } catch (const Json::exception&) {
    throw SetupError(json.string() +
                     " is damaged (it is no posterior). Remove it, or calibrate "
                     "again.");
  }
}

}  // namespace

std::string observation_hash(const Scenario& scenario, const std::vector<InputIdentity>& inputs) {
  std::string text;
  for (const KeyInfo& key : schema())
    if (key.path.starts_with("observation.") && key.kind != ValueKind::path)
      text += fmt::format("{}={}\n", key.path, value_text(key.get(scenario)));
  for (const InputIdentity& input : inputs) {
    if (!input.role.starts_with("observation.")) continue;
    text += fmt::format("{}: {}\n", input.role, input.shape);
    for (const auto& [part, hash] : input.parts) text += fmt::format("{}={}\n", part, hash);
  }
  return text_checksum(text);
}

std::optional<PosteriorShown> shown_posterior(const OutputFolder& folder, const Manifest& manifest,
                                              const Scenario& scenario, Observer& observer) {
  const fs::path json = folder.root / "posterior.json", csv = folder.root / "posterior.csv";
  if (!fs::exists(json) || !fs::exists(csv)) return {};
  try {
    return read_files(json, csv, manifest.maps_of, observation_hash(scenario, manifest.inputs));
  } catch (const SetupError& problem) {
    observer.warning(fmt::format("{} The page is without it.", problem.what()));
    return {};
  }
}

}  // namespace sturz::workflow
