// SPDX-License-Identifier: Apache-2.0
// Writes a member with maps, one without, and a file of maps into a folder: fuzz_seeds FOLDER
#include "io/members/member_file.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "tests/io/io_fixture.hpp"

#include <filesystem>

namespace {

sturz::MemberResult small_member(std::int64_t number) {
  sturz::MemberResult m = sturz::test::made_up_member(number);
  m.grid.crs_wkt.clear();  // a long text whose bytes nobody reads here
  return m;
}

sturz::LayerStack maps() {
  sturz::LayerStack stack;
  stack.grid = {3, 2, 500000, 4600000, 10, ""};
  sturz::Layer plain;
  plain.name = "thickness_mean";
  plain.meaning = {sturz::Quantity::thickness, sturz::Statistic::mean};
  plain.units = "m";
  plain.values.assign(6, 1.5F);
  sturz::Layer counted = plain;
  counted.name = "number_of_members";
  counted.meaning = {sturz::Quantity::members, sturz::Statistic::count};
  counted.values.assign(6, 2.0F);
  sturz::Layer planes = plain;
  planes.name = "thickness_exceedance";
  planes.meaning = {sturz::Quantity::thickness, sturz::Statistic::probability};
  planes.axis = {"thickness_threshold", "", "m", {0.5, 1}};
  planes.values.assign(12, 0.25F);
  stack.layers = {plain, counted, planes};
  return stack;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 1;
  const std::filesystem::path folder = argv[1];
  sturz::write_member(folder, small_member(0));
  sturz::MemberResult without_maps = small_member(1);
  without_maps.window = {};
  for (auto& layer : without_maps.layers) layer.clear();
  sturz::write_member(folder, without_maps);
  sturz::write_layers(folder / "maps.nc", maps());
  return 0;
}
