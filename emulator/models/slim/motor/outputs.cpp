#include "emulator/models/slim/motor/outputs.h"

#include <algorithm>
#include <cmath>

#include "base/simulated_time.h"

namespace understudy::emulator::models::slim {

namespace {

constexpr double kTicksPerSecond = 1000;
constexpr double kFastestShown_hz = kTicksPerSecond / 2;
/// A duration that is slightly longer than a whole number of ticks, because of a division, counts as that
/// number.
constexpr double kTolerance_ticks = 1e-6;

bool varies(const Output& output) {
  return output.frequency_hz <= kFastestShown_hz && output.duty_percent > 0 && output.duty_percent < 100;
}

/// Returns the first tick, counted from the start of period 0, at or after the end of `periods` periods.
double tick_of(const Output& output, double periods) {
  return std::ceil(periods * kTicksPerSecond / output.frequency_hz - kTolerance_ticks);
}

/// Returns the period that contains tick `k`.
double period_of(const Output& output, double k) {
  double period = std::floor(k * output.frequency_hz / kTicksPerSecond);
  if (tick_of(output, period + 1) <= k) ++period;
  if (tick_of(output, period) > k) --period;
  return period;
}

}  // namespace

bool Output::level_at(Tick tick) const {
  if (mode != Mode::level && tick < since) return on;
  switch (mode) {
    case Mode::level: return on;
    case Mode::pulse: return tick < since + width;
    case Mode::pwm: break;
  }
  if (!varies(*this)) return duty_percent >= 50;
  const auto k = static_cast<double>(tick - since);
  return k < tick_of(*this, period_of(*this, k) + duty_percent / 100);
}

Tick Output::next_change(Tick done) const {
  if (mode != Mode::level && done < since) {
    const bool changes = level_at(since) != on;
    return changes ? since : next_change(since);
  }
  if (mode == Mode::pulse && done < since + width) return since + width;
  if (mode != Mode::pwm || !varies(*this)) return kNever;
  const auto k = static_cast<double>(done - since);
  const double period = period_of(*this, k);
  const double off = tick_of(*this, period + duty_percent / 100);
  const double next = k < off ? off : tick_of(*this, period + 1);
  return since + std::max(static_cast<Tick>(next), done - since + 1);
}

void carry_out(Output& output, const OutputOrder& order, Tick begin_at) {
  const bool before = output.level_at(begin_at - 1);
  switch (order.kind) {
    case OutputOrder::Kind::set: output = {.on = true}; break;
    case OutputOrder::Kind::clear: output = {}; break;
    case OutputOrder::Kind::toggle: output = {.on = !output.level_at(begin_at)}; break;
    case OutputOrder::Kind::pulse:
      output = {.mode = Output::Mode::pulse, .on = before, .since = begin_at, .width = order.width};
      break;
    case OutputOrder::Kind::pwm:
      output = {.mode = Output::Mode::pwm,
                .on = before,
                .since = begin_at,
                .frequency_hz = order.frequency_hz,
                .duty_percent = order.duty_percent};
      break;
    case OutputOrder::Kind::all:
    case OutputOrder::Kind::arm: break;  // handled by the module
  }
}

}  // namespace understudy::emulator::models::slim
