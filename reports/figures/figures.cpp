// SPDX-License-Identifier: Apache-2.0
#include "reports/figures/figures.hpp"

#include "reports/figures/png.hpp"
#include "reports/texts/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace sturz {
namespace {

constexpr double map_width = 640;  // SVG units; text sizes are in the same units
constexpr double opacity = 0.78;
constexpr const char* font =
    "font-family=\"system-ui, 'Segoe UI', Roboto, 'Helvetica Neue', Arial, sans-serif\"";

/// Where map coordinates fall in a figure whose map starts at (left, top).
struct Frame {
  const Grid& ground;
  double left = 0, top = 0;
  double scale() const { return map_width / (ground.east_m() - ground.west_m); }
  double height() const { return (ground.north_m - ground.south_m()) * scale(); }
  double x(double east) const { return left + (east - ground.west_m) * scale(); }
  double y(double north) const { return top + (ground.north_m - north) * scale(); }
};

double nice_length(double longest) {
  const double power = std::pow(10, std::floor(std::log10(longest)));
  for (const double step : {5.0, 2.0, 1.0})
    if (step * power <= longest) return step * power;
  return power;
}

std::string length_text(double metres) {
  return metres >= 1000 ? shown_number(metres / 1000) + " km" : shown_number(metres) + " m";
}

/// Classes as palette indices (0 clear), and the palette.
struct Indexed {
  std::vector<std::uint8_t> index;
  std::vector<Rgb> palette;
};

Indexed indexed_classes(const std::vector<float>& values, const Legend& legend) {
  Indexed out;
  out.palette.push_back({255, 255, 255});
  for (const auto& c : legend.classes) out.palette.push_back(c.colour);
  for (const float v : values)
    out.index.push_back(static_cast<std::uint8_t>(legend.class_of(v) + 1));
  return out;
}

std::string scale_bar(const Frame& frame) {
  const double length = nice_length((frame.ground.east_m() - frame.ground.west_m) / 4);
  const double width = length * frame.scale();
  const double x = frame.left + 14, y = frame.top + frame.height() - 16;
  return fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"30\" rx=\"4\" fill=\"#fff\" "
      "fill-opacity=\"0.82\"/>"
      "<path d=\"M{:.1f} {:.1f}v5h{:.1f}v-5\" fill=\"none\" stroke=\"#1b2228\" "
      "stroke-width=\"1.5\"/>"
      "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"12\" fill=\"#1b2228\" "
      "text-anchor=\"middle\">{}</text>",
      x - 8, y - 17, width + 16, x, y, width, x + width / 2, y - 3, length_text(length));
}

/// Ticks with coordinates along the lower and left edge, inside the map.
std::string coordinate_ticks(const Frame& frame) {
  const Grid& g = frame.ground;
  const double step = nice_length((g.east_m() - g.west_m) / 3);
  std::string out = "<g stroke=\"#1b2228\" stroke-opacity=\"0.45\" stroke-width=\"1\">";
  std::string labels = "<g font-size=\"10.5\" fill=\"#3c464e\">";
  for (double x = std::ceil(g.west_m / step) * step; x < g.east_m(); x += step) {
    out += fmt::format("<path d=\"M{:.1f} {:.1f}v-7\"/>", frame.x(x), frame.top + frame.height());
    if (std::abs(frame.x(x) - frame.left - map_width / 2) > map_width / 2 - 30) continue;
    labels += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>",
                          frame.x(x), frame.top + frame.height() + 14, shown_number(x, 9));
  }
  for (double y = std::ceil(g.south_m() / step) * step; y < g.north_m; y += step) {
    out += fmt::format("<path d=\"M{:.1f} {:.1f}h7\"/>", frame.left, frame.y(y));
    if (std::abs(frame.y(y) - frame.top - frame.height() / 2) > frame.height() / 2 - 30) continue;
    labels += fmt::format(
        "<text transform=\"translate({:.1f} {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
        frame.left - 5, frame.y(y), shown_number(y, 9));
  }
  return out + "</g>" + labels + "</g>";
}

std::string north_arrow(const Frame& frame) {
  const double x = frame.left + map_width - 22, y = frame.top + 10;
  return fmt::format(
      "<path d=\"M{0:.1f} {1:.1f}l7 22l-7 -5l-7 5Z\" fill=\"#111\" stroke=\"#fff\" "
      "stroke-width=\"1.2\"/><text x=\"{0:.1f}\" y=\"{2:.1f}\" font-size=\"12\" "
      "font-weight=\"700\" fill=\"#111\" text-anchor=\"middle\">N</text>",
      x, y, y + 34);
}

std::string path_of(const Frame& frame, const std::vector<MapLine>& lines) {
  std::string path;
  for (const MapLine& l : lines)
    path += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", frame.x(l.x0), frame.y(l.y0), frame.x(l.x1),
                        frame.y(l.y1));
  return path;
}

