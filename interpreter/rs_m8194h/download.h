// The download of a macro, line by line: which lines are accepted, and what inputs 110 to 114 show
// afterwards.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/macro.h"

namespace understudy::interpreter::rs_m8194h {

/// Options about downloads that the manual leaves open.
struct DownloadOptions {
  /// True: CLOSE counts as a line of the macro.
  bool close_takes_line = false;
  /// True: FOR and IF share the seven levels; false: each has seven.
  bool levels_are_of_both = false;
  /// True: a GOTO that leaves a block is refused; false: it is allowed.
  bool goto_stays_in_its_block = false;
  /// Input 112 shows a line's code as 0x0Axx, as in the worked example, or as it was sent.
  enum class ShownCode : std::uint8_t { real_time, as_sent } shown_code = ShownCode::real_time;
  /// Without an error, inputs 112 and 113 show 0, the CLOSE, or what they showed before.
  enum class GoodStatus : std::uint8_t { zero, of_close, stays } good_status = GoodStatus::zero;
  /// True: a wrong operator of VAR_CALCULATE has the error of a wrong operator of IF.
  bool operators_share_error = false;
  /// True: an error in a line is reported at CLOSE; false: in the reply to the line.
  bool faults_show_at_close = false;
  /// True: of several errors the last one is shown; false: the first.
  bool last_error_counts = false;
  /// A line that is refused for its class, its registers or a parameter is omitted, or invalidates the
  /// download.
  enum class RefusedLine : std::uint8_t { is_left_out, spoils } refused_line = RefusedLine::is_left_out;

  bool operator==(const DownloadOptions&) const = default;
};

/// Inputs 110 to 114.
struct DownloadStatus {
  std::uint16_t mp = 0;
  std::uint16_t isr = 0;
  std::uint16_t command = 0;
  std::uint16_t line = 0;
  std::uint16_t error = 0;

  bool operator==(const DownloadStatus&) const = default;
};

/// A macro that is being downloaded. One error counts, the first or the last; a line with an error is not
/// stored.
struct Download {
  MacroName name = {};
  std::vector<Command> lines = {};
  Fault fault = Fault::none;  // the fault that counts
  std::uint16_t code = 0;     // code of its line, as it was sent
  std::uint16_t line = 0;     // number of its line
  bool is_spoilt = false;     // a line was refused

  bool operator==(const Download&) const = default;
};

/// Returns how many lines still fit.
int room_of(const Download& download, const DownloadOptions& options);

/// Adds a line that decode() accepts in this state. Returns the reason if it is refused, otherwise none.
Fault add(Download& download, const Command& command, const DownloadOptions& options = {});
/// Records a line that decode() has refused: undefined commands are download errors.
void refuse(Download& download, std::uint16_t code, Fault fault, const DownloadOptions& options = {});

struct Closed {
  Fault fault = Fault::none;        // of CLOSE itself
  std::optional<Macro> macro = {};  // replaces the old macro if there was no error
};
/// Ends the download. If there is an error, `download` then holds it.
Closed close(Download& download, const DownloadOptions& options = {});

/// Returns what inputs 110 to 114 show after a CLOSE; the number of the other kind of macro does not change.
DownloadStatus status_of(const Download& closed, const DownloadStatus& before,
                         const DownloadOptions& options = {});

}  // namespace understudy::interpreter::rs_m8194h
