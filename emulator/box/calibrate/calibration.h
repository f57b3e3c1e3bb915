// Finds the options with which a bench replies as a real controller did.
//
// A hypothesis changes the options of some choices. At the first difference, the search tries every other
// option of every choice. It keeps all hypotheses that get further and extends them, so several explanations
// can remain. A choice is called measured only if all of them agree and every other option contradicts a
// reply.
#pragma once

#include <atomic>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "emulator/box/capture/capture.h"
#include "emulator/box/compare/comparison.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::box {

/// A choice of a device, or its firmware, whose options are the versions.
struct ChoiceKey {
  static constexpr std::size_t kFirmware = std::numeric_limits<std::size_t>::max();
  std::size_t device = 0;
  std::size_t row = 0;
  auto operator<=>(const ChoiceKey&) const = default;
};
/// The numbers of the options that differ from the bench's.
using Hypothesis = std::map<ChoiceKey, std::uint8_t>;

struct RowFinding {
  enum class State : std::uint8_t {
    measured,       // every other option contradicts a reply
    undecided,      // several options remain
    not_exercised,  // no reply depends on it
  } state = State::not_exercised;
  ChoiceKey key;
  std::set<std::uint8_t> remaining{};  // options
  std::uint8_t before = 0;             // the bench's option
  /// Where one of the other options contradicts a reply.
  std::optional<std::size_t> capture{};
  std::size_t place = 0;
};

struct Calibration {
  bool explains = false;
  bool is_interrupted = false;           // the findings are only those that are certain by then
  std::vector<Hypothesis> explanations;  // equally good ones, or the one that gets furthest
  std::vector<RowFinding> findings;      // of all choices with several options, in the order of the tables
  std::size_t tried = 0;                 // hypotheses
  double drift_ppm = 0;                  // by which the controller's clock runs faster than the captures'
  // If no hypothesis explains everything: where the best one ends.
  std::size_t capture = 0;
  std::size_t exchange = 0;
  /// Two captures that can be explained separately but not together. They come from different controllers, or
  /// someone changed the controller in between.
  std::optional<std::pair<std::size_t, std::size_t>> contradictory{};
};

struct CalibrateSettings {
  CompareSettings compare{};
  unsigned threads = 0;  // 0: one for each core
};

/// How far a search is. Another thread may read it.
struct CalibrateTally {
  enum class Phase : std::uint8_t {
    explaining,     // looks for options that explain all captures
    trying_each,    // tries each option of each choice with them
    contradicting,  // looks for two captures that no options explain together
  };
  std::atomic<Phase> phase = Phase::explaining;
  std::atomic<std::size_t> tried = 0;      // hypotheses
  std::atomic<std::size_t> planned = 0;    // those that the search knows of by now
  std::atomic<std::size_t> explained = 0;  // exchanges, by the best hypothesis
  std::atomic<std::size_t> captures = 0;   // the same, of which it explains all
};

struct CalibrateWatch {
  /// Asked by several threads. If it returns true, the search ends with what it knows. Empty: nothing does.
  std::function<bool()> is_over{};
  CalibrateTally* tally = nullptr;  // null: nobody reads it
};

Calibration calibrate(const world::Bench& bench, const std::vector<Capture>& captures,
                      const CalibrateSettings& settings, const CalibrateWatch& watch = {});

/// Returns the options that, changed alone, remove the first difference of a capture. Returns none if the
/// search is ended.
std::vector<Hypothesis> remedies(const world::Bench& bench, const Capture& capture,
                                 std::size_t first_difference, const CalibrateSettings& settings,
                                 const CalibrateWatch& watch = {});

std::string option_name(const world::Bench& bench, ChoiceKey key, std::uint8_t number);
std::string choice_id(const world::Bench& bench, ChoiceKey key);

}  // namespace understudy::emulator::box
