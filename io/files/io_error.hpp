// SPDX-License-Identifier: Apache-2.0
/// A file that could not be written or read back: disk full, no permission, damaged.
#pragma once

#include "engine/core/error.hpp"

namespace sturz {

/// Like every SetupError it is the user's to mend; files that were already there are unharmed.
class IoError : public SetupError {
 public:
  using SetupError::SetupError;
};

}  // namespace sturz
