// SPDX-License-Identifier: Apache-2.0
/// What a pack keeps of a member besides its maps, as bytes: facts are what MemberSummary holds and
/// where the member comes from; series are what it did over time, and where its computing time
/// went.
#pragma once

#include "engine/simulation/member_result.hpp"
#include "io/members/member_origin.hpp"
#include "io/members/packs/byte_stream.hpp"

#include <span>

namespace sturz {

struct RecordFacts {
  MemberSummary summary;
  MemberOrigin origin;
  Grid grid;
};

/// Without maps the window is empty, as in a member's own file.
void write_facts(ByteWriter&, const MemberResult&, const MemberOrigin&);
/// \throws BadRecord, also for what another version of the program wrote, and where the window
/// reaches beyond the grid
RecordFacts read_facts(std::span<const std::byte>);

void write_series(ByteWriter&, const MemberResult&);
/// Fills history, gauges and the seconds of passes. \throws BadRecord
void read_series(std::span<const std::byte>, MemberResult&);

/// Whether a result has maps to keep.
bool has_maps(const MemberResult&);

}  // namespace sturz
