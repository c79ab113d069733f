// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/evaluation/umbridge.hpp"

#include "engine/core/error.hpp"
#include "scenarios/schema/value_text.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <utility>

namespace sturz::workflow {
namespace {

using Json = nlohmann::ordered_json;

/// Names of files are bytes and JSON is UTF-8: what is not is replaced.
std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// An error of the protocol, on its way out of a handler.
struct Refused : std::exception {
  UmbridgeReply reply;
  explicit Refused(UmbridgeReply r) : reply(std::move(r)) {}
};

[[noreturn]] void refuse(int status, const std::string& type, const std::string& message) {
  throw Refused(Umbridge::error(status, type, message));
}

[[noreturn]] void invalid(const std::string& message) { refuse(400, "InvalidInput", message); }

Json parsed(std::string_view body) {
  try {
    Json json = Json::parse(body);
    if (!json.is_object()) invalid("the body must be a JSON object.");
    return json;
  } catch (const nlohmann::json::exception& problem) {
    invalid(fmt::format("the body is no JSON ({}).", problem.what()));
  }
}

void require_model(const Json& request) {
  const auto name = request.find("name");
  if (name == request.end() || !name->is_string())
    invalid("name is missing (must be a string). GET /Info lists the models.");
  if (const auto& wanted = name->get_ref<const std::string&>(); wanted != Umbridge::model)
    refuse(400, "ModelNotFound",
           fmt::format("{} is not served here; the only model is {}.", wanted, Umbridge::model));
}

/// What `config` may hold.
struct Config {
  std::vector<EvaluatorOutput> outputs;
  Umbridge::Censored censored;
};

/// In the order of Umbridge::Censored.
constexpr std::array<const char*, 2> censored_words{"error", "value"};

std::vector<EvaluatorOutput> outputs_in(const Json& list) {
  std::vector<std::string> names;
  if (list.is_array())
    for (const Json& name : list)
      if (name.is_string()) names.push_back(name.get<std::string>());
  if (names.empty() || names.size() != list.size())
    invalid("config.outputs must be a list of one or more names.");
  return outputs_named(names);
}

Umbridge::Censored censored_in(const Json& word) {
  if (word == censored_words[0]) return Umbridge::Censored::error;
  if (word == censored_words[1]) return Umbridge::Censored::value;
  invalid(fmt::format("config.censored is {} (must be \"error\" or \"value\").", text_of(word)));
}

/// What `config` asks for; the server's own where it does not.
Config config_of(const Json& request, Config own) {
  const auto config = request.find("config");
  if (config == request.end() || config->is_null()) return own;
  if (!config->is_object()) invalid("config must be a JSON object.");
  for (const auto& [key, value] : config->items()) {
    if (key == "outputs")
      own.outputs = outputs_in(value);
    else if (key == "censored")
      own.censored = censored_in(value);
    else
      invalid(
          fmt::format("config.{} is not known. There are outputs (names of scalars) and "
                      "censored (\"error\" or \"value\").",
                      key));
  }
  return own;
}

/// The one input vector. \return [n_keys]
std::vector<double> input_of(const Json& request, std::size_t n_keys) {
  const auto input = request.find("input");
  const std::string wanted = fmt::format("input must be a list of one list of {} numbers", n_keys);
  if (input == request.end() || !input->is_array()) invalid(wanted + ".");
  if (input->size() != 1) invalid(fmt::format("{} (it holds {} lists).", wanted, input->size()));
  const Json& vector = input->front();
  if (!vector.is_array()) invalid(wanted + ".");
  if (vector.size() != n_keys) invalid(fmt::format("{} (it holds {}).", wanted, vector.size()));
  std::vector<double> values;
  for (const Json& value : vector) {
    if (!value.is_number())
      invalid(fmt::format("{} (number {} is {}).", wanted, values.size(), value.type_name()));
    values.push_back(value.get<double>());
  }
  return values;
}

/// A bound that arrives as a plain number would be taken for the thing itself.
void refuse_if_not_known(const MemberResult& result, const EvaluatorOutput& output) {
  const Known known = output.known(result);
  if (known == Known::exactly) return;
  const bool left = has_left(result.censoring), moving = is_moving(result.censoring);
  refuse(500, "InvalidOutput",
         fmt::format("{} of this member is {}, because {}{}{} (censored: {}; seen: {}). A larger "
                     "raster or a later end time may show the rest; config {{\"censored\": "
                     "\"value\"}} gives numbers as far as they were seen, and the output \"{}\" "
                     "says of which members.",
                     output.name, known == Known::at_least ? "only a lower bound" : "not known",
                     left ? "mass left the known ground" : "", left && moving ? ", and " : "",
                     moving ? "mass still moved at its end" : "", to_string(result.censoring),
                     output.value(result), censored_output));
}

/// JSON has no NaN, and a number in its place would be a lie.
Json output_of(const MemberResult& result, const Config& wanted) {
  if (result.outcome == Outcome::cancelled)
    refuse(503, "InvalidOutput",
           "the member was not finished: the server stops, or its client hung up.");
  if (!is_valid(result.outcome))
    refuse(500, "InvalidOutput",
           fmt::format("the member {}: {}", to_string(result.outcome), result.reason));
  Json vector = Json::array();
  for (const EvaluatorOutput& output : wanted.outputs) {
    if (wanted.censored == Umbridge::Censored::error) refuse_if_not_known(result, output);
    const double value = output.value(result);
    if (!std::isfinite(value))
      refuse(500, "InvalidOutput",
             fmt::format("this member has no {} ({}). Leave it out of config.outputs.", output.name,
                         output.meaning));
    vector.push_back(value);
  }
  return Json{{"output", Json::array({vector})}};
}

/// What `config` may hold, for people who read /Description.
Json config_meanings() {
  return Json{
      {"outputs", "names of scalars, or \"censored\": 1 for members whose end was not seen"},
      {"censored",
       "\"error\": a number that is only a bound, or not known, because mass left the "
       "known ground or still moved at the end time, is an error; \"value\": it comes as "
       "far as it was seen"}};
}

}  // namespace

Umbridge::Umbridge(Evaluator& evaluator, std::vector<EvaluatorOutput> outputs, Censored censored)
    : evaluator_(evaluator), outputs_(std::move(outputs)), censored_(censored) {
  require(!evaluator_.keys().empty(),
          "the scene has no uncertain value, so there is nothing to evaluate it at. Give a "
          "distribution for some number, such as basal.friction_coefficient: "
          "{uniform: [0.1, 0.3]}.");
}

UmbridgeReply Umbridge::error(int status, const std::string& type, const std::string& message) {
  return {status, text_of(Json{{"error", {{"type", type}, {"message", message}}}})};
}

UmbridgeReply Umbridge::info() const {
  return {200, text_of(Json{{"protocolVersion", 1.0}, {"models", Json::array({model})}})};
}

UmbridgeReply Umbridge::description() const {
  Json inputs = Json::array(), outputs = Json::array();
  const std::vector<double> medians = evaluator_.medians();
  for (std::size_t k = 0; k < medians.size(); ++k) {
    const UncertainKey& key = evaluator_.keys()[k];
    inputs.push_back({{"key", key.path},
                      {"units", key.units},
                      {"distribution", distribution_text(key.distribution)},
                      {"median", medians[k]}});
  }
  for (const EvaluatorOutput& output : outputs_)
    outputs.push_back(
        {{"name", output.name}, {"units", output.units}, {"meaning", output.meaning}});
  return {200, text_of(Json{{"model", model},
                            {"title", evaluator_.scene().scenario.title},
                            {"inputs", inputs},
                            {"outputs", outputs},
                            {"censored", censored_words[static_cast<std::size_t>(censored_)]},
                            {"config", config_meanings()}})};
}

UmbridgeReply Umbridge::answer(std::string_view request, std::string_view body,
                               const Cancelled& cancelled) {
  try {
    const Json asked = parsed(body);
    require_model(asked);
    if (request == "ModelInfo")
      return {200, text_of(Json{{"support",
                                 {{"Evaluate", true},
                                  {"Gradient", false},
                                  {"ApplyJacobian", false},
                                  {"ApplyHessian", false}}}})};
    if (request == "InputSizes")
      return {200, text_of(Json{{"inputSizes", Json::array({evaluator_.keys().size()})}})};
    if (request != "OutputSizes" && request != "Evaluate")
      refuse(400, "UnsupportedFeature",
             fmt::format("{} is not supported: members have no derivatives.", request));
    const Config wanted = config_of(asked, {outputs_, censored_});
    if (request == "OutputSizes")
      return {200, text_of(Json{{"outputSizes", Json::array({wanted.outputs.size()})}})};
    const std::vector<double> values = input_of(asked, evaluator_.keys().size());
    return {200, text_of(output_of(evaluator_.evaluate(values, cancelled), wanted)), true};
  } catch (const Refused& refused) {
    return refused.reply;
  } catch (const SetupError& problem) {
    return error(400, "InvalidInput", problem.what());
  } catch (const std::exception& problem) {
    return error(500, "InvalidOutput", problem.what());
  }
}

}  // namespace sturz::workflow
