// Reads and writes the terminal settings on the host's side of a pseudo-terminal. Every call accepts either
// descriptor of the pair: the master represents the slave.
#pragma once

#include <optional>

#include "pty/line_settings.h"

namespace understudy::pty {

/// The speed of a line that no host has set. Few hosts ask for it, so their first tcsetattr changes
/// something. This matters because Debian's libc refuses a call that changes parity alone, as a pty drops
/// parity.
inline constexpr int kRestingBaud = 50;

/// Returns the settings of the host, or nothing while the line is at the resting speed.
std::optional<HostSettings> host_settings_of(int descriptor);

/// Like host_settings_of(), and restores the resting speed. It also turns off echo, which would send every
/// reply back as a request. Other settings are up to the host (a text host may want whole lines).
std::optional<HostSettings> take_host_settings(int descriptor);

/// Returns true if the line is raw, with 8 bits, at the resting speed: the state that rest() sets.
bool is_at_rest(int descriptor);
/// Sets the line to raw, with 8 bits, at the resting speed. Returns false if the kernel refused.
bool rest(int descriptor);

}  // namespace understudy::pty
