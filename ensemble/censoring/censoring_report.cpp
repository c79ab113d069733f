// SPDX-License-Identifier: Apache-2.0
#include "ensemble/censoring/censoring_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

namespace sturz {
namespace {

std::string percent(double share) {
  if (share > 0 && share < 0.01) return fmt::format("{:.2g} %", 100 * share);
  return fmt::format("{:.0f} %", 100 * share);
}

std::string of_all(std::int64_t n, const CensoringReport& r) {
  return fmt::format("{} of {}", n, r.valid);
}

/// A sentence without its numbers.
std::string shape_of(std::string text) {
  std::erase_if(text, [](unsigned char c) { return std::isdigit(c) || c == '.' || c == '-'; });
  return text;
}

/// A sentence around its first number.
struct AroundNumber {
  std::string before, number, after;
};
AroundNumber around_number(const std::string& text) {
  const auto digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  auto begin = std::find_if(text.begin(), text.end(), digit);
  const auto end =
      std::find_if(begin, text.end(), [&](unsigned char c) { return !digit(c) && c != '.'; });
  if (begin != text.begin() && begin != end && *(begin - 1) == '-') --begin;
  return {{text.begin(), begin}, {begin, end}, {end, text.end()}};
}

/// The smaller and the larger first number of sentences of one shape, as they were written.
struct NumberRange {
  AroundNumber least, most;

  void add(const AroundNumber& one) {
    if (value(one) < value(least)) least = one;
    if (value(one) > value(most)) most = one;
  }
  /// One sentence for all: "for 2.3 to 7.5 % of mass and time".
  std::string text() const {
    return least.before + least.number + (least.number == most.number ? "" : " to " + most.number) +
           most.after;
  }

