#include "emulator/serve/ports/tcp_places.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/files/descriptor.h"
#include "emulator/world/bench/listening.h"
#include "pty/port_link.h"

namespace understudy::emulator::serve {

namespace {

constexpr int kMaxWaiting = 16;  // clients that are not accepted yet

struct Freed {
  void operator()(addrinfo* found) const { freeaddrinfo(found); }
};
using Found = std::unique_ptr<addrinfo, Freed>;

[[noreturn]] void fail(const world::TcpAddress& address, const std::string& why,
                       const std::string& expected) {
  throw pty::PortError("--listen: cannot listen at " + world::to_string(address) + ": " + why +
                       "; expected " + expected);
}

Found find(const world::TcpAddress& address) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(), &hints, &found);
  if (error != 0) fail(address, gai_strerror(error), "an address of this machine, or a name for one");
  return Found(found);
}

std::string expected_after(int error) {
  switch (error) {
    case EADDRNOTAVAIL: return "an address of this machine";
    case EACCES: return "a port from 1024 on";
    default: return "a free port";
  }
}

void set_port(sockaddr* place, int port) {
  const std::uint16_t number = htons(static_cast<std::uint16_t>(port));
  if (place->sa_family == AF_INET6) {
    reinterpret_cast<sockaddr_in6*>(place)->sin6_port = number;
  } else {
    reinterpret_cast<sockaddr_in*>(place)->sin_port = number;
  }
}

int port_of(const Descriptor& listener) {
  sockaddr_storage place{};
  socklen_t size = sizeof place;
  auto* const raw = reinterpret_cast<sockaddr*>(&place);
  if (getsockname(listener.get(), raw, &size) != 0) return 0;
  return ntohs(raw->sa_family == AF_INET6 ? reinterpret_cast<sockaddr_in6*>(raw)->sin6_port
                                          : reinterpret_cast<sockaddr_in*>(raw)->sin_port);
}

/// Returns an empty descriptor on failure, and leaves the reason in errno.
Descriptor listen_there(const addrinfo& place, bool is_one_of_several) {
  Descriptor listener(socket(place.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!listener) return {};
  const int yes = 1;
  setsockopt(listener.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  if (place.ai_family == AF_INET6 && is_one_of_several)
    setsockopt(listener.get(), IPPROTO_IPV6, IPV6_V6ONLY, &yes, sizeof yes);
  const bool listens =
      bind(listener.get(), place.ai_addr, place.ai_addrlen) == 0 && listen(listener.get(), kMaxWaiting) == 0;
  return listens ? std::move(listener) : Descriptor();
}

bool is_same(const addrinfo& a, const addrinfo& b) {
  return a.ai_addrlen == b.ai_addrlen && std::memcmp(a.ai_addr, b.ai_addr, a.ai_addrlen) == 0;
}

}  // namespace

std::vector<Descriptor> listen_at(world::TcpAddress& address) {
  const Found found = find(address);
  std::vector<addrinfo*> places;
  for (addrinfo* place = found.get(); place != nullptr; place = place->ai_next) {
    if (std::ranges::none_of(places, [&](const addrinfo* other) { return is_same(*place, *other); }))
      places.push_back(place);
  }
  std::vector<Descriptor> listeners;
  int error = 0;
  for (addrinfo* const place : places) {
    set_port(place->ai_addr, address.port);
    Descriptor listener = listen_there(*place, places.size() > 1);
    if (!listener) {
      // A name may resolve to an IPv6 address on a machine without IPv6.
      error = errno;
      const bool is_elsewhere = error == EADDRNOTAVAIL || error == EAFNOSUPPORT;
      if (is_elsewhere && places.size() > 1) continue;
      fail(address, std::strerror(error), expected_after(error));
    }
    if (address.port == 0) address.port = port_of(listener);
    listeners.push_back(std::move(listener));
  }
  if (listeners.empty()) fail(address, std::strerror(error), expected_after(error));
  return listeners;
}

}  // namespace understudy::emulator::serve
