// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/results/gis/gis_files.hpp"

#include "ensemble/assets/asset_risk.hpp"
#include "ensemble/workflow/results/asset_files.hpp"
#include "ensemble/workflow/results/gis/flow_lines.hpp"
#include "ensemble/workflow/results/gis/outline_tables.hpp"
#include "ensemble/workflow/results/ground_source.hpp"
#include "ensemble/workflow/results/map_files.hpp"
#include "ensemble/workflow/version.hpp"
#include "io/features/feature_file.hpp"
#include "io/features/geographic.hpp"
#include "io/features/zip_file.hpp"
#include "io/files/text_files.hpp"
#include "io/gdal/cog.hpp"
#include "reports/figures/legend.hpp"
#include "reports/gis/qgis_project.hpp"
#include "reports/gis/qgis_style.hpp"
#include "reports/gis/stac_item.hpp"
#include "reports/gis/vector_style.hpp"
#include "reports/layer_titles.hpp"
#include "scenarios/layers/plane_name.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

Shape shape_of(const FeatureTable& table) {
  // The fifth byte of WKB and its neighbours hold the kind: 1, 4 points; 2, 5 lines; 3, 6 areas.
  const auto kind = static_cast<unsigned char>(table.wkb.front()[1]) % 3;
  return kind == 1 ? Shape::point : kind == 2 ? Shape::line : Shape::polygon;
}

class Files {
 public:
  Files(const OutputFolder& folder, const GisContent& of)
      : folder_(folder), of_(of), about_(of.maps->about()) {}

  void write() {
    project_.title = of_.title;
    project_.place = about_.grid;
    project_.epsg = epsg_code(about_.grid.crs_wkt);
    write_package();
    write_ground();
    write_project();
    write_item();
  }

 private:
  const Layer& shown(const Layer& layer) const {
    const Layer* found = of_.coarse->find(layer.name);
    return found != nullptr ? *found : layer;
  }

  void add_site(GeoPackage& package, const FeatureTable& table, SiteLayer kind, const char* title,
                bool is_shown = true) {
    if (table.size() == 0) return;
    const Shape shape = shape_of(table);
    const std::string symbology = site_symbology(kind, shape);
    package.add(table, vector_style(symbology, shape));
    site_.layers.push_back({title, package_name(), table.name, shape, symbology, is_shown});
  }

  void write_package() {
    GeoPackage package(package_file());
    const std::string& crs = about_.grid.crs_wkt;
    site_.title = "Scene";
    if (of_.assets)
      add_site(package, *of_.assets, SiteLayer::assets, "Assets, by their probability to be hit");
    if (of_.inputs != nullptr) {
      add_site(package, gauge_table("gauge_points", of_.inputs->gauge_points, crs),
               SiteLayer::gauge, "Gauges");
      add_site(package, gauge_table("gauge_lines", of_.inputs->gauge_lines, crs), SiteLayer::gauge,
               "Gauge lines");
      add_site(package, thalweg_line(*of_.inputs, crs), SiteLayer::thalweg, "Thalweg of the event");
      add_site(package, observed_area(of_.inputs->observed, crs), SiteLayer::observed,
               "Observed outline");
    }
    if (of_.release != nullptr) {
      add_site(package, flow_lines(*of_.coarse, *of_.release), SiteLayer::flow,
               "Ways of the front, by arrival times", of_.one_run);
      add_site(package, release_area(*of_.release), SiteLayer::release, "Release");
    }
    add_site(package, deposit_centres(of_.members, crs), SiteLayer::deposits,
             of_.one_run ? "Centre of the deposit" : "Centres of the members' deposits", false);
    outlines_.title = "Areas of classes";
    outlines_.open = false;
    for (std::size_t l = 0; l < about_.layers.size(); ++l)
      if (is_outlined(about_.layers[l])) add_areas(package, l);
    of_.cancel.check();
    package.commit();
  }

