// SPDX-License-Identifier: Apache-2.0
// Atomic files, text, checksums, GeoTIFF, particle frames.
#include "io/files/atomic_file.hpp"
#include "io/files/checksum.hpp"
#include "io/files/io_error.hpp"
#include "io/files/text_files.hpp"
#include "io/gdal/cog.hpp"
#include "io/gdal/gdal_raster.hpp"
#include "io/members/particle_frames.hpp"
#include "tests/io/io_fixture.hpp"

#include <gdal_priv.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class TextFiles : public IoTest {};

TEST_F(TextFiles, ReplaceTheWholeFile) {
  write_text_atomic(path("a.csv"), "long old text");
  write_text_atomic(path("a.csv"), "new");
  EXPECT_EQ(read_text(path("a.csv")), "new");
  write_text_atomic(path("a.csv"), "");
  EXPECT_EQ(read_text(path("a.csv")), "");
  EXPECT_THAT(names(), ElementsAre("a.csv"));
}

TEST_F(TextFiles, AFullDiskLeavesTheOldText) {
  write_text_atomic(path("a.csv"), "old");
  std::string message;
  {
    const SmallDisk disk(1000);
    message = message_of([&] { write_text_atomic(path("a.csv"), std::string(5000, 'x')); });
  }
  EXPECT_THAT(message,
              AllOf(HasSubstr("cannot write " + path("a.csv") + " (File too large). A limit"),
                    HasSubstr("files already there are unharmed")));
  EXPECT_EQ(read_text(path("a.csv")), "old");
  EXPECT_THAT(names(), ElementsAre("a.csv"));
}

