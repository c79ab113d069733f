// SPDX-License-Identifier: Apache-2.0
// Any bytes as manifest.json: a manifest or SetupError.
#include "engine/core/error.hpp"
#include "ensemble/workflow/folder/manifest.hpp"
#include "tests/fuzz/memory_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const sturz::fuzz::MemoryFile file(data, size);
  try {
    sturz::workflow::Manifest::read(file.path()).lines();
  } catch (const sturz::SetupError&) {
  }
  return 0;
}
