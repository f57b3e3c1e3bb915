// The input of `compare` and `calibrate`: captures, and a bench that stands for the controller.
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

/// Reads the bench and everything else that the arguments name, but no capture. `command` is for messages.
/// Throws UsageError and FileError.
BoxBench read_box_bench(ModelList models, const std::string& command, const CompareArguments& arguments);

/// Takes out requests to stations that the bench does not have. Masters of Modbus TCP call a device that is
/// alone at its address 0 or 255.
class StationFilter {
 public:
  explicit StationFilter(const BoxBench& box);

  /// Returns true if the exchange is to be judged. It may change the number of its station.
  bool keeps(box::Exchange& exchange, box::CaptureNotes& notes);
  /// Throws FileError if nothing was kept.
  void require_some(const std::string& path) const;

 private:
  const BoxBench& box_;
  box::ReplayBench stations_;
  std::optional<std::uint8_t> only_;  // the number of the only station
  std::set<int> others_;
  bool has_kept_ = false;
};

/// Reads a capture, or takes a recording as one, and hands on its exchanges with stations of the bench. It
/// holds no more than one of them, unless it is a recording. Throws FileError.
using ExchangeTaker = std::function<void(box::Exchange exchange, const box::CaptureNotes& notes,
                                         const std::vector<box::InputChange>& inputs)>;
box::CaptureNotes take_exchanges(ModelList models, const BoxBench& box, const std::string& path,
                                 const ExchangeTaker& take);
/// Like take_exchanges(), with a capture that another program writes, until it is interrupted.
box::CaptureNotes follow_exchanges(const BoxBench& box, const std::string& path, const ExchangeTaker& take);
std::vector<box::Capture> read_captures(ModelList models, const BoxBench& box,
                                        const std::vector<std::string>& paths);

/// Returns what the reader of a capture has noticed, in sentences: "3 bytes belong to no frame".
std::vector<std::string> notes_text(const box::CaptureNotes& notes);

/// Returns why a command that wants another kind of file refuses one that begins with `head`, like
/// is_another_kind(). It knows captures of other programs, too, and says which command takes them.
std::string why_no_capture_is_expected(std::string_view head, ContentKind expected);

/// Returns "feeder" and the id of a choice: "feeder.exceptions".
std::string choice_text(const world::Bench& bench, std::size_t device, const std::string& id);

}  // namespace understudy::emulator::command_line
