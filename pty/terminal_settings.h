// The terminal settings of a pseudo-terminal, as its host's side has them; the master speaks for the slave.
//
// The kernel tells the master that they have changed: each reading begins with a byte of status (packet mode,
// TIOCPKT in ioctl_tty(2)). It does so while the line has EXTPROC, which means nothing on a line that is raw,
// and on another that its input is not processed. So the line has it while it is raw, and only then.
#pragma once

#include <optional>

#include "pty/line_settings.h"

namespace understudy::pty {

/// The speed of a line that no host has set. Few hosts ask for it, so their first tcsetattr changes
/// something: Debian's libc refuses one that changes parity alone, as a pty drops parity.
inline constexpr int kRestingBaud = 50;

/// What a host has set; nothing while the line is at the resting speed.
std::optional<HostSettings> host_settings_of(int master);

/// Like the above, and puts the resting speed back. Echo is turned off too: it would send every reply back as
/// a request. The rest is up to the host (a text host may want whole lines).
struct Taken {
  std::optional<HostSettings> settings;
  bool tells_changes = false;  // the kernel will tell the next one
};
Taken take_host_settings(int master);

/// Has the kernel tell changes, or not. What we set is never told. False if it cannot.
bool tell_changes(int master, bool is_wanted);
/// Has input processed again if the host has asked for that: then changes are not told any more, and this
/// returns false.
bool tells_changes(int master);

/// Raw, 8 bits, at the resting speed: what a host that sets nothing finds.
bool is_at_rest(int master);
/// False if the kernel refused, or a host has set something in that moment.
bool rest(int master);

}  // namespace understudy::pty
