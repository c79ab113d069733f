// SPDX-License-Identifier: Apache-2.0
// One slope on a raster long enough and on one that ends where half of the members still run: what
// the short one says must be true of the long one.
#include "ensemble/censoring/censoring_report.hpp"
#include "ensemble/censoring/scalar_censoring.hpp"
#include "ensemble/workflow/folder/manifest.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"
#include "io/members/member_store.hpp"
#include "tests/workflow/workflow_fixture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sturz::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double cell_m = 4, west_m = 400000, south_m = 4000000, release_x_m = west_m + 30;
constexpr int n_rows = 60;  // wide enough that no mass leaves at the sides

/// Thirty degrees for 80 m, then five; ends `length_m` after its western edge. ESRI ASCII.
std::string slope(double length_m) {
  const int n_cols = static_cast<int>(length_m / cell_m);
  std::string row;
  for (int col = 0; col < n_cols; ++col) {
    const double x = (col + 0.5) * cell_m;
    const double z = 500 - std::tan(0.5235987755982988) * std::min(x, 80.0) -
                     std::tan(0.08726646259971647) * std::max(0.0, x - 80);
    row += fmt::format("{:.3f} ", z);
  }
  std::string text = fmt::format(
      "ncols {}\nnrows {}\nxllcorner {}\nyllcorner {}\ncellsize {}\nNODATA_value -9999\n", n_cols,
      n_rows, west_m, south_m, cell_m);
  for (int r = 0; r < n_rows; ++r) text += row + "\n";
  return text;
}

std::string scenario(const std::string& raster) {
  return fmt::format(R"(title: slope
terrain: {{raster: {}, crs: "EPSG:32633"}}
release:
  box: {{x_m: [{}, {}], y_m: [{}, {}]}}
  thickness_m: 3
grains: {{density_kg_m3: 2600, solid_fraction: 0.6, friction_angle_deg: 30}}
basal: {{friction_coefficient: {{uniform: [0.2, 0.45]}}}}
numerics: {{spacing_m: 2, end_time_s: 200}}
ensemble: {{design: latin_hypercube, members: 24, seed: 3}}
hazard: {{cell_size_m: 4}}
formulation: depth_averaged
)",
                     raster, release_x_m - 10, release_x_m + 10, south_m + 110, south_m + 130);
}

struct Finished {
  workflow::MapsMade made;
  std::vector<MemberSummary> members;
  std::vector<double> runouts() const {
    std::vector<double> all;
    for (const MemberSummary& m : members) all.push_back(m.scalars.runout_m);
    std::sort(all.begin(), all.end());
    return all;
  }
  CensoredEstimate median(double MemberScalars::*field) const {
    return censored_quantile(observations(members, field), 0.5, 0.95);
  }
  /// As if every value were the true one.
  CensoredEstimate naive(double MemberScalars::*field) const {
    std::vector<Observation> all = observations(members, field);
    for (Observation& o : all) o.known = Known::exactly;
    return censored_quantile(all, 0.5, 0.95);
  }
};

class CensoredEnsemble : public Workflow {
 protected:
  /// The ensemble on a raster of that length.
  Finished run_on(const std::string& name, double length_m) {
    write(name + ".asc", slope(length_m));
    write("scene.yaml", scenario(name + ".asc"));
    Recorder silent;
    Finished f{whole(request(name), silent), {}};
    f.members = MemberStore(path(name) / "members").members();
    return f;
  }
  /// Where the raster must end so that `share` of the members of `whole` run beyond it.
  static double length_for(const Finished& whole, double share) {
    const std::vector<double> all = whole.runouts();
    const auto k = static_cast<std::size_t>((1 - share) * static_cast<double>(all.size()));
    return std::floor((release_x_m - west_m + (all[k - 1] + all[k]) / 2) / cell_m) * cell_m;
  }
};

