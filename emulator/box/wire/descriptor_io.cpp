#include "emulator/box/wire/descriptor_io.h"

#include <poll.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <span>
#include <string>

#include "base/files/descriptor.h"
#include "base/text/one_line.h"
#include "emulator/box/wire/wire.h"
#include "emulator/serve/loop/event_loop.h"

namespace understudy::emulator::box {

namespace {

[[noreturn]] void report_lost(const std::string& place, const std::string& why) {
  throw WireError(one_line(place) + ": is lost: " + why + "; expected a port that stays open");
}

bool is_only_waiting(int error) { return error == EAGAIN || error == EINTR; }

bool wait_for(int descriptor, short event, WallTime until) {
  pollfd waited{.fd = descriptor, .events = event, .revents = 0};
  const WallTime rest = std::max(until - serve::wall_now(), WallTime{0});
  const timespec patience{.tv_sec = rest.count() / 1'000'000'000, .tv_nsec = rest.count() % 1'000'000'000};
  return ppoll(&waited, 1, &patience, nullptr) > 0;
}

}  // namespace

void write_all(const Descriptor& to, std::span<const std::uint8_t> bytes, const std::string& place) {
  constexpr WallTime kPatience = std::chrono::seconds(5);
  const WallTime deadline = serve::wall_now() + kPatience;
  while (!bytes.empty()) {
    const ssize_t size = ::write(to.get(), bytes.data(), bytes.size());
    if (size > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(size));
      continue;
    }
    if (size < 0 && !is_only_waiting(errno)) report_lost(place, std::strerror(errno));
    if (serve::wall_now() >= deadline) report_lost(place, "accepts no more bytes");
    wait_for(to.get(), POLLOUT, std::min(deadline, serve::wall_now() + std::chrono::milliseconds(100)));
  }
}

bool read_some(const Descriptor& from, Bytes& bytes, WallTime until, const std::string& place) {
  if (!wait_for(from.get(), POLLIN, until)) return false;
  std::array<std::uint8_t, 512> part;
  const ssize_t size = ::read(from.get(), part.data(), part.size());
  if (size < 0 && is_only_waiting(errno)) return false;
  if (size < 0) report_lost(place, std::strerror(errno));
  if (size == 0) report_lost(place, "the other end has hung up");
  bytes.insert(bytes.end(), part.begin(), part.begin() + size);
  return true;
}

}  // namespace understudy::emulator::box
