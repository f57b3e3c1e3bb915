// What a bench file says of a machine, its inputs and its faults.
#pragma once

#include "emulator/bench/bench.h"
#include "emulator/bench/complaints.h"
#include "emulator/bench/names.h"
#include "emulator/bench/yaml_fields.h"

namespace understudy::emulator {

class World;

/// One entry of `plant`: the machine on an axis. What is wrong with it is kept.
PlantSetup read_machine(const YamlFields& fields, const Model& model, int axis, Complaints& complaints);
/// One entry of `inputs`: "feeder.DIN_10: on", "feeder.AIN_A: 2.5V".
InputSetup read_input(const YamlFields& field, const std::string& name, const KnownDevices& devices);
/// One element of `faults`: "{ lost_steps: feeder.A, one_in: 50 }". `other_key` may be there as well, for
/// others.
Fault read_fault(const YamlFields& fields, const KnownDevices& devices, std::string_view other_key = {});

/// Complains of a fault that the world cannot have.
void demand_possible(const YamlFields& fields, const World& world, const Fault& fault);

}  // namespace understudy::emulator
