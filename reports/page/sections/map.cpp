// SPDX-License-Identifier: Apache-2.0
#include "reports/figures/figures.hpp"
#include "reports/page/report.hpp"
#include "reports/page/sections/sections.hpp"
#include "reports/page/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

constexpr std::size_t max_still_figures = 6;

/// The plane that stands for a layer in a still picture: the median quantile, else the first
/// threshold that the resolution allows, else the first plane.
std::size_t typical_plane(const Layer& layer, double resolved_thickness_m) {
  const auto& values = layer.axis.values;
  const Statistic statistic = layer.meaning.statistic;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (statistic == Statistic::quantile && std::abs(values[k] - 0.5) < 1e-9) return k;
    if (statistic == Statistic::probability &&
        (layer.axis.units != "m" || values[k] >= resolved_thickness_m))
      return k;
  }
  return 0;
}

std::string still_figure(const MapScene& scene, const LayerStack& maps, const Layer& layer,
                         double resolved_thickness_m, const MapMarks& marks) {
  const std::size_t plane = typical_plane(layer, resolved_thickness_m);
  return fmt::format("<figure><figcaption>{}</figcaption>{}{}</figure>",
                     html_escape(plane_title(layer, plane)),
                     map_figure_svg(scene, maps, layer, plane, marks),
                     legend_html(legend_for(layer)) + marks_legend_html(marks));
}

/// One picture each of what readers ask for most, as far as the stack has it; the first layer to
/// look at comes first. A single run has one statistic per quantity, so all its layers come.
std::vector<const Layer*> still_layers(const LayerStack& maps) {
  struct Wish {
    Quantity quantity;
    Statistic statistic;
  };
  static constexpr Wish wishes[] = {{Quantity::solid_reached, Statistic::probability},
                                    {Quantity::liquid_reached, Statistic::probability},
                                    {Quantity::thickness, Statistic::quantile},
                                    {Quantity::sources, Statistic::value},
                                    {Quantity::energy, Statistic::source_quantile},
                                    {Quantity::energy, Statistic::probability},
                                    {Quantity::speed, Statistic::quantile},
                                    {Quantity::arrival, Statistic::quantile},
                                    {Quantity::deposit, Statistic::quantile}};
  const std::vector<const Layer*> shown = shown_layers(maps);
  std::vector<const Layer*> chosen{default_layer(maps)};
  for (const Wish& wish : wishes)
    for (const Layer* layer : shown) {
      const LayerMeaning& m = layer->meaning;
      if (m.quantity == wish.quantity && m.statistic == wish.statistic) chosen.push_back(layer);
    }
  // A still picture has a palette of 256.
  std::erase_if(chosen, [](const Layer* layer) { return layer->classes.size() > 200; });
  for (const Layer* layer : shown)
    if (layer->classes.size() <= 200 &&
        std::find(chosen.begin(), chosen.end(), layer) == chosen.end())
      chosen.push_back(layer);
  if (chosen.size() > max_still_figures) chosen.resize(max_still_figures);
  return chosen;
}

std::string still_figures(const ReportInput& input, const MapScene& scene, const LayerStack& maps) {
  std::string html = "<div id=\"still-maps\" class=\"stills\">";
  MapMarks marks = map_marks(scene, maps, input.release);
  marks.observed = input.observed;
  marks.observed_note = input.observed_note;
  if (input.nearest != nullptr) {
    marks.nearest = cell_outline(*input.nearest);
    marks.nearest_label = nearest_label(input.nearest_member, input.hazard == nullptr);
  }
  for (const Layer* layer : still_layers(maps)) {
    input.cancel.check();
    html += still_figure(scene, maps, *layer, input.resolved_thickness_m, marks);
  }
  return html + "</div>";
}

