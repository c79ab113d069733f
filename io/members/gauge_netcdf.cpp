// SPDX-License-Identifier: Apache-2.0
#include "io/members/gauge_netcdf.hpp"

#include "io/files/io_error.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace sturz {
namespace {

constexpr const char *time_axis = "gauge_time", *point_axis = "gauge_point",
                     *line_axis = "gauge_line", *interval_attribute = "gauge_interval_s";

struct About {
  const char *name, *units, *long_name;
};

template <class Gauge>
struct Series {
  About about;
  std::vector<float> Gauge::*values;
};
constexpr Series<PointSeries> point_series[] = {
    {{"gauge_thickness", "m", "vertical thickness at a gauge"}, &PointSeries::thickness_m},
    {{"gauge_speed", "m s-1", "speed of the mean momentum at a gauge"}, &PointSeries::speed_m_s},
    {{"gauge_momentum_flux", "N m-1", "density times thickness times speed squared at a gauge"},
     &PointSeries::momentum_flux_n_m}};

template <class Gauge>
struct Peak {
  About about;
  GaugePeak Gauge::*peak;
};
constexpr Peak<PointSeries> point_peaks[] = {
    {{"gauge_peak_thickness", "m", "largest thickness at a gauge"}, &PointSeries::thickness},
    {{"gauge_peak_speed", "m s-1", "largest speed at a gauge"}, &PointSeries::speed},
    {{"gauge_peak_momentum_flux", "N m-1", "largest momentum flux at a gauge"},
     &PointSeries::momentum_flux}};

int described(NetcdfWriter& file, const About& about, NcType type, const std::vector<int>& axes) {
  const int variable = file.variable(about.name, type, axes);
  file.text(variable, "long_name", about.long_name);
  file.text(variable, "units", about.units);
  return variable;
}

template <class Gauges, class Value>
void put_each(NetcdfWriter& file, const About& about, int axis, const Gauges& gauges,
              Value value_of) {
  std::vector<double> values;
  for (const auto& gauge : gauges) values.push_back(value_of(gauge));
  file.put(described(file, about, NcType::float64, {axis}), values);
}

template <class Number, class Gauges, class Member>
void put_series(NetcdfWriter& file, const About& about, NcType type, const std::vector<int>& axes,
                const Gauges& gauges, Member member) {
  std::vector<Number> all;
  for (const auto& gauge : gauges)
    all.insert(all.end(), (gauge.*member).begin(), (gauge.*member).end());
  const int variable = file.variable(about.name, type, axes);
  file.compress(variable, {1, std::max<std::size_t>(1, all.size() / gauges.size())});
  file.text(variable, "long_name", about.long_name);
  file.text(variable, "units", about.units);
  file.put(variable, std::span<const Number>(all));
}

std::string name_attribute(const char* axis, std::size_t k) {
  return fmt::format("{}_{}", axis, k);
}

constexpr About point_arrival{"gauge_arrival", "s",
                              "time at which a point is reached; NaN: it was not"};
constexpr About line_arrival{"gauge_line_arrival", "s",
                             "time at which the first column crosses; NaN: none did"};
constexpr About volume_about{"gauge_volume", "m3", "volume that passed a line by then"};
constexpr About discharge_about{"gauge_discharge", "m3 s-1",
                                "mean discharge since the time before"};
constexpr About total_about{"gauge_total_volume", "m3", "volume that passed a line in the end"};
constexpr About peak_about{"gauge_peak_discharge", "m3 s-1", "largest discharge"};

void write_points(NetcdfWriter& file, int time, const std::vector<PointSeries>& points) {
  if (points.empty()) return;
  const int axis = file.dimension(point_axis, points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
    file.text(NetcdfWriter::global, name_attribute(point_axis, k), points[k].name);
  put_each(file, {"gauge_x", "m", "easting"}, axis, points, [](const auto& p) { return p.at.x(); });
  put_each(file, {"gauge_y", "m", "northing"}, axis, points,
           [](const auto& p) { return p.at.y(); });
  put_each(file, point_arrival, axis, points, [](const auto& p) { return p.arrival_s; });
  for (const auto& peak : point_peaks) {
    put_each(file, peak.about, axis, points, [&](const auto& p) { return (p.*peak.peak).value; });
    const std::string name = std::string(peak.about.name) + "_time";
    put_each(file, {name.c_str(), "s", "when it was there first"}, axis, points,
             [&](const auto& p) { return (p.*peak.peak).time_s; });
  }
  for (const auto& series : point_series)
    put_series<float>(file, series.about, NcType::float32, {axis, time}, points, series.values);
}

void write_lines(NetcdfWriter& file, int time, const std::vector<LineSeries>& lines) {
  if (lines.empty()) return;
  const int axis = file.dimension(line_axis, lines.size());
  for (std::size_t k = 0; k < lines.size(); ++k)
    file.text(NetcdfWriter::global, name_attribute(line_axis, k), lines[k].name);
  put_each(file, line_arrival, axis, lines, [](const auto& l) { return l.arrival_s; });
  put_each(file, total_about, axis, lines, [](const auto& l) { return l.total_m3; });
  put_each(file, peak_about, axis, lines, [](const auto& l) { return l.discharge.value; });
  put_each(file, {"gauge_peak_discharge_time", "s", "when it was there first"}, axis, lines,
           [](const auto& l) { return l.discharge.time_s; });
  put_series<double>(file, volume_about, NcType::float64, {axis, time}, lines,
                     &LineSeries::volume_m3);
  put_series<double>(file, discharge_about, NcType::float64, {axis, time}, lines,
                     &LineSeries::discharge_m3_s);
}

/// One number for each gauge of an axis.
std::vector<double> numbers_of(const NetcdfReader& file, const char* name, std::size_t n) {
  std::vector<double> values = file.doubles(name);
  if (values.size() != n)
    throw IoError(
        fmt::format("{}: {} has not one value per gauge (damaged).", file.file().string(), name));
  return values;
}

/// The part of series k.
template <class Number>
std::vector<Number> part_of(const std::vector<double>& all, std::size_t k, std::size_t length) {
  const auto first = all.begin() + static_cast<std::ptrdiff_t>(k * length);
  std::vector<Number> out(length);
  std::transform(first, first + static_cast<std::ptrdiff_t>(length), out.begin(),
                 [](double v) { return static_cast<Number>(v); });
  return out;
}

void read_points(const NetcdfReader& file, GaugeResult& out) {
  const std::size_t n = file.length(point_axis), length = out.time_s.size();
  if (n == 0) return;
  const auto x = numbers_of(file, "gauge_x", n), y = numbers_of(file, "gauge_y", n);
  const auto arrival = numbers_of(file, point_arrival.name, n);
  out.points.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    out.points[k].name = file.text("", name_attribute(point_axis, k)).value_or("");
    out.points[k].at = Vec2(x[k], y[k]);
    out.points[k].arrival_s = arrival[k];
  }
  for (const auto& peak : point_peaks) {
    const auto value = numbers_of(file, peak.about.name, n);
    const auto time = numbers_of(file, (std::string(peak.about.name) + "_time").c_str(), n);
    for (std::size_t k = 0; k < n; ++k) out.points[k].*peak.peak = {value[k], time[k]};
  }
  for (const auto& series : point_series) {
    const auto all = numbers_of(file, series.about.name, n * length);
    for (std::size_t k = 0; k < n; ++k)
      out.points[k].*series.values = part_of<float>(all, k, length);
  }
}

void read_lines(const NetcdfReader& file, GaugeResult& out) {
  const std::size_t n = file.length(line_axis), length = out.time_s.size();
  if (n == 0) return;
  const auto arrival = numbers_of(file, line_arrival.name, n),
             total = numbers_of(file, total_about.name, n),
             peak = numbers_of(file, peak_about.name, n),
             peak_time = numbers_of(file, "gauge_peak_discharge_time", n),
             volume = numbers_of(file, volume_about.name, n * length),
             discharge = numbers_of(file, discharge_about.name, n * length);
  for (std::size_t k = 0; k < n; ++k) {
    LineSeries& line = out.lines.emplace_back();
    line.name = file.text("", name_attribute(line_axis, k)).value_or("");
    line.arrival_s = arrival[k], line.total_m3 = total[k];
    line.discharge = {peak[k], peak_time[k]};
    line.volume_m3 = part_of<double>(volume, k, length);
    line.discharge_m3_s = part_of<double>(discharge, k, length);
  }
}

}  // namespace

void write_gauges(NetcdfWriter& file, const GaugeResult& gauges) {
  if (gauges.empty()) return;
  file.number(NetcdfWriter::global, interval_attribute, gauges.interval_s);
  const int time = file.dimension(time_axis, gauges.time_s.size());
  file.put(
      described(file, {time_axis, "s", "time since the start of the run"}, NcType::float64, {time}),
      gauges.time_s);
  write_points(file, time, gauges.points);
  write_lines(file, time, gauges.lines);
}

GaugeResult read_gauges(const NetcdfReader& file) {
  GaugeResult out;
  if (!file.has(time_axis)) return out;
  out.interval_s = file.number("", interval_attribute).value_or(0);
  out.time_s = file.doubles(time_axis);
  read_points(file, out);
  read_lines(file, out);
  return out;
}

}  // namespace sturz
