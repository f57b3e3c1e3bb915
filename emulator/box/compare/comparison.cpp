#include "emulator/box/compare/comparison.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/compare/judge.h"
#include "emulator/box/compare/replay_bench.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/view/world_view.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator::box {

namespace {

/// A controller that was on before the capture began has finished its start after this time.
constexpr SimTime kStarted = std::chrono::seconds(5);
/// A reply later than this belongs to no request.
constexpr SimTime kLongestWait = std::chrono::seconds(2);

class Fingerprint {
 public:
  void add(const Frame& bytes) {
    for (const std::uint8_t byte : bytes) mix(byte);
    mix(0x100);
  }
  std::uint64_t value() const { return value_; }

 private:
  void mix(std::uint64_t number) { value_ = (value_ ^ number) * 0x100'0000'01B3U; }  // FNV-1a
  std::uint64_t value_ = 0xCBF2'9CE4'8422'2325U;
};

/// Adapters and drivers delay all replies alike. Replies that differ from this usual delay are late or early.
void judge_times(Comparison& comparison, const std::vector<bool>& has_time, SimTime tolerance) {
  std::vector<SimTime> all;
  for (std::size_t i = 0; i < comparison.judgements.size(); ++i)
    if (has_time[i]) all.push_back(comparison.judgements[i].later);
  if (all.empty()) return;
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  comparison.usual_delay = *middle;
  for (std::size_t i = 0; i < comparison.judgements.size(); ++i) {
    Judgement& judgement = comparison.judgements[i];
    if (!has_time[i] || judgement.verdict != Verdict::same) continue;
    const SimTime off = judgement.later - comparison.usual_delay;
    if (off > tolerance) judgement.verdict = Verdict::late;
    if (-off > tolerance) judgement.verdict = Verdict::early;
  }
}

}  // namespace

Comparison compare(const world::Bench& bench, const Capture& capture, const CompareSettings& settings,
                   Extent extent) {
  ReplayBench replay(bench, settings.line);
  Judge judge(settings.from_power_up);
  Comparison comparison;
  Fingerprint fingerprint;
  std::vector<bool> has_time;
  const SimTime shift = settings.from_power_up && capture.notes.begins_at_power_up
                            ? SimTime{0}
                            : kStarted - std::min(kStarted, capture.exchanges.front().at);
  const auto on_bench = [&](SimTime time) {
    const double drift = static_cast<double>(time.count()) * settings.drift_ppm * 1e-6;
    return time + SimTime{static_cast<std::int64_t>(drift)} + shift;
  };
  std::vector<InputChange> inputs = settings.inputs;
  for (InputChange& change : inputs)
    change.at = std::max(SimTime{0}, on_bench(change.at - capture.notes.first_at));
  replay.set_inputs(std::move(inputs));
  for (std::size_t i = 0; i < capture.exchanges.size(); ++i) {
    const Exchange& exchange = capture.exchanges[i];
    const bool is_end = i + 1 == capture.exchanges.size();
    const bool is_last = is_end && !capture.is_cut;
    const SimTime at = on_bench(exchange.at);
    const SimTime next = is_end ? at + kLongestWait : on_bench(capture.exchanges[i + 1].at);
    const BenchReply reply =
        replay.ask(exchange.request, at, std::min(next, at + kLongestWait), settings.tolerance);
    Judgement judgement{.verdict = judge.judge(exchange, reply, replay.bank_of(exchange.request), is_last)};
    fingerprint.add(reply.bytes);
    has_time.push_back(exchange.replied_at.has_value() && reply.at.has_value());
    if (has_time.back()) judgement.later = on_bench(*exchange.replied_at) - *reply.at;
    const bool is_different = judgement.verdict == Verdict::different;
    if (is_different && !comparison.first_difference) {
      comparison.first_difference = i;
      const auto differs = std::ranges::mismatch(exchange.reply, reply.bytes);
      const bool is_text = !pty::rtu_crc_ok(exchange.request);
      if (is_text) comparison.agreeing_bytes = static_cast<std::size_t>(differs.in1 - exchange.reply.begin());
    }
    if (extent == Extent::whole) {
      const world::WorldLine& line = replay.line();
      const auto told = [&](const Frame& bytes) {
        return bytes.empty() ? std::string("no reply") : line.reply_text(exchange.request, bytes);
      };
      judgement.request = line.request_text(exchange.request);
      if (judgement.verdict != Verdict::same) {
        judgement.box = told(exchange.reply);
        judgement.bench = told(reply.bytes);
      }
    }
    comparison.judgements.push_back(std::move(judgement));
    if (is_different && extent == Extent::to_difference) break;
  }
  comparison.fingerprint = fingerprint.value();
  if (extent == Extent::whole) judge_times(comparison, has_time, settings.tolerance);
  return comparison;
}

}  // namespace understudy::emulator::box
