// Logs requests to a station that is not on the line. Such a request gets no answer, and the host itself can
// only report a timeout.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "emulator/world/world.h"
#include "pty/capture.h"

namespace understudy::emulator::serve {

class MissingStations {
 public:
  MissingStations(const world::World& world, std::function<void(const std::string&)> log)
      : world_(world), log_(std::move(log)) {}

  /// Logs each number once, and only the first few if a host tries all numbers.
  void check(const pty::CapturedPacket& packet);

 private:
  static constexpr std::size_t kMaxReported = 8;  // for each line

  bool is_new(std::size_t line, std::uint8_t address);

  const world::World& world_;
  std::function<void(const std::string&)> log_;
  std::vector<std::vector<std::uint8_t>> reported_;  // the numbers reported for each line
};

}  // namespace understudy::emulator::serve
