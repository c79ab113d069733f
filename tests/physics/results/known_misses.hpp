// SPDX-License-Identifier: Apache-2.0
/// What is known to miss its bound: said by name in known_misses.csv beside this file, so that a
/// bound need not be widened for it and no flag has to switch it off.
#pragma once

#include <string>
#include <vector>

namespace sturz::test {

/// One line of the list. Its figures come from a run; `scripts/misses.py --write` takes them over.
struct KnownMiss {
  std::string name;      ///< of the line of the results: its key
  std::string quantity;  ///< what is measured, with its unit
  double measured = 0;
  double error = 0;  ///< in the sense and unit of the tolerance
  double asked = 0;  ///< the tolerance
  std::string since, why;
};

/// The list on disk, read once. Throws std::runtime_error where it cannot be read.
const std::vector<KnownMiss>& known_misses();

/// The list from its text: "name",quantity,measured,error,asked,since,why with a head line; every
/// text in quotes, no quotes within. Throws std::runtime_error with the line's number.
std::vector<KnownMiss> read_misses(const std::string& text);

bool listed(const std::vector<KnownMiss>&, const std::string& name);

/// A listed miss may get half as large again before it fails: compilers differ, physics should not.
inline constexpr double worse_by = 1.5;

/// What a test has to say against a figure; empty where nothing.
///   unlisted and within      nothing
///   unlisted and beyond      a miss
///   listed and beyond        nothing, unless it is worse_by times the listed error or more
///   listed and within        no longer missed: it has to come off the list
/// NaN is never within, and never excused.
std::string objection(const std::vector<KnownMiss>&, const std::string& name, double error,
                      double tolerance);

}  // namespace sturz::test
