// Models that tests describe as texts.
#pragma once

#include <string>
#include <vector>

#include "base/files/file_error.h"
#include "emulator/model_file/model_files.h"
#include "emulator/models/models.h"
#include "emulator/world/bench_file/bench_file.h"

namespace understudy::emulator::model_file {

/// Returns the described models, which exist as long as the tests.
inline DescribedModels& described_models() {
  static DescribedModels described(models::all_models());
  return described;
}
inline ModelList with_described() { return {models::all_models(), &described_models()}; }

/// Returns a model file with the list as a block after `registers: |`. The list's first line is line 4.
inline std::string model_with(const std::string& list, const std::string& more) {
  std::string text = "understudy: 1\nmodel: one\nregisters: |\n";
  for (std::size_t begin = 0; begin < list.size();) {
    const std::size_t end = list.find('\n', begin);
    text += "  " + list.substr(begin, end - begin) + "\n";
    begin = end + 1;
  }
  return text + more;
}

/// Returns the error of a model file, or an empty text.
inline std::string diagnostic_about(const std::string& text) {
  try {
    described_models().parse(text, "m.yaml");
    return "";
  } catch (const FileError& error) {
    return error.what();
  }
}

/// Returns a text as a YAML scalar on one line.
inline std::string quoted_scalar(const std::string& text) {
  std::string made = "\"";
  for (const char c : text) {
    if (c == '\n') {
      made += "\\n";
    } else if (c == '"' || c == '\\') {
      made += std::string("\\") + c;
    } else {
      made += c;
    }
  }
  return made + "\"";
}

/// Returns a bench with one device `it` of a described model. `more` is the rest of the bench file.
inline world::Bench bench_with(const std::string& model, const std::string& more = "") {
  return world::parse_bench(with_described(),
                            "understudy: 1\nlines: { a: { timing: instant, stations: [ { name: it, model: " +
                                quoted_scalar(model) + " } ] } }\n" + more,
                            "bench.yaml", "/nonexistent");
}

}  // namespace understudy::emulator::model_file
