// SPDX-License-Identifier: Apache-2.0
#include "reports/page/cut_off_text.hpp"

#include "reports/texts/text_table.hpp"

namespace sturz {
namespace {

std::string percent(double share) {
  if (share > 0 && share < 0.01) return fmt::format("{:.2g} %", 100 * share);
  return fmt::format("{:.0f} %", 100 * share);
}

std::string of_each(const char* what, const CensoringReport::OfPhase& p) {
  const std::string name = tr(fmt::format("cut.{}", what));
  std::string text = tr("cut.left_in", name, p.left);
  if (p.left > 0) text += tr("cut.up_to_of", percent(p.largest_lost_fraction), name);
  return text;
}

std::string what_left(const CensoringReport& r) {
  if (!r.phases) return {};
  if (r.valid == 1)
    return tr("cut.of_both", percent(r.grains.largest_lost_fraction),
              percent(r.liquid.largest_lost_fraction));
  std::string text(": ");
  text.append(of_each("grains", r.grains)).append(", ").append(of_each("liquid", r.liquid));
  return text;
}

std::string where_left(const CensoringReport& r, bool one) {
  const std::string where = r.where.empty() ? "" : " " + r.where;
  const std::string share = percent(r.largest_lost_fraction);
  if (one) return tr("cut.left.one", where, share, what_left(r));
  return tr("cut.left.many", r.left(), where, share, what_left(r));
}

/// A material that nothing left of is known better than the flow.
std::string kept_whole(const CensoringReport& r) {
  const bool grains = r.grains.left == 0;
  const std::string kept = tr(grains ? "cut.grains" : "cut.liquid");
  const std::int64_t cut = grains ? r.grains.censored : r.liquid.censored;
  return cut == 0 ? tr("cut.kept", kept) : tr("cut.kept_moving", kept, cut);
}

}  // namespace

std::string cut_off_counts(const CensoringReport& r) {
  std::string text;
  const auto add = [&](std::int64_t n, const char* key) {
    if (n > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, tr(key));
  };
  add(r.settled, "cut.n_settled");
  add(r.still_moving, "cut.n_moving");
  add(r.left_terrain, "cut.n_left");
  add(r.left_and_moving, "cut.n_left_moving");
  return text.empty() ? tr("cut.n_none") : text;
}

std::vector<std::string> cut_off_sentences(const CensoringReport& r) {
  if (r.censored() == 0) return {};
  const bool one = r.valid == 1;
  std::vector<std::string> lines;
  lines.push_back(one ? tr("cut.head.one")
                      : tr("cut.head.many", r.censored(), r.valid, percent(r.fraction())));
  if (r.left() > 0) lines.push_back(where_left(r, one));
  if (r.moving() > 0) lines.push_back(one ? tr("cut.moved.one") : tr("cut.moved.many", r.moving()));
  if (r.phases && r.left() > 0 && (r.grains.left == 0 || r.liquid.left == 0))
    lines.push_back(kept_whole(r));
  lines.push_back(tr(one ? "cut.counts.one" : "cut.counts.many"));
  std::string cure;
  if (r.left() > 0) cure = tr("cut.cure_ground");
  if (r.moving() > 0) cure += (cure.empty() ? "" : tr("cut.cure_and")) + tr("cut.cure_time");
  lines.push_back(tr(one ? "cut.cure.one" : "cut.cure.many", cure));
  return lines;
}

std::string outcome_text(Outcome o) { return tr(fmt::format("outcome.{}", to_string(o))); }

std::string censoring_text(Censoring c) {
  return c == Censoring::none ? std::string() : tr(fmt::format("censoring.{}", to_string(c)));
}

}  // namespace sturz
