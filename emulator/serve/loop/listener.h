// A socket that accepts clients. When the process has no descriptors left, clients wait without busy looping:
// the socket is checked again when a client has left, or after a moment, because other parts may close
// descriptors.
#pragma once

#include <functional>

#include "base/files/descriptor.h"
#include "emulator/serve/loop/event_loop.h"

namespace understudy::emulator::serve {

class Listener {
 public:
  /// `socket` must listen and must not block. Each client is passed to `admit`. Throws std::system_error if
  /// no descriptor is left to watch the socket.
  Listener(EventLoop& loop, Descriptor socket, std::function<void(Descriptor)> admit,
           EventLoop::Rank rank = EventLoop::Rank::first);
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  /// Tries to accept clients again, because a descriptor was closed.
  void try_again();
  /// Accepts all waiting clients.
  void accept_all();

 private:
  void rest();

  EventLoop& loop_;
  Descriptor socket_;
  Descriptor timer_;  // ends a rest
  std::function<void(Descriptor)> admit_;
  bool is_resting_ = false;
};

}  // namespace understudy::emulator::serve
