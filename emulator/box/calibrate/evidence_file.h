// The file that `calibrate` and `probe` write: the options that a real controller has, and the evidence.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/file_error.h"

namespace understudy::emulator::box {

/// The states of a row, in the order of summaries.
inline constexpr std::array<std::string_view, 4> kEvidenceStates{"measured", "contradicted", "undecided",
                                                                 "not_exercised"};

struct EvidenceDevice {
  std::string name;
  std::string model;
  std::string firmware;
};

/// A capture that was explained.
struct EvidenceCapture {
  std::string file;
  std::size_t exchanges = 0;
  std::string sha256;
};

struct EvidenceRow {
  std::string device;  // its name
  std::string model{};
  std::string firmware{};
  std::string choice;                // its id
  std::string state;                 // one of kEvidenceStates
  std::vector<std::string> options;  // those that remain
  std::string expected{};            // the option of the bench, or the model's default
  std::string capture{};             // which contradicts the others; empty: none
  std::size_t place = 0;
  std::string proof{};    // the scenario that tells the options apart; empty: a capture does
  std::string why_not{};  // why it was not exercised, after its name: "needs a machine"
  std::map<std::string, std::string> seen{};  // by option: why the controller does not have it

  std::string label() const { return device + "." + choice; }
};

struct EvidenceFile {
  std::string path{};
  std::string sha256{};  // of the file itself
  std::string box{};     // a name for the controller; empty: it was not given one
  std::string bench{};   // of `calibrate`
  std::string port{};    // of `probe`
  std::vector<EvidenceDevice> devices{};
  std::vector<EvidenceCapture> captures{};
  bool is_explained = true;     // all captures together
  bool is_interrupted = false;  // rows are missing that were not tried
  double drift_ppm = 0;
  std::vector<std::string> contradictory{};  // two captures
  std::vector<EvidenceRow> rows{};
};

/// The message begins with the path.
struct EvidenceError : FileError {
  using FileError::FileError;
};
/// Throws EvidenceError.
EvidenceFile parse_evidence(std::string_view text, const std::string& path);
/// Returns the text of the file.
std::string evidence_text(const EvidenceFile& evidence);
/// Returns a line for each exercised row, and one with the counts. `remark` follows a measured option that
/// differs from the expected one.
std::string evidence_table(const EvidenceFile& evidence, std::string_view remark);

}  // namespace understudy::emulator::box
