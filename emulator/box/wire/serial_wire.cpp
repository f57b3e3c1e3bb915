#include "emulator/box/wire/serial_wire.h"

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <utility>

#include "base/text/one_line.h"
#include "emulator/box/wire/descriptor_io.h"
#include "emulator/box/wire/wire.h"
#include "pty/line_settings.h"

namespace understudy::emulator::box {

namespace {

struct SpeedRow {
  int baud;
  speed_t code;
};
constexpr std::array kSpeeds{
    SpeedRow{110, B110},         SpeedRow{300, B300},         SpeedRow{600, B600},
    SpeedRow{1200, B1200},       SpeedRow{2400, B2400},       SpeedRow{4800, B4800},
    SpeedRow{9600, B9600},       SpeedRow{19200, B19200},     SpeedRow{38400, B38400},
    SpeedRow{57600, B57600},     SpeedRow{115200, B115200},   SpeedRow{230400, B230400},
    SpeedRow{460800, B460800},   SpeedRow{500000, B500000},   SpeedRow{576000, B576000},
    SpeedRow{921600, B921600},   SpeedRow{1000000, B1000000}, SpeedRow{1152000, B1152000},
    SpeedRow{1500000, B1500000}, SpeedRow{2000000, B2000000}, SpeedRow{2500000, B2500000},
    SpeedRow{3000000, B3000000}, SpeedRow{3500000, B3500000}, SpeedRow{4000000, B4000000}};

tcflag_t flags_of(const pty::LineSettings& settings) {
  tcflag_t flags = CREAD | CLOCAL | (settings.data_bits == 7 ? CS7 : CS8);
  if (settings.parity != pty::Parity::none) flags |= PARENB;
  if (settings.parity == pty::Parity::odd) flags |= PARODD;
  if (settings.stop_bits == 2) flags |= CSTOPB;
  return flags;
}

}  // namespace

SerialWire::SerialWire(std::string path, WireUse use)
    : path_(std::move(path)),
      port_(::open(path_.c_str(),
                   (use == WireUse::listen ? O_RDONLY : O_RDWR) | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
  if (!port_)
    throw WireError(one_line(path_) + ": " + std::strerror(errno) + "; expected a serial port" +
                    (errno == EACCES ? " that you may open (group dialout)" : ""));
  if (isatty(port_.get()) == 0)
    throw WireError(one_line(path_) + ": is not a serial port; expected one such as /dev/ttyUSB0");
}

void SerialWire::set_line(const pty::LineSettings& settings) {
  const auto* const speed = std::ranges::find(kSpeeds, settings.baud, &SpeedRow::baud);
  if (speed == kSpeeds.end())
    throw WireError(one_line(path_) + ": " + std::to_string(settings.baud) +
                    " is not a speed of a serial port; expected one such as 9600, 19200 or 115200");
  termios port{};
  tcgetattr(port_.get(), &port);
  cfmakeraw(&port);
  port.c_cflag = flags_of(settings);
  port.c_cc[VMIN] = 0;
  port.c_cc[VTIME] = 0;
  cfsetspeed(&port, speed->code);
  if (tcsetattr(port_.get(), TCSANOW, &port) == 0) return;
  // A pseudo-terminal has no parity, and the C library refuses a call that changes nothing else.
  port.c_cflag &= ~static_cast<tcflag_t>(PARENB | PARODD);
  if (errno == EINVAL && tcsetattr(port_.get(), TCSANOW, &port) == 0) return;
  throw WireError(one_line(path_) + ": cannot be set to " + pty::to_string(settings) + ": " +
                  std::strerror(errno) + "; expected a serial port that supports this");
}

void SerialWire::send(std::span<const std::uint8_t> bytes) { write_all(port_, bytes, path_); }

bool SerialWire::receive(Bytes& bytes, WallTime until) { return read_some(port_, bytes, until, path_); }

}  // namespace understudy::emulator::box
