// SPDX-License-Identifier: Apache-2.0
/// GDAL for fuzz targets: few drivers, files in memory.
#pragma once

#include "io/gdal/gdal_handles.hpp"

#include <cpl_conv.h>
#include <cpl_vsi.h>

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace sturz::fuzz {

/// Takes all other drivers away: what is looked for are faults of this program, and some drivers
/// follow names inside the bytes to other files or hosts.
inline void keep_only_drivers(std::initializer_list<std::string_view> names) {
  const GdalScope scope;
  GDALDriverManager& manager = *GetGDALDriverManager();
  std::vector<GDALDriver*> others;
  for (int i = 0; i < manager.GetDriverCount(); ++i) {
    GDALDriver* driver = manager.GetDriver(i);
    const std::string_view name = driver->GetDescription();
    if (std::find(names.begin(), names.end(), name) == names.end()) others.push_back(driver);
  }
  for (GDALDriver* driver : others) manager.DeregisterDriver(driver);
}

/// A file under /vsimem/ that goes away with this.
class GdalFile {
 public:
  GdalFile(std::string path, std::string_view bytes) : path_(std::move(path)) {
    VSILFILE* file = VSIFOpenL(path_.c_str(), "wb");
    VSIFWriteL(bytes.data(), 1, bytes.size(), file);
    VSIFCloseL(file);
  }
  ~GdalFile() { VSIUnlink(path_.c_str()); }
  GdalFile(const GdalFile&) = delete;
  GdalFile& operator=(const GdalFile&) = delete;

 private:
  std::string path_;
};

}  // namespace sturz::fuzz
