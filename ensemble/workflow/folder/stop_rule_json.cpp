// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/folder/stop_rule_json.hpp"

namespace sturz::workflow {

nlohmann::ordered_json stop_json(const StopRecord& stop) {
  nlohmann::ordered_json json{{"wanted_half_width", stop.wanted_half_width},
                              {"half_width", stop.last.found.half_width},
                              {"reached", stop.reached()},
                              {"looked_at", to_string(stop.last.found.at)},
                              {"cells", stop.last.found.n_cells},
                              {"members", stop.last.n_members},
                              {"valid", stop.last.found.n_valid},
                              {"looks", stop.n_looks},
                              {"at_most", stop.at_most}};
  if (stop.asset.empty()) return json;
  json["asset"] = stop.asset;
  json["not_known"] = stop.last.found.n_not_known;
  return json;
}

}  // namespace sturz::workflow
