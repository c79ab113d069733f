// SPDX-License-Identifier: Apache-2.0
#include "reports/gis/vector_style.hpp"

#include "reports/gis/qgis_style.hpp"
#include "reports/page/text.hpp"
#include "scenarios/layers/layer_stack.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>
#include <vector>

namespace sturz {
namespace {

constexpr int clear = 0, solid = 255;

using Properties = std::vector<std::pair<std::string_view, std::string>>;

std::string rgba(Rgb c, int alpha) { return fmt::format("{},{},{},{}", c.r, c.g, c.b, alpha); }

/// One symbol of a renderer, called by its number.
/// \param below what is drawn under it, in the same way; empty: nothing
std::string symbol(std::size_t number, Shape shape, const Properties& properties,
                   const Properties& below = {}) {
  const auto [type, kind] = shape == Shape::point  ? std::pair("marker", "SimpleMarker")
                            : shape == Shape::line ? std::pair("line", "SimpleLine")
                                                   : std::pair("fill", "SimpleFill");
  std::string text = fmt::format(
      "   <symbol type=\"{}\" name=\"{}\" alpha=\"1\" clip_to_extent=\"1\" force_rhr=\"0\">\n",
      type, number);
  for (const Properties* layer : {&below, &properties}) {
    if (layer->empty()) continue;
    text += fmt::format("    <layer class=\"{}\" enabled=\"1\" locked=\"0\" pass=\"0\">\n", kind);
    for (const auto& [key, value] : *layer)
      text += fmt::format("     <prop k=\"{}\" v=\"{}\"/>\n", key, value);
    text += "    </layer>\n";
  }
  return text + "   </symbol>\n";
}

/// \param fill alpha of the area's inside
std::string drawn(std::size_t number, Shape shape, Rgb inside, int fill, Rgb edge,
                  const std::string& width_mm, const std::string& pen) {
  switch (shape) {
    case Shape::point:
      return symbol(number, shape,
                    {{"name", "circle"},
                     {"color", rgba(inside, solid)},
                     {"outline_color", rgba(edge, solid)},
                     {"outline_width", "0.2"},
                     {"outline_width_unit", "MM"},
                     {"size", "2.4"},
                     {"size_unit", "MM"}});
    case Shape::line:
      return symbol(number, shape,
                    {{"line_color", rgba(inside, solid)},
                     {"line_width", width_mm},
                     {"line_width_unit", "MM"},
                     {"line_style", pen},
                     {"capstyle", "round"},
                     {"joinstyle", "round"}});
    case Shape::polygon:
      break;
  }
  return symbol(number, Shape::polygon,
                {{"color", rgba(inside, fill)},
                 {"style", fill == clear ? "no" : "solid"},
                 {"outline_color", rgba(edge, solid)},
                 {"outline_style", pen},
                 {"outline_width", width_mm},
                 {"outline_width_unit", "MM"},
                 {"joinstyle", "bevel"}});
}

Rgb darker(Rgb c) {
  const auto part = [](std::uint8_t v) { return static_cast<std::uint8_t>(v * 7 / 10); };
  return {part(c.r), part(c.g), part(c.b)};
}

/// An outline that stands out from pale and dark ground: a white line below it.
std::string outline(Rgb colour, const std::string& pen) {
  const auto line = [](Rgb c, const char* width_mm, const std::string& style) {
    return Properties{{"color", rgba(c, clear)},
                      {"style", "no"},
                      {"outline_color", rgba(c, solid)},
                      {"outline_style", style},
                      {"outline_width", width_mm},
                      {"outline_width_unit", "MM"},
                      {"joinstyle", "bevel"}};
  };
  return symbol(0, Shape::polygon, line(colour, "0.7", pen), line({255, 255, 255}, "1.3", "solid"));
}

/// A line over a white one, so that it can be followed over dark classes.
std::string cased_line(Rgb colour) {
  const auto line = [](Rgb c, const char* width_mm) {
    return Properties{{"line_color", rgba(c, solid)}, {"line_width", width_mm},
                      {"line_width_unit", "MM"},      {"line_style", "solid"},
                      {"capstyle", "round"},          {"joinstyle", "round"}};
  };
  return symbol(0, Shape::line, line(colour, "0.6"), line({255, 255, 255}, "1.2"));
}

std::string single(const std::string& one) {
  return " <renderer-v2 type=\"singleSymbol\" symbollevels=\"0\" enableorderby=\"0\" "
         "forceraster=\"0\">\n  <symbols>\n" +
         one + "  </symbols>\n </renderer-v2>\n <blendMode>0</blendMode>\n";
}

/// What may be hit, in the classes of probabilities, and grey where it is not known.
std::string by_probability(Shape shape) {
  Layer probability;
  probability.meaning = {Quantity::reached, Statistic::probability};
  probability.units = "1";
  const Legend legend = legend_for(probability);
  const Rgb grey{150, 150, 150}, edge{40, 40, 40};
  std::string rules, symbols;
  const std::size_t n = legend.classes.size();
  const auto add = [&](std::size_t k, const std::string& filter, const std::string& label, Rgb c) {
    rules += fmt::format("   <rule key=\"rule{0}\" symbol=\"{0}\" filter=\"{1}\" label=\"{2}\"/>\n",
                         k, html_escape(filter), html_escape(label));
    symbols += drawn(k, shape, c, solid, edge, shape == Shape::line ? "0.8" : "0.3", "solid");
  };
  for (std::size_t k = 0; k < n; ++k) {
    std::string filter = fmt::format("\"probability\" >= {}", legend.classes[k].lower);
    if (k + 1 < n) filter += fmt::format(" AND \"probability\" < {}", legend.classes[k + 1].lower);
    add(k, filter, legend.classes[k].label, legend.classes[k].colour);
  }
  add(n, "ELSE", "not known", grey);
  return " <renderer-v2 type=\"RuleRenderer\" symbollevels=\"0\" enableorderby=\"0\" "
         "forceraster=\"0\">\n  <rules key=\"rules\">\n" +
         rules + "  </rules>\n  <symbols>\n" + symbols +
         "  </symbols>\n </renderer-v2>\n <blendMode>0</blendMode>\n";
}

std::string named() {
  return " <labeling type=\"simple\">\n  <settings calloutType=\"simple\">\n"
         "   <text-style fieldName=\"name\" isExpression=\"0\" fontSize=\"8\" "
         "fontSizeUnit=\"Point\" "
         "textColor=\"40,40,40,255\" textOpacity=\"1\">\n"
         "    <text-buffer bufferDraw=\"1\" bufferSize=\"0.8\" bufferSizeUnits=\"MM\" "
         "bufferColor=\"255,255,255,255\" bufferOpacity=\"0.85\"/>\n"
         "   </text-style>\n  </settings>\n </labeling>\n";
}

}  // namespace

std::string class_symbology(const Legend& legend) {
  const std::string unit = legend.unit.label.empty() ? "" : " " + legend.unit.label;
  std::string categories, symbols;
  for (std::size_t k = 0; k < legend.classes.size(); ++k) {
    const LegendClass& c = legend.classes[k];
    categories +=
        fmt::format("   <category symbol=\"{}\" value=\"{}\" label=\"{}\" render=\"true\"/>\n", k,
                    k + 1, html_escape(c.label + unit));
    symbols += drawn(k, Shape::polygon, c.colour, 216, darker(c.colour), "0.2", "solid");
  }
  return fmt::format(
      " <renderer-v2 type=\"categorizedSymbol\" attr=\"{}\" symbollevels=\"0\" "
      "enableorderby=\"0\" forceraster=\"0\">\n  <categories>\n{}  </categories>\n"
      "  <symbols>\n{}  </symbols>\n </renderer-v2>\n <blendMode>0</blendMode>\n",
      class_column, categories, symbols);
}

std::string site_symbology(SiteLayer layer, Shape shape) {
  constexpr Rgb blue{11, 79, 145}, magenta{208, 28, 110}, water{21, 101, 192}, white{255, 255, 255},
      brown{122, 76, 40}, orange{230, 85, 13};
  switch (layer) {
    case SiteLayer::release:
      return single(outline(blue, "solid"));
    case SiteLayer::observed:
      return single(outline(magenta, "dash"));
    case SiteLayer::flow:
      return single(cased_line(orange)) + named();
    case SiteLayer::thalweg:
      return single(drawn(0, shape, water, clear, water, "0.5", "dash dot"));
    case SiteLayer::gauge:
      return single(drawn(0, shape, water, solid, white, "0.8", "solid")) + named();
    case SiteLayer::assets:
      return by_probability(shape) + named();
    case SiteLayer::deposits:
      break;
  }
  return single(drawn(0, shape, brown, solid, white, "0.3", "solid"));
}

std::string vector_style(const std::string& symbology, Shape shape) {
  return qgis_style_file(fmt::format("{} <layerGeometryType>{}</layerGeometryType>\n", symbology,
                                     static_cast<int>(shape)),
                         "Symbology|Labeling");
}

}  // namespace sturz
