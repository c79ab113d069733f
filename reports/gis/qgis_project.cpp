// SPDX-License-Identifier: Apache-2.0
#include "reports/gis/qgis_project.hpp"

#include "reports/page/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace sturz {
namespace {

/// XML knows no control characters, not even escaped.
std::string xml_text(std::string_view words) {
  std::string text(words);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c >= 0 && c < ' '; }, ' ');
  return html_escape(text);
}

/// Letters, digits and underscores, and a number that no other layer has. QGIS passes over ids of
/// ten letters and less.
std::string id_of(const ProjectLayer& layer, std::size_t number) {
  std::string id = layer.shape ? layer.table : layer.source;
  std::replace_if(
      id.begin(), id.end(),
      [](char c) {
        return !((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'));
      },
      '_');
  return fmt::format("sturz_layer_{}_{}", id, number);
}

std::string source_of(const ProjectLayer& layer) {
  return xml_text("./" + layer.source + (layer.shape ? "|layername=" + layer.table : ""));
}

const char* provider_of(const ProjectLayer& layer) { return layer.shape ? "ogr" : "gdal"; }

std::string system_text(const QgisProject& project) {
  if (project.place.crs_wkt.empty()) return "<spatialrefsys/>";
  return fmt::format("<spatialrefsys><wkt>{}</wkt><authid>{}</authid></spatialrefsys>",
                     xml_text(project.place.crs_wkt),
                     project.epsg ? fmt::format("EPSG:{}", *project.epsg) : "");
}

std::string extent_text(const Grid& place) {
  return fmt::format("<xmin>{}</xmin><ymin>{}</ymin><xmax>{}</xmax><ymax>{}</ymax>", place.west_m,
                     place.south_m(), place.east_m(), place.north_m);
}

std::string tree_text(const QgisProject& project) {
  std::string text = " <layer-tree-group>\n";
  std::size_t number = 0;
  for (const ProjectGroup& group : project.groups) {
    const bool shown = std::any_of(group.layers.begin(), group.layers.end(),
                                   [](const ProjectLayer& l) { return l.shown; });
    // An unchecked group hides what is checked in it: here what is in it says what is shown.
    text +=
        fmt::format("  <layer-tree-group name=\"{}\" checked=\"Qt::Checked\" expanded=\"{}\">\n",
                    xml_text(group.title), group.open || shown ? 1 : 0);
    for (const ProjectLayer& layer : group.layers)
      text += fmt::format(
          "   <layer-tree-layer id=\"{}\" name=\"{}\" checked=\"{}\" expanded=\"{}\" "
          "source=\"{}\" providerKey=\"{}\"/>\n",
          id_of(layer, number++), xml_text(layer.title),
          layer.shown ? "Qt::Checked" : "Qt::Unchecked", layer.shown ? 1 : 0, source_of(layer),
          provider_of(layer));
    text += "  </layer-tree-group>\n";
  }
  return text + " </layer-tree-group>\n";
}

const char* shape_word(Shape shape) {
  switch (shape) {
    case Shape::point:
      return "Point";
    case Shape::line:
      return "Line";
    case Shape::polygon:
      break;
  }
  return "Polygon";
}

std::string layer_text(const ProjectLayer& layer, std::size_t number, const std::string& system) {
  const bool labels = layer.symbology.find("<labeling") != std::string::npos;
  const std::string kind = layer.shape
                               ? fmt::format("type=\"vector\" geometry=\"{}\" labelsEnabled=\"{}\"",
                                             shape_word(*layer.shape), labels ? 1 : 0)
                               : std::string("type=\"raster\"");
  return fmt::format(
      "  <maplayer {} autoRefreshEnabled=\"0\" refreshOnNotifyEnabled=\"0\" "
      "hasScaleBasedVisibilityFlag=\"0\">\n"
      "   <id>{}</id>\n   <datasource>{}</datasource>\n   <layername>{}</layername>\n"
      "   <srs>{}</srs>\n   <provider{}>{}</provider>\n{}  </maplayer>\n",
      kind, id_of(layer, number), source_of(layer), xml_text(layer.title), system,
      layer.shape ? " encoding=\"UTF-8\"" : "", provider_of(layer), layer.symbology);
}

}  // namespace

std::string qgis_project(const QgisProject& project) {
  const std::string system = system_text(project), title = xml_text(project.title);
  std::string layers, order;
  std::size_t number = 0;
  for (const ProjectGroup& group : project.groups)
    for (const ProjectLayer& layer : group.layers) {
      order += fmt::format("  <layer id=\"{}\"/>\n", id_of(layer, number));
      layers += layer_text(layer, number++, system);
    }
  return fmt::format(
      "<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>\n"
      "<qgis projectname=\"{0}\" version=\"3.22.0\">\n"
      " <homePath path=\"\"/>\n <title>{0}</title>\n"
      " <projectCrs>{1}</projectCrs>\n{2}"
      " <mapcanvas name=\"theMapCanvas\" annotationsVisible=\"1\">\n  <units>meters</units>\n"
      "  <extent>{3}</extent>\n  <rotation>0</rotation>\n"
      "  <destinationsrs>{1}</destinationsrs>\n </mapcanvas>\n"
      " <projectlayers>\n{4} </projectlayers>\n <layerorder>\n{5} </layerorder>\n"
      " <properties>\n  <Paths><Absolute type=\"bool\">false</Absolute></Paths>\n"
      "  <SpatialRefSys><ProjectionsEnabled type=\"int\">1</ProjectionsEnabled></SpatialRefSys>\n"
      " </properties>\n"
      " <ProjectViewSettings UseProjectScales=\"0\">\n  <Scales/>\n"
      "  <DefaultViewExtent xmin=\"{6}\" ymin=\"{7}\" xmax=\"{8}\" ymax=\"{9}\">{1}"
      "</DefaultViewExtent>\n </ProjectViewSettings>\n</qgis>\n",
      title, system, tree_text(project), extent_text(project.place), layers, order,
      project.place.west_m, project.place.south_m(), project.place.east_m(), project.place.north_m);
}

}  // namespace sturz
