// SPDX-License-Identifier: Apache-2.0
#include "reports/fidelity/multilevel_page.hpp"

#include "reports/fidelity/result_words.hpp"
#include "reports/figures/figures.hpp"
#include "reports/layer_titles.hpp"
#include "reports/page/page_head.hpp"
#include "reports/page/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sturz {
namespace {

/// Header cells and rows of one table; the first column are names.
class Table {
 public:
  Table(const std::string& first, const std::vector<std::string>& heads) : heads_(heads) {
    html_ = fmt::format(
        "<div class=\"batch-box\"><table class=\"batch steps\"><thead><tr><th scope=\"col\">{}"
        "</th>",
        html_escape(first));
    for (const std::string& head : heads)
      html_ += fmt::format("<th scope=\"col\" class=\"n\">{}</th>", html_escape(head));
    html_ += "</tr></thead><tbody>";
  }
  void row(const std::string& name, const std::vector<std::string>& cells) {
    html_ += fmt::format("<tr><th scope=\"row\">{}</th>", html_escape(name));
    for (std::size_t i = 0; i < cells.size(); ++i)
      html_ += fmt::format("<td class=\"n\" data-label=\"{}\">{}</td>", html_escape(heads_[i]),
                           html_escape(cells[i]));
    html_ += "</tr>";
  }
  std::string html() const { return html_ + "</tbody></table></div>\n"; }

