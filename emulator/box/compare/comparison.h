// Plays a capture against a bench, and judges each reply.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/compare/asked_choices.h"
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
  bool knows_inputs = false;          // all of them; otherwise they follow what replies show
};

/// What may explain the first difference.
struct Surroundings {
  std::vector<AskedChoice> asked;  // the latest first
  std::vector<std::string> state;  // of the bench's device when it had replied
};

struct Judgement {
  Verdict verdict = Verdict::same;
  bool has_times = false;  // true if both replies have a time
  SimTime later{0};        // how much later the reply was than the bench's
  std::string request{};   // in words; only for Extent::whole
  std::string box{};
  std::string bench{};
  std::shared_ptr<const Surroundings> around{};  // of the first difference; only for Extent::whole
};

struct Comparison {
  std::vector<Judgement> judgements;  // one for each exchange, up to the end
  std::optional<std::size_t> first_difference{};
  /// For lines of text: how many characters of the differing reply agree, from its beginning. Such a reply
  /// can differ for several reasons at once.
  std::size_t agreeing_bytes = 0;
  std::uint64_t fingerprint = 0;  // of all that the bench has replied
};

enum class Extent : std::uint8_t {
  to_difference,  // ends at the first difference, and describes no frames
  whole,
};
/// Throws what World throws for settings that a model refuses.
Comparison compare(const world::Bench& bench, const Capture& capture, const CompareSettings& settings,
                   Extent extent);

/// Judges exchanges one by one, in their order. It stores none of them.
class Comparer {
 public:
  /// `notes` and `inputs` are those of the capture, and `first_at` is the time of its first exchange. Throws
  /// what World throws for settings that a model refuses.
  Comparer(const world::Bench& bench, const CompareSettings& settings, const CaptureNotes& notes,
           std::vector<InputChange> inputs, SimTime first_at, Extent extent);

  /// `next` is the time of the next exchange. `is_last`: the capture may end before the reply.
  Judgement judge(const Exchange& exchange, std::optional<SimTime> next, bool is_last);

  std::uint64_t fingerprint() const { return fingerprint_; }
  const std::set<std::string>& taken_inputs() const { return replay_.taken_inputs(); }
  /// Describes the exchange that was judged last.
  std::size_t agreeing_bytes() const { return agreeing_bytes_; }

 private:
  SimTime on_bench(SimTime time) const;
  void note_around(const Exchange& exchange, Judgement& judgement);

  CompareSettings settings_;
  Extent extent_;
  bool knows_beginning_;
  bool takes_inputs_;
  SimTime shift_{0};  // from the capture's time to the bench's
  ReplayBench replay_;
  Judge judge_;
  std::uint64_t fingerprint_;
  std::size_t agreeing_bytes_ = 0;
  std::optional<AskedChoices> asked_;  // up to the first difference; only for Extent::whole
};

/// Tells which replies are late or early. Adapters and drivers delay all replies alike: the usual delay is
/// the median of the first replies. Judgements wait until it is known.
class ReplyTimes {
 public:
  using Sink = std::function<void(const Exchange& exchange, const Judgement& judgement)>;
  /// `samples` is the number of replies from which it takes the usual delay.
  ReplyTimes(SimTime tolerance, std::size_t samples, Sink sink)
      : tolerance_(tolerance), samples_(samples), sink_(std::move(sink)) {}

  void add(Exchange exchange, Judgement judgement);
  void finish();
  SimTime usual_delay() const { return usual_.value_or(SimTime{0}); }

 private:
  void judge(const Exchange& exchange, Judgement& judgement);

  SimTime tolerance_;
  std::size_t samples_;
  Sink sink_;
  std::vector<std::pair<Exchange, Judgement>> waiting_;
  std::vector<SimTime> delays_;
  std::optional<SimTime> usual_;
};
/// Enough for the capture of a whole evening, and small enough to hold in memory.
inline constexpr std::size_t kDelaySamples = 1000;

}  // namespace understudy::emulator::box
