#include "emulator/models/rs_m8194h/chip/interrupts.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <tuple>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/chip/axis_unit.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "motion/axis.h"

namespace understudy::emulator::models::rs_m8194h {

void Interrupts::check_factors(std::size_t axis, motion::Events events, Tick tick, std::int64_t pulses) {
  const AxisUnit& unit = chip_.unit(axis);
  const bool is_noted_always = chose(option("factors_noted", "enabled_ones"));
  for (std::size_t i = 0; i < kIsrFactors; ++i) {
    const bool is_asked = (unit.factors >> i & 1) != 0;
    if ((events & motion::bit(kFactorEvents[i])) == 0) continue;
    if (is_asked && (is_noted_always || state_.interrupts)) note_factor(axis, static_cast<Factor>(i));
    if (machine_options().all_factors_are_noted) note_factor(axis, static_cast<Factor>(i));
    if (!is_asked || !state_.interrupts) continue;
    constexpr std::int64_t kMax = kMaxMarks;
    const bool is_counted =
        machine_options().each_pulse_is_an_event && kFactorEvents[i] == motion::Event::pulse;
    const std::int64_t times = is_counted ? std::min(std::abs(pulses), kMax) : 1;
    for (std::int64_t k = 0; k < times; ++k) mark_isr(axis, static_cast<std::uint8_t>(i), tick);
  }
}

void Interrupts::on_synchronous(std::size_t axis, std::size_t noted_axis, Tick tick) {
  note_factor(noted_axis, Factor::synchronous);
  if (state_.interrupts) mark_isr(axis, IsrMark::kSynchronous, tick);
}

void Interrupts::note_factor(std::size_t axis, Factor factor) {
  state_.factor_axes[static_cast<std::size_t>(factor)] |= mask_of(axis);
}

void Interrupts::forget_factor(std::size_t axis, std::size_t factor) {
  state_.factor_axes[factor] &= static_cast<AxisMask>(~mask_of(axis));
}

void Interrupts::note_enabled(std::size_t axis, std::uint8_t source, bool is_on) {
  std::erase(state_.enabled, name_of_source(axis, source));
  if (is_on) state_.enabled.push_back(name_of_source(axis, source));
}

void Interrupts::mark_isr(std::size_t axis, std::uint8_t source, Tick tick) {
  const auto is_same = [&](const IsrMark& mark) { return mark.axis == axis && mark.source == source; };
  const bool is_lost = !language_options().isr_requests_are_counted || state_.marks.size() >= kMaxMarks;
  if (is_lost && std::any_of(state_.marks.begin(), state_.marks.end(), is_same)) return;
  IsrMark made{.tick = tick, .axis = static_cast<std::uint8_t>(axis), .source = source};
  const bool needs_number =
      language_options().isrs_are_bound_at_the_event || language_options().isrs_go_by_number;
  if (needs_number) made.number = static_cast<std::uint8_t>(bound_isr(made));
  const auto& enabled = state_.enabled;
  const auto turn_of = [&](const IsrMark& mark) {
    return std::find(enabled.begin(), enabled.end(), name_of_source(mark.axis, mark.source)) -
           enabled.begin();
  };
  const auto is_before = [&](const IsrMark& one, const IsrMark& other) {
    if (language_options().isrs_go_by_enabling) {
      return std::tuple(one.tick, turn_of(one), one) < std::tuple(other.tick, turn_of(other), other);
    }
    if (language_options().isrs_go_by_number) {
      return std::tie(one.tick, one.number, one.axis, one.source) <
             std::tie(other.tick, other.number, other.axis, other.source);
    }
    if (!language_options().isrs_go_by_factor) return one < other;
    return std::tie(one.tick, one.source, one.axis) < std::tie(other.tick, other.source, other.axis);
  };
  state_.marks.insert(std::upper_bound(state_.marks.begin(), state_.marks.end(), made, is_before), made);
}

void Interrupts::call(int number) {
  state_.marks.push_back({.tick = now(),
                          .axis = kAxes - 1,
                          .source = IsrMark::kCalled,
                          .number = static_cast<std::uint8_t>(number)});
}

bool Interrupts::is_due() const {
  return !state_.marks.empty() && state_.marks.front().tick + language_options().isr_delay_ticks <= now();
}

IsrMark Interrupts::take_mark() {
  const IsrMark mark = state_.marks.front();
  state_.marks.erase(state_.marks.begin());
  return mark;
}

int Interrupts::isr_of(const IsrMark& mark) const {
  return language_options().isrs_are_bound_at_the_event ? mark.number : bound_isr(mark);
}

/// Returns the ISR that a mark calls, according to what is bound and enabled now; 0: none.
int Interrupts::bound_isr(const IsrMark& mark) const {
  const AxisUnit& unit = chip_.unit(mark.axis);
  if (mark.source == IsrMark::kCalled) return mark.number;
  if (!state_.interrupts) return 0;
  if (mark.source == IsrMark::kSynchronous) {
    return chip_.sync().actions[mark.axis].interrupt ? unit.action_isr : 0;
  }
  return (unit.factors >> mark.source & 1) != 0 ? unit.isr_of[mark.source] : 0;
}

}  // namespace understudy::emulator::models::rs_m8194h
