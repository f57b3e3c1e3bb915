// Logs requests to stations that are not on the line. Such a request gets no answer, and the host itself can
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

  /// Logs each number once. If a host tries all numbers, logs only the first few.
  void check(const pty::CapturedPacket& packet);

 private:
  static constexpr std::size_t kMaxReported = 8;  // for each line

  bool is_new(std::size_t line, std::uint8_t address);

  const world::World& world_;
  std::function<void(const std::string&)> log_;
  std::vector<std::vector<std::uint8_t>> reported_;  // the reported numbers of each line
};

}  // namespace understudy::emulator::serve
