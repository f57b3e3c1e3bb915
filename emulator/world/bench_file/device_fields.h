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

/// Reads the entry of a device without its name. Keeps all errors; if the model is unknown, the result's
/// model is null. Paths are relative to `folder`, and refused without a folder. Files that it reads are added
/// to the bench; no two of its devices may have the same memory file.
DeviceSetup read_device(const YamlFields& fields, const std::string& name,
                        const std::optional<std::string>& folder, ModelList models, Bench& bench,
                        Diagnostics& diagnostics);

/// The positions in a file of a device's description, and of its stations by port.
struct DevicePlaces {
  YamlFields device;
  std::vector<std::optional<YamlFields>> stations{};
};

/// Reports all settings of a device that the model refuses, and removes them, so that the model accepts the
/// rest.
void judge_device(const DevicePlaces& places, DeviceSetup& device, Diagnostics& diagnostics);

/// Returns a path in `folder`. It is refused if there is no folder.
std::string path_in(const std::optional<std::string>& folder, const YamlFields& field);

}  // namespace understudy::emulator::world
