// What `calibrate` writes, read again: which options a real controller was found to have.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/files/file_error.h"

namespace understudy::emulator::box {

struct EvidenceRow {
  std::string model;
  std::string firmware;              // of the device
  std::string choice;                // its id
  std::string state;                 // "measured", "undecided" or "not_exercised"
  std::vector<std::string> options;  // those that remain
  std::string capture;               // which contradicts the others; empty: none
  std::size_t place = 0;
};

struct EvidenceFile {
  std::string path;
  std::string box;  // a name for the controller; empty: it was not given one
  std::vector<EvidenceRow> rows;
};

/// The message begins with the path.
struct EvidenceError : FileError {
  using FileError::FileError;
};
/// Throws EvidenceError.
EvidenceFile parse_evidence(std::string_view text, const std::string& path);

}  // namespace understudy::emulator::box
