// A host that writes and reads bytes itself, with the frames of the specification (section 1.5).
#pragma once

#include <chrono>
#include <string>

#include "tests/acceptance/running_understudy.h"
#include "tests/pty/pty_host.h"

namespace understudy::acceptance {

using pty::Bytes;
using pty::hex;
using pty::Host;

inline constexpr int kSilenceMs = 150;  // no reply takes this long on these lines

inline const Bytes kReadHardwareCode = pty::hex("01 03 00 01 00 01 D5 CA");
inline const Bytes kHardwareCodeReply = pty::hex("01 03 02 C0 01 29 84");
inline const Bytes kSetSpeed200 = pty::hex("01 06 10 02 00 C8 2D 5C");  // the reply is the same

/// Writes the request and reads as many bytes as the reply must have.
inline Bytes exchange(Host& host, const Bytes& request, std::size_t reply_size) {
  host.write(request);
  return host.read(reply_size);
}

/// Returns true if nothing is received.
inline bool is_silent(Host& host) { return host.read(1, kSilenceMs).empty(); }

}  // namespace understudy::acceptance
