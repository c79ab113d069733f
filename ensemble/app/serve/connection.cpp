// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/serve/connection.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

namespace sturz::app {
namespace {

using Clock = std::chrono::steady_clock;

/// Between two looks at whether the server stops [ms].
constexpr int look_ms = 20;
/// For a client that says nothing, or does not read.
constexpr std::chrono::seconds patience{5};
/// For what a client still writes after it was answered.
constexpr std::chrono::seconds farewell{2};

thread_local int served_here = -1;

short events_of(int socket, short wanted, int wait_ms) {
  pollfd one{socket, wanted, 0};
  return poll(&one, 1, wait_ms) > 0 ? one.revents : static_cast<short>(0);
}

using Asked = int (*)(int, sockaddr*, socklen_t*);

void address_of(int socket, Asked ask, std::string& ip, int& port) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (ask(socket, reinterpret_cast<sockaddr*>(&address), &size) != 0) return;
  const void* number = nullptr;
  if (address.ss_family == AF_INET) {
    const auto* const four = reinterpret_cast<const sockaddr_in*>(&address);
    number = &four->sin_addr, port = ntohs(four->sin_port);
  } else if (address.ss_family == AF_INET6) {
    const auto* const six = reinterpret_cast<const sockaddr_in6*>(&address);
    number = &six->sin6_addr, port = ntohs(six->sin6_port);
  }
  if (number != nullptr && inet_ntop(address.ss_family, number, text.data(), text.size()))
    ip = text.data();
}

}  // namespace

Connection::Connection(int socket, const std::atomic<bool>& over) : socket_(socket), over_(over) {
  served_here = socket;
}

Connection::~Connection() {
  served_here = -1;
  ::shutdown(socket_, SHUT_WR);
  const auto end = Clock::now() + farewell;
  while (!over_.load() && Clock::now() < end) {
    if (events_of(socket_, POLLIN, look_ms) == 0) continue;
    if (::recv(socket_, held_.data(), held_.size(), 0) <= 0) break;
  }
  ::close(socket_);
}

bool Connection::client_is_gone() {
  return served_here >= 0 && events_of(served_here, POLLRDHUP, 0) != 0;
}

bool Connection::wait_for(short event) const {
  const auto end = Clock::now() + patience;
  do {
    if (events_of(socket_, event, look_ms) != 0) return true;
  } while (!over_.load() && Clock::now() < end);
  return false;
}

bool Connection::is_readable() const { return next_ < end_ || wait_for(POLLIN); }
bool Connection::is_writable() const { return wait_for(POLLOUT); }

ssize_t Connection::read(char* to, std::size_t most) {
  if (next_ == end_) {
    if (!wait_for(POLLIN)) return -1;
    const ssize_t n = ::recv(socket_, held_.data(), held_.size(), 0);
    if (n <= 0) return n;
    next_ = 0, end_ = static_cast<std::size_t>(n);
  }
  const std::size_t n = std::min(most, end_ - next_);
  std::copy_n(held_.data() + next_, n, to);
  next_ += n;
  return static_cast<ssize_t>(n);
}

ssize_t Connection::write(const char* from, std::size_t size) {
  return wait_for(POLLOUT) ? ::send(socket_, from, size, MSG_NOSIGNAL) : -1;
}

void Connection::get_remote_ip_and_port(std::string& ip, int& port) const {
  address_of(socket_, getpeername, ip, port);
}

void Connection::get_local_ip_and_port(std::string& ip, int& port) const {
  address_of(socket_, getsockname, ip, port);
}

}  // namespace sturz::app
