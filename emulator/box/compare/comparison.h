// Plays a capture against a bench, and judges each reply.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/compare/input_log.h"
#include "emulator/box/compare/judge.h"
#include "emulator/box/compare/replay_bench.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::box {

struct CompareSettings {
  std::size_t line = 0;  // of the bench
  SimTime tolerance{0};
  bool from_power_up = false;         // the capture's time 0 is the controller's power-up
  double drift_ppm = 0;               // by which the controller's clock runs faster than the capture's
  std::vector<InputChange> inputs{};  // by the capture's clock
};

struct Judgement {
  Verdict verdict = Verdict::same;
  SimTime later{0};       // how much later the reply was than the bench's
  std::string request{};  // in words; only for Extent::whole
  std::string box{};
  std::string bench{};
};

struct Comparison {
  std::vector<Judgement> judgements;  // one for each exchange, up to the end
  std::optional<std::size_t> first_difference{};
  /// Of lines of text: how many characters at the beginning of the reply that differs agree. Such a reply may
  /// differ for several reasons at once.
  std::size_t agreeing_bytes = 0;
  SimTime usual_delay{0};         // of a reply, compared to the bench's
  std::uint64_t fingerprint = 0;  // of all that the bench has replied
};

enum class Extent : std::uint8_t {
  to_difference,  // ends at the first difference, and describes no frames
  whole,
};
/// Throws what World throws for settings that a model refuses.
Comparison compare(const world::Bench& bench, const Capture& capture, const CompareSettings& settings,
                   Extent extent);

}  // namespace understudy::emulator::box
