#pragma once

#include <string>
#include <vector>

#include "base/files/file_claims.h"
#include "emulator/device/model.h"

namespace understudy::emulator::command_line {

/// The model of that name, or of the file that it is the path of. `files` gets what was read. Throws
/// UsageError with the nearest name; FileError.
const Model& demand_model(ModelList models, const std::string& name);
const Model& demand_model(ModelList models, const std::string& name, std::vector<FileClaim>& files);
/// Of a file. Throws FileError.
const Model& described_model(ModelList models, const std::string& path, std::vector<FileClaim>& files);

}  // namespace understudy::emulator::command_line
