// SPDX-License-Identifier: Apache-2.0
#include "tests/support/netcdf_document.hpp"

#include <netcdf.h>
#include <netcdf_mem.h>

#include <cstdlib>

namespace sturz::test {
namespace {

constexpr std::size_t most_values = 4096;

std::vector<Attribute> read_attributes(int id, int variable) {
  std::vector<Attribute> all;
  int n = 0;
  nc_inq_varnatts(id, variable, &n);
  for (int a = 0; a < n; ++a) {
    char name[NC_MAX_NAME + 1] = {};
    std::size_t length = 0;
    Attribute attribute;
    nc_inq_attname(id, variable, a, name);
    attribute.name = name;
    nc_inq_att(id, variable, name, &attribute.type, &length);
    if (attribute.type == NC_CHAR) {
      attribute.text.resize(length);
      nc_get_att_text(id, variable, name, attribute.text.data());
    } else {
      attribute.numbers.resize(length);
      nc_get_att_double(id, variable, name, attribute.numbers.data());
    }
    all.push_back(attribute);
  }
  return all;
}

Variable read_variable(const Document& document, int id, int v) {
  Variable variable;
  char name[NC_MAX_NAME + 1] = {};
  int n = 0;
  nc_inq_var(id, v, name, &variable.type, &n, nullptr, nullptr);
  variable.name = name;
  variable.dimensions.resize(static_cast<std::size_t>(n));
  nc_inq_vardimid(id, v, variable.dimensions.data());
  std::size_t size = 1;
  for (const int d : variable.dimensions)
    size *= document.dimensions[static_cast<std::size_t>(d)].second;
  variable.values.resize(size);
  nc_get_var_double(id, v, variable.values.data());
  variable.attributes = read_attributes(id, v);
  return variable;
}

void write(int id, int variable, const Attribute& a) {
  if (a.type == NC_CHAR)
    nc_put_att_text(id, variable, a.name.c_str(), a.text.size(), a.text.data());
  else
    nc_put_att_double(id, variable, a.name.c_str(), a.type, a.numbers.size(), a.numbers.data());
}

/// The variable's number in the file, or -1 when netCDF refuses it.
int define(int id, const std::vector<int>& dimension_ids, const Variable& v) {
  std::vector<int> dimensions;
  for (const int d : v.dimensions) dimensions.push_back(dimension_ids[static_cast<std::size_t>(d)]);
  int variable = -1;
  if (nc_def_var(id, v.name.c_str(), v.type, static_cast<int>(dimensions.size()), dimensions.data(),
                 &variable) != NC_NOERR)
    return -1;
  for (const Attribute& attribute : v.attributes) write(id, variable, attribute);
  return variable;
}

void write_values(int id, int variable, const Document& document, const Variable& v) {
  std::size_t size = 1;
  for (const int d : v.dimensions) size *= document.dimensions[static_cast<std::size_t>(d)].second;
  if (size > most_values) return;  // stays a promise of the header
  std::vector<double> values = v.values;
  values.resize(size, 0.5);
  nc_put_var_double(id, variable, values.data());
}

}  // namespace

Document read_document(const std::string& path) {
  int id = -1, n = 0;
  if (nc_open(path.c_str(), NC_NOWRITE, &id) != NC_NOERR) std::abort();
  Document document;
  nc_inq_ndims(id, &n);
  for (int d = 0; d < n; ++d) {
    char name[NC_MAX_NAME + 1] = {};
    std::size_t length = 0;
    nc_inq_dim(id, d, name, &length);
    document.dimensions.emplace_back(name, length);
  }
  document.attributes = read_attributes(id, NC_GLOBAL);
  nc_inq_nvars(id, &n);
  for (int v = 0; v < n; ++v) document.variables.push_back(read_variable(document, id, v));
  nc_close(id);
  return document;
}

std::vector<unsigned char> bytes_of(const Document& document) {
  int id = -1;
  if (nc_create_mem("fuzz", NC_NETCDF4, 1 << 16, &id) != NC_NOERR) std::abort();
  std::vector<int> dimension_ids;
  for (const auto& [name, length] : document.dimensions) {
    int dimension = -1;
    if (nc_def_dim(id, name.c_str(), length, &dimension) != NC_NOERR) dimension = 0;
    dimension_ids.push_back(dimension);
  }
  for (const Attribute& attribute : document.attributes) write(id, NC_GLOBAL, attribute);
  std::vector<int> variables;
  for (const Variable& v : document.variables) variables.push_back(define(id, dimension_ids, v));
  // A dimension of 2^61 cells cannot be written: netCDF says so here, and would follow a null
  // pointer at the next value.
  const bool writable = nc_enddef(id) == NC_NOERR;
  for (std::size_t v = 0; writable && v < variables.size(); ++v)
    if (variables[v] >= 0) write_values(id, variables[v], document, document.variables[v]);
  NC_memio image{};
  if (nc_close_memio(id, &image) != NC_NOERR || !writable) return {};
  const auto* begin = static_cast<const unsigned char*>(image.memory);
  std::vector<unsigned char> bytes(begin, begin + image.size);
  std::free(image.memory);
  return bytes;
}

}  // namespace sturz::test
