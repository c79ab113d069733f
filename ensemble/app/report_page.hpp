// SPDX-License-Identifier: Apache-2.0
/// Collects what the page of a results folder needs, and writes it.
#pragma once

#include "engine/simulation/member_result.hpp"
#include "ensemble/app/output_folder.hpp"
#include "ensemble/hazard/convergence.hpp"
#include "ensemble/sampling/design.hpp"
#include "scenarios/layers/layer_stack.hpp"

#include <span>

namespace sturz::app {

/// What there is to show; absent parts are null or empty.
struct PageContent {
  const LayerStack* hazard = nullptr;
  const LayerStack* peaks = nullptr;
  const DesignTable* design = nullptr;
  const Raster<double>* elevation = nullptr;
  std::span<const MemberSummary> members;
  std::span<const ConvergencePoint> convergence;
  const MemberResult* run = nullptr;  ///< of a single run: its history and where its time went
};

/// Writes report.html. \throws IoError
void write_page(const OutputFolder&, const Manifest&, const Scenario&, const PageContent&);

}  // namespace sturz::app
