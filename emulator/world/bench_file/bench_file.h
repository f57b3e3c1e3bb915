// Bench files (YAML, docs/bench.md) into benches.
#pragma once

#include <string>

#include "base/files/file_error.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::world {

/// The name by which readers of benches know it.
using BenchError = FileError;

class YamlFields;

/// Devices are of one of the models. Paths are relative to the file's folder, links to `links` if that is
/// given. Throws FileError.
Bench load_bench(ModelList models, const std::string& path, const std::string& links = "");

/// Like the above, if another file names it: if it cannot be read, the message points there.
Bench load_bench(ModelList models, const YamlFields& path);

/// Like the above, from a text; `name` stands for the file in messages, paths are relative to `folder`.
Bench parse_bench(ModelList models, const std::string& text, const std::string& name,
                  const std::string& folder, const std::string& links = "");

/// The bench that is inside a recording. It is complete: a path there would have something read or written
/// that does not belong to the recording, so it is refused.
Bench parse_recorded_bench(ModelList models, const std::string& text);

/// A bench that is written inside another file, as the value of a key.
Bench read_bench(ModelList models, const YamlFields& fields, const std::string& folder);

}  // namespace understudy::emulator::world
