// Counts what has been exercised on one device, in the rows of its model's tables.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/device.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/world/coverage/coverage_report.h"
#include "emulator/world/coverage/touched.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/protocol/modbus_request.h"

namespace understudy::emulator::world {

class DeviceTouches {
 public:
  explicit DeviceTouches(const Device& device);

  /// Counts a request that the device has executed. `data` contains the words or bits of a read, as in the
  /// reply.
  void answered(const ModbusRequest& request, std::span<const std::uint8_t> data);
  /// Counts a request that the device has refused, with the exception in its answer, if it answered.
  void refused(const ModbusRequest& request, std::optional<int> exception);
  /// Counts a write that bypassed the line.
  void written(Table table, std::uint16_t first, std::span<const std::uint16_t> words);
  /// Counts a command by its text: "MA 1000".
  void command(std::string_view text, bool is_refused);
  /// Counts a fault that has begun.
  void fault(Fault::Kind kind, bool is_moving);
  /// Returns the tables, including the counts of instructions by their first word and the decisions that the
  /// device has recorded (device/decisions.h).
  TouchedModel tables(const std::map<std::string, CoveredLine>& instructions) const;

 private:
  void add_registers();
  void add_functions();
  void add_commands();
  void add_faults();
  void touch(const RegisterSpan& span, std::size_t column);
  void send_command(const RegisterSpan& span, std::span<const std::uint16_t> words, bool is_refused);
  void see(const Place& place, std::uint16_t word);
  std::string command_called(std::string_view text) const;

  const Device& device_;
  TouchedTable registers_{.name = "registers", .columns = {"read", "written", "refused"}};
  TouchedTable bits_{.name = "bits", .columns = {"read as 1", "read as 0"}};
  TouchedTable functions_{.name = "functions", .columns = {"answered", "refused"}};
  TouchedTable exceptions_{.name = "exceptions", .columns = {"answered"}};
  TouchedTable commands_{.name = "commands", .columns = {"accepted", "refused"}};
  TouchedTable faults_{.name = "faults", .columns = {"begun while standing", "begun while moving"}};
  std::vector<std::size_t> first_bits_;  // by row of the map: its first row in bits_
};

}  // namespace understudy::emulator::world
