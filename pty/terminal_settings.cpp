#include "pty/terminal_settings.h"

// This is a separate file because the kernel's structure, which holds any speed as a number, cannot be
// included together with libc's <termios.h>.
#include <asm/termbits.h>
#include <sys/ioctl.h>

#include <optional>

#include "pty/line_settings.h"

namespace understudy::pty {
namespace {

constexpr auto kEcho = static_cast<tcflag_t>(ECHO | ECHOE | ECHOK | ECHONL);
constexpr auto kRestingControl = static_cast<tcflag_t>(B50 | CS8 | CREAD | CLOCAL);

void set_resting_speed(termios2& settings) {
  settings.c_cflag &= ~static_cast<tcflag_t>(CBAUD | CIBAUD);
  settings.c_cflag |= B50;
  settings.c_ospeed = settings.c_ispeed = kRestingBaud;
}

bool has_resting_speed(const termios2& settings) { return settings.c_ospeed == kRestingBaud; }

std::optional<HostSettings> host_settings_in(const termios2& settings) {
  if (has_resting_speed(settings)) return std::nullopt;
  return HostSettings{.baud = static_cast<int>(settings.c_ospeed),
                      .stop_bits = (settings.c_cflag & CSTOPB) != 0 ? 2 : 1};
}

}  // namespace

std::optional<HostSettings> host_settings_of(int descriptor) {
  termios2 settings = {};
  if (::ioctl(descriptor, TCGETS2, &settings) != 0) return std::nullopt;
  return host_settings_in(settings);
}

std::optional<HostSettings> take_host_settings(int descriptor) {
  termios2 settings = {};
  if (::ioctl(descriptor, TCGETS2, &settings) != 0) return std::nullopt;
  const auto taken = host_settings_in(settings);
  if (taken || (settings.c_lflag & kEcho) != 0) {
    settings.c_lflag &= ~kEcho;
    set_resting_speed(settings);
    ::ioctl(descriptor, TCSETS2, &settings);
  }
  return taken;
}

bool is_at_rest(int descriptor) {
  termios2 settings = {};
  return ::ioctl(descriptor, TCGETS2, &settings) == 0 && has_resting_speed(settings) &&
         settings.c_iflag == 0 && settings.c_oflag == 0 && settings.c_lflag == 0 &&
         settings.c_cflag == kRestingControl;
}

bool rest(int descriptor) {
  termios2 settings = {};
  if (::ioctl(descriptor, TCGETS2, &settings) != 0) return false;
  settings.c_iflag = settings.c_oflag = settings.c_lflag = 0;
  settings.c_cflag = kRestingControl;
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  set_resting_speed(settings);
  return ::ioctl(descriptor, TCSETS2, &settings) == 0;
}

}  // namespace understudy::pty
