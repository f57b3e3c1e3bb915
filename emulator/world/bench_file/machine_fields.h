// What a bench file says about a machine.
#pragma once

#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/complaints.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::world {

/// One entry of `plant`: the machine on an axis. All that is wrong with it is kept.
PlantSetup read_machine(const YamlFields& fields, const Model& model, int axis, Complaints& complaints);

}  // namespace understudy::emulator::world
