// SPDX-License-Identifier: Apache-2.0
// A member's file, or a file of maps, whose dimensions, attributes and variables were changed as
// the bytes say: a result, IoError or SetupError. The file itself is always sound: HDF5 and netCDF
// are known to crash on broken bytes (the seal stands before them), and would hide what
// this program makes of sound files with senseless contents.
#include "engine/core/error.hpp"
#include "io/files/io_error.hpp"
#include "io/files/seal.hpp"
#include "io/members/member_file.hpp"
#include "io/netcdf/netcdf_file.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "tests/fuzz/memory_file.hpp"
#include "tests/support/netcdf_document.hpp"

#include <fuzzer/FuzzedDataProvider.h>

#include <cmath>
#include <limits>
#include <span>

namespace {

using sturz::test::Attribute;
using sturz::test::Document;
using sturz::test::Variable;

std::vector<Document> originals;

/// netCDF's numbers of its simple types: byte, char, short, int, float, double, ... string.
constexpr int first_type = 1, last_type = 12;

double any_number(FuzzedDataProvider& bytes) {
  static constexpr double senseless[] = {0,
                                         1,
                                         -1,
                                         2,
                                         3,
                                         0.5,
                                         1e300,
                                         -1e300,
                                         1e-300,
                                         2147483647,
                                         2147483648,
                                         -2147483649.0,
                                         4e8,
                                         1e18,
                                         std::numeric_limits<double>::infinity(),
                                         std::numeric_limits<double>::quiet_NaN()};
  return bytes.ConsumeBool() ? bytes.PickValueInArray(senseless)
                             : bytes.ConsumeIntegralInRange<int>(-20, 20);
}

template <class T>
T* any_of(FuzzedDataProvider& bytes, std::vector<T>& all) {
  return all.empty() ? nullptr : &all[bytes.ConsumeIntegralInRange<std::size_t>(0, all.size() - 1)];
}

void change(FuzzedDataProvider& bytes, std::vector<Attribute>& attributes) {
  Attribute* a = any_of(bytes, attributes);
  if (a == nullptr) return;
  switch (bytes.ConsumeIntegralInRange(0, 5)) {
    case 0:
      attributes.erase(attributes.begin() + (a - attributes.data()));
      return;
    case 1:
      a->type = bytes.ConsumeIntegralInRange(first_type, last_type);
      return;
    case 2:
      a->numbers.assign(bytes.ConsumeIntegralInRange<std::size_t>(0, 5), any_number(bytes));
      return;
    case 3:
      a->text = bytes.ConsumeRandomLengthString(12);
      return;
    default:
      a->numbers.assign(1, any_number(bytes));
  }
}

void change(FuzzedDataProvider& bytes, Document& document, Variable& v) {
  switch (bytes.ConsumeIntegralInRange(0, 6)) {
    case 0:
      return change(bytes, v.attributes);
    case 1:
      v.type = bytes.ConsumeIntegralInRange(first_type, last_type);
      return;
    case 2:
      v.name = any_of(bytes, document.variables)->name + (bytes.ConsumeBool() ? "" : "x");
      return;
    case 3:
      if (!v.dimensions.empty()) v.dimensions.pop_back();
      return;
    case 4:
      if (!document.dimensions.empty())
        v.dimensions.push_back(
            bytes.ConsumeIntegralInRange(0, static_cast<int>(document.dimensions.size()) - 1));
      return;
    default:
      if (double* value = any_of(bytes, v.values)) *value = any_number(bytes);
  }
}

void change(FuzzedDataProvider& bytes, Document& document) {
  switch (bytes.ConsumeIntegralInRange(0, 4)) {
    case 0:
      if (auto* d = any_of(bytes, document.dimensions))
        d->second = bytes.ConsumeBool() ? bytes.ConsumeIntegralInRange<std::size_t>(1, 20)
                                        : std::size_t{1} << bytes.ConsumeIntegralInRange(0, 62);
      return;
    case 1:
      if (Variable* v = any_of(bytes, document.variables))
        document.variables.erase(document.variables.begin() + (v - document.variables.data()));
      return;
    case 2:
      if (Variable* v = any_of(bytes, document.variables)) change(bytes, document, *v);
      return;
    default:
      change(bytes, document.attributes);
  }
}

template <class Read>
void run(Read read) {
  try {
    read();
  } catch (const sturz::IoError&) {
  } catch (const sturz::SetupError&) {
  }
}

void check(const sturz::MemberResult& m) {
  for (const auto& layer : m.layers)
    if (layer.size() != m.window.n_cells()) std::abort();
  if (m.window.n_cells() == 0) return;
  if (!m.grid.contains(m.window.row0, m.window.col0) ||
      !m.grid.contains(m.window.row0 + m.window.n_rows - 1, m.window.col0 + m.window.n_cols - 1))
    std::abort();
}

void check(const sturz::LayerStack& stack) {
  for (const auto& layer : stack.layers)
    if (layer.values.size() != layer.n_planes() * stack.grid.n_cells()) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char*** arguments) {
  // The valid files stand beside the program: fuzz_seeds wrote them.
  const std::string program = (*arguments)[0];
  const std::string folder = program.substr(0, program.rfind('/')) + "/valid/";
  sturz::netcdf_mutex();  // quiets HDF5
  for (const char* name : {"000000.nc", "000001.nc", "maps.nc"})
    originals.push_back(sturz::test::read_document(folder + name));
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider bytes(data, size);
  const std::size_t which = bytes.ConsumeIntegralInRange<std::size_t>(0, originals.size() - 1);
  Document document = originals[which];
  for (int n = 0; n < 12 && bytes.remaining_bytes() > 0; ++n) change(bytes, document);
  std::vector<unsigned char> image = sturz::test::bytes_of(document);
  const std::string seal = sturz::seal_of(std::as_bytes(std::span(image)));
  image.insert(image.end(), seal.begin(), seal.end());
  const sturz::fuzz::MemoryFile file(image.data(), image.size());
  if (which < 2)
    run([&] { check(sturz::read_member(file.path())); });
  else
    run([&] { check(sturz::read_layers(file.path())); });
  return 0;
}
