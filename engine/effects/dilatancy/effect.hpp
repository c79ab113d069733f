// SPDX-License-Identifier: Apache-2.0
/// Dilatancy of grains in full stress: where they yield, a loose packing tightens and a dense one
/// loosens, div(v_plastic) = gamma tan psi, tan psi = k (alpha - alpha_eq) (Iverson & George 2014;
/// docs/physics.md B.5, F.7). In a liquid that is what makes and takes away pore pressure.
///
/// fields::packing_change is how much denser than the reference a grain's packing is without load;
/// fields::density_change is then what load adds to that. Brings the passes
///   force: forces by the packing's own density   stress: packing n -> n+1
#pragma once

#include "engine/effects/dilatancy/settings.hpp"
#include "engine/effects/step.hpp"

#include <memory>

namespace sturz {

struct GrainStress;

/// After add_grain_stress(), whose lists and velocity gradients it reads; before passes that read
/// accelerations.
void add_dilatancy(Step&, State&, const std::shared_ptr<GrainStress>&, const DilatancySettings&);

}  // namespace sturz
