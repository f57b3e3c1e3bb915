// Bench files (YAML, docs/bench.md) into benches.
#pragma once

#include <string>

#include "base/files/file_error.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::world {

/// The name that readers of benches know it by.
using BenchError = FileError;

class YamlFields;

/// Devices are of one of the models. Paths are relative to the file's folder, links to `links` if that is
/// given. Throws FileError.
Bench load_bench(ModelList models, const std::string& path, const std::string& links = "");

/// The same where another file names it: that is where it is told if it cannot be read.
Bench load_bench(ModelList models, const YamlFields& path);

/// The same from a text; `name` stands for the file in messages, paths are relative to `folder`.
Bench parse_bench(ModelList models, const std::string& text, const std::string& name,
                  const std::string& folder, const std::string& links = "");

/// The bench that is inside a recording. It has everything in itself: whoever names a path there wants
/// something read or written that is none of a recording's business, and is refused.
Bench parse_recorded_bench(ModelList models, const std::string& text);

/// One that is written inside another file, as the value of a key.
Bench read_bench(ModelList models, const YamlFields& fields, const std::string& folder);

}  // namespace understudy::emulator::world
