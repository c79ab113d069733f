// SPDX-License-Identifier: Apache-2.0
/// The sub-commands: a file for each, with its options and what it does, and two lines here.
#pragma once

namespace sturz::app {

struct Grammar;

void add_init(Grammar&);
void add_run(Grammar&);
void add_ensemble(Grammar&);
void add_batch(Grammar&);
void add_calibrate(Grammar&);
void add_sensitivity(Grammar&);
void add_merge(Grammar&);
void add_sources(Grammar&);
void add_plan(Grammar&);
void add_submit(Grammar&);
void add_status(Grammar&);
void add_members(Grammar&);
void add_risk(Grammar&);
void add_compare(Grammar&);
void add_cost(Grammar&);
void add_describe(Grammar&);
void add_serve(Grammar&);
void add_terrain(Grammar&);
void add_schema(Grammar&);
void add_report(Grammar&);
void add_cases(Grammar&);
void add_print_help(Grammar&);

/// In the order in which help, manual page and completion name them.
inline constexpr void (*sub_commands[])(Grammar&) = {
    add_init,   add_run,     add_ensemble, add_batch,      add_calibrate, add_sensitivity,
    add_merge,  add_members, add_plan,     add_submit,     add_status,    add_sources,
    add_risk,   add_compare, add_cost,     add_describe,   add_serve,     add_terrain,
    add_schema, add_report,  add_cases,    add_print_help,
};

}  // namespace sturz::app
