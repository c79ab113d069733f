// SPDX-License-Identifier: Apache-2.0
#include "ensemble/scores/member_view.hpp"

#include <string_view>

namespace sturz {
namespace {

bool in_columns(std::string_view formulation) { return formulation == "depth_averaged"; }

}  // namespace

MemberView view_of(const MemberResult& r) {
  MemberView view{r.scalars, r.censoring, in_columns(r.formulation), r.window, {}};
  for (std::size_t k = 0; k < view.layers.size(); ++k) view.layers[k] = r.layers[k];
  return view;
}

MemberView view_of(const MemberSummary& m) {
  return {m.scalars, m.censoring, in_columns(m.formulation), m.window, {}};
}

}  // namespace sturz
