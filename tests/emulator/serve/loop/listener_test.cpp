// A socket that listens in an event loop.
#include "emulator/serve/loop/listener.h"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <memory>
#include <utility>

namespace understudy::emulator::serve {
namespace listener_test {

struct Listening {
  Listening() : socket(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(bind(socket.get(), reinterpret_cast<const sockaddr*>(&place), sizeof place), 0);
    EXPECT_EQ(listen(socket.get(), 4), 0);
    socklen_t size = sizeof place;
    EXPECT_EQ(getsockname(socket.get(), reinterpret_cast<sockaddr*>(&place), &size), 0);
  }
  void call() const {
    const Descriptor client(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    EXPECT_EQ(connect(client.get(), reinterpret_cast<const sockaddr*>(&place), sizeof place), 0);
  }

  sockaddr_in place{};
  Descriptor socket;
};

// A child that has inherited the socket keeps it open.
TEST(Listener, AdmitsNobodyWhenItIsGoneThoughItsSocketStays) {
  EventLoop loop;
  Listening listening;
  const Descriptor inherited(dup(listening.socket.get()));
  int admitted = 0;
  // On the heap, where a sanitizer detects a call of a deleted object.
  auto listener =
      std::make_unique<Listener>(loop, std::move(listening.socket), [&](Descriptor) { ++admitted; });
  listening.call();
  loop.wait(wall_now());
  EXPECT_EQ(admitted, 1);
  listener.reset();
  listening.call();
  loop.wait(wall_now());
  EXPECT_EQ(admitted, 1);
}

}  // namespace listener_test
}  // namespace understudy::emulator::serve
