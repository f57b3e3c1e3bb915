// Finds the options with which a bench replies as a real controller did.
//
// A hypothesis changes the options of some choices. At the first difference, the search tries every other
// option of every choice. It keeps all hypotheses that get further and extends them, so several explanations
// can remain. A choice is called measured only if all of them agree and every other option contradicts a
// reply.
#pragma once

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

/// Receives the number of hypotheses tried so far; `what` is always empty.
using CalibrateProgress = std::function<void(std::size_t tried, const std::string& what)>;

Calibration calibrate(const world::Bench& bench, const std::vector<Capture>& captures,
                      const CalibrateSettings& settings, const CalibrateProgress& progress);

/// Estimates from the motions how much faster the controller's clock is than the capture's, in parts per
/// million: the value with which the bench agrees for longest. Returns 0 if no value helps.
double fit_drift(const world::Bench& bench, const Capture& capture, const CompareSettings& settings);

/// Returns the options that, changed alone, remove the first difference of a capture.
std::vector<Hypothesis> remedies(const world::Bench& bench, const Capture& capture,
                                 std::size_t first_difference, const CalibrateSettings& settings);

std::string option_name(const world::Bench& bench, ChoiceKey key, std::uint8_t number);
std::string choice_id(const world::Bench& bench, ChoiceKey key);

}  // namespace understudy::emulator::box
