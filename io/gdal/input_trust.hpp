// SPDX-License-Identifier: Apache-2.0
/// What a scenario may make the program read. A scenario is a text that people pass on: it may name
/// files, but by default it may neither reach over the network nor have an arbitrary file read as
/// numbers.
#pragma once

#include "io/gdal/input_files.hpp"

#include <string>

namespace sturz {

/// Opens the network and raw virtual rasters to every input of this process. Before the first file
/// is read; only on the word of the user at the command line.
void allow_remote_inputs();

/// Refuses names that lead over the network, and virtual files (VRT, however nested) that name such
/// a source or take the raw bytes of another file as values. Does nothing when they are allowed.
/// \throws SetupError naming key, file and source
void require_trusted(const InputFile& file);

/// Takes the network away from the library, whatever a file inside a file asks for: drivers of
/// servers and databases, file systems over the network, and plain requests. Does nothing when
/// remote inputs are allowed. Called once, when the drivers are registered.
void close_network();

}  // namespace sturz
