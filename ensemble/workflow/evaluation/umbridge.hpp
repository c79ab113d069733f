// SPDX-License-Identifier: Apache-2.0
/// UM-Bridge, protocol 1.0: what a server says of a model that samplers evaluate over HTTP.
/// Requests and answers as text; who carries them is no matter here. See docs/decisions/0057.
///
///   GET  /Info         {"protocolVersion": 1.0, "models": ["sturz"]}
///   POST /ModelInfo    {"name"}                     {"support": {"Evaluate": true, ...}}
///   POST /InputSizes   {"name", "config"}           {"inputSizes": [n]}
///   POST /OutputSizes  {"name", "config"}           {"outputSizes": [m]}
///   POST /Evaluate     {"name", "input", "config"}  {"output": [[...]]}
///   anything wrong                                  {"error": {"type", "message"}}
#pragma once

#include "ensemble/workflow/evaluation/evaluator.hpp"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace sturz::workflow {

/// An answer with its HTTP status; the body is JSON.
struct UmbridgeReply {
  int status = 200;
  std::string body;
  bool evaluated = false;  ///< a member was computed and is in the body
};

/// The one model "sturz": an input vector of the uncertain keys in their order, an output vector of
/// scalars. `config` may choose others, {"outputs": ["runout_m", ...]}, and what becomes of numbers
/// that a member does not fully know because its end was not seen: {"censored": "error" | "value"}.
/// It may hold nothing else.
class Umbridge {
 public:
  static constexpr const char* model = "sturz";
  /// Names of the POST requests that the protocol knows.
  static constexpr std::array<const char*, 7> requests{"ModelInfo",   "InputSizes", "OutputSizes",
                                                       "Evaluate",    "Gradient",   "ApplyJacobian",
                                                       "ApplyHessian"};

  /// The protocol has no word for "at least": such a number is an error, or comes as it was seen.
  enum class Censored { error, value };

  /// \param censored where a question does not say it
  /// \throws SetupError for a scene without any uncertain value
  Umbridge(Evaluator&, std::vector<EvaluatorOutput> outputs, Censored censored = Censored::error);

  UmbridgeReply info() const;
  /// Beyond the protocol: what the vectors hold. {"model", "title", "inputs": [{"key", "units",
  /// "distribution", "median"}], "outputs": [{"name", "units", "meaning"}], "censored": "error" |
  /// "value", "config": {what `config` may hold: its meaning}}
  UmbridgeReply description() const;
  /// Never throws: whatever is wrong is an error reply. From any number of threads.
  /// \param request one of `requests`
  UmbridgeReply answer(std::string_view request, std::string_view body, const Cancelled&);
  /// For what the carrier refuses by itself.
  static UmbridgeReply error(int status, const std::string& type, const std::string& message);

 private:
  Evaluator& evaluator_;
  std::vector<EvaluatorOutput> outputs_;
  Censored censored_;
};

}  // namespace sturz::workflow
