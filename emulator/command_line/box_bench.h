// The input of `compare` and `calibrate`: captures, and a bench that represents the controller.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/files/content_kind.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/compare/comparison.h"
#include "emulator/box/compare/replay_bench.h"
#include "emulator/command_line/commands.h"
#include "emulator/device/model.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::command_line {

struct BoxBench {
  world::Bench bench;
  box::CompareSettings settings;
  box::CaptureSettings reading;
};

/// Reads the bench and all other files in the arguments, but no captures. `command` is used in messages.
/// Throws UsageError and FileError.
BoxBench read_box_bench(ModelList models, const std::string& command, const CompareArguments& arguments);

/// Drops requests to stations that are not on the bench. Modbus TCP masters use station 0 or 255 for a device
/// that is alone at its address.
class StationFilter {
 public:
  explicit StationFilter(const BoxBench& box);

  /// Returns true if the exchange should be judged. It may change the exchange's station number.
  bool keeps(box::Exchange& exchange, box::CaptureNotes& notes);
  /// Throws FileError if no exchange was kept.
  void require_some(const std::string& path) const;

 private:
  const BoxBench& box_;
  box::ReplayBench stations_;
  std::optional<std::uint8_t> only_;  // the number of the only station
  std::set<int> others_;
  bool has_kept_ = false;
};

/// Reads a capture, or a recording as a capture, and passes on its exchanges with stations of the bench.
/// Keeps only one exchange in memory at a time, except for recordings. Throws FileError.
using ExchangeTaker = std::function<void(box::Exchange exchange, const box::CaptureNotes& notes,
                                         const std::vector<box::InputChange>& inputs)>;
box::CaptureNotes take_exchanges(ModelList models, const BoxBench& box, const std::string& path,
                                 const ExchangeTaker& take);
/// Like take_exchanges(), but for a capture that another program is still writing. Ends when the user
/// interrupts it.
box::CaptureNotes follow_exchanges(const BoxBench& box, const std::string& path, const ExchangeTaker& take);
std::vector<box::Capture> read_captures(ModelList models, const BoxBench& box,
                                        const std::vector<std::string>& paths);

/// Returns the notes of a capture's reader as sentences, such as "3 bytes belong to no frame".
std::vector<std::string> notes_text(const box::CaptureNotes& notes);

/// Returns the reason why a command that expects another kind of file refuses a file that begins with `head`,
/// like is_another_kind(). Also recognizes captures of other programs, and suggests the command that accepts
/// them.
std::string why_no_capture_is_expected(std::string_view head, ContentKind expected);

/// Returns the name of a device and the id of a choice, such as "feeder.exceptions".
std::string choice_text(const world::Bench& bench, std::size_t device, const std::string& id);

}  // namespace understudy::emulator::command_line
