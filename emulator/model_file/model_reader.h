// A model file (YAML, docs/import.md) into a description.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/files/file_claims.h"
#include "emulator/device/model.h"
#include "emulator/models/imported/description.h"

namespace understudy::emulator::model_file {

/// `name` stands for the file in messages; the list's path is relative to its folder, and refused where
/// `may_read` is false. `files` gets the list that was read. The description's text has all in itself, the
/// list as well: reading that gives the same model. Throws FileError: everything that is wrong.
models::imported::Description read_model(const std::string& text, const std::string& name, bool may_read,
                                         std::vector<FileClaim>& files);

}  // namespace understudy::emulator::model_file
