#include "emulator/box/compare/comparison.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
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

constexpr std::uint64_t kFingerprintBasis = 0xCBF2'9CE4'8422'2325U;

/// FNV-1a
std::uint64_t mixed(std::uint64_t fingerprint, const Frame& bytes) {
  const auto mix = [&](std::uint64_t number) { fingerprint = (fingerprint ^ number) * 0x100'0000'01B3U; };
  for (const std::uint8_t byte : bytes) mix(byte);
  mix(0x100);
  return fingerprint;
}

}  // namespace

Comparer::Comparer(const world::Bench& bench, const CompareSettings& settings, const CaptureNotes& notes,
                   std::vector<InputChange> inputs, SimTime first_at, Extent extent)
    : settings_(settings),
      extent_(extent),
      knows_beginning_(settings.from_power_up || notes.knows_beginning),
      takes_inputs_(!settings.knows_inputs && !notes.knows_beginning),
      shift_(knows_beginning_ && notes.begins_at_power_up ? SimTime{0}
                                                          : kStarted - std::min(kStarted, first_at)),
      replay_(bench, settings.line),
      judge_(knows_beginning_),
      fingerprint_(kFingerprintBasis) {
  inputs.insert(inputs.end(), settings_.inputs.begin(), settings_.inputs.end());
  std::ranges::stable_sort(inputs, {}, &InputChange::at);
  for (InputChange& change : inputs) change.at = std::max(SimTime{0}, on_bench(change.at - notes.first_at));
  replay_.set_inputs(std::move(inputs));
  if (extent_ == Extent::whole) asked_.emplace(replay_.line());
}

SimTime Comparer::on_bench(SimTime time) const {
  const double drift = static_cast<double>(time.count()) * settings_.drift_ppm * 1e-6;
  return time + SimTime{static_cast<std::int64_t>(drift)} + shift_;
}

Judgement Comparer::judge(const Exchange& exchange, std::optional<SimTime> next, bool is_last) {
  const SimTime at = on_bench(exchange.at);
  const SimTime end = next ? std::min(on_bench(*next), at + kLongestWait) : at + kLongestWait;
  std::vector<std::uint16_t> shown;
  const auto asked = takes_inputs_ ? addressed_by(exchange.request) : std::nullopt;
  if (asked && !asked->is_write) shown = words_in(*asked, exchange.request, exchange.reply);
  const BenchReply reply = replay_.ask(exchange.request, at, end, settings_.tolerance, shown);
  Judgement judgement{.verdict = judge_.judge(exchange, reply, replay_.bank_of(exchange.request), is_last),
                      .has_times = exchange.replied_at.has_value() && reply.at.has_value()};
  fingerprint_ = mixed(fingerprint_, reply.bytes);
  if (judgement.has_times) judgement.later = on_bench(*exchange.replied_at) - *reply.at;
  const auto differs = std::ranges::mismatch(exchange.reply, reply.bytes);
  const bool is_text = judgement.verdict == Verdict::different && !pty::rtu_crc_ok(exchange.request);
  agreeing_bytes_ = is_text ? static_cast<std::size_t>(differs.in1 - exchange.reply.begin()) : 0;
  if (extent_ == Extent::to_difference) return judgement;
  if (asked_) note_around(exchange, judgement);
  const world::WorldLine& line = replay_.line();
  const auto reported = [&](const Frame& bytes) {
    return bytes.empty() ? std::string("no reply") : line.reply_text(exchange.request, bytes);
  };
  judgement.request = line.request_text(exchange.request);
  if (judgement.verdict == Verdict::same) return judgement;
  judgement.box = reported(exchange.reply);
  judgement.bench = reported(reply.bytes);
  return judgement;
}

void Comparer::note_around(const Exchange& exchange, Judgement& judgement) {
  asked_->note(exchange.place);
  if (judgement.verdict == Verdict::undecidable) return;  // it may be different
  if (judgement.verdict != Verdict::different) return asked_->agree();
  judgement.around = std::make_shared<const Surroundings>(
      Surroundings{.asked = asked_->latest_first(), .state = replay_.state_text(exchange.request)});
  asked_.reset();
}

void ReplyTimes::add(Exchange exchange, Judgement judgement) {
  if (usual_) {
    judge(exchange, judgement);
    return;
  }
  if (judgement.has_times) delays_.push_back(judgement.later);
  waiting_.emplace_back(std::move(exchange), std::move(judgement));
  if (delays_.size() >= samples_) finish();
}

void ReplyTimes::finish() {
  if (!usual_ && !delays_.empty()) {
    const auto middle = delays_.begin() + static_cast<std::ptrdiff_t>(delays_.size() / 2);
    std::nth_element(delays_.begin(), middle, delays_.end());
    usual_ = *middle;
  }
  for (auto& [exchange, judgement] : std::exchange(waiting_, {})) judge(exchange, judgement);
}

void ReplyTimes::judge(const Exchange& exchange, Judgement& judgement) {
  if (judgement.has_times && judgement.verdict == Verdict::same) {
    const SimTime off = judgement.later - usual_delay();
    if (off > tolerance_) judgement.verdict = Verdict::late;
    if (-off > tolerance_) judgement.verdict = Verdict::early;
  }
  sink_(exchange, judgement);
}

Comparison compare(const world::Bench& bench, const Capture& capture, const CompareSettings& settings,
                   Extent extent) {
  const std::vector<Exchange>& exchanges = capture.exchanges;
  Comparer comparer(bench, settings, capture.notes, capture.inputs, exchanges.front().at, extent);
  Comparison comparison;
  for (std::size_t i = 0; i < exchanges.size(); ++i) {
    const bool is_end = i + 1 == exchanges.size();
    const std::optional<SimTime> next = is_end ? std::nullopt : std::optional(exchanges[i + 1].at);
    comparison.judgements.push_back(comparer.judge(exchanges[i], next, is_end && !capture.is_cut));
    const bool is_different = comparison.judgements.back().verdict == Verdict::different;
    if (is_different && !comparison.first_difference) {
      comparison.first_difference = i;
      comparison.agreeing_bytes = comparer.agreeing_bytes();
    }
    if (is_different && extent == Extent::to_difference) break;
  }
  comparison.fingerprint = comparer.fingerprint();
  return comparison;
}

}  // namespace understudy::emulator::box
