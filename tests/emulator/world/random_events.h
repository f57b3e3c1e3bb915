// Random events from outside for a world of two Simple2-R3: requests, noise, inputs.
#pragma once

#include <random>
#include <vector>

#include "tests/emulator/world/two_devices.h"

namespace understudy::emulator::world {

/// An event from outside: bytes on the line, or an input's level.
struct RandomEvent {
  SimTime at{0};
  Bytes bytes{};
  std::size_t device = 0;
  int terminal = -1;
  bool on = false;
};

class RandomEvents {
 public:
  explicit RandomEvents(std::uint64_t seed_value) : random_(seed_value) {}

  std::int64_t between(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
  }

  std::vector<RandomEvent> make(int count) {
    std::vector<RandomEvent> events;
    for (int i = 0; i < count; ++i) {
      time_ += gap();
      RandomEvent event{.at = time_};
      if (between(0, 4) == 0) {
        event.device = static_cast<std::size_t>(between(0, 1));
        event.terminal = static_cast<int>(between(0, 10));
        event.on = between(0, 1) == 1;
      } else {
        event.bytes = bytes();
      }
      events.push_back(event);
    }
    return events;
  }

 private:
  SimTime gap() {
    switch (between(0, 6)) {
      case 0: return SimTime{between(0, 2'000'000)};
      case 1: return SimTime{between(0, 50'000'000)};
      case 2: return SimTime{between(0, 3'000'000'000)};
      case 3: return (kTickLength - time_ % kTickLength);                   // exactly the next tick
      case 4: return (kTickLength - time_ % kTickLength) * 2 - SimTime{1};  // often near a tick
      default: return SimTime{between(8'000'000, 20'000'000)};              // a host's polling interval
    }
  }

  Bytes bytes() {
    const auto station = static_cast<int>(between(0, 9) == 0 ? between(0, 4) : between(1, 2));
    switch (between(0, 9)) {
      case 0: {  // noise
        Bytes noise;
        for (auto n = between(1, 20); n > 0; --n) noise.push_back(static_cast<std::uint8_t>(between(0, 255)));
        return noise;
      }
      case 1: return read_request(station, 0x0000, 1);
      case 2: return read_request(station, 0x0E00, 8);
      case 3: return read_request(station, static_cast<int>(between(0, 0xFFFF)), 2);
      case 4:
        return write_request(station, static_cast<int>(between(0x0A00, 0x0A0D)),
                             static_cast<int>(between(0, 1)));
      case 5: return whole_move(station);
      case 6: return write_request(station, 0x1013, between(0, 5) > 0 ? 1 : 0);
      default: {
        constexpr int kAddresses[] = {0x0D00, 0x0D04, 0x0D05, 0x0DF0, 0x0E00, 0x0E04, 0x1000, 0x1002, 0x1003,
                                      0x1005, 0x100B, 0x100C, 0x100D, 0x1013, 0x1014, 0x1016, 0x1017, 0x101B,
                                      0x101C, 0x2000, 0x2100, 0x2107, 0xF002, 0xF014, 0xF016, 0xF018, 0xFF06};
        const int address = kAddresses[static_cast<std::size_t>(between(0, std::size(kAddresses) - 1))];
        return write_request(station, address,
                             static_cast<int>(between(0, 3) == 0 ? between(0, 3000) : between(0, 1)));
      }
    }
  }

  /// Returns a request with function 16 that writes an axis's distance, speed, ramp times and trigger.
  Bytes whole_move(int station) {
    const auto byte = [](std::int64_t n) { return static_cast<std::uint8_t>(n); };
    const std::int64_t first = between(0, 1) == 0 ? 0x1000 : 0x1006;
    const std::int64_t distance = between(-1500, 1500);
    Bytes frame{byte(station), 0x10, byte(first >> 8), byte(first), 0, 6, 12};
    for (const std::int64_t word : {distance, distance >> 16, between(0, 3) == 0 ? 0 : between(1, 400),
                                    between(0, 30), between(0, 30), std::int64_t{1}}) {
      frame.push_back(byte(word >> 8));
      frame.push_back(byte(word));
    }
    return framed(frame);
  }

  std::mt19937_64 random_;
  SimTime time_{0};
};

inline void apply(World& world, const RandomEvent& event) {
  if (event.terminal >= 0) {
    world.set_external_input(event.device, event.terminal, event.on);
  } else {
    world.receive(0, event.bytes, event.at);
  }
}

}  // namespace understudy::emulator::world