 private:
  std::vector<std::string> heads_;
  std::string html_;
};

std::string half_width(double value, const std::string& units) {
  return std::isfinite(value) ? "\u00B1 " + with_unit(value, units, 2) : "unknown";
}

/// Bounds of a skewed mean lie farther on one side; half their width would put them elsewhere.
std::string off_by(double below, double above, const std::string& units) {
  if (!std::isfinite(below) || !std::isfinite(above)) return "unknown";
  if (std::abs(above - below) <= 0.05 * (above + below))
    return half_width((above + below) / 2, units);
  return "\u2212 " + with_unit(below, units, 2) + ", + " + with_unit(above, units, 2);
}

/// Bounds of a quantile; an open end where the draws do not tell one.
std::string between(double low, double high, const std::string& units) {
  if (std::isfinite(low) && std::isfinite(high))
    return with_unit(low, units) + " \u2013 " + with_unit(high, units);
  if (std::isfinite(high)) return "below " + with_unit(high, units);
  return std::isfinite(low) ? "above " + with_unit(low, units) : "unknown";
}

std::string share(double value) {
  return std::isfinite(value) ? percent_text(value) : std::string("\u2013");
}

std::string results_html(const MultilevelPage& page) {
  Table means("mean of all members", {"mean", "sampling, 90 %", "resolution", "model"});
  for (const MultilevelPageResult& r : page.results)
    means.row(result_words(r.name),
              {with_unit(r.mean, r.units), off_by(r.below, r.above, r.units),
               half_width(r.resolution, r.units), half_width(r.model, r.units)});
  std::string html =
      "<section id=\"means\"><h2>Means, and by how much they may be off</h2>" + means.html();
  if (page.results.empty() || page.results.front().quantiles.empty()) return html + "</section>\n";
  std::vector<std::string> heads;
  for (const auto& q : page.results.front().quantiles)
    heads.push_back(percent_text(q.level) + " of members below");
  Table quantiles("quantiles", heads);
  for (const MultilevelPageResult& r : page.results) {
    std::vector<std::string> cells;
    for (const auto& q : r.quantiles)
      cells.push_back(
          fmt::format("{} ({})", with_unit(q.value, r.units), between(q.low, q.high, r.units)));
    quantiles.row(result_words(r.name), cells);
  }
  return html + "<h3>Quantiles, with 90 % bounds</h3>" + quantiles.html() +
         "<p class=\"note\">A bound is left open (above, below) where so few members of the "
         "dearest level are expected beyond the quantile that none might be: how many tell it is "
         "said at the top.</p></section>\n";
}

std::string levels_html(const MultilevelPage& page) {
  std::vector<std::string> heads{"members", "seconds a member", "of all seconds"};
  for (const MultilevelPageResult& r : page.results) heads.push_back(result_words(r.name));
  heads.emplace_back("map");
  Table table("level", heads);
  for (const MultilevelPageLevel& l : page.levels) {
    std::vector<std::string> cells{shown_number(l.members), shown_number(l.member_cpu_s, 2) + " s",
                                   share(l.share_of_seconds)};
    for (std::size_t i = 0; i <= page.results.size(); ++i)
      cells.push_back(share(i < l.shares_of_variance.size() ? l.shares_of_variance[i] : nan_d));
    table.row(words(l.name) + (l.used ? "" : " (tried, not used)"), cells);
  }
  return "<section id=\"levels\"><h2>What each level costs and leaves</h2><p class=\"note\">Of "
         "each "
         "result's variance (the square of its sampling error) the share that the level "
         "leaves.</p>" +
         table.html() + "</section>\n";
}

constexpr std::size_t most_assets = 200;

std::string assets_html(const MultilevelPage& page) {
  if (page.assets.empty()) return {};
  std::vector<std::string> heads{"hit"};
  heads.insert(heads.end(), page.exceedances.begin(), page.exceedances.end());
  Table table("asset", heads);
  const std::size_t n = std::min(most_assets, page.assets.size());
  for (std::size_t a = 0; a < n; ++a) {
    const MultilevelPageAsset& asset = page.assets[a];
    std::vector<std::string> cells;
    for (const auto& s : asset.shares)
      cells.push_back(std::isfinite(s.value)
                          ? fmt::format("{}{} ({} \u2013 {})", s.at_least ? "\u2265 " : "",
                                        percent_text(s.value), percent_text(s.low),
                                        percent_text(s.high))
                          : "not known");
    table.row(asset.name, cells);
  }
  return "<section id=\"assets\"><h2>Whether assets are hit, and how hard</h2>" + table.html() +
         fmt::format(
             "<p class=\"note\">Probabilities that a member hits the asset, and that the largest "
             "over the asset's cells exceeds the threshold, with 90 % bounds{}. All columns stand "
             "in assets.csv.</p></section>\n",
             n < page.assets.size()
                 ? fmt::format("; the first {} of {} assets", n, page.assets.size())
                 : std::string());
}

const Layer* layer_of(const LayerStack& maps, Statistic statistic) {
  for (const Layer& layer : maps.layers)
    if (layer.meaning.quantity == Quantity::reached && layer.meaning.statistic == statistic)
      return &layer;
  return nullptr;
}

/// Elsewhere no colour is 0: here it is not.
std::string untold_html(const std::string& note) {
  if (note.empty()) return {};
  return "<p class=\"note\"><strong>No colour: not told, which is not 0.</strong> " +
         html_escape(note) + "</p>";
}

std::string maps_html(const MultilevelPage& page) {
  if (page.maps == nullptr || page.maps->grid.n_cells() == 0) return {};
  const MapScene scene = make_map_scene(*page.maps, page.elevation);
  std::string html = hillshade_defs(scene) + "<section id=\"maps\"><h2>Whether the flow comes</h2>";
  for (const Statistic s :
       {Statistic::probability, Statistic::lower_bound, Statistic::upper_bound}) {
    const Layer* layer = layer_of(*page.maps, s);
    if (layer == nullptr) continue;
    html += fmt::format(
        "<figure><figcaption>{}</figcaption>{}{}</figure>", html_escape(plane_title(*layer, 0)),
        map_figure_svg(scene, *page.maps, *layer, 0, MapMarks{}),
        legend_html(legend_for(*layer)) +
            (s == Statistic::upper_bound ? untold_html(page.upper_bound_note) : std::string()));
  }
  return html + "</section>\n";
}

std::string list_html(const std::vector<std::string>& lines) {
  std::string html = "<ul>";
  for (const std::string& line : lines) html += "<li>" + html_escape(line) + "</li>";
  return html + "</ul>";
}

const char* const reading_html =
    "<section id=\"reading\"><h2>How to read this</h2><p class=\"note\">Few members were computed "
    "as the scene asks for, and many in cheaper ways with the same drawn values. The cheap ones "
    "tell "
    "where the mean lies, the others correct what the cheap ones get wrong: means and "
    "probabilities "
    "are those of the scene itself. Sampling is what more members would remove (90 % bounds); "
    "resolution what finer particles would, estimated from the levels of the same formulation (of "
    "two spacings alone it is mostly the first order that is assumed); model how far another "
    "formulation lies away with the same values, each at its finest spacing here: no member "
    "removes "
    "it, and finer spacings only a part. All numbers stand in multilevel.json, all maps with their "
    "bounds in "
    "hazard.nc.</p></section>\n";

}  // namespace

std::string make_multilevel_page(const MultilevelPage& page) {
  std::string html =
      page_head(page.title + " \u2013 multilevel ensemble", "'none'") + "<body>\n<main>\n" +
      fmt::format(
          "<header class=\"top\"><p class=\"kind\">Multilevel ensemble</p>"
          "<h1>{}</h1><p class=\"origin\">{} \u00B7 {}</p></header>\n",
          html_escape(page.title), html_escape(page.when), html_escape(page.program));
  if (!page.warnings.empty())
    html += "<div class=\"warnings\"><h2>Warnings</h2>" + list_html(page.warnings) + "</div>\n";
  return html + list_html(page.sentences) + results_html(page) + assets_html(page) +
         maps_html(page) + levels_html(page) + reading_html + "</main>\n</body>\n</html>\n";
}

}  // namespace sturz
