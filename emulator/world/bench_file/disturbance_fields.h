// Reads the inputs and the initial faults of a bench file.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"
#include "emulator/world/names/names.h"
#include "emulator/world/view/inventory.h"

namespace understudy::emulator::world {

/// Reads an entry of `inputs`: "feeder.DIN_10: on", "feeder.AIN_A: 2.5V".
InputSetup read_input(const YamlFields& field, const std::string& name, const KnownDevices& devices);

/// Reads an element of `faults`: "{ lost_steps: feeder.A, one_in: 50 }". `other_key` is allowed, but left to
/// other readers. If anything is wrong, keeps all errors and returns nothing.
std::optional<Fault> read_fault(const YamlFields& fields, const KnownDevices& devices,
                                Diagnostics& diagnostics, std::string_view other_key = {});

/// Reports a fault that is impossible on this bench. The condition is checked even if the fault itself could
/// not be read.
void require_possible(const YamlFields& fields, const Inventory& inventory, const std::optional<Fault>& fault,
                      Diagnostics& diagnostics);

}  // namespace understudy::emulator::world
