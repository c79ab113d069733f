// SPDX-License-Identifier: Apache-2.0
/// A netCDF file as data that a test can change and write again: dimensions, attributes,
/// variables with their values.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace sturz::test {

struct Attribute {
  std::string name;
  int type = 0;  ///< nc_type
  std::string text;
  std::vector<double> numbers;
};

struct Variable {
  std::string name;
  int type = 0;                 ///< nc_type
  std::vector<int> dimensions;  ///< indices
  std::vector<Attribute> attributes;
  std::vector<double> values;
};

struct Document {
  std::vector<std::pair<std::string, std::size_t>> dimensions;
  std::vector<Attribute> attributes;
  std::vector<Variable> variables;
};

Document read_document(const std::string& path);
/// Writes what can be written; an attribute or variable that netCDF refuses is left out.
std::vector<unsigned char> bytes_of(const Document& document);

}  // namespace sturz::test
