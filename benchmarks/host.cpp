#include "benchmarks/host.h"

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>

namespace understudy::benchmarks {

Host::Host(const std::string& port) : descriptor_(open(port.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)) {
  if (descriptor_ < 0) throw CannotRun(port + ": cannot be opened");
  termios settings{};
  tcgetattr(descriptor_, &settings);
  cfmakeraw(&settings);
  cfsetspeed(&settings, B19200);
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  if (tcsetattr(descriptor_, TCSANOW, &settings) != 0)
    throw CannotRun(port + ": cannot be put into raw mode");
}

Host::~Host() { close(descriptor_); }

Nanoseconds Host::exchange(std::span<const std::uint8_t> request, std::span<std::uint8_t> reply) const {
  const Nanoseconds start = now();
  if (write(descriptor_, request.data(), request.size()) != static_cast<ssize_t>(request.size())) {
    throw CannotRun("a request could not be written");
  }
  for (std::size_t filled = 0; filled < reply.size();) {
    const ssize_t size = read(descriptor_, reply.data() + filled, reply.size() - filled);
    if (size <= 0) throw CannotRun("a reply did not arrive");
    filled += static_cast<std::size_t>(size);
  }
  return now() - start;
}

}  // namespace understudy::benchmarks
