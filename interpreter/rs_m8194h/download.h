// The download of a macro, line by line: which lines are accepted, and what inputs 110 to 114 show
// afterwards.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/macro.h"
#include "interpreter/rs_m8194h/options.h"

namespace understudy::interpreter::rs_m8194h {

/// Inputs 110 to 114.
struct DownloadStatus {
  std::uint16_t mp = 0;
  std::uint16_t isr = 0;
  std::uint16_t command = 0;
  std::uint16_t line = 0;
  std::uint16_t error = 0;

  bool operator==(const DownloadStatus&) const = default;
};

/// A macro that is being downloaded. Only one error counts, the first or the last. A line with an error is
/// not stored.
struct Download {
  MacroName name = {};
  std::vector<Command> lines = {};
  Fault fault = Fault::none;  // the fault that counts
  std::uint16_t code = 0;     // code of its line, as it was sent
  std::uint16_t line = 0;     // number of its line
  bool is_spoilt = false;     // a line was refused, so nothing will be stored

  bool operator==(const Download&) const = default;
};

/// Returns how many lines still fit.
int room_of(const Download& download, const Options& options);

/// Adds a line that decode() accepts in this state. Returns the reason for a refusal, or none.
Fault add(Download& download, const Command& command, const Options& options = {});
/// Records a line that decode() has refused: undefined commands are download errors.
void refuse(Download& download, std::uint16_t code, Fault fault, const Options& options = {});

struct Closed {
  Fault fault = Fault::none;        // of CLOSE itself
  std::optional<Macro> macro = {};  // replaces the old macro if there was no error
};
/// Ends the download. If there was an error, `download` contains it afterwards.
Closed close(Download& download, const Options& options = {});

/// Returns what inputs 110 to 114 show after a CLOSE. The number of the other kind of macro does not change.
DownloadStatus status_of(const Download& closed, const DownloadStatus& before, const Options& options = {});

}  // namespace understudy::interpreter::rs_m8194h
