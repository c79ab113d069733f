// SPDX-License-Identifier: Apache-2.0
#include "io/netcdf/history_netcdf.hpp"

namespace sturz {
namespace {

constexpr const char* time_axis = "time";

bool any(const NetcdfReader& file, HistoryPart part) {
  for (const HistoryColumn& column : history_table())
    if (column.part == part && file.has(column.name)) return true;
  return false;
}

}  // namespace

void write_history(NetcdfWriter& file, const MemberHistory& history) {
  if (history.rows.empty()) return;
  const int time = file.dimension(time_axis, history.rows.size());
  std::vector<float> values(history.rows.size());
  for (const HistoryColumn& column : history_table()) {
    if (!history.has(column.part)) continue;
    const int variable = file.variable(column.name, NcType::float32, {time});
    file.text(variable, "long_name", column.long_name);
    file.text(variable, "units", column.units);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = history.rows[i].*column.field;
    file.put(variable, values);
  }
}

MemberHistory read_history(const NetcdfReader& file) {
  MemberHistory history;
  file.require_room(static_cast<double>(file.length(time_axis)), time_axis);
  history.rows.resize(file.length(time_axis));
  if (history.rows.empty()) return history;
  history.has_states = any(file, HistoryPart::states);
  history.has_temperature = any(file, HistoryPart::temperature);
  history.has_mixture = any(file, HistoryPart::mixture);
  std::vector<float> values(history.rows.size());
  for (const HistoryColumn& column : history_table()) {
    if (!history.has(column.part)) continue;
    file.floats(column.name, {0}, {values.size()}, values);
    for (std::size_t i = 0; i < values.size(); ++i) history.rows[i].*column.field = values[i];
  }
  return history;
}

}  // namespace sturz
