// SPDX-License-Identifier: Apache-2.0
#include "io/netcdf/netcdf_layers.hpp"

#include "engine/core/error.hpp"
#include "io/files/io_error.hpp"
#include "io/files/stored_count.hpp"
#include "io/netcdf/grid_netcdf.hpp"
#include "io/netcdf/history_netcdf.hpp"
#include "io/netcdf/netcdf_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace sturz {
namespace {

constexpr std::size_t chunk_edge = 128;  // the blocks in which maps are made

constexpr const char* order_attribute = "layer_order";
constexpr const char* quantity_attribute = "sturz_quantity";
constexpr const char* statistic_attribute = "sturz_statistic";
constexpr const char* censored_attribute = "sturz_censored_members";
constexpr const char* confidence_attribute = "confidence_level";
constexpr const char* intensity_attribute = "sturz_intensity_class";

struct WrittenAxis {
  int dimension = -1;
  std::vector<double> values;
};

std::string spoken(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

void text_if_any(NetcdfWriter& file, int variable, const char* name, const std::string& value) {
  if (!value.empty()) file.text(variable, name, value);
}

int write_axis(NetcdfWriter& file, const Layer& layer, std::map<std::string, WrittenAxis>& done) {
  const LayerAxis& axis = layer.axis;
  if (const auto known = done.find(axis.name); known != done.end()) {
    require(known->second.values == axis.values,
            fmt::format("axis '{}' has different values in two layers (one file, one axis). Give "
                        "the axes different names.",
                        axis.name));
    return known->second.dimension;
  }
  require(std::adjacent_find(axis.values.begin(), axis.values.end(), std::greater_equal<>()) ==
              axis.values.end(),
          fmt::format("axis '{}' does not increase strictly (CF asks for it). Sort its values and "
                      "remove doubles.",
                      axis.name));
  const int dimension = file.dimension(axis.name, axis.values.size());
  const int variable = file.variable(axis.name, NcType::float64, {dimension});
  text_if_any(file, variable, "standard_name", axis.standard_name);
  file.text(variable, "long_name", spoken(axis.name));
  file.text(variable, "units", axis.units);
  if (layer.meaning.has_thresholds())
    file.text(variable, "spp__relative_to_threshold", "greater_than");
  file.put(variable, axis.values);
  done[axis.name] = {dimension, axis.values};
  return dimension;
}

void write_meaning(NetcdfWriter& file, int variable, const LayerMeaning& meaning) {
  file.text(variable, quantity_attribute, std::string(to_string(meaning.quantity)));
  file.text(variable, statistic_attribute, std::string(to_string(meaning.statistic)));
  if (meaning.intensity != IntensityClass::none)
    file.text(variable, intensity_attribute, std::string(to_string(meaning.intensity)));
}

/// CF's flags: numbers in the type of the variable, and a word without spaces for each.
void write_classes(NetcdfWriter& file, int variable, const std::vector<LayerClass>& classes) {
  if (classes.empty()) return;
  std::vector<float> values;
  std::string words;
  for (const LayerClass& c : classes) {
    values.push_back(static_cast<float>(c.value));
    std::string word = c.words;
    std::replace(word.begin(), word.end(), ' ', '_');
    words += (words.empty() ? "" : " ") + word;
  }
  file.numbers(variable, "flag_values", values);
  file.text(variable, "flag_meanings", words);
}

/// Defines one variable and tells its number.
int define_layer(NetcdfWriter& file, const Layer& layer, const Grid& grid,
                 const GridDimensions& place, std::map<std::string, WrittenAxis>& axes) {
  std::vector<int> dimensions{place.y, place.x};
  std::vector<std::size_t> chunk{std::min(chunk_edge, static_cast<std::size_t>(grid.n_rows)),
                                 std::min(chunk_edge, static_cast<std::size_t>(grid.n_cols))};
  if (!layer.axis.values.empty()) {
    dimensions.insert(dimensions.begin(), write_axis(file, layer, axes));
    chunk.insert(chunk.begin(), 1);
  }
  const int variable =
      file.variable(layer.name, layer.is_count() ? NcType::int32 : NcType::float32, dimensions);
  file.compress(variable, chunk);
  if (layer.is_count()) {
    file.fill_value(variable, no_count);
  } else {
    file.fill_value(variable, nan_f);
  }
  text_if_any(file, variable, "standard_name", layer.standard_name);
  file.text(variable, "long_name", layer.long_name.empty() ? spoken(layer.name) : layer.long_name);
  file.text(variable, "units", layer.units);
  text_if_any(file, variable, "cell_methods", layer.cell_methods);
  text_if_any(file, variable, "comment", layer.comment);
  write_meaning(file, variable, layer.meaning);
  write_classes(file, variable, layer.classes);
  if (layer.n_censored > 0) file.integer(variable, censored_attribute, layer.n_censored);
  if (layer.confidence > 0) file.number(variable, confidence_attribute, layer.confidence);
  link_grid(file, variable, grid);
  return variable;
}

void write_attributes(NetcdfWriter& file, const LayerStack& stack) {
  file.text(NetcdfWriter::global, "Conventions", "CF-1.10");
  std::vector<std::pair<std::string, std::string>> all = stack.attributes;
  const auto add_missing = [&](const char* name, const char* value) {
    const auto same = [&](const auto& a) { return a.first == name; };
    if (std::none_of(all.begin(), all.end(), same)) all.emplace_back(name, value);
  };
  add_missing("title", "Landslide hazard maps");
  add_missing("source", "sturz, landslide ensemble runner");
  add_missing("history", "written by sturz");
  for (const auto& [name, value] : all)
    if (name != "Conventions") file.text(NetcdfWriter::global, name, value);
  // Files that were built in memory list their variables by name; people want ours.
  std::string order;
  for (const auto& layer : stack.layers) order += (order.empty() ? "" : " ") + layer.name;
  file.text(NetcdfWriter::global, order_attribute, order);
  write_grid_attributes(file, stack.grid);
}

template <Worded Enum>
Enum read_word(const NetcdfReader& file, const std::string& map, const char* attribute) {
  const std::string word = file.text(map, attribute).value_or("");
  if (const auto known = from_word<Enum>(word)) return *known;
  throw IoError(fmt::format(
      "{}: map '{}' {} (the file is of another version of this program). Make the maps again: "
      "`sturz merge` for an ensemble, `sturz run` for a single run.",
      file.file().string(), map,
      word.empty() ? fmt::format("has no attribute {}", attribute)
                   : fmt::format("has the unknown {} '{}'", attribute, word)));
}

LayerMeaning read_meaning(const NetcdfReader& file, const std::string& map) {
  LayerMeaning meaning{read_word<Quantity>(file, map, quantity_attribute),
                       read_word<Statistic>(file, map, statistic_attribute)};
  if (file.text(map, intensity_attribute))
    meaning.intensity = read_word<IntensityClass>(file, map, intensity_attribute);
  return meaning;
}

std::vector<LayerClass> read_classes(const NetcdfReader& file, const std::string& map) {
  const std::vector<double> values = file.numbers(map, "flag_values");
  std::istringstream words(file.text(map, "flag_meanings").value_or(""));
  std::vector<LayerClass> classes;
  std::string word;
  for (const double value : values) {
    const bool whole = std::abs(value) < 1e6 && value == std::floor(value);
    const int number = whole ? static_cast<int>(value) : 0;
    if (!whole || !(words >> word) || (!classes.empty() && number <= classes.back().value))
      throw IoError(
          fmt::format("{}: the classes of map '{}' are no rising whole numbers with a "
                      "word each (it is damaged). Compute it again.",
                      file.file().string(), map));
    classes.push_back({number, spoken(word)});
  }
  return classes;
}

/// Everything but the values.
Layer read_layer(const NetcdfReader& file, const Grid& grid, const std::string& name,
                 const std::vector<std::string>& dimensions) {
  Layer layer;
  layer.name = name;
  layer.meaning = read_meaning(file, name);
  const auto text = [&](const std::string& of, const char* attribute) {
    return file.text(of, attribute).value_or("");
  };
  layer.long_name = text(name, "long_name");
  layer.standard_name = text(name, "standard_name");
  layer.units = text(name, "units");
  layer.cell_methods = text(name, "cell_methods");
  layer.comment = text(name, "comment");
  layer.classes = read_classes(file, name);
  layer.n_censored =
      static_cast<int>(std::clamp(file.number(name, censored_attribute).value_or(0), 0.0, 1e9));
  // Files made before bounds said so have none.
  layer.confidence = std::clamp(file.number(name, confidence_attribute).value_or(0), 0.0, 1.0);
  if (dimensions.size() == 3)
    layer.axis = {dimensions[0], text(dimensions[0], "standard_name"), text(dimensions[0], "units"),
                  file.doubles(dimensions[0])};
  std::vector<std::size_t> count;
  for (const auto& dimension : dimensions) count.push_back(file.length(dimension));
  const std::size_t n = count.size();
  if (count[n - 2] != static_cast<std::size_t>(grid.n_rows) ||
      count[n - 1] != static_cast<std::size_t>(grid.n_cols) ||
      (n == 3 && (layer.axis.values.empty() || layer.axis.values.size() != count[0])))
    throw IoError(
        fmt::format("{}: variable '{}' does not lie on the file's grid (it is damaged). "
                    "Compute it again.",
                    file.file().string(), name));
  file.size(name);  // refuses what the file cannot hold
  return layer;
}

/// Layers as listed in `order`, others behind them.
void restore_order(std::vector<Layer>& layers, const std::string& order) {
  const std::string list = " " + order + " ";
  std::stable_sort(layers.begin(), layers.end(), [&](const Layer& a, const Layer& b) {
    return list.find(" " + a.name + " ") < list.find(" " + b.name + " ");
  });
}

}  // namespace

LayersFileWriter::LayersFileWriter(std::filesystem::path file, NetcdfMedium medium)
    : file_(std::move(file), medium) {}

void LayersFileWriter::begin(const LayerStack& about) {
  write_attributes(file_, about);
  const GridDimensions place = write_grid(file_, about.grid);
  std::map<std::string, WrittenAxis> axes;
  for (const auto& layer : about.layers) {
    variables_.push_back(define_layer(file_, layer, about.grid, place, axes));
    is_count_.push_back(layer.is_count());
    has_axis_.push_back(!layer.axis.values.empty());
  }
}

void LayersFileWriter::put(std::size_t layer, std::size_t plane, const Window& w,
                           std::span<const float> values) {
  std::vector<std::size_t> start{static_cast<std::size_t>(w.row0),
                                 static_cast<std::size_t>(w.col0)},
      count{static_cast<std::size_t>(w.n_rows), static_cast<std::size_t>(w.n_cols)};
  if (has_axis_[layer]) {
    start.insert(start.begin(), plane);
    count.insert(count.begin(), 1);
  }
  if (!is_count_[layer]) {
    file_.put(variables_[layer], start, count, values);
    return;
  }
  std::vector<std::int32_t> counts(values.size());
  std::transform(values.begin(), values.end(), counts.begin(), stored_count);
  file_.put(variables_[layer], start, count, counts);
}

void LayersFileWriter::commit(const MemberHistory& history) {
  write_history(file_, history);
  file_.commit();
}

LayersFileReader::LayersFileReader(const std::filesystem::path& path) : file_(path) {
  about_.grid = read_grid(file_);
  for (const auto& name : file_.attributes(""))
    if (const auto value = file_.text("", name);
        value && name != "Conventions" && name != order_attribute)
      about_.attributes.emplace_back(name, *value);
  for (const auto& name : file_.variables()) {
    const auto dimensions = file_.dimensions(name);
    if (dimensions.size() < 2) continue;  // coordinates, crs and history
    if (dimensions.size() > 3 || dimensions.back() != "x" ||
        dimensions[dimensions.size() - 2] != "y")
      throw IoError(
          fmt::format("{}: variable '{}' is not a map over y, x. Remove it.", path.string(), name));
    about_.layers.push_back(read_layer(file_, about_.grid, name, dimensions));
  }
  restore_order(about_.layers, file_.text("", order_attribute).value_or(""));
}

void LayersFileReader::read(std::size_t number, std::size_t plane, const Window& w,
                            std::span<float> out) const {
  const Layer& layer = about_.layers[number];
  std::vector<std::size_t> start{static_cast<std::size_t>(w.row0),
                                 static_cast<std::size_t>(w.col0)},
      count{static_cast<std::size_t>(w.n_rows), static_cast<std::size_t>(w.n_cols)};
  if (!layer.axis.values.empty()) {
    start.insert(start.begin(), plane);
    count.insert(count.begin(), 1);
  }
  file_.floats(layer.name, start, count, out);
  if (!layer.is_count()) return;
  for (float& v : out)
    if (v == static_cast<float>(no_count)) v = nan_f;
}

void write_layers(const std::filesystem::path& path, const LayerStack& stack,
                  const MemberHistory& history) {
  const StackSource checked(stack);
  LayersFileWriter file(path, NetcdfMedium::memory);
  file.begin(stack);
  const std::size_t n = stack.grid.n_cells();
  for (std::size_t l = 0; l < stack.layers.size(); ++l)
    for (std::size_t plane = 0; plane < stack.layers[l].n_planes(); ++plane)
      file.put(l, plane, {0, 0, stack.grid.n_rows, stack.grid.n_cols},
               std::span(stack.layers[l].values).subspan(plane * n, n));
  file.commit(history);
}

LayerStack read_layers(const std::filesystem::path& path) {
  const LayersFileReader file(path);
  LayerStack stack = file.about();
  const std::size_t n = stack.grid.n_cells();
  for (std::size_t l = 0; l < stack.layers.size(); ++l) {
    stack.layers[l].values.resize(stack.layers[l].n_planes() * n);
    for (std::size_t plane = 0; plane < stack.layers[l].n_planes(); ++plane)
      file.read(l, plane, {0, 0, stack.grid.n_rows, stack.grid.n_cols},
                std::span(stack.layers[l].values).subspan(plane * n, n));
  }
  return stack;
}

}  // namespace sturz
