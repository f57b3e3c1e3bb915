// Reads the stations of a bench file: the port through which a device is connected to a line, and its number
// on the line.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::world {

/// Returns the port in the file, or by default the first port.
std::size_t read_port(const YamlFields& station, const Model& model);

/// Throws if one of the two stations must be alone on its line.
void require_room(const YamlFields& station, const StationSetup& wanted, const LineSetup& line,
                  const Bench& bench);

/// Reads the station's number, if any, and sets it in the device. A device has the same number on all its
/// lines, so only one of its stations may specify it.
std::optional<int> read_address(const YamlFields& station, DeviceSetup& device);

/// A station as it is written in the file: its device, if that could be read, and its number.
struct NumberedStation {
  YamlFields fields;
  std::optional<std::size_t> device;
  std::optional<int> address;
};

/// Reports stations that have the same number on a line. A device whose number is in a memory file is
/// omitted, because that file is read later.
void check_addresses(const std::vector<std::vector<NumberedStation>>& lines, const Bench& bench,
                     Diagnostics& diagnostics);

}  // namespace understudy::emulator::world
