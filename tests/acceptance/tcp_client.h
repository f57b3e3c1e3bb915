// A client of a line that listens on TCP.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <regex>
#include <string>

#include "tests/acceptance/raw_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {

/// Returns the port on which the daemon listens, from its log, or 0 if there is none.
inline int listened_port(const RunningUnderstudy& served) {
  std::smatch found;
  const std::string errors = served.errors();
  return std::regex_search(errors, found, std::regex("listens at [a-z0-9-]+://127\\.0\\.0\\.1:(\\d+)"))
             ? std::stoi(found[1])
             : 0;
}

/// Returns a port of this machine on which nothing listens now.
inline int free_port() {
  const Descriptor held(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in where{};
  where.sin_family = AF_INET;
  where.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof where;
  auto* const raw = reinterpret_cast<sockaddr*>(&where);
  EXPECT_EQ(bind(held.get(), raw, size), 0);
  EXPECT_EQ(getsockname(held.get(), raw, &size), 0);
  return ntohs(where.sin_port);
}

/// A TCP client on this machine.
class TcpClient {
 public:
  explicit TcpClient(int port) : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in where{};
    where.sin_family = AF_INET;
    where.sin_port = htons(static_cast<std::uint16_t>(port));
    where.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    is_connected = connect(socket_.get(), reinterpret_cast<sockaddr*>(&where), sizeof where) == 0;
  }
  void write(const Bytes& bytes) const {
    EXPECT_EQ(send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL), ssize_t(bytes.size()));
  }
  /// Sends as much as the other side accepts without a long wait.
  void write_what_goes(const Bytes& bytes) const {
    std::size_t gone = 0;
    for (pollfd wait{socket_.get(), POLLOUT, 0}; gone < bytes.size() && poll(&wait, 1, 200) == 1;) {
      const ssize_t count =
          send(socket_.get(), bytes.data() + gone, bytes.size() - gone, MSG_NOSIGNAL | MSG_DONTWAIT);
      if (count <= 0) return;
      gone += std::size_t(count);
    }
  }
  /// Returns fewer bytes if the other side closes, or sends nothing for the test's patience.
  Bytes read(std::size_t count) const {
    Bytes bytes;
    while (bytes.size() < count && is_readable()) {
      std::uint8_t byte = 0;
      if (recv(socket_.get(), &byte, 1, 0) != 1) break;
      bytes.push_back(byte);
    }
    return bytes;
  }
  bool is_closed() const {
    std::uint8_t byte = 0;
    return is_readable() && recv(socket_.get(), &byte, 1, 0) <= 0;
  }
  bool is_connected = false;

 private:
  bool is_readable() const {
    pollfd wait{socket_.get(), POLLIN, 0};
    return poll(&wait, 1, int(kPatience.count())) == 1;
  }
  Descriptor socket_;
};

}  // namespace understudy::acceptance
