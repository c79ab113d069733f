// SPDX-License-Identifier: Apache-2.0
/// The reading half of netcdf_file.hpp.
#include "io/files/io_error.hpp"
#include "io/netcdf/netcdf_file.hpp"

#include <fmt/core.h>
#include <netcdf.h>

#include <array>
#include <fstream>
#include <string_view>

namespace sturz {
namespace {

using Lock = std::lock_guard<std::recursive_mutex>;

/// Bytes that deflate gets out of one, at most.
constexpr double largest_inflation = 1032;

/// This program writes the HDF5 layout alone; netCDF's readers of its older layouts crash on
/// headers that are broken. A file that cannot be opened is left to netCDF's own message.
void require_hdf5(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 4> begin{};
  if (!file.read(begin.data(), begin.size())) return;
  if (std::string_view(begin.data(), begin.size()) == "\x89HDF") return;
  throw IoError(
      fmt::format("{}: is not netCDF in the HDF5 layout, which this program writes. Is "
                  "the file complete?",
                  path.string()));
}

}  // namespace

NetcdfReader::NetcdfReader(std::filesystem::path file) : file_(std::move(file)) {
  const Lock lock(netcdf_mutex());
  require_hdf5(file_);
  check(nc_open(file_.c_str(), NC_NOWRITE, &id_), "opening");
}

NetcdfReader::~NetcdfReader() {
  const Lock lock(netcdf_mutex());
  nc_close(id_);
}

void NetcdfReader::check(int status, const std::string& what) const {
  if (status == NC_NOERR) return;
  throw IoError(fmt::format("{}: {} failed (netCDF: {}). Is the file complete and readable?",
                            file_.string(), what, nc_strerror(status)));
}

int NetcdfReader::find(const std::string& variable) const {
  if (variable.empty()) return NC_GLOBAL;
  int id = -1;
  check(nc_inq_varid(id_, variable.c_str(), &id), "looking for variable " + variable);
  return id;
}

std::vector<std::string> NetcdfReader::variables() const {
  const Lock lock(netcdf_mutex());
  int n = 0;
  check(nc_inq_nvars(id_, &n), "listing variables");
  std::vector<std::string> names;
  char name[NC_MAX_NAME + 1] = {};
  for (int v = 0; v < n; ++v) {
    check(nc_inq_varname(id_, v, name), "listing variables");
    names.emplace_back(name);
  }
  return names;
}

bool NetcdfReader::has(const std::string& variable) const {
  const Lock lock(netcdf_mutex());
  int id = -1;
  return nc_inq_varid(id_, variable.c_str(), &id) == NC_NOERR;
}

std::vector<std::string> NetcdfReader::dimensions(const std::string& variable) const {
  const Lock lock(netcdf_mutex());
  const int v = find(variable);
  int n = 0;
  check(nc_inq_varndims(id_, v, &n), "reading the shape of " + variable);
  std::vector<int> ids(static_cast<std::size_t>(n));
  check(nc_inq_vardimid(id_, v, ids.data()), "reading the shape of " + variable);
  std::vector<std::string> names;
  char name[NC_MAX_NAME + 1] = {};
  for (const int id : ids) {
    check(nc_inq_dimname(id_, id, name), "reading the shape of " + variable);
    names.emplace_back(name);
  }
  return names;
}

std::size_t NetcdfReader::length(const std::string& dimension) const {
  const Lock lock(netcdf_mutex());
  int id = -1;
  std::size_t n = 0;
  if (nc_inq_dimid(id_, dimension.c_str(), &id) != NC_NOERR) return 0;
  check(nc_inq_dimlen(id_, id, &n), "reading dimension " + dimension);
  return n;
}

bool NetcdfReader::is_integer(const std::string& variable) const {
  const Lock lock(netcdf_mutex());
  nc_type type = NC_NAT;
  check(nc_inq_vartype(id_, find(variable), &type), "reading the type of " + variable);
  return type != NC_FLOAT && type != NC_DOUBLE;
}

std::vector<std::string> NetcdfReader::attributes(const std::string& variable) const {
  const Lock lock(netcdf_mutex());
  const int v = find(variable);
  int n = 0;
  check(v == NC_GLOBAL ? nc_inq_natts(id_, &n) : nc_inq_varnatts(id_, v, &n), "listing attributes");
  std::vector<std::string> names;
  char name[NC_MAX_NAME + 1] = {};
  for (int a = 0; a < n; ++a) {
    check(nc_inq_attname(id_, v, a, name), "listing attributes");
    names.emplace_back(name);
  }
  return names;
}

std::optional<std::string> NetcdfReader::text(const std::string& variable,
                                              const std::string& name) const {
  const Lock lock(netcdf_mutex());
  const int v = find(variable);
  nc_type type = NC_NAT;
  std::size_t length = 0;
  if (nc_inq_att(id_, v, name.c_str(), &type, &length) != NC_NOERR || type != NC_CHAR)
    return std::nullopt;
  std::string value(length, '\0');
  check(nc_get_att_text(id_, v, name.c_str(), value.data()), "reading attribute " + name);
  return value;
}

std::optional<double> NetcdfReader::number(const std::string& variable,
                                           const std::string& name) const {
  const std::vector<double> all = numbers(variable, name);
  return all.size() == 1 ? std::optional(all.front()) : std::nullopt;
}

std::vector<double> NetcdfReader::numbers(const std::string& variable,
                                          const std::string& name) const {
  const Lock lock(netcdf_mutex());
  const int v = find(variable);
  nc_type type = NC_NAT;
  std::size_t length = 0;
  if (nc_inq_att(id_, v, name.c_str(), &type, &length) != NC_NOERR || type == NC_CHAR) return {};
  std::vector<double> values(length);
  check(nc_get_att_double(id_, v, name.c_str(), values.data()), "reading attribute " + name);
  return values;
}

std::optional<std::int64_t> NetcdfReader::integer(const std::string& variable,
                                                  const std::string& name) const {
  const Lock lock(netcdf_mutex());
  long long value = 0;
  if (!number(variable, name)) return std::nullopt;
  check(nc_get_att_longlong(id_, find(variable), name.c_str(), &value),
        "reading attribute " + name);
  return value;
}

std::optional<std::uint64_t> NetcdfReader::hash(const std::string& variable,
                                                const std::string& name) const {
  const Lock lock(netcdf_mutex());
  unsigned long long value = 0;
  if (!number(variable, name)) return std::nullopt;
  check(nc_get_att_ulonglong(id_, find(variable), name.c_str(), &value),
        "reading attribute " + name);
  return value;
}

std::vector<std::size_t> NetcdfReader::shape_of(int variable) const {
  int n = 0;
  check(nc_inq_varndims(id_, variable, &n), "reading a shape");
  std::vector<int> dims(static_cast<std::size_t>(n));
  check(nc_inq_vardimid(id_, variable, dims.data()), "reading a shape");
  std::vector<std::size_t> shape(dims.size());
  for (std::size_t d = 0; d < dims.size(); ++d)
    check(nc_inq_dimlen(id_, dims[d], &shape[d]), "reading a shape");
  return shape;
}

std::size_t NetcdfReader::size(const std::string& variable) const {
  const Lock lock(netcdf_mutex());
  std::size_t size = 1;
  double exact = 1;  // the product of the lengths may be more than an integer holds
  for (const std::size_t length : shape_of(find(variable))) {
    exact *= static_cast<double>(length);
    size *= length;
  }
  require_room(exact, variable);
  return size;
}

void NetcdfReader::require_room(double n_values, const std::string& what) const {
  std::error_code error;
  const auto bytes = static_cast<double>(std::filesystem::file_size(file_, error));
  if (error || n_values <= largest_inflation * bytes) return;
  throw IoError(
      fmt::format("{}: {} would have {:g} values (more than the file can hold; it is "
                  "damaged). Compute it again.",
                  file_.string(), what, n_values));
}

std::vector<double> NetcdfReader::doubles(const std::string& variable) const {
  const Lock lock(netcdf_mutex());
  std::vector<double> values(size(variable));
  check(nc_get_var_double(id_, find(variable), values.data()), "reading " + variable);
  return values;
}

std::vector<std::int32_t> NetcdfReader::integers(const std::string& variable) const {
  const Lock lock(netcdf_mutex());
  std::vector<std::int32_t> values(size(variable));
  check(nc_get_var_int(id_, find(variable), values.data()), "reading " + variable);
  return values;
}

void NetcdfReader::floats(const std::string& variable, const std::vector<std::size_t>& start,
                          const std::vector<std::size_t>& count, std::span<float> out) const {
  const Lock lock(netcdf_mutex());
  const int v = find(variable);
  const std::vector<std::size_t> shape = shape_of(v);
  bool fits = shape.size() == count.size() && start.size() == count.size();
  std::size_t size = 1;
  for (std::size_t d = 0; fits && d < shape.size(); ++d) {
    fits = start[d] <= shape[d] && count[d] <= shape[d] - start[d];
    size *= count[d];
  }
  if (!fits || size > out.size())
    throw IoError(
        fmt::format("{}: {} has another shape than it should (the file is damaged). "
                    "Compute it again.",
                    file_.string(), variable));
  check(nc_get_vara_float(id_, v, start.data(), count.data(), out.data()), "reading " + variable);
}

}  // namespace sturz
