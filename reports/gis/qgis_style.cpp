// SPDX-License-Identifier: Apache-2.0
#include "reports/gis/qgis_style.hpp"

#include "reports/figures/legend.hpp"
#include "reports/page/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

/// QGIS gives a class its upper end, and the end belongs to it; here a class begins at its lower
/// end. The step is that of Legend::class_of.
std::string upper_end(const Legend& legend, std::size_t k) {
  if (k + 1 == legend.classes.size()) return "inf";
  const double next = legend.classes[k + 1].lower / legend.unit.factor;
  return fmt::format("{:.9g}", next - 1e-6 * std::abs(next));
}

}  // namespace

std::string raster_symbology(const Layer& layer) {
  const Legend legend = legend_for(layer);
  const double first = legend.diverging ? legend.classes.front().lower / legend.unit.factor : 0;
  const double last = legend.classes.back().lower / legend.unit.factor;
  std::string text = fmt::format(
      " <pipe>\n"
      "  <rasterrenderer type=\"singlebandpseudocolor\" band=\"1\" opacity=\"0.85\" "
      "alphaBand=\"-1\" classificationMin=\"{2:.9g}\" classificationMax=\"{0:.9g}\">\n"
      "   <rasterTransparency>\n    <singleValuePixelList>\n{1}"
      "    </singleValuePixelList>\n   </rasterTransparency>\n"
      "   <rastershader>\n"
      "    <colorrampshader colorRampType=\"DISCRETE\" classificationMode=\"1\" clip=\"0\" "
      "minimumValue=\"{2:.9g}\" maximumValue=\"{0:.9g}\" labelPrecision=\"3\">\n",
      last,
      legend.clear_zero ? "     <pixelListEntry min=\"0\" max=\"0\" percentTransparent=\"100\"/>\n"
                        : "",
      first);
  const std::string unit = legend.unit.label.empty() ? "" : " " + legend.unit.label;
  for (std::size_t k = 0; k < legend.classes.size(); ++k)
    text += fmt::format("     <item value=\"{}\" color=\"{}\" alpha=\"255\" label=\"{}\"/>\n",
                        upper_end(legend, k), hex_text(legend.classes[k].colour),
                        html_escape(legend.classes[k].label + unit));
  return text +
         "    </colorrampshader>\n   </rastershader>\n  </rasterrenderer>\n"
         "  <brightnesscontrast brightness=\"0\" contrast=\"0\"/>\n"
         "  <huesaturation saturation=\"0\"/>\n"
         "  <rasterresampler/>\n </pipe>\n <blendMode>0</blendMode>\n";
}

std::string hillshade_symbology() {
  // Light falls on cells that are joined first: each cell for itself is a stair, drawn as a grid.
  return " <pipe>\n"
         "  <provider>\n   <resampling enabled=\"true\" maxOversampling=\"2\" "
         "zoomedInResamplingMethod=\"cubic\" zoomedOutResamplingMethod=\"bilinear\"/>\n"
         "  </provider>\n"
         "  <rasterrenderer type=\"hillshade\" band=\"1\" opacity=\"1\" alphaBand=\"-1\" "
         "azimuth=\"315\" angle=\"45\" zfactor=\"1\" multidirection=\"1\">\n"
         "   <rasterTransparency/>\n  </rasterrenderer>\n"
         // Pale, so that what lies on it is read first.
         "  <brightnesscontrast brightness=\"40\" contrast=\"-20\"/>\n"
         "  <huesaturation saturation=\"0\"/>\n"
         "  <rasterresampler maxOversampling=\"2\"/>\n"
         "  <resamplingStage>provider</resamplingStage>\n </pipe>\n <blendMode>0</blendMode>\n";
}

std::string qgis_style(const Layer& layer) {
  return qgis_style_file(raster_symbology(layer), "Symbology");
}

std::string qgis_style_file(const std::string& symbology, const char* categories) {
  return fmt::format(
      "<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>\n"
      "<qgis version=\"3.22\" styleCategories=\"{}\">\n{}</qgis>\n",
      categories, symbology);
}

}  // namespace sturz
