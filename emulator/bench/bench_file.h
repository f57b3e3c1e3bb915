// Bench files (YAML, docs/bench.md) into benches.
#pragma once

#include <stdexcept>
#include <string>

#include "emulator/bench/bench.h"
#include "emulator/one_line.h"

namespace understudy::emulator {

/// One line: "file:line: field: what is wrong; what was expected".
struct BenchError : std::runtime_error {
  explicit BenchError(const std::string& text) : std::runtime_error(one_line(text)) {}
};

/// Paths are relative to the file's folder, links to `links` if that is given. Throws BenchError.
Bench load_bench(const std::string& path, const std::string& links = "");

/// The same from a text; `name` stands for the file in messages, paths are relative to `folder`.
Bench parse_bench(const std::string& text, const std::string& name, const std::string& folder,
                  const std::string& links = "");

}  // namespace understudy::emulator