/// The liquid's line is the wider one below: where both run together both are seen.
std::string fronts_svg(const Frame& frame, const std::vector<FrontMark>& fronts) {
  std::string svg;
  for (const Phase phase : {Phase::liquid, Phase::grains})
    for (const FrontMark& front : fronts)
      if (front.phase == phase)
        svg += fmt::format(
            "<path d=\"{0}\" fill=\"none\" stroke=\"#fff\" stroke-width=\"{1}\"/>"
            "<path d=\"{0}\" fill=\"none\" stroke=\"{2}\" stroke-width=\"{3}\"/>",
            path_of(frame, front.lines), phase == Phase::liquid ? 5.4 : 2.4,
            phase == Phase::liquid ? "#00798c" : "#7a3b00", phase == Phase::liquid ? 4.4 : 1.5);
  return svg;
}

std::string marks_svg(const Frame& frame, const MapScene& scene, const MapMarks& marks) {
  std::string cells, observed;
  const std::string nearest = path_of(frame, marks.nearest),
                    outline = path_of(frame, marks.release);
  for (const auto& ring : marks.observed)
    for (std::size_t i = 0; i < ring.size(); ++i)
      observed += fmt::format("{}{:.1f} {:.1f}", i == 0 ? 'M' : 'L', frame.x(ring[i].x()),
                              frame.y(ring[i].y()));
  const Grid& g = scene.cells;
  const double side = g.cell_m * frame.scale();
  for (std::size_t i = 0; i < marks.left.size(); ++i) {
    if (!(marks.left[i] > 0)) continue;
    const std::size_t row = i / g.n_cols, col = i % g.n_cols;
    cells += fmt::format("M{0:.1f} {1:.1f}h{2:.2f}v{2:.2f}h-{2:.2f}Z",
                         frame.x(g.west_m + static_cast<double>(col) * g.cell_m),
                         frame.y(g.north_m - static_cast<double>(row) * g.cell_m), side);
  }
  std::string svg = fronts_svg(frame, marks.fronts);
  if (!cells.empty())
    svg += fmt::format(
        "<path d=\"{}\" fill=\"url(#hatch)\" stroke=\"#b3123f\" "
        "stroke-width=\"1.4\"/>",
        cells);
  if (!outline.empty())
    svg += fmt::format(
        "<path d=\"{0}\" fill=\"none\" stroke=\"#fff\" stroke-width=\"3.2\"/>"
        "<path d=\"{0}\" fill=\"none\" stroke=\"#111\" stroke-width=\"1.4\"/>",
        outline);
  if (!nearest.empty())
    svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#7b1fa2\" stroke-width=\"1.4\"/>",
                       nearest);
  if (!observed.empty())
    svg += fmt::format(
        "<path d=\"{0}\" fill=\"none\" stroke=\"#fff\" stroke-width=\"3.6\"/>"
        "<path d=\"{0}\" fill=\"none\" stroke=\"#0a58ca\" stroke-width=\"1.8\" "
        "stroke-dasharray=\"7 4\"/>",
        observed);
  return svg;
}

std::string hillshade_uri(const MapScene& scene) {
  const Grid& g = scene.ground.grid;
  return data_uri(grey_png(scene.shade, g.n_cols, g.n_rows));
}

/// Colours, frame, ticks and scale bar; the hillshade lies below already.
std::string overlay_svg(const Frame& frame, const MapScene& scene, const LayerStack& maps,
                        const Layer& layer, std::size_t plane, const MapMarks& marks) {
  const Legend legend = legend_for(layer);
  const Indexed colours = indexed_classes(scene_plane(scene, layer, plane, maps.grid), legend);
  const Grid& c = scene.cells;
  std::string svg = fmt::format(
      "<image x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" "
      "preserveAspectRatio=\"none\" image-rendering=\"pixelated\" opacity=\"{}\" href=\"{}\"/>",
      frame.x(c.west_m), frame.y(c.north_m), c.n_cols * c.cell_m * frame.scale(),
      c.n_rows * c.cell_m * frame.scale(), opacity,
      data_uri(palette_png(colours.index, c.n_cols, c.n_rows, colours.palette)));
  svg += fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" "
      "stroke=\"#1b2228\" stroke-opacity=\"0.35\"/>",
      frame.left, frame.top, map_width, frame.height());
  return svg + marks_svg(frame, scene, marks) + coordinate_ticks(frame) + scale_bar(frame) +
         north_arrow(frame);
}

}  // namespace

const char* style_word(Phase phase) { return phase == Phase::grains ? "grains" : "liquid"; }

