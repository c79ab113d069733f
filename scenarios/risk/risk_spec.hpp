// SPDX-License-Identifier: Apache-2.0
/// Several release scenarios and how often each comes: plain data of a risk file.
#pragma once

#include <string>
#include <vector>

namespace sturz {

/// A finished ensemble as one scenario of a site.
struct RiskScenario {
  std::string folder;             ///< as written; relative to the risk file
  double frequency_per_year = 0;  ///< how often an event of this kind comes
};

struct RiskSpec {
  std::vector<RiskScenario> scenarios;
  std::vector<double> return_periods_years{30, 100, 300};  ///< rising
  /// Strong intensity of a debris flow needs more than both at its peak, what is reached otherwise
  /// is of medium intensity, and there is no weak one: Loat & Petrascheck (1997),
  /// "Beruecksichtigung der Hochwassergefahren bei raumwirksamen Taetigkeiten", BWW, BRP and BUWAL,
  /// Biel.
  double strong_thickness_m = 1, strong_speed_m_s = 1;
  /// Up to which return period a probability is high, medium, low (the same guideline).
  std::vector<double> probability_classes_years{30, 100, 300};
};

}  // namespace sturz
