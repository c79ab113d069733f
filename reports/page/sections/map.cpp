// SPDX-License-Identifier: Apache-2.0
#include "reports/figures/figures.hpp"
#include "reports/page/crs_text.hpp"
#include "reports/page/cut_off_text.hpp"
#include "reports/page/report.hpp"
#include "reports/page/sections/sections.hpp"
#include "reports/page/text.hpp"
#include "reports/texts/text_table.hpp"

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

}  // namespace

std::string title_block_html(const ReportInput& input, const Headline& h, const MapScene& scene,
                             const LayerStack& maps) {
  const PlainWords words = plain_words(input, h);
  const auto value = [&](const std::string& key) {
    for (const auto& [k, v] : input.manifest)
      if (k == key) return v;
    return std::string();
  };
  std::string rows;
  const auto row = [&rows](const char* key, const std::string& text) {
    if (!text.empty())
      rows += "<div><dt>" + html_escape(tr(key)) + "</dt><dd>" + html_escape(text) + "</dd></div>";
  };
  row("sheet.system", crs_name(maps.grid.crs_wkt));
  row("sheet.cells", with_unit(scene.cells.cell_m, "m"));
  row("sheet.rests_on",
      input.region != nullptr ? tr("sheet.region", input.region->sources.size())
      : input.comparison != nullptr
          ? tr("header.comparison", input.comparison->valid_a, input.comparison->valid_b)
      : input.hazard != nullptr ? tr("sheet.valid_of", h.n_valid, std::max(h.n_members, h.n_valid))
                                : tr("sheet.one_run"));
  row("sheet.started", moment_text(value("started")));
  row("sheet.program", value("program"));
  row("sheet.hash", value("hash of the maps"));
  row("sheet.sheets", tr("sheet.map_sheet"));
  const std::vector<std::string> cut = cut_off_sentences(h.censoring);
  return "<aside class=\"title-block print-only\"><h1>" +
         html_escape(input.title.empty() ? tr("header.untitled") : input.title) +
         "</h1><p class=\"finding\">" + html_escape(words.finding) + "</p><p>" +
         html_escape(words.holds) + "</p>" +
         (cut.empty() ? "" : "<p class=\"cut-line\">" + html_escape(cut.front()) + "</p>") +
         "<dl>" + rows + "</dl><p>" + html_escape(tr("sheet.not_official")) + "</p></aside>";
}

std::string map_html(const ReportInput& input, const Headline& h, const MapScene* scene,
                     const LayerStack* maps) {
  std::string html = "<section id=\"maps\"><h2 class=\"screen-only\">" +
                     html_escape(tr(input.region != nullptr   ? "map.title_region"
                                    : input.hazard != nullptr ? "map.title_ensemble"
                                                              : "map.title_single")) +
                     "</h2>";
  if (scene == nullptr || maps == nullptr || default_layer(*maps) == nullptr)
    return html + "<p class=\"empty\">" + html_escape(tr("map.none")) + "</p></section>";
  html += "<div id=\"map-app\" class=\"map-app\" hidden></div>";
  html += "<p id=\"still-note\" class=\"note\">";
  html += html_escape(tr(report_has_script() ? "map.stills_script" : "map.stills_built_without"));
  html += "</p>" + hillshade_defs(*scene) + "<div class=\"map-sheet\">" +
          still_figures(input, *scene, *maps) +
          "<figure id=\"seen-map\" class=\"print-only\" hidden></figure>" +
          title_block_html(input, h, *scene, *maps) + "</div>";
  const int joined = scene->coarsening * maps->joined;
  return html + "<p class=\"note screen-only\">" +
         html_escape(tr("map.cells", crs_name(maps->grid.crs_wkt),
                        with_unit(scene->cells.cell_m, "m"),
                        joined > 1 ? tr("map.joined", joined) : std::string())) +
         "</p></section>";
}

std::string charts_html(const ReportInput& input, const Headline& h) {
  if (h.n_valid < 2 || !report_has_script()) return {};
  std::string html = "<section id=\"spread\" class=\"needs-script\" hidden><h2>" +
                     html_escape(tr("spread.title")) +
                     "</h2><div class=\"charts\"><figure class=\"chart\"><figcaption>" +
                     html_escape(tr("spread.runout")) +
                     "<small id=\"read-runout\"></small></figcaption>"
                     "<div id=\"chart-runout\"></div></figure>";
  if (input.convergence.size() > 1)
    html += "<figure class=\"chart\"><figcaption>" + html_escape(tr("spread.more")) +
            " <select id=\"pick-convergence\" aria-label=\"" + html_escape(tr("spread.follow")) +
            "\"></select></figcaption><div id=\"chart-convergence\"></div></figure>";
  html += "</div>";
  if (!input.stop_rule.empty())
    html += "<p class=\"note\">" + html_escape(tr("spread.stop_rule", input.stop_rule)) + "</p>";
  if (!input.samples.rows.empty())
    html += "<h3>" + html_escape(tr("spread.drives")) + "</h3><p class=\"note\">" +
            html_escape(tr("spread.note") +
                        (h.censoring.censored() > 0 ? tr("spread.note_cut") : std::string()) +
                        tr("spread.note_failed")) +
            "</p><div id=\"chart-scatter\" class=\"charts scatter\"></div>";
  return html + "</section>";
}

}  // namespace sturz
