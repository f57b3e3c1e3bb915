// The download of a macro, line by line: what each line may be, and what inputs 110 to 114 show behind it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/macro.h"

namespace understudy::interpreter::rs_m8194h {

/// What the manual leaves open about downloads.
struct DownloadOptions {
  /// CLOSE takes a line of the macro.
  bool close_takes_line = false;
  /// Seven levels of FOR and IF together.
  bool levels_are_of_both = false;
  /// GOTO leaves the blocks around it, or is refused there.
  bool goto_stays_in_its_block = false;
  /// Input 112 shows a line's code as 0x0Axx, as the worked example does, or as it was sent.
  enum class ShownCode : std::uint8_t { real_time, as_sent } shown_code = ShownCode::real_time;
  /// What inputs 112 and 113 show without an error.
  enum class GoodStatus : std::uint8_t { zero, of_close, stays } good_status = GoodStatus::zero;
  /// A wrong operator of VAR_CALCULATE has the error of those of IF.
  bool operators_share_error = false;
  /// A line with an error is told of it, or CLOSE is.
  bool faults_show_at_close = false;
  /// Of several errors the last one is shown, not the first.
  bool last_error_counts = false;
  /// A line that is refused for its class, its registers or a parameter is left out, or spoils the download.
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

/// A macro on its way. One error counts, the first or the last; a line with an error is not stored.
struct Download {
  MacroName name = {};
  std::vector<Command> lines = {};
  Fault fault = Fault::none;  // the one that counts
  std::uint16_t code = 0;     // of the line with it, as it was sent
  std::uint16_t line = 0;     // its number
  bool is_spoilt = false;     // by a line that was refused

  bool operator==(const Download&) const = default;
};

/// Lines that still fit.
int room_of(const Download& download, const DownloadOptions& options);

/// A line that decode() takes in this state. Anything but none is the reason of its refusal.
Fault add(Download& download, const Command& command, const DownloadOptions& options = {});
/// A line that decode() has refused: undefined commands are download errors.
void refuse(Download& download, std::uint16_t code, Fault fault, const DownloadOptions& options = {});

struct Closed {
  Fault fault = Fault::none;        // of CLOSE itself
  std::optional<Macro> macro = {};  // takes the old one's place, if there was no error at all
};
/// What CLOSE finds. It ends the download in any case; the error, if any, is then in `download`.
Closed close(Download& download, const DownloadOptions& options = {});

/// What inputs 110 to 114 show behind a CLOSE; the number of the other kind of macro stays.
DownloadStatus status_of(const Download& closed, const DownloadStatus& before,
                         const DownloadOptions& options = {});

}  // namespace understudy::interpreter::rs_m8194h