  void add_areas(GeoPackage& package, std::size_t number) {
    const Layer& layer = about_.layers[number];
    const Legend legend = legend_for(shown(layer));
    const std::string symbology = class_symbology(legend);
    for (std::size_t plane = 0; plane < layer.n_planes(); ++plane) {
      const FeatureTable table = class_areas(*of_.maps, number, plane, legend, of_.cancel);
      if (table.size() == 0) continue;
      of_.cancel.check();
      package.add(table, vector_style(symbology, Shape::polygon));
      outlines_.layers.push_back({plane_title(layer, plane), package_name(), table.name,
                                  Shape::polygon, symbology, false});
    }
  }

  void write_ground() {
    const fs::path style = fs::path(folder_.ground_tif()).replace_extension(".qml");
    if (of_.elevation == nullptr) {
      fs::remove(folder_.ground_tif());
      fs::remove(style);
      return;
    }
    write_cog(folder_.ground_tif(), *of_.elevation, 0, 0, of_.cancel);
    write_text_atomic(style, qgis_style_file(hillshade_symbology(), "Symbology"));
  }

  void write_project() {
    std::vector<ProjectGroup>& groups = project_.groups;
    ProjectGroup bounds{"Bounds of the probabilities", {}, false};
    std::vector<ProjectGroup> maps;
    const Layer* first = default_layer(*of_.coarse);
    for (const PlaneFile& file : cog_files(tifs(), about_)) {
      const Layer& layer = about_.layers[file.layer];
      ProjectLayer one{title_of(layer, file.plane),
                       file.path.lexically_relative(folder_.root).generic_string(),
                       "",
                       {},
                       raster_symbology(shown(layer)),
                       false};
      if (layer.meaning.is_bound()) {
        bounds.layers.push_back(std::move(one));
        continue;
      }
      one.shown = first != nullptr && layer.name == first->name && file.plane == 0;
      group_of(maps, layer).layers.push_back(std::move(one));
    }
    if (!site_.layers.empty()) groups.push_back(std::move(site_));
    for (ProjectGroup& group : maps) groups.push_back(std::move(group));
    if (!outlines_.layers.empty()) groups.push_back(std::move(outlines_));
    if (!bounds.layers.empty()) groups.push_back(std::move(bounds));
    if (of_.elevation != nullptr)
      groups.push_back({"Ground",
                        {{"Hillshade",
                          folder_.ground_tif().filename().string(),
                          "",
                          {},
                          hillshade_symbology(),
                          true}},
                        false});
    write_zip(project_file(), project_file().stem().string() + ".qgs", qgis_project(project_));
  }

  static ProjectGroup& group_of(std::vector<ProjectGroup>& groups, const Layer& layer) {
    const std::string name = layer.meaning.statistic == Statistic::probability
                                 ? "Probability"
                                 : title(layer.meaning.quantity);
    const auto found = std::find_if(groups.begin(), groups.end(),
                                    [&](const ProjectGroup& g) { return g.title == name; });
    if (found != groups.end()) return *found;
    groups.push_back({name, {}, groups.empty()});
    return groups.back();
  }

  /// A bound is called as its probability is.
  static std::string title_of(const Layer& layer, std::size_t plane) {
    if (!layer.meaning.is_bound()) return plane_title(layer, plane);
    Layer probability = layer;
    probability.meaning.statistic = Statistic::probability;
    const bool lower = layer.meaning.statistic == Statistic::lower_bound;
    const std::string level =
        layer.confidence > 0 ? fmt::format("{:.0f} % ", 100 * layer.confidence) : "";
    return plane_title(probability, plane) + ", " + level + (lower ? "lower" : "upper") + " bound";
  }

