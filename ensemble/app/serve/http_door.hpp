// SPDX-License-Identifier: Apache-2.0
/// HTTP for a model of UM-Bridge: sockets, sizes and threads; what is said comes from the workflow.
#pragma once

#include "ensemble/workflow/evaluation/umbridge.hpp"

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace sturz::app {

/// True for the names and numbers of this machine alone: localhost, 127.x.y.z, ::1.
bool is_loopback(const std::string& address);

class HttpDoor {
 public:
  /// Bytes of a request's body; a thousand inputs with all their digits are some twenty thousand.
  static constexpr std::size_t largest_body = 1 << 20;
  /// Hears of each POST request that was answered; called from any thread.
  using Hearer = std::function<void(std::string_view request, const workflow::UmbridgeReply&)>;

  /// \param cancel ends running members and is the sign to stop serving
  HttpDoor(workflow::Umbridge&, Hearer, const std::atomic<bool>& cancel);
  ~HttpDoor();
  HttpDoor(const HttpDoor&) = delete;
  HttpDoor& operator=(const HttpDoor&) = delete;

  /// Takes the port. \param port 0: any free one \return the port \throws SetupError
  int bind(const std::string& address, int port);
  /// Answers until the flag is raised and what runs has come back.
  void serve();

 private:
  struct Server;
  std::unique_ptr<Server> server_;
  const std::atomic<bool>& cancel_;
};

}  // namespace sturz::app
