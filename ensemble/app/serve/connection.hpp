// SPDX-License-Identifier: Apache-2.0
/// One accepted connection, because the library's own (0.11) neither tells whether its client is
/// still there nor reads on after an early answer.
#pragma once

#include <httplib.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <string>

namespace sturz::app {

/// Owns the socket. Made, used and destroyed by the one thread that serves it.
class Connection final : public httplib::Stream {
 public:
  /// \param over ends every wait: the server stops
  Connection(int socket, const std::atomic<bool>& over);
  /// Closes; before that reads what the client still writes, for two seconds at most: closed with
  /// unread bytes, its system would take the answer away from it.
  ~Connection() override;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// True when the client of the connection that this thread serves has closed its side, or is
  /// gone; false on other threads.
  static bool client_is_gone();

  bool is_readable() const override;
  bool is_writable() const override;
  ssize_t read(char* to, std::size_t most) override;
  ssize_t write(const char* from, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  int socket() const override { return socket_; }

 private:
  bool wait_for(short event) const;

  int socket_;
  const std::atomic<bool>& over_;
  std::array<char, 4096> held_{};  ///< read, not yet asked for: the library reads byte by byte
  std::size_t next_ = 0, end_ = 0;
};

}  // namespace sturz::app