TEST_F(CensoredEnsemble, MedianOnAShortRasterCoversTheTruthAndTheNaiveOneDoesNot) {
  const Finished truth = run_on("long", 700);
  ASSERT_EQ(truth.made.censoring.settled, 24) << counts_text(truth.made.censoring);
  const double median = truth.median(&MemberScalars::runout_m).value;

  const Finished cut = run_on("short", length_for(truth, 0.6));
  ASSERT_EQ(read("long/design.csv"), read("short/design.csv"));
  EXPECT_GE(cut.made.censoring.left(), 13) << counts_text(cut.made.censoring);
  EXPECT_GE(cut.made.censoring.settled, 5) << counts_text(cut.made.censoring);

  const CensoredEstimate known = cut.median(&MemberScalars::runout_m);
  EXPECT_TRUE(known.at_least);
  EXPECT_LE(known.value, median);
  EXPECT_LE(known.lower, median);
  EXPECT_GE(known.upper, median);
  EXPECT_LT(cut.naive(&MemberScalars::runout_m).upper, median) << "the distance to the edge";

  // The same of area and of the deposit's length, lost with the mass.
  for (const auto field :
       {&MemberScalars::reached_area_m2, &MemberScalars::crown_to_toe_length_m}) {
    const double value = truth.median(field).value;
    EXPECT_LE(cut.median(field).lower, value);
    EXPECT_GE(cut.median(field).upper, value);
  }
}

TEST_F(CensoredEnsemble, MedianIsTheTrueOneWhereTheRasterEndsBeyondIt) {
  const Finished truth = run_on("long", 700);
  const Finished cut = run_on("short", length_for(truth, 0.2));
  EXPECT_GE(cut.made.censoring.left(), 4);
  const CensoredEstimate known = cut.median(&MemberScalars::runout_m);
  const double median = truth.median(&MemberScalars::runout_m).value;
  EXPECT_FALSE(known.at_least);
  EXPECT_NEAR(known.value, median, cell_m);
  EXPECT_LE(known.lower, median);
  EXPECT_GE(known.upper, median);
}

TEST_F(CensoredEnsemble, SaysWhatIsCutWhereverItIsRead) {
  const Finished truth = run_on("long", 700);
  const Finished cut = run_on("short", length_for(truth, 0.6));
  const std::string counts = one_line(cut.made.censoring);
  EXPECT_TRUE(cut.made.censoring.too_many());
  EXPECT_EQ(workflow::Manifest::read(path("short") / "manifest.json").censored, counts);
  const std::string page = read("short/report.html");
  EXPECT_THAT(page, HasSubstr("<section class=\"banner\""));
  EXPECT_THAT(page, HasSubstr(fmt::format("{} of 24 simulations", cut.made.censoring.censored())));
  EXPECT_THAT(page, HasSubstr("larger terrain.raster"));
  EXPECT_THAT(page, HasSubstr("upper end not known"));
  EXPECT_THAT(read("short/members.csv"), HasSubstr(",left_terrain,"));
  EXPECT_THAT(read("long/report.html"), Not(HasSubstr("<section class=\"banner\"")));
  // Said of both before, answered where no member came to the edge.
  for (const char* folder : {"long", "short"})
    EXPECT_THAT(read(std::string(folder) + "/manifest.json"), HasSubstr("edge of the terrain: "));
  EXPECT_THAT(page, HasSubstr("edge of the terrain: "));
  EXPECT_THAT(read("long/report.html"), Not(HasSubstr("edge of the terrain: ")));
  EXPECT_EQ(workflow::Manifest::read(path("long") / "manifest.json").censored,
            "0 of 24 valid members (24 settled)");
}

TEST_F(CensoredEnsemble, StillMovingMembersTellNothingOfTheirDeposit) {
  const Finished truth = run_on("long", 700);
  write("scene.yaml", replaced(scenario("long.asc"), "end_time_s: 200", "end_time_s: 9"));
  Recorder silent;
  Finished early{whole(request("early"), silent), {}};
  early.members = MemberStore(path("early") / "members").members();
  ASSERT_GT(early.made.censoring.moving(), 12) << counts_text(early.made.censoring);
  const CensoredEstimate area = early.median(&MemberScalars::deposit_area_m2);
  EXPECT_TRUE(std::isnan(area.value));
  EXPECT_TRUE(std::isinf(area.upper));
  const CensoredEstimate runout = early.median(&MemberScalars::runout_m);
  EXPECT_TRUE(runout.at_least);
  EXPECT_LE(runout.lower, truth.median(&MemberScalars::runout_m).value);
  EXPECT_THAT(read("early/report.html"), HasSubstr("longer numerics.end_time_s"));
}

}  // namespace
}  // namespace sturz::test
