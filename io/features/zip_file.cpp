// SPDX-License-Identifier: Apache-2.0
#include "io/features/zip_file.hpp"

#include "io/files/atomic_file.hpp"
#include "io/files/io_error.hpp"
#include "io/gdal/gdal_handles.hpp"

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <fmt/core.h>

#include <cstddef>
#include <memory>
#include <span>

namespace sturz {

void write_zip(const std::filesystem::path& file, const std::string& name,
               const std::string& text) {
  const GdalScope scope;
  const std::string memory = fmt::format("/vsimem/sturz_{}.zip", static_cast<const void*>(&text));
  const auto check = [&](bool good) {
    if (good) return;
    VSIUnlink(memory.c_str());
    throw IoError(fmt::format("{}: cannot be made ({}).", file.string(), gdal_reason()));
  };
  void* zip = CPLCreateZip(memory.c_str(), nullptr);
  check(zip != nullptr);
  const bool put = CPLCreateFileInZip(zip, name.c_str(), nullptr) == CE_None &&
                   CPLWriteFileInZip(zip, text.data(), static_cast<int>(text.size())) == CE_None &&
                   CPLCloseFileInZip(zip) == CE_None;
  check(CPLCloseZip(zip) == CE_None && put);
  vsi_l_offset size = 0;
  const std::unique_ptr<GByte, decltype(&VSIFree)> bytes(
      VSIGetMemFileBuffer(memory.c_str(), &size, true), &VSIFree);
  check(bytes != nullptr);
  write_bytes_atomic(file, std::as_bytes(std::span(bytes.get(), static_cast<std::size_t>(size))));
}

}  // namespace sturz
