#pragma once

#include <string>
#include <vector>

#include "base/files/file_claims.h"
#include "emulator/device/model.h"

namespace understudy::emulator::command_line {

/// Returns the model with that name, or the model in the file at that path. Adds the files that were read to
/// `files`. Throws UsageError with the nearest name, or FileError.
const Model& require_model(ModelList models, const std::string& name);
const Model& require_model(ModelList models, const std::string& name, std::vector<FileClaim>& files);
/// Returns the model in a file. Throws FileError.
const Model& described_model(ModelList models, const std::string& path, std::vector<FileClaim>& files);
/// Returns the version in the text of `--firmware`; 0 if the text is empty. Throws UsageError.
Firmware require_firmware(const Model& model, const std::string& text);

}  // namespace understudy::emulator::command_line
