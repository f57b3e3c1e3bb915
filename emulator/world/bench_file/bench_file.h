// Reads bench files (YAML, docs/bench.md).
#pragma once

#include <string>

#include "base/files/file_error.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::world {

/// The name of this error in code that reads benches.
using BenchError = FileError;

class YamlFields;

/// Reads a bench whose devices may have the given models. Paths are relative to the file's folder; links are
/// relative to `links` if it is not empty. Throws FileError.
Bench load_bench(ModelList models, const std::string& path, const std::string& links = "");

/// The same, for a bench to which another file refers. If the bench cannot be read, the error has the
/// position of `path`.
Bench load_bench(ModelList models, const YamlFields& path);

/// The same, for a text. In messages, `name` is used as the file name; paths are relative to `folder`.
Bench parse_bench(ModelList models, const std::string& text, const std::string& name,
                  const std::string& folder, const std::string& links = "");

/// Reads the bench within a recording. It must be complete, so paths are refused: they would refer to files
/// that do not belong to the recording.
Bench parse_recorded_bench(ModelList models, const std::string& text);

/// Reads a bench that is the value of a key in another file.
Bench read_bench(ModelList models, const YamlFields& fields, const std::string& folder);

}  // namespace understudy::emulator::world