std::vector<FrontMark> front_marks(const LayerStack& maps) {
  std::vector<FrontMark> fronts;
  for (const Layer* layer : shown_layers(maps)) {
    const LayerMeaning& m = layer->meaning;
    const Phase phase = phase_of(m.quantity);
    const bool share = is_whether_reached(m.quantity) && m.statistic == Statistic::probability;
    const bool time = is_arrival(m.quantity) && m.statistic == Statistic::peak;
    if (phase == Phase::both || (!share && !time)) continue;
    Raster<std::uint8_t> reached(maps.grid, 0);
    for (std::size_t k = 0; k < reached.values.size(); ++k)
      reached.values[k] = share ? layer->values[k] >= 0.5F : !std::isnan(layer->values[k]);
    FrontMark front{phase, "", cell_outline(reached)};
    const bool grains = phase == Phase::grains;
    front.label = tr(share ? (grains ? "mark.front_grains" : "mark.front_liquid")
                           : (grains ? "mark.reached_grains" : "mark.reached_liquid"));
    if (!front.lines.empty()) fronts.push_back(std::move(front));
  }
  return fronts;
}

MapMarks map_marks(const MapScene& scene, const LayerStack& maps,
                   const Raster<std::uint8_t>* release) {
  MapMarks marks;
  if (release != nullptr) marks.release = cell_outline(*release);
  for (const Layer* layer : shown_layers(maps))
    if (layer->meaning.quantity == Quantity::left)
      marks.left = scene_plane(scene, *layer, 0, maps.grid);
  marks.fronts = front_marks(maps);
  return marks;
}

std::string observed_label(const std::string& note) {
  return note.empty() ? tr("mark.observed") : tr("mark.observed_note", note);
}

std::string nearest_label(std::int64_t member, bool single) {
  return single ? tr("mark.this_run") : tr("mark.nearest", member);
}

std::string marks_legend_html(const MapMarks& marks) {
  const bool left =
      std::any_of(marks.left.begin(), marks.left.end(), [](float v) { return v > 0; });
  if (marks.release.empty() && marks.observed.empty() && marks.nearest.empty() && !left &&
      marks.fronts.empty())
    return {};
  std::string html = "<ul class=\"legend marks\">";
  if (!marks.release.empty())
    html += "<li><span class=\"swatch release\"></span>" + html_escape(tr("js.release")) + "</li>";
  if (!marks.observed.empty())
    html += "<li><span class=\"swatch observed\"></span>" +
            html_escape(observed_label(marks.observed_note)) + "</li>";
  if (!marks.nearest.empty())
    html +=
        "<li><span class=\"swatch nearest\"></span>" + html_escape(marks.nearest_label) + "</li>";
  for (const FrontMark& front : marks.fronts)
    html += fmt::format("<li><span class=\"swatch front-{}\"></span>{}</li>",
                        style_word(front.phase), html_escape(front.label));
  if (left)
    html += "<li><span class=\"swatch left\"></span>" + html_escape(tr("js.mass_left")) + "</li>";
  return html + "</ul>";
}

std::string hillshade_defs(const MapScene& scene) {
  const Frame frame{scene.ground.grid};
  return fmt::format(
      "<svg class=\"defs\" width=\"0\" height=\"0\" aria-hidden=\"true\"><defs>"
      "<image id=\"hillshade\" width=\"{:.2f}\" height=\"{:.2f}\" preserveAspectRatio=\"none\" "
      "href=\"{}\"/><pattern id=\"hatch\" width=\"5\" height=\"5\" "
      "patternUnits=\"userSpaceOnUse\"><rect width=\"5\" height=\"5\" fill=\"#fff\" "
      "fill-opacity=\"0.75\"/><path d=\"M0 5L5 0M-1 1L1 -1M4 6L6 4\" stroke=\"#b3123f\" "
      "stroke-width=\"1.2\"/></pattern></defs></svg>",
      map_width, frame.height(), hillshade_uri(scene));
}

std::string map_figure_svg(const MapScene& scene, const LayerStack& maps, const Layer& layer,
                           std::size_t plane, const MapMarks& marks) {
  const Frame frame{scene.ground.grid, 18, 0};
  return fmt::format(
             "<svg class=\"map-figure\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" "
             "aria-label=\"{}\" {}><use href=\"#hillshade\" x=\"{}\" y=\"{}\"/>",
             frame.left + map_width + 1, frame.height() + 18,
             html_escape(plane_title(layer, plane)), font, frame.left, frame.top) +
         overlay_svg(frame, scene, maps, layer, plane, marks) + "</svg>";
}

std::string legend_html(const Legend& legend) {
  std::string html =
      "<p class=\"legend-title\">" + html_escape(legend.title) + "</p><ul class=\"legend\">";
  for (const auto& c : legend.classes)
    html += fmt::format(
        "<li><svg width=\"22\" height=\"14\" aria-hidden=\"true\"><rect width=\"22\" height=\"14\" "
        "rx=\"2\" fill=\"{}\"/></svg>{}</li>",
        hex_text(c.colour), html_escape(c.label));
  return html + "</ul>";
}

}  // namespace sturz