 private:
  static double value(const AroundNumber& a) { return std::strtod(a.number.c_str(), nullptr); }
};

void add_phase(CensoringReport::OfPhase& to, Phase phase, double lost, const MemberSummary& m) {
  const Censoring own = censoring_of(phase, m.scalars, m.censoring);
  to.left += has_left(own);
  to.censored += is_censored(own);
  to.largest_lost_fraction = std::max(to.largest_lost_fraction, lost);
}

/// ": 3 % of its grains, 21 % of its liquid", or in how many members each left.
std::string what_left(const CensoringReport& r) {
  if (!r.phases) return {};
  if (r.valid == 1)
    return fmt::format(" ({} of the grains, {} of the liquid)",
                       percent(r.grains.largest_lost_fraction),
                       percent(r.liquid.largest_lost_fraction));
  const auto of = [](const char* what, const CensoringReport::OfPhase& p) {
    return fmt::format("{} in {}{}", what, p.left,
                       p.left > 0 ? fmt::format(" (up to {} of a simulation's {})",
                                                percent(p.largest_lost_fraction), what)
                                  : std::string());
  };
  return fmt::format(": {}, {}", of("grains", r.grains), of("liquid", r.liquid));
}

}  // namespace

CensoringReport censoring_report(std::span<const MemberSummary> members, double accepted_fraction) {
  CensoringReport r;
  r.accepted_fraction = accepted_fraction;
  for (const MemberSummary& m : members) {
    if (!is_valid(m.outcome)) continue;
    ++r.valid;
    r.settled += m.censoring == Censoring::none;
    r.still_moving += m.censoring == Censoring::still_moving;
    r.left_terrain += m.censoring == Censoring::left_terrain;
    r.left_and_moving += m.censoring == Censoring::left_and_moving;
    if (has_left(m.censoring))
      r.largest_lost_fraction = std::max(r.largest_lost_fraction, m.scalars.lost_fraction);
    if (std::isnan(m.scalars.solid_lost_fraction)) continue;
    r.phases = true;
    add_phase(r.grains, Phase::grains, m.scalars.solid_lost_fraction, m);
    add_phase(r.liquid, Phase::liquid, m.scalars.liquid_lost_fraction, m);
  }
  return r;
}

std::string counts_text(const CensoringReport& r) {
  std::string text;
  const auto add = [&](std::int64_t n, const char* what) {
    if (n > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, what);
  };
  add(r.settled, "settled");
  add(r.still_moving, "out of time");
  add(r.left_terrain, "left the terrain");
  add(r.left_and_moving, "left the terrain and still moved");
  return text.empty() ? "none" : text;
}

std::string one_line(const CensoringReport& r) {
  const std::string left =
      r.phases && r.left() > 0
          ? fmt::format("; grains left in {}, liquid in {}", r.grains.left, r.liquid.left)
          : "";
  return fmt::format("{} of {} valid members ({}{})", r.censored(), r.valid, counts_text(r), left);
}

std::vector<std::string> censoring_sentences(const CensoringReport& r) {
  if (r.censored() == 0) return {};
  const bool one = r.valid == 1;
  std::vector<std::string> lines;
  lines.push_back(one ? std::string("This result is cut off.")
                      : fmt::format("{} simulations ({}) are cut off.", of_all(r.censored(), r),
                                    percent(r.fraction())));
  if (r.left() > 0)
    lines.push_back(fmt::format(
        "{}ass ran off the known terrain{}{}{}.",
        one ? std::string("M") : fmt::format("In {} of them m", r.left()),
        r.where.empty() ? "" : " " + r.where,
        one ? fmt::format(": {} of it", percent(r.largest_lost_fraction))
            : fmt::format(", up to {} of a simulation's mass", percent(r.largest_lost_fraction)),
        what_left(r)));
  if (r.moving() > 0)
    lines.push_back(
        one ? "Mass still moved at the end time."
            : fmt::format("In {} of them mass still moved at the end time.", r.moving()));
  lines.emplace_back(
      one ? "What it reached counts, as a lower bound: it may have gone farther, faster and "
            "thicker. "
            "Where all of it would lie at rest is not known."
          : "What they reached counts, as a lower bound: they may have gone farther, faster and "
            "thicker. Where all of it would lie at rest is not known.");
  if (r.phases && r.left() > 0 && (r.grains.left == 0 || r.liquid.left == 0)) {
    const char* kept = r.grains.left == 0 ? "grains" : "liquid";
    const std::int64_t cut = r.grains.left == 0 ? r.grains.censored : r.liquid.censored;
    lines.insert(lines.end() - 1,
                 cut == 0 ? fmt::format("No {0} left: what is said of {0} alone is whole.", kept)
                          : fmt::format("No {0} left: what is said of {0} alone is cut off only "
                                        "where the flow still moved ({1}).",
                                        kept, cut));
  }
  std::string cure;
  if (r.left() > 0)
    cure = "take terrain that is known there, too (a larger terrain.raster, or holes filled)";
  if (r.moving() > 0)
    cure += std::string(cure.empty() ? "" : ", and ") + "a longer numerics.end_time_s";
  lines.push_back(fmt::format("To see the whole {}: {}.", one ? "runout" : "spread", cure));
  return lines;
}

std::vector<MemberWarning> member_warnings(std::span<const MemberSummary> members,
                                           std::span<const std::string> known) {
  std::set<std::string> left_out;
  for (const std::string& text : known) left_out.insert(shape_of(text));
  std::map<std::string, std::size_t> place;
  std::vector<MemberWarning> found;
  std::vector<NumberRange> ranges;
  for (const MemberSummary& m : members) {
    std::size_t start = 0;
    while (start < m.warnings.size()) {
      const std::size_t end = std::min(m.warnings.find("; ", start), m.warnings.size());
      const std::string text = m.warnings.substr(start, end - start), shape = shape_of(text);
      start = end + 2;
      if (left_out.contains(shape)) continue;
      const auto [it, is_new] = place.try_emplace(shape, found.size());
      const AroundNumber around = around_number(text);
      if (is_new) found.emplace_back(), ranges.push_back({around, around});
      ++found[it->second].count;
      ranges[it->second].add(around);
    }
  }
  for (std::size_t i = 0; i < found.size(); ++i) found[i].text = ranges[i].text();
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.count > b.count; });
  return found;
}

}  // namespace sturz
