#include "pty/terminal_settings.h"

// The kernel's own structure holds any speed as a number; libc's <termios.h> does not, and cannot be included
// beside it. Hence this file.
#include <asm/termbits.h>
#include <sys/ioctl.h>

#include <optional>

#include "pty/line_settings.h"

namespace understudy::pty {
namespace {

constexpr auto kEcho = static_cast<tcflag_t>(ECHO | ECHOE | ECHOK | ECHONL);
constexpr auto kRestingControl = static_cast<tcflag_t>(B50 | CS8 | CREAD | CLOCAL);
constexpr auto kTellsChanges = static_cast<tcflag_t>(EXTPROC);
// What has the kernel look at each byte that goes to the host.
constexpr auto kProcessedInput =
    static_cast<tcflag_t>(ISTRIP | IUCLC | IGNCR | ICRNL | INLCR | IXON | PARMRK);
constexpr auto kProcessedLocally = static_cast<tcflag_t>(ICANON | ISIG);

void set_resting_speed(termios2& settings) {
  settings.c_cflag &= ~static_cast<tcflag_t>(CBAUD | CIBAUD);
  settings.c_cflag |= B50;
  settings.c_ospeed = settings.c_ispeed = kRestingBaud;
}

bool has_resting_speed(const termios2& settings) { return settings.c_ospeed == kRestingBaud; }

bool is_processed(const termios2& settings) {
  return (settings.c_iflag & kProcessedInput) != 0 || (settings.c_lflag & kProcessedLocally) != 0;
}

std::optional<HostSettings> host_settings_in(const termios2& settings) {
  if (has_resting_speed(settings)) return std::nullopt;
  return HostSettings{.baud = static_cast<int>(settings.c_ospeed),
                      .stop_bits = (settings.c_cflag & CSTOPB) != 0 ? 2 : 1};
}

}  // namespace

std::optional<HostSettings> host_settings_of(int master) {
  termios2 settings = {};
  if (::ioctl(master, TCGETS2, &settings) != 0) return std::nullopt;
  return host_settings_in(settings);
}

bool tell_changes(int master, bool is_wanted) {
  const int on = is_wanted ? 1 : 0;
  return ::ioctl(master, TIOCPKT, &on) == 0;
}

namespace {

/// Sets them without being told so. False if a host has set something meanwhile, or the kernel refused.
bool set_untold(int master, const termios2& settings) {
  tell_changes(master, false);
  const bool is_done = ::ioctl(master, TCSETS2, &settings) == 0;
  tell_changes(master, true);
  termios2 after = {};
  return is_done && ::ioctl(master, TCGETS2, &after) == 0 && after.c_ospeed == settings.c_ospeed &&
         after.c_cflag == settings.c_cflag && after.c_iflag == settings.c_iflag &&
         after.c_lflag == settings.c_lflag;
}

}  // namespace

Taken take_host_settings(int master) {
  termios2 settings = {};
  if (::ioctl(master, TCGETS2, &settings) != 0) return {};
  const auto taken = host_settings_in(settings);
  const bool tells = !is_processed(settings);
  const tcflag_t local = (settings.c_lflag & ~(kEcho | kTellsChanges)) | (tells ? kTellsChanges : 0U);
  if (!taken && local == settings.c_lflag) return {.settings = taken, .tells_changes = tells};
  settings.c_lflag = local;
  set_resting_speed(settings);
  return {.settings = taken, .tells_changes = set_untold(master, settings) && tells};
}

bool tells_changes(int master) {
  termios2 settings = {};
  if (::ioctl(master, TCGETS2, &settings) != 0) return false;
  if ((settings.c_lflag & kTellsChanges) == 0) return false;
  if (!is_processed(settings)) return true;
  settings.c_lflag &= ~kTellsChanges;
  set_untold(master, settings);
  return false;
}

bool is_at_rest(int master) {
  termios2 settings = {};
  return ::ioctl(master, TCGETS2, &settings) == 0 && has_resting_speed(settings) && settings.c_iflag == 0 &&
         settings.c_oflag == 0 && settings.c_lflag == kTellsChanges && settings.c_cflag == kRestingControl;
}

bool rest(int master) {
  termios2 settings = {};
  if (::ioctl(master, TCGETS2, &settings) != 0) return false;
  settings.c_iflag = settings.c_oflag = 0;
  settings.c_lflag = kTellsChanges;
  settings.c_cflag = kRestingControl;
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  set_resting_speed(settings);
  return set_untold(master, settings);
}

}  // namespace understudy::pty
