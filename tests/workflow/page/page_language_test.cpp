// SPDX-License-Identifier: Apache-2.0
// A page that is written again speaks the language that it is asked for.
#include "engine/core/error.hpp"
#include "ensemble/workflow/results/report_page.hpp"
#include "tests/workflow/workflow_fixture.hpp"

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Text of the SetupError that `call` throws.
template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const SetupError& problem) {
    return problem.what();
  }
  return "not refused";
}

class PageLanguage : public Workflow {};

TEST_F(PageLanguage, IsEnglishUnlessAskedOtherwise) {
  Recorder heard;
  whole(request("out"), heard);
  EXPECT_THAT(read("out/report.html"), HasSubstr("<html lang=\"en\">"));
  workflow::rewrite_page(path("out"), heard, {}, "de");
  EXPECT_THAT(read("out/report.html"),
              AllOf(HasSubstr("<html lang=\"de\">"), HasSubstr("Wahrscheinlichkeit, dass")));
  EXPECT_THAT(refusal([&] { workflow::rewrite_page(path("out"), heard, {}, "xx"); }),
              AllOf(HasSubstr("--language: xx"), HasSubstr("de")));
}

}  // namespace
}  // namespace sturz::test
