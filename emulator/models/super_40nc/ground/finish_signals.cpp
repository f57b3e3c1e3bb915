// The signals at outputs Y0 to Y9, which indicate for some time that a motion or a program has finished.
#include <algorithm>
#include <array>
#include <cstddef>

#include "base/simulated_time.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"

namespace understudy::emulator::models::super_40nc {

namespace {

/// The duration of each signal. Its output is the Y with the same number.
struct FinishSignal {
  StoredRegister time;
  int axis = 0;
};
constexpr std::array<FinishSignal, kSignalCount> kSignals{{{stored_x(d9x::kFinishSignalTime), 0},
                                                           {stored_x(d9x::kFinishSignalTime), 1},
                                                           {stored_x(d9x::kFinishSignalTime), 2},
                                                           {stored_x(d9x::kFinishSignalTime), 3},
                                                           {stored_x(d9x::kEndSignalTime), 0},
                                                           {stored_x(d9x::kEndSignalTime), 1},
                                                           {stored_x(d9x::kEndSignalTime), 2},
                                                           {stored_x(d9x::kEndSignalTime), 3},
                                                           {stored_d(d9::kFinishSignalTime), 0},
                                                           {stored_d(d9::kEndSignalTime), 0}}};

}  // namespace

void Ground::show_finished(std::size_t signal) {
  const FinishSignal& finish = kSignals[signal];
  if (now() < state_.signal_until[signal] && chose(option("fsh_restart", "time_goes_on"))) return;
  state_.signal_until[signal] = now() + 1 + registers().of(finish.time, finish.axis);
}

void Ground::update_signals(Tick tick) {
  for (std::size_t i = 0; i < kSignalCount; ++i) {
    const FinishSignal& signal = kSignals[i];
    if (registers().of(signal.time, signal.axis) == 0) continue;
    const bool is_over = tick >= state_.signal_until[i];
    if (tick > state_.signal_until[i] && shares_signals()) continue;
    state_.image[kFirstY.slot + i] = is_over ? 0 : 1;
  }
}

Tick Ground::next_signal_tick(Tick done) const {
  Tick next = kNever;
  for (std::size_t i = 0; i < kSignalCount; ++i) {
    const bool is_on = state_.image[kFirstY.slot + i] != 0;
    const bool is_system = registers().of(kSignals[i].time, kSignals[i].axis) != 0;
    const bool is_plcs = shares_signals() && state_.signal_until[i] <= done;
    if (is_system && is_on && !is_plcs) next = std::min(next, std::max(done + 1, state_.signal_until[i]));
  }
  return next;
}

}  // namespace understudy::emulator::models::super_40nc
