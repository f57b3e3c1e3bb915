// Reads a model file (YAML, docs/import.md) into a description.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/files/file_claims.h"
#include "emulator/device/model.h"
#include "emulator/models/imported/description.h"

namespace understudy::emulator::model_file {

/// `name` stands for the file in messages. The list's path is relative to its folder, and refused if
/// `may_read` is false. `files` receives the list that was read. The description's text is complete,
/// including the list: reading it gives the same model. Throws FileError with all mistakes.
models::imported::Description read_model(const std::string& text, const std::string& name, bool may_read,
                                         std::vector<FileClaim>& files);

}  // namespace understudy::emulator::model_file
