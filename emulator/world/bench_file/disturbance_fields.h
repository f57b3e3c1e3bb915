// What a bench file says about inputs, and about what is broken at first.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/complaints.h"
#include "emulator/world/bench_file/yaml_fields.h"
#include "emulator/world/names/names.h"
#include "emulator/world/view/inventory.h"

namespace understudy::emulator::world {

/// One entry of `inputs`: "feeder.DIN_10: on", "feeder.AIN_A: 2.5V".
InputSetup read_input(const YamlFields& field, const std::string& name, const KnownDevices& devices);

/// One element of `faults`: "{ lost_steps: feeder.A, one_in: 50 }". `other_key` may be there as well, for
/// others. All that is wrong with it is kept; nothing is returned then.
std::optional<Fault> read_fault(const YamlFields& fields, const KnownDevices& devices, Complaints& complaints,
                                std::string_view other_key = {});

/// Complains about a fault that the bench cannot have. What it waits for is judged even if the fault itself
/// could not be read.
void demand_possible(const YamlFields& fields, const Inventory& inventory, const std::optional<Fault>& fault,
                     Complaints& complaints);

}  // namespace understudy::emulator::world
