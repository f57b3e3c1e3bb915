#include "tests/acceptance/any_speed.h"

// The kernel's structure can hold any speed as a number, but <termios.h> cannot be included in the same file.
#include <asm/termbits.h>
#include <sys/ioctl.h>

namespace understudy::acceptance {

bool set_any_speed(int descriptor, int baud) {
  termios2 settings = {};
  if (ioctl(descriptor, TCGETS2, &settings) != 0) return false;
  settings.c_iflag = settings.c_oflag = settings.c_lflag = 0;
  settings.c_cflag = static_cast<tcflag_t>(BOTHER | CS8 | CREAD | CLOCAL);
  settings.c_ispeed = settings.c_ospeed = static_cast<speed_t>(baud);
  return ioctl(descriptor, TCSETS2, &settings) == 0;
}

}  // namespace understudy::acceptance
