// What a bench file says of a device.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/complaints.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::world {

/// A name that other names can be joined to with a dot.
void demand_name(const YamlFields& field, const std::string& name);

/// The entry of a device without its name. All that is wrong is kept; with an unknown model the device has
/// none. Paths are relative to `folder`, and refused without one; files that are read are added to the bench,
/// whose devices have other memories.
DeviceSetup read_device(const YamlFields& fields, const std::string& name,
                        const std::optional<std::string>& folder, ModelList models, Bench& bench,
                        Complaints& complaints);

/// Keeps all that the model refuses of a device, and takes it away: what is left suits the model.
void judge_device(const YamlFields& fields, DeviceSetup& device, Complaints& complaints);

/// A path in `folder`; refused without one.
std::string path_in(const std::optional<std::string>& folder, const YamlFields& field);

}  // namespace understudy::emulator::world
