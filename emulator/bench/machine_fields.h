// What a bench file says of a machine.
#pragma once

#include "emulator/bench/bench.h"
#include "emulator/bench/complaints.h"
#include "emulator/bench/yaml_fields.h"

namespace understudy::emulator {

/// One entry of `plant`: the machine on an axis. All that is wrong with it is kept.
PlantSetup read_machine(const YamlFields& fields, const Model& model, int axis, Complaints& complaints);

}  // namespace understudy::emulator
