// SPDX-License-Identifier: Apache-2.0
// What may be hit.
#include "io/site/assets/asset_files.hpp"
#include "io/site/hazard_grid.hpp"
#include "io/site/loading/loading.hpp"

namespace sturz {

void load_assets(Loading& loading, const ReadGround& ground) {
  if (!loading.scenario.assets) return;
  loading.attempt([&] {
    const Grid& terrain = loading.grid();
    const Grid maps = terrain.n_cols > 0 ? hazard_grid(loading.scenario, terrain) : Grid{};
    AssetsRead read = read_assets(loading.scenario, maps, terrain, ground);
    loading.take_words(read);
    for (InputIdentity& identity : read.identities) loading.take_identity(identity);
    loading.inputs.assets = std::make_shared<const Assets>(std::move(read.assets));
  });
}

}  // namespace sturz