  void write_item() const {
    StacItem item;
    item.id = "sturz-" + of_.hazard_hash;
    item.title = of_.title;
    item.description = of_.one_run
                           ? "Largest values of one simulation of a moving mass."
                           : fmt::format(
                                 "Maps of {} simulations of a moving mass, of which parameters "
                                 "that are not known were drawn.",
                                 of_.n_members);
    item.datetime = of_.started;
    item.software = fmt::format("{} ({})", version, git_commit);
    item.grid = about_.grid;
    item.epsg = epsg_code(about_.grid.crs_wkt);
    item.outline = geographic_outline(about_.grid);
    const auto add = [&](const fs::path& file, const char* what, const char* type,
                         const char* role) {
      std::error_code ignored;
      if (!fs::exists(file, ignored)) return;
      item.assets.push_back(
          {file.filename().string(), file.filename().string(), what, type, {role}, "", false});
    };
    constexpr const char *netcdf = "application/netcdf", *gpkg = "application/geopackage+sqlite3",
                         *geotiff = "image/tiff; application=geotiff; profile=cloud-optimized";
    add(of_.one_run ? folder_.peaks_nc() : folder_.hazard_nc(), "All maps", netcdf, "data");
    add(package_file(), "Areas of classes, release, ways of the front, assets", gpkg, "data");
    add(folder_.ground_tif(), "Elevations under the maps", geotiff, "data");
    add(project_file(), "QGIS project", "application/x-qgis-project", "visual");
    for (const PlaneFile& file : cog_files(tifs(), about_)) {
      const Layer& layer = about_.layers[file.layer];
      const std::string name = file.path.lexically_relative(folder_.root).generic_string();
      item.assets.push_back(
          {name, name, title_of(layer, file.plane), geotiff, {"data"}, layer.units, true});
    }
    write_text_atomic(folder_.stac_item(), stac_item(item));
  }

  fs::path package_file() const {
    return of_.one_run ? folder_.peaks_gpkg() : folder_.hazard_gpkg();
  }
  fs::path tifs() const { return of_.one_run ? folder_.peaks_folder() : folder_.tif_folder(); }
  fs::path project_file() const {
    return of_.one_run ? folder_.peaks_project() : folder_.project();
  }
  std::string package_name() const { return package_file().filename().string(); }

  const OutputFolder& folder_;
  const GisContent& of_;
  const LayerStack& about_;
  ProjectGroup site_, outlines_;
  QgisProject project_;
};

}  // namespace

GisContent gis_content(const LayerSource& maps, const PageContent& page, const Manifest& manifest,
                       const Scenario& scenario, const SceneInputs& inputs) {
  GisContent content;
  content.title = scenario.title.empty() ? "Landslide hazard" : scenario.title;
  content.maps = &maps;
  content.one_run = page.hazard == nullptr;
  content.coarse = content.one_run ? page.peaks : page.hazard;
  content.inputs = &inputs;
  if (page.elevation != nullptr)
    content.elevation = ground_source(maps.about().grid, [&ground = *page.elevation](auto&) {
      return std::shared_ptr<const Raster<double>>(std::shared_ptr<void>(), &ground);
    });
  content.release = page.release;
  content.members = page.members;
  content.n_members = static_cast<std::size_t>(
      std::count_if(page.members.begin(), page.members.end(),
                    [](const MemberSummary& m) { return is_valid(m.outcome); }));
  content.started = manifest.started;
  content.hazard_hash = manifest.hazard_hash;
  content.cancel = page.cancel;
  if (page.risk != nullptr) {
    content.assets = risk_features(*page.risk->assets, page.risk->risk, maps.about().grid.crs_wkt);
    content.assets->name = "assets";
  }
  return content;
}

void write_gis_files(const OutputFolder& folder, const GisContent& content) {
  Files(folder, content).write();
}

void write_all_for_gis(const OutputFolder& folder, const Scenario& scenario,
                       const GisContent& content) {
  const fs::path tifs = content.one_run ? folder.peaks_folder() : folder.tif_folder();
  if (scenario.hazard.gis_files) {
    write_map_files(tifs, *content.maps, *content.coarse, content.cancel);
    write_gis_files(folder, content);
    return;
  }
  remove_map_files(tifs);
  remove_gis_files(folder);
}

void remove_gis_files(const OutputFolder& folder) {
  for (const fs::path& file :
       {folder.hazard_gpkg(), folder.project(), folder.peaks_gpkg(), folder.peaks_project(),
        folder.ground_tif(), fs::path(folder.ground_tif()).replace_extension(".qml"),
        folder.stac_item()})
    fs::remove(file);
}

}  // namespace sturz::workflow
