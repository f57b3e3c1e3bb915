// Reads a model file (YAML, docs/import.md) into a description.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/files/file_claims.h"
#include "emulator/device/model.h"
#include "emulator/models/imported/description.h"

namespace understudy::emulator::model_file {

/// In messages, `name` is used as the file name. The path of the list is relative to the folder of that file,
/// and is refused if `may_read` is false. `files` receives the list that was read. The text of the resulting
/// description is complete and includes the list: reading it creates the same model. Throws FileError with
/// all mistakes.
models::imported::Description read_model(const std::string& text, const std::string& name, bool may_read,
                                         std::vector<FileClaim>& files);

}  // namespace understudy::emulator::model_file
