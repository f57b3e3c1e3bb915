// Reads the devices of a bench file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::world {

/// Checks that a name can be followed by a dot and another name.
void require_name(const YamlFields& field, const std::string& name);

/// Reads the entry of a device, except its name. Keeps all errors. If the model is unknown, the model of the
/// result is null. Paths are relative to `folder`, and are refused without a folder. Files that are read are
/// added to the bench. Two devices must not have the same memory file.
DeviceSetup read_device(const YamlFields& fields, const std::string& name,
                        const std::optional<std::string>& folder, ModelList models, Bench& bench,
                        Diagnostics& diagnostics);

/// The positions of a device's description and of its stations (by port) in a file.
struct DevicePlaces {
  YamlFields device;
  std::vector<std::optional<YamlFields>> stations{};
};

/// Reports all settings of a device that the model refuses, and removes them, so that the model accepts the
/// other settings.
void judge_device(const DevicePlaces& places, DeviceSetup& device, Diagnostics& diagnostics);

/// Returns a path relative to `folder`. Without a folder, it is refused.
std::string path_in(const std::optional<std::string>& folder, const YamlFields& field);

}  // namespace understudy::emulator::world
