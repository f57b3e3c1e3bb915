// What a bench file says of a station: by which port a device stands on a line, and its number there.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/complaints.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::world {

/// The port that it names, or the first.
std::size_t read_port(const YamlFields& station, const Model& model);

/// Fails where one of the two must be alone on its line.
void demand_room(const YamlFields& station, const StationSetup& wanted, const LineSetup& line,
                 const Bench& bench);

/// The number that it says, if it says one; the device has it then. A device has one on all its lines, so it
/// need be said of one of its stations only.
std::optional<int> read_address(const YamlFields& station, DeviceSetup& device);

/// A station as it was written: of which device, if that could be read, and the number that is said there.
struct NumberedStation {
  YamlFields fields;
  std::optional<std::size_t> device;
  std::optional<int> address;
};

/// Reports stations of each line that have one number. Not of a device whose memory says it and is a file:
/// that is read later.
void check_addresses(const std::vector<std::vector<NumberedStation>>& lines, const Bench& bench,
                     Complaints& complaints);

}  // namespace understudy::emulator::world
