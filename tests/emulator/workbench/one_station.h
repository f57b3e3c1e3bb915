// The tests' controller as a single station.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "emulator/world/stations/rtu_station.h"
#include "pty/rtu_crc.h"
#include "tests/emulator/workbench/workbench.h"
#include "tests/emulator/world/stations/pdus.h"

namespace understudy::emulator::workbench {

/// Receives requests and answers them, without a line.
struct OneStation final : pty::Transmitter {
  explicit OneStation(bool strict = false) {
    DeviceSettings settings;
    settings.name = "it";
    device = make_device(model(), settings);
    station = std::make_unique<world::RtuStation>(*device, 0,
                                                  pty::RtuFraming{.strict = strict,
                                                                  .silence = std::chrono::microseconds(500),
                                                                  .patience = std::chrono::milliseconds(10)});
  }
  void transmit(std::span<const std::uint8_t> bytes) override {
    sent = world::text(bytes.subspan(1, bytes.size() - 3));
  }
  void answer(std::span<const std::uint8_t> bytes, std::uint64_t) override { transmit(bytes); }

  /// Returns the reply to a PDU; empty if there is none.
  std::string ask(std::string_view pdu, std::uint8_t address = 1) {
    world::Bytes frame{address};
    for (const std::uint8_t byte : world::hex(pdu)) frame.push_back(byte);
    pty::append_rtu_crc(frame);
    sent.clear();
    for (const std::uint8_t value : frame) {
      station->receive({.start = now, .end = now + kCharacter, .value = value});
      now += kCharacter;
    }
    for (int runs = 0; station->due() && runs < 100; ++runs) {
      now = std::max(now, *station->due());
      station->run(now, *this);
    }
    now += std::chrono::milliseconds(10);
    return sent;
  }
  const Workbench& bench() const { return static_cast<const Workbench&>(*device); }
  const WorkbenchState& state() const { return bench().state; }

  std::unique_ptr<Device> device;
  std::unique_ptr<world::RtuStation> station;
  std::string sent;
  pty::SimTime now{0};
  static constexpr pty::SimTime kCharacter = std::chrono::microseconds(87);
};

}  // namespace understudy::emulator::workbench
