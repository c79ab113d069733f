// SPDX-License-Identifier: Apache-2.0
// What the page draws besides results.
#include "io/site/loading/loading.hpp"
#include "io/site/overlays/orthophoto.hpp"
#include "io/site/overlays/overlay_layers.hpp"

namespace sturz {

void load_overlays(Loading& loading) {
  loading.attempt([&] { check_orthophoto(loading.scenario); });
  if (loading.scenario.report.overlays.empty()) return;
  loading.attempt([&] {
    OverlaysRead read = read_overlays(loading.scenario, loading.grid());
    loading.take_words(read);
    loading.inputs.overlays = std::move(read.overlays);
  });
}

}  // namespace sturz
