// What a bench file says about a device.
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

/// Where a device is described, and where its stations are, by its ports.
struct DevicePlaces {
  YamlFields device;
  std::vector<std::optional<YamlFields>> stations{};
};

/// Reports everything that the model refuses in a device, and removes it: what is left suits the model.
void judge_device(const DevicePlaces& places, DeviceSetup& device, Complaints& complaints);

/// A path in `folder`; refused if there is no folder.
std::string path_in(const std::optional<std::string>& folder, const YamlFields& field);

}  // namespace understudy::emulator::world