TEST_F(TextFiles, ADiskThatIsReallyFullSaysSo) {
  // A file system of 64 kB, mounted where only the child sees it.
  write_text_atomic(path("text"), "");
  const pid_t child = fork();
  if (child == 0) {
    if (unshare(CLONE_NEWNS) != 0 ||
        mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        mount("tmpfs", folder().c_str(), "tmpfs", 0, "size=64k") != 0)
      _exit(77);
    write_text_atomic(path("a"), "old");
    std::string message;
    try {
      write_text_atomic(path("a"), std::string(1 << 20, 'x'));
    } catch (const IoError& error) {
      message = error.what();
    }
    const bool good = message.find("(No space left on device; 0.") != std::string::npos &&
                      read_text(path("a")) == "old" && names() == std::vector<std::string>{"a"};
    _exit(good ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == 77) GTEST_SKIP() << "no right to mount a small file system here";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST_F(TextFiles, PlacesThatCannotBeWrittenAreNamed) {
  EXPECT_EQ(message_of([&] { write_text_atomic(path("no/a.csv"), "x"); }),
            "cannot create " + path("no/a.csv") + " (there is no folder " + path("no") +
                "). Make it first.");
  EXPECT_EQ(message_of([&] { write_text_atomic(folder(), "x"); }),
            "cannot write " + folder().string() +
                " (a folder or device has this name). Choose another name.");
  EXPECT_THAT(message_of([&] { write_text_atomic("/dev/full", "x"); }),
              HasSubstr("cannot write /dev/full (a folder or device has this name)"));
}

TEST_F(TextFiles, ALinkStaysALink) {
  write_text_atomic(path("real.txt"), "old");
  std::filesystem::create_symlink("real.txt", path("link.txt"));
  write_text_atomic(path("link.txt"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(path("link.txt")));
  EXPECT_EQ(read_text(path("real.txt")), "new");
}

TEST_F(TextFiles, AMissingFileIsNamed) {
  EXPECT_THAT(message_of([&] { read_text(path("none.txt")); }),
              HasSubstr("cannot read " + path("none.txt") + " (No such file or directory)"));
}

class Checksum : public IoTest {};

TEST_F(Checksum, IsSha256) {
  // Test vectors of FIPS 180-2: "abc", a million times "a" (more than one block is read), nothing.
  write("abc", "abc");
  EXPECT_EQ(file_checksum(path("abc")),
            "sha256:ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  write("long", std::string(1000000, 'a'));
  EXPECT_EQ(file_checksum(path("long")),
            "sha256:cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  write("empty", "");
  EXPECT_EQ(file_checksum(path("empty")),
            "sha256:e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_THROW(file_checksum(path("none")), IoError);
}

TEST_F(Checksum, DifferenceSaysWhyTwoSumsDiffer) {
  EXPECT_EQ(checksum_difference("sha256:ab", "sha256:ab"), "");
  EXPECT_EQ(checksum_difference("sha256:ab", "sha256:cd"), "other content than before");
  EXPECT_THAT(checksum_difference("fnv1a64:ab", "sha256:cd"),
              HasSubstr("another kind (fnv1a64, now sha256)"));
}

class GeoTiff : public IoTest {};

TEST_F(GeoTiff, RoundTripsElevationsAndMetadata) {
  Raster<double> bed = plane(7, 5, 2.5, 403000.1, 4629500.3);
  bed.at(2, 3) = nan_d;
  bed.at(0, 0) = 1234.56789012345;
  write_geotiff(path("bed.tif"), bed, {{"SYNTHETIC", "YES"}});
  RasterRequest r;
  r.path = path("bed.tif");
  const RasterRead read = read_elevation(r);
  EXPECT_TRUE(read.raster.grid.same_place(bed.grid));
  EXPECT_EQ(std::bit_cast<std::uint64_t>(read.raster.values[0]),
            std::bit_cast<std::uint64_t>(bed.values[0]));
  EXPECT_TRUE(std::isnan(read.raster.at(2, 3)));
  GDALDataset* data = GDALDataset::Open(path("bed.tif").c_str());
  EXPECT_STREQ(data->GetMetadataItem("SYNTHETIC"), "YES");
  GDALClose(data);
}

TEST_F(GeoTiff, OneCloudOptimisedFilePerPlane) {
  LayerStack s;
  s.grid = {600, 520, 403000, 4629500, 10, utm33_wkt()};
  s.attributes = {{"scenario_title", "test"}};
  Layer p{"thickness_exceedance",
          {Quantity::thickness, Statistic::probability},
          "chance",
          "",
          "1",
          "",
          "not resolved",
          {"thickness_threshold", "", "m", {0.1, 2}},
          std::vector<float>(624000, 0.25F)};
  p.values[0] = nan_f;
  p.values[312000] = 0.75F;
  Layer bound = p;
  bound.name = "thickness_exceedance_lower";
  bound.meaning.statistic = Statistic::lower_bound;
  Layer n{"number_of_valid_members",
          {Quantity::members, Statistic::count},
          "members",
          "",
          "1",
          "",
          "",
          {},
          std::vector<float>(312000, 32)};
  s.layers = {p, bound, n};
  const auto written = write_cogs(folder() / "hazard", StackSource(s));
  EXPECT_THAT(names(), ElementsAre("hazard/P_thickness_gt_0.1m.tif", "hazard/P_thickness_gt_2m.tif",
                                   "hazard/bounds/P_thickness_gt_0.1m_lower.tif",
                                   "hazard/bounds/P_thickness_gt_2m_lower.tif"));
  ASSERT_EQ(written.size(), 4U);
  EXPECT_EQ(written[3].layer, 1U);
  EXPECT_EQ(written[3].plane, 1U);
  const std::vector<std::filesystem::path> files{written[0].path, written[1].path};
  GDALDataset* data = GDALDataset::Open(files[1].c_str());
  EXPECT_STREQ(data->GetMetadataItem("LAYOUT", "IMAGE_STRUCTURE"), "COG");
  EXPECT_STREQ(data->GetSpatialRef()->GetAuthorityCode(nullptr), "32633");
  GDALRasterBand& band = *data->GetRasterBand(1);
  EXPECT_TRUE(std::isnan(band.GetNoDataValue()));
  EXPECT_EQ(band.GetOverviewCount(), 1);
  EXPECT_STREQ(band.GetMetadataItem("long_name"), "chance");
  EXPECT_STREQ(band.GetMetadataItem("sturz_quantity"), "thickness");
  EXPECT_STREQ(band.GetMetadataItem("sturz_statistic"), "probability");
  EXPECT_STREQ(band.GetMetadataItem("thickness_threshold"), "2 m");
  EXPECT_STREQ(band.GetMetadataItem("comment"), "not resolved");
  EXPECT_STREQ(band.GetUnitType(), "1");
  EXPECT_STREQ(band.GetDescription(), "thickness_exceedance");
  EXPECT_STREQ(data->GetMetadataItem("scenario_title"), "test");
  float first = 0;
  ASSERT_EQ(band.RasterIO(GF_Read, 0, 0, 1, 1, &first, 1, 1, GDT_Float32, 0, 0, nullptr), CE_None);
  EXPECT_EQ(first, 0.75F);
  // Every cell, through blocks of other sizes than the source's.
  std::vector<float> all(312000);
  ASSERT_EQ(
      band.RasterIO(GF_Read, 0, 0, 600, 520, all.data(), 600, 520, GDT_Float32, 0, 0, nullptr),
      CE_None);
  EXPECT_EQ(std::memcmp(all.data(), &p.values[312000], all.size() * sizeof(float)), 0);
  GDALClose(data);
}

/// Fails in the middle, as a damaged file does.
struct BrokenSource : LayerSource {
  LayerStack stack;
  const LayerStack& about() const override { return stack; }
  void read(std::size_t, std::size_t, const Window& w, std::span<float> out) const override {
    if (w.row0 > 0) throw IoError("hazard.nc: damaged");
    std::fill(out.begin(), out.end(), 1.0F);
  }
};

TEST_F(GeoTiff, ADamagedSourceIsToldAndLeavesNothing) {
  BrokenSource source;
  source.stack.grid = {600, 520, 403000, 4629500, 10, utm33_wkt()};
  source.stack.layers = {{"deposit_mean", {}, "", "", "m", "", "", {}, {}}};
  EXPECT_EQ(message_of([&] { write_cogs(folder(), source); }), "hazard.nc: damaged");
  EXPECT_THAT(names(), IsEmpty());
}

TEST_F(GeoTiff, StopsWhenToldAndLeavesNothing) {
  LayerStack s;
  s.grid = {3, 2, 0, 2, 1, ""};
  s.layers = {{"deposit_mean", {}, "", "", "m", "", "", {}, {1, 2, 3, 4, 5, 6}}};
  const std::atomic<bool> stop{true};
  EXPECT_THROW(write_cogs(folder(), StackSource(s), stop), Cancelled);
  EXPECT_THAT(names(), IsEmpty());
}

TEST_F(GeoTiff, ABareSceneHasNoSystem) {
  LayerStack s;
  s.grid = {3, 2, 0, 2, 1, ""};
  s.layers = {{"deposit_mean", {}, "", "", "m", "", "", {}, {1, 2, 3, 4, 5, 6}}};
  const auto files = write_cogs(folder(), StackSource(s));
  EXPECT_THAT(names(), ElementsAre("deposit_mean_m.tif"));
  GDALDataset* data = GDALDataset::Open(files[0].path.c_str());
  EXPECT_EQ(data->GetSpatialRef(), nullptr);
  GDALClose(data);
}

TEST_F(GeoTiff, AFullDiskLeavesNothing) {
  const Raster<double> bed = plane(70, 50, 2.5, 403000.1, 4629500.3);
  const SmallDisk disk(500);
  EXPECT_THAT(message_of([&] { write_geotiff(path("bed.tif"), bed, {}); }),
              HasSubstr("cannot write " + path("bed.tif")));
  EXPECT_THAT(names(), IsEmpty());
}

class ParticleFrames : public IoTest {
 protected:
  std::vector<double> x{403000.123456789, 2, 3, 4}, y{4, 3, 2, 1}, z{9, 9, 9, 9};
  std::vector<double> vx{3, 0, 0, 0}, vy{4, 0, 0, 0}, vz{0, 0, 0, 1}, mass{1, 2, 3, 4};
  std::vector<double> density{2600, 2601, 2602, 2603}, pressure{0, 10, 20, 30};
  std::vector<std::uint32_t> id{3, 1, 2, 0};
  std::vector<double> fraction{0.61, 0.55, 0.3, 0.01}, state{0, 1, 2, 3}, theta{0, 0.25, 4, 0};
  ParticleFrame frame(double time) const {
    return {time, x, y, z, vx, vy, vz, mass, density, pressure, id, fraction, state, theta};
  }
};

TEST_F(ParticleFrames, HoldTheirValuesAsRawAppendedArrays) {
  ParticleFrameWriter writer(folder() / "frames");
  writer.write(frame(0));
  writer.write(frame(1.5));
  EXPECT_THAT(names(), ElementsAre("frames/particles.pvd", "frames/particles_000000.vtp",
                                   "frames/particles_000001.vtp"));
  const std::string index = read_text(writer.index());
  EXPECT_THAT(index, AllOf(HasSubstr("timestep=\"0\" part=\"0\" file=\"particles_000000.vtp\""),
                           HasSubstr("timestep=\"1.5\" part=\"0\" file=\"particles_000001.vtp\"")));
  const std::string vtp = read_text(path("frames/particles_000001.vtp"));
  EXPECT_THAT(vtp, AllOf(HasSubstr("header_type=\"UInt64\""), HasSubstr("NumberOfPoints=\"4\""),
                         HasSubstr("encoding=\"raw\"")));
  const std::size_t data = vtp.find("\n_") + 2;
  const auto array = [&](const std::string& name, void* to, std::size_t bytes) {
    const std::size_t tag = vtp.find("Name=\"" + name + "\"");
    const std::size_t at = data + std::stoul(vtp.substr(vtp.find("offset=\"", tag) + 8));
    std::uint64_t size = 0;
    std::memcpy(&size, vtp.data() + at, 8);
    ASSERT_EQ(size, bytes) << name;
    std::memcpy(to, vtp.data() + at + 8, bytes);
  };
  double points[12], masses[4];
  float velocity[12], speed[4], pressures[4];
  std::uint32_t ids[4];
  array("Points", points, sizeof points);
  array("velocity", velocity, sizeof velocity);
  array("speed", speed, sizeof speed);
  array("mass", masses, sizeof masses);
  array("pressure", pressures, sizeof pressures);
  array("id", ids, sizeof ids);
  std::int8_t states[4];
  float fractions[4], temperatures[4];
  array("state", states, sizeof states);
  array("solid_fraction", fractions, sizeof fractions);
  array("granular_temperature", temperatures, sizeof temperatures);
  EXPECT_THAT(states, ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(fractions[2], 0.3F);
  EXPECT_EQ(temperatures[1], 0.25F);
  EXPECT_EQ(points[0], 403000.123456789);
  EXPECT_EQ(points[4], 3);
  EXPECT_EQ(velocity[1], 4);
  EXPECT_EQ(speed[0], 5);
  EXPECT_EQ(masses[3], 4);
  EXPECT_EQ(pressures[2], 20);
  EXPECT_EQ(ids[0], 3U);
}

TEST_F(ParticleFrames, VtkReadsThem) {
  if (shell("/usr/bin/python3 -c 'import vtk'").exit_code != 0)
    GTEST_SKIP() << "python3 with vtk is not installed";
  ParticleFrameWriter(folder()).write(frame(2));
  const ShellResult read =
      shell("/usr/bin/python3 -c \"import vtk; r = vtk.vtkXMLPolyDataReader(); r.SetFileName('" +
            path("particles_000000.vtp") +
            "'); r.Update(); d = r.GetOutput(); print(d.GetNumberOfPoints(), d.GetNumberOfVerts(), "
            "d.GetPoint(0)[0], d.GetPointData().GetArray('speed').GetValue(0), "
            "d.GetPointData().GetArray('state').GetValue(3))\"");
  EXPECT_EQ(read.output, "4 1 403000.123456789 5.0 3\n");
}

TEST_F(ParticleFrames, LeaveOutWhatTheSceneDoesNotHave) {
  ParticleFrame dry = frame(0);
  dry.state = dry.granular_temperature = {};
  ParticleFrameWriter(folder()).write(dry);
  const std::string vtp = read_text(path("particles_000000.vtp"));
  EXPECT_THAT(vtp, HasSubstr("Name=\"solid_fraction\""));
  EXPECT_THAT(vtp, Not(HasSubstr("Name=\"state\"")));
  EXPECT_THAT(vtp, Not(HasSubstr("granular_temperature")));
}

TEST_F(ParticleFrames, SetsOfOneInstantArePartsOfIt) {
  ParticleFrameWriter writer(folder());
  for (const double time : {0.0, 1.0}) {
    ParticleFrame second = frame(time);
    second.set = "fluid";
    second.set_index = 1;
    writer.write(frame(time));
    writer.write(second);
  }
  EXPECT_THAT(names(), ElementsAre("particles.pvd", "particles_000000.vtp", "particles_000001.vtp",
                                   "particles_fluid_000000.vtp", "particles_fluid_000001.vtp"));
  EXPECT_THAT(read_text(writer.index()),
              AllOf(HasSubstr("timestep=\"1\" part=\"0\" file=\"particles_000001.vtp\""),
                    HasSubstr("timestep=\"1\" part=\"1\" file=\"particles_fluid_000001.vtp\"")));
}

TEST_F(ParticleFrames, AnEmptyFrameIsStillAFile) {
  ParticleFrameWriter writer(folder());
  writer.write(ParticleFrame{});
  EXPECT_THAT(read_text(path("particles_000000.vtp")), HasSubstr("NumberOfVerts=\"0\""));
}

}  // namespace
}  // namespace sturz::test
