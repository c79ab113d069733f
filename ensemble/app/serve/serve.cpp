// SPDX-License-Identifier: Apache-2.0
// sturz serve: members on demand for programs that sample by themselves.
#include "engine/core/error.hpp"
#include "ensemble/app/commands.hpp"
#include "ensemble/app/console/interrupt.hpp"
#include "ensemble/app/console/json_text.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/grammar.hpp"
#include "ensemble/app/serve/http_door.hpp"
#include "ensemble/app/speed_cache.hpp"
#include "ensemble/workflow/evaluation/evaluator.hpp"
#include "ensemble/workflow/evaluation/umbridge.hpp"
#include "ensemble/workflow/machine/cores.hpp"
#include "scenarios/schema/value_text.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <mutex>

namespace sturz::app {
namespace {

struct Options {
  std::string scenario;
  std::vector<std::string> set;  ///< "key=value"
  bool umbridge = false;
  std::string address = "127.0.0.1";
  int port = 4242;              ///< 0: any free one
  bool remote_clients = false;  ///< an address that other machines reach
  int workers = 0, threads = 0;
  std::vector<std::string> outputs;  ///< empty: the usual ones
  std::string censored = "error";    ///< or "value"
};

void check(const Options& o) {
  require(o.umbridge, "serve needs to know the protocol (only UM-Bridge so far). Add --umbridge.");
  require(is_loopback(o.address) || o.remote_clients,
          fmt::format("--address {} (other machines reach it and can have this one compute; there "
                      "is no password). Leave it out for this machine alone, or add "
                      "--allow-remote-clients inside a network that you trust.",
                      o.address));
}

/// What becomes of numbers of members whose end was not seen.
std::string options_of_censored(const Options& o) {
  if (o.censored == "error")
    return "Members whose mass leaves the raster or still moves at the end: numbers that are only "
           "bounds are errors (config {\"censored\": \"value\"} or --censored value: as seen).";
  return "Members whose mass leaves the raster or still moves at the end: numbers come as far as "
         "they were seen; the output \"censored\" is 1 then.";
}

/// What is served where, for people and for programs that wait for it.
void announce(const Options& o, int port, const workflow::Evaluator& evaluator,
              const workflow::Umbridge& model, Console& console) {
  for (const std::string& warning : evaluator.scene().description.warnings) console.warn(warning);
  const int cores = workflow::available_cores();
  if (o.workers > cores)
    console.warn(fmt::format("--workers {} on {} cores: members will wait for each other.",
                             o.workers, cores));
  if (o.workers > evaluator.workers())
    console.warn(fmt::format("{} members at a time instead of {}: more do not fit into memory.",
                             evaluator.workers(), o.workers));
  const std::string host =
      o.address.find(':') == std::string::npos ? o.address : "[" + o.address + "]";
  const std::string url = fmt::format("http://{}:{}", host, port);
  nlohmann::ordered_json event{{"event", "serving"},
                               {"url", url},
                               {"port", port},
                               {"workers", evaluator.workers()},
                               {"threads_per_member", evaluator.threads()}};
  event.update(nlohmann::ordered_json::parse(model.description().body));
  console.event(json_text(event));
  console.say(fmt::format("UM-Bridge 1.0 at {}, model \"{}\", {} at a time", url, model.model,
                          evaluator.workers()));
  console.say("inputs, one vector:");
  for (const UncertainKey& key : evaluator.keys())
    console.say(
        fmt::format("  {} [{}]: {}", key.path, key.units, distribution_text(key.distribution)));
  console.say("outputs, one vector:");
  for (const auto& output : event["outputs"])
    console.say(fmt::format("  {} [{}]: {}", output["name"].get<std::string>(),
                            output["units"].get<std::string>(),
                            output["meaning"].get<std::string>()));
  console.say(options_of_censored(o));
  console.say("Ctrl-C stops it.");
}

int serve(const Options& options, Console& console) {
  check(options);
  workflow::EvaluatorRequest request;
  request.scene = {options.scenario, options.set, speed_cache()};
  request.workers = options.workers;
  request.threads = options.threads;
  const auto outputs = options.outputs.empty() ? workflow::usual_outputs()
                                               : workflow::outputs_named(options.outputs);
  workflow::Evaluator evaluator(request);
  workflow::Umbridge model(evaluator, outputs,
                           options.censored == "value" ? workflow::Umbridge::Censored::value
                                                       : workflow::Umbridge::Censored::error);
  std::mutex lock;  // of console and counts
  std::int64_t answered = 0, refused = 0;
  const auto hear = [&](std::string_view name, const workflow::UmbridgeReply& reply) {
    const std::lock_guard held(lock);
    if (reply.evaluated) ++answered;
    if (reply.status == 200) return;
    ++refused;
    console.warn(fmt::format("{} answered with {}: {}", name, reply.status, reply.body));
  };
  HttpDoor door(model, hear, interrupt_flag());
  const int port = door.bind(options.address, options.port);
  announce(options, port, evaluator, model, console);
  door.serve();
  require(interrupt_flag().load(), "the server stopped by itself (its socket was closed).");
  const std::lock_guard held(lock);
  console.event(json_text(
      nlohmann::ordered_json{{"event", "done"}, {"evaluations", answered}, {"refused", refused}}));
  console.say(
      fmt::format("Stopped. Members computed: {}, requests refused: {}.", answered, refused));
  interruption_told();  // to be stopped is how a server ends
  return ok;
}

}  // namespace

void add_serve(Grammar& grammar) {
  auto [parser, options] =
      add_command(grammar, "serve",
                  "Compute members on demand for samplers of other programs (UM-Bridge)", serve);
  add_scenario(parser, options.scenario, options.set);
  parser.add_flag("--umbridge", options.umbridge, "Speak UM-Bridge, protocol 1.0, over HTTP");
  parser.add_option("--port", options.port, "Port, 0 for any free one")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  parser.add_option("--address", options.address, "Address to listen on")
      ->type_name("ADDRESS")
      ->capture_default_str();
  parser.add_flag("--allow-remote-clients", options.remote_clients,
                  "Let other machines ask, by an --address that they reach; there is no password");
  parser.add_option("--workers", options.workers, "Members at a time (default: all cores)")
      ->check(CLI::Range(1, 4096));
  parser
      .add_option("--threads", options.threads,
                  "Threads of each (default: what is left of the cores)")
      ->check(CLI::Range(1, 1024));
  parser
      .add_option("--outputs", options.outputs,
                  "Scalars of members.csv, with commas between (default: the usual ones)")
      ->delimiter(',')
      ->type_name("NAMES");
  parser
      .add_option(
          "--censored", options.censored,
          "Numbers that are only bounds, because mass left the raster or still moved at the "
          "end: an error, or the value as far as it was seen")
      ->check(CLI::IsMember({"error", "value"}))
      ->capture_default_str();
  add_json(grammar, parser);
}

}  // namespace sturz::app