/// " (EPSG:32633)" where the whole system, not only a part of it, has a code: the last thing in
/// its WKT.
std::string epsg_text(const std::string& wkt) {
  const std::size_t at = wkt.rfind("\"EPSG\",");
  if (at == std::string::npos) return {};
  const std::size_t from = wkt.find_first_of("0123456789", at);
  const std::size_t to = wkt.find_first_not_of("0123456789", from);
  if (from == std::string::npos || to == std::string::npos) return {};
  std::size_t closed = 0;
  for (std::size_t i = to; i < wkt.size(); ++i) closed += wkt[i] == ']';
  return closed == 2 ? " (EPSG:" + wkt.substr(from, to - from) + ")" : "";
}

/// Name of the coordinate system: the first quoted text of its WKT, and its code.
std::string crs_name(const std::string& wkt) {
  const std::size_t open = wkt.find('"');
  if (open == std::string::npos) return "local coordinates";
  return wkt.substr(open + 1, wkt.find('"', open + 1) - open - 1) + epsg_text(wkt);
}

}  // namespace

std::string map_html(const ReportInput& input, const MapScene* scene, const LayerStack* maps) {
  const bool hazard = input.hazard != nullptr;
  std::string html = fmt::format("<section id=\"maps\"><h2>{}</h2>", input.region != nullptr
                                                                         ? "Maps of all sources"
                                                                     : hazard ? "Hazard maps"
                                                                              : "Maps of the run");
  if (scene == nullptr || maps == nullptr || default_layer(*maps) == nullptr)
    return html +
           "<p class=\"empty\">There is no map to show: no member left a valid one.</p></section>";
  html += "<div id=\"map-app\" class=\"map-app\" hidden></div>";
  html += "<p id=\"still-note\" class=\"note\">";
  html += report_has_script()
              ? "These are still pictures. The maps that can be switched and queried need script "
                "and a browser from 2023 on."
              : "These are still pictures: this sturz was built without the script bundle "
                "(STURZ_REPORT_JS=OFF, or node was missing). All maps are in the result files.";
  html += "</p>" + hillshade_defs(*scene) + still_figures(input, *scene, *maps);
  const int joined = scene->coarsening * maps->joined;
  html += fmt::format(
      "<p class=\"note\">{}; cells of {}{}.</p>", html_escape(crs_name(maps->grid.crs_wkt)),
      with_unit(scene->cells.cell_m, "m"),
      joined > 1 ? fmt::format(" (the most severe of {0} x {0} cells of the result files)", joined)
                 : std::string());
  return html + "</section>";
}

std::string charts_html(const ReportInput& input, const Headline& h) {
  if (h.n_valid < 2 || !report_has_script()) return {};
  std::string html =
      "<section id=\"spread\" class=\"needs-script\" hidden><h2>Spread of the simulations</h2>"
      "<div class=\"charts\">"
      "<figure class=\"chart\"><figcaption>How far the simulations ran<small id=\"read-runout\">"
      "</small></figcaption>"
      "<div id=\"chart-runout\"></div></figure>";
  if (input.convergence.size() > 1)
    html +=
        "<figure class=\"chart\"><figcaption>Would more simulations change the map? "
        "<select id=\"pick-convergence\" aria-label=\"Number to follow\"></select></figcaption>"
        "<div id=\"chart-convergence\"></div></figure>";
  html += "</div>";
  if (!input.stop_rule.empty())
    html += fmt::format(
        "<p class=\"note\">The number of simulations followed from a stop rule: {}. Each cell's "
        "interval was made for one look; of a rule that looks often, a few more than 5 % lie "
        "beyond."
        "</p>",
        html_escape(input.stop_rule));
  if (!input.samples.rows.empty())
    html +=
        "<h3>What drives the runout</h3><p class=\"note\">One dot per simulation. \u03C4 is the "
        "rank "
        "correlation with runout (Kendall): of the pairs of simulations whose order is known, the "
        "share that runs farther with the larger value, less the share that runs less far. " +
        std::string(h.censoring.censored() > 0
                        ? "Rings with an arrow are cut off: they ran at least so far, and pairs of "
                          "them, or with one that came to rest farther, are not counted. "
                        : "") +
        "Crosses are simulations that failed.</p>"
        "<div id=\"chart-scatter\" class=\"charts scatter\"></div>";
  return html + "</section>";
}

}  // namespace sturz
