// Reads bench files (YAML, docs/bench.md).
#pragma once

#include <string>

#include "base/files/file_error.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::world {

/// The name of this error in code that reads benches.
using BenchError = FileError;

class YamlFields;

/// Reads a bench whose devices are of the given models. Paths are relative to the file's folder, links to
/// `links` if given. Throws FileError.
Bench load_bench(ModelList models, const std::string& path, const std::string& links = "");

/// Like the above, for a bench named in another file: if it cannot be read, the error has the position of
/// `path`.
Bench load_bench(ModelList models, const YamlFields& path);

/// Like the above, from a text. `name` stands for the file in messages; paths are relative to `folder`.
Bench parse_bench(ModelList models, const std::string& text, const std::string& name,
                  const std::string& folder, const std::string& links = "");

/// Reads the bench inside a recording. It must be complete, so paths are refused: they would read or write
/// files that do not belong to the recording.
Bench parse_recorded_bench(ModelList models, const std::string& text);

/// Reads a bench that is the value of a key in another file.
Bench read_bench(ModelList models, const YamlFields& fields, const std::string& folder);

}  // namespace understudy::emulator::world
