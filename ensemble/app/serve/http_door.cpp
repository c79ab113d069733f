// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/serve/http_door.hpp"

#include "engine/core/error.hpp"
#include "ensemble/app/serve/connection.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <httplib.h>

#include <chrono>
#include <exception>
#include <thread>
#include <utility>

namespace sturz::app {
namespace {

using httplib::Request;
using httplib::Response;
using workflow::Umbridge;
using workflow::UmbridgeReply;
using Decision = httplib::Server::HandlerResponse;

constexpr const char* json_type = "application/json";
/// Connections at a time; those beyond wait. Each holds a thread while its member waits for a turn.
constexpr std::size_t most_connections = 64;

void put(const UmbridgeReply& reply, Response& response) {
  response.status = reply.status;
  response.set_content(reply.body, json_type);
}

/// What is refused before a body is read: bodies of unknown or unpacked size, and what the pages of
/// a browser send, which may reach this machine without its user's knowledge.
Decision look_at(const Request& request, Response& response) {
  const auto refuse = [&response](int status, const std::string& message) {
    put(Umbridge::error(status, "InvalidInput", message), response);
    return Decision::Handled;
  };
  if (request.has_header("Origin"))
    return refuse(403, "requests of web pages (header Origin) are not answered.");
  if (request.method != "POST") return Decision::Unhandled;
  if (request.has_header("Transfer-Encoding") || !request.has_header("Content-Length"))
    return refuse(411, "the body's length must be given (header Content-Length).");
  if (request.has_header("Content-Encoding"))
    return refuse(415, "packed bodies (header Content-Encoding) are not read. Send plain JSON.");
  return Decision::Unhandled;
}

/// What the library refuses by itself, in the protocol's words.
void explain(const Request& request, Response& response) {
  if (!response.body.empty()) return;
  std::string message = fmt::format("HTTP status {}.", response.status);
  if (response.status == 413)
    message = fmt::format("the body is too large (at most {} bytes).", HttpDoor::largest_body);
  if (response.status == 404)
    message = fmt::format(
        "{} {} is not known here. UM-Bridge 1.0 knows GET /Info and POST /ModelInfo, /InputSizes, "
        "/OutputSizes, /Evaluate; GET /Description names inputs and outputs.",
        request.method, request.path);
  put(Umbridge::error(response.status,
                      response.status == 404 ? "UnsupportedFeature" : "InvalidInput", message),
      response);
}

void explain_exception(const std::exception_ptr& thrown, Response& response) {
  std::string message = "an unknown error.";
  try {
    std::rethrow_exception(thrown);
  } catch (const std::exception& problem) {
    message = problem.what();
  } catch (...) {
  }
  put(Umbridge::error(500, "InvalidOutput", message), response);
}

}  // namespace

bool is_loopback(const std::string& address) {
  // A name may begin with 127. and stand for any machine: only a number counts.
  in_addr four{};
  const bool is_number = inet_pton(AF_INET, address.c_str(), &four) == 1;
  return address == "localhost" || address == "::1" || (is_number && address.starts_with("127."));
}

/// The library's server on connections of our own, one request each: nothing idle is waited for
/// when the program stops.
struct HttpDoor::Server final : httplib::Server {
  Server(Hearer h, const std::atomic<bool>& o) : hearer(std::move(h)), over(o) {}

  Hearer hearer;
  const std::atomic<bool>& over;

 private:
  bool process_and_close_socket(socket_t socket) override {
    Connection connection(socket, over);
    bool closed = false;
    return process_request(connection, true, closed, [](Request&) {});
  }
};

HttpDoor::HttpDoor(Umbridge& model, Hearer hearer, const std::atomic<bool>& cancel)
    : server_(std::make_unique<Server>(std::move(hearer), cancel)), cancel_(cancel) {
  httplib::Server& http = *server_;
  http.new_task_queue = [] { return new httplib::ThreadPool(most_connections); };
  http.set_payload_max_length(largest_body);
  http.set_pre_routing_handler(look_at);
  http.set_error_handler([](const Request& q, Response& r) { explain(q, r); });
  http.set_exception_handler([](const Request&, Response& r, const std::exception_ptr& thrown) {
    explain_exception(thrown, r);
  });
  http.Get("/Info", [&model](const Request&, Response& r) { put(model.info(), r); });
  http.Get("/Description", [&model](const Request&, Response& r) { put(model.description(), r); });
  for (const char* const name : Umbridge::requests)
    http.Post(std::string("/") + name, [this, name, &model](const Request& q, Response& r) {
      const UmbridgeReply reply = model.answer(
          name, q.body, [this] { return cancel_.load() || Connection::client_is_gone(); });
      server_->hearer(name, reply);
      put(reply, r);
    });
}

HttpDoor::~HttpDoor() = default;

int HttpDoor::bind(const std::string& address, int port) {
  httplib::Server& http = *server_;
  // Two servers on one port would share its requests: the library's own options allow that.
  http.set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  const int bound = port == 0                          ? http.bind_to_any_port(address)
                    : http.bind_to_port(address, port) ? port
                                                       : -1;
  require(bound > 0,
          fmt::format("{} port {} (cannot be listened on: another program has it, or the address "
                      "is none of this machine). Choose another with --port or --address.",
                      address, port));
  return bound;
}

void HttpDoor::serve() {
  httplib::Server& http = *server_;
  std::atomic<bool> over{false};
  std::thread watcher([&] {
    while (!cancel_.load() && !over.load())
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    while (!http.is_running() && !over.load())
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    if (!over.load()) http.stop();
  });
  http.listen_after_bind();
  over.store(true);
  watcher.join();
}

}  // namespace sturz::app
