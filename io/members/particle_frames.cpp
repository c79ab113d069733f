// SPDX-License-Identifier: Apache-2.0
#include "io/members/particle_frames.hpp"

#include "engine/core/error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/text_files.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>
#include <regex>

namespace sturz {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say LittleEndian");

template <class T>
constexpr const char* vtk_type();
template <>
constexpr const char* vtk_type<double>() {
  return "Float64";
}
template <>
constexpr const char* vtk_type<float>() {
  return "Float32";
}
template <>
constexpr const char* vtk_type<std::int8_t>() {
  return "Int8";
}
template <>
constexpr const char* vtk_type<std::uint32_t>() {
  return "UInt32";
}
template <>
constexpr const char* vtk_type<std::int64_t>() {
  return "Int64";
}

/// The text part and the binary part of a file, which grow together.
struct VtpParts {
  std::string text;
  std::vector<std::byte> data;

  /// Adds one array: its tag, and its bytes behind their length.
  template <class T>
  void add(const char* name, int components, const std::vector<T>& values) {
    text += fmt::format(
        "        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
        "offset=\"{}\"/>\n",
        vtk_type<T>(), name, components, data.size());
    const std::uint64_t bytes = values.size() * sizeof(T);
    const std::size_t begin = data.size();
    data.resize(begin + sizeof bytes + bytes);
    std::memcpy(data.data() + begin, &bytes, sizeof bytes);
    if (bytes > 0) std::memcpy(data.data() + begin + sizeof bytes, values.data(), bytes);
  }
};

template <class T>
std::vector<T> interleaved(std::span<const double> x, std::span<const double> y,
                           std::span<const double> z) {
  std::vector<T> all;
  all.reserve(3 * x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    for (const double v : {x[i], y[i], z[i]}) all.push_back(static_cast<T>(v));
  return all;
}

std::vector<float> narrowed(std::span<const double> values) {
  return {values.begin(), values.end()};
}

std::vector<float> speeds(const ParticleFrame& f) {
  std::vector<float> all(f.vx.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = static_cast<float>(std::hypot(f.vx[i], f.vy[i], f.vz[i]));
  return all;
}

void add_point_data(VtpParts& parts, const ParticleFrame& f) {
  parts.text += "      <PointData Scalars=\"speed\" Vectors=\"velocity\">\n";
  if (!f.vx.empty()) {
    parts.add("velocity", 3, interleaved<float>(f.vx, f.vy, f.vz));
    parts.add("speed", 1, speeds(f));
  }
  if (!f.mass.empty()) parts.add("mass", 1, std::vector<double>(f.mass.begin(), f.mass.end()));
  if (!f.density.empty()) parts.add("density", 1, narrowed(f.density));
  if (!f.pressure.empty()) parts.add("pressure", 1, narrowed(f.pressure));
  if (!f.solid_fraction.empty()) parts.add("solid_fraction", 1, narrowed(f.solid_fraction));
  if (!f.state.empty())
    parts.add("state", 1, std::vector<std::int8_t>(f.state.begin(), f.state.end()));
  if (!f.granular_temperature.empty())
    parts.add("granular_temperature", 1, narrowed(f.granular_temperature));
  if (!f.id.empty()) parts.add("id", 1, std::vector<std::uint32_t>(f.id.begin(), f.id.end()));
  parts.text += "      </PointData>\n";
}

VtpParts vtp(const ParticleFrame& f) {
  const std::size_t n = f.x.size();
  // All particles are one poly-vertex cell: drawn at once, without a cell each.
  const std::size_t n_cells = n > 0 ? 1 : 0;
  VtpParts parts;
  parts.text = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n"
      "  <PolyData>\n"
      "    <FieldData>\n"
      "      <DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
      "format=\"ascii\">{:.17g}</DataArray>\n"
      "    </FieldData>\n"
      "    <Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"0\" "
      "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
      f.time_s, n, n_cells);
  add_point_data(parts, f);
  parts.text += "      <Points>\n";
  parts.add("Points", 3, interleaved<double>(f.x, f.y, f.z));
  parts.text += "      </Points>\n      <Verts>\n";
  std::vector<std::int64_t> connectivity(n);
  std::iota(connectivity.begin(), connectivity.end(), 0);
  parts.add("connectivity", 1, connectivity);
  parts.add("offsets", 1, std::vector<std::int64_t>(n_cells, static_cast<std::int64_t>(n)));
  parts.text += "      </Verts>\n    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n_";
  return parts;
}

/// The first set has the plain name; the others carry theirs.
std::string frame_name(const std::string& name, const ParticleFrame& frame, std::size_t number) {
  if (frame.set_index == 0) return fmt::format("{}_{:06d}.vtp", name, number);
  return fmt::format("{}_{}_{:06d}.vtp", name, frame.set, number);
}

}  // namespace

ParticleFrameWriter::ParticleFrameWriter(std::filesystem::path folder, std::string name)
    : folder_(std::move(folder)), index_(folder_ / (name + ".pvd")), name_(std::move(name)) {
  make_folder(folder_);
}

void ParticleFrameWriter::write(const ParticleFrame& frame) {
  const std::size_t n = frame.x.size();
  const auto fits = [n](std::size_t size) { return size == n || size == 0; };
  expect(frame.y.size() == n && frame.z.size() == n, "positions have one length");
  expect(fits(frame.vx.size()) && frame.vy.size() == frame.vx.size() &&
             frame.vz.size() == frame.vx.size() && fits(frame.mass.size()) &&
             fits(frame.density.size()) && fits(frame.pressure.size()) && fits(frame.id.size()) &&
             fits(frame.solid_fraction.size()) && fits(frame.state.size()) &&
             fits(frame.granular_temperature.size()),
         "fields are empty or as long as the positions");
  const VtpParts parts = vtp(frame);
  const auto earlier = std::count_if(entries_.begin(), entries_.end(),
                                     [&](const Entry& e) { return e.part == frame.set_index; });
  const std::string name = frame_name(name_, frame, static_cast<std::size_t>(earlier));
  AtomicFile file(folder_ / name);
  const auto put = [&](std::string_view text) {
    file.write(std::as_bytes(std::span(text.data(), text.size())));
  };
  put(parts.text);
  file.write(parts.data);
  put("\n  </AppendedData>\n</VTKFile>\n");
  file.commit();
  entries_.push_back({frame.time_s, frame.set_index, name});

  std::string pvd =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n  <Collection>\n";
  for (const Entry& e : entries_)
    pvd += fmt::format("    <DataSet timestep=\"{:.9g}\" part=\"{}\" file=\"{}\"/>\n", e.time_s,
                       e.part, e.file);
  write_text_atomic(index_, pvd + "  </Collection>\n</VTKFile>\n");
}

void remove_particle_frames(const std::filesystem::path& folder, const std::string& name) {
  namespace fs = std::filesystem;
  const std::regex ours(name + R"((_.*)?_[0-9]{6,}\.vtp|)" + name + R"(\.pvd)");
  std::error_code error, ignored;
  std::vector<fs::path> found;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (std::regex_match(entry->path().filename().string(), ours)) found.push_back(entry->path());
  for (const fs::path& file : found) fs::remove(file, ignored);
  if (fs::is_directory(folder, ignored) && fs::is_empty(folder, ignored))
    fs::remove(folder, ignored);
}

}  // namespace sturz
