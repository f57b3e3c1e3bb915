// The terminal settings of a pseudo-terminal, as its host's side has them. Every call works through any
// descriptor of the pair: the master speaks for the slave.
#pragma once

#include <optional>

#include "pty/line_settings.h"

namespace understudy::pty {

/// The speed of a line that no host has set. Few hosts ask for it, so their first tcsetattr changes
/// something: Debian's libc refuses one that changes parity alone, as a pty drops parity.
inline constexpr int kRestingBaud = 50;

/// What a host has set; nothing while the line is at the resting speed.
std::optional<HostSettings> host_settings_of(int descriptor);

/// Like the above, and puts the resting speed back. Echo is turned off too: it would send every reply back as
/// a request. The rest is up to the host (a text host may want whole lines).
std::optional<HostSettings> take_host_settings(int descriptor);

/// Raw, 8 bits, at the resting speed: what a host that sets nothing finds.
bool is_at_rest(int descriptor);
/// False if the kernel refused.
bool rest(int descriptor);

}  // namespace understudy::pty
