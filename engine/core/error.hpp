// SPDX-License-Identifier: Apache-2.0
/// Errors: what the user can mend (SetupError) and what only a programmer can (expect).
#pragma once

#include <stdexcept>
#include <string>

namespace sturz {

/// Something in the user's data is wrong; thrown before any step is computed.
/// The text reads: problem (why it is one). Suggestion.
class SetupError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws SetupError with `message` unless `condition` holds. For user data, always on.
inline void require(bool condition, const std::string& message) {
  if (!condition) throw SetupError(message);
}

/// Checks a programmer's promise; throws std::logic_error naming the place. Not for hot loops.
/// The builtins stand for std::source_location, which clang 14 does not have.
inline void expect(bool condition, const char* promise, const char* file = __builtin_FILE(),
                   int line = __builtin_LINE()) {
  if (!condition)
    throw std::logic_error(std::string(file) + ":" + std::to_string(line) +
                           ": broken promise: " + promise);
}

}  // namespace sturz
