// Receives the messages of a host in simulated time.
#pragma once

#include <sys/types.h>

#include "base/files/descriptor.h"
#include "pty/host_time/protocol.h"

namespace understudy::emulator::serve {

/// Receives a message, and the descriptor sent with it, if any. Returns as recvmsg() does.
ssize_t receive_message(int socket, host_time::Message& message, Descriptor& passed);

}  // namespace understudy::emulator::serve
