// SPDX-License-Identifier: Apache-2.0
/// Particles for ParaView: one .vtp (raw appended) per instant and a .pvd index over time.
#pragma once

#include "engine/simulation/simulation.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace sturz {

/// Writes folder/name_000000.vtp, ..., and folder/name.pvd after each frame, so a run that is
/// killed leaves a series that opens. Further particle sets of a scene are further parts of an
/// instant, in files name_SET_000000.vtp.
class ParticleFrameWriter {
 public:
  /// \throws IoError if the folder cannot be made
  explicit ParticleFrameWriter(std::filesystem::path folder, std::string name = "particles");

  /// Positions are absolute map coordinates (float64); fields velocity, speed, mass, density,
  /// pressure, solid_fraction, state (0 dense, 1 transition, 2 dilute, 3 ultradilute),
  /// granular_temperature and id; arrays that the frame leaves empty are left out. \throws IoError
  void write(const ParticleFrame& frame);

  const std::filesystem::path& index() const { return index_; }

 private:
  std::filesystem::path folder_, index_;
  std::string name_;
  struct Entry {
    double time_s = 0;
    std::size_t part = 0;  // the set's index
    std::string file;
  };
  std::vector<Entry> entries_;
};

/// Removes the frames and the index that a writer of that name has left, and the folder when
/// nothing else lies in it.
void remove_particle_frames(const std::filesystem::path& folder,
                            const std::string& name = "particles");

}  // namespace sturz
