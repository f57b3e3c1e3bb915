#include "emulator/models/rs_m8194h/programs/frnet.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "emulator/models/rs_m8194h/rows/terminals.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

/// The duration of a scan, 2.88 ms (1.1), in units of 10 us.
constexpr Tick kScanUnits = 288;
constexpr Tick kTickUnits = 100;

}  // namespace

std::uint16_t Frnet::word(std::uint32_t group) const {
  const auto number = static_cast<std::size_t>(group % kFrnetGroups);
  return group < kFrnetGroups ? state_.outputs[number] : state_.inputs[number];
}

void Frnet::write_bit(std::size_t group, std::size_t channel, bool is_on) {
  std::uint16_t& word = state_.outputs[group];
  const auto bit = static_cast<std::uint16_t>(1U << channel);
  word = static_cast<std::uint16_t>(is_on ? word | bit : word & ~bit);
}

bool Frnet::scans_at(Tick tick) const {
  if (machine_options().frnet_every_tick) return true;
  const Tick since = tick - state_.powered_at;
  if (since <= 0) return false;
  const Tick in_round = (since - 1) % kScanUnits + 1;  // 288 ticks are exactly 100 scans
  return in_round * kTickUnits / kScanUnits > (in_round - 1) * kTickUnits / kScanUnits;
}

Tick Frnet::next_active_tick(Tick done) const {
  if (!state_.unscanned && state_.sent == state_.outputs) return kNever;
  for (Tick tick = std::max(done, state_.powered_at) + 1;; ++tick) {
    if (scans_at(tick)) return tick;
  }
}

FrnetWords Frnet::words_now() const {
  FrnetWords words{};
  for (int group = 0; group < kFrnetGroups; ++group) {
    std::uint16_t word = 0;
    for (int channel = 0; channel < kFrnetChannels; ++channel) {
      const bool is_on = input(kFirstDi + group * kFrnetChannels + channel) != 0;
      if (is_on) word |= static_cast<std::uint16_t>(1U << channel);
    }
    words[static_cast<std::size_t>(group)] = word;
  }
  return words;
}

void Frnet::scan() {
  state_.sent = state_.outputs;
  if (state_.unscanned) state_.inputs = words_now();
  state_.unscanned = false;
}

void Frnet::scan_first() {
  state_.unscanned = true;
  scan();
}

}  // namespace understudy::emulator::models::rs_m8194h
