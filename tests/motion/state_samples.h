// A value of every type that motion can save, taken in the middle of its work, and functions that continue
// the work.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "motion/bad_motion.h"
#include "motion/external_drive.h"
#include "motion/following.h"
#include "motion/state.h"
#include "motion/synchronous.h"
#include "tests/motion/coordinated_bench.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {

/// Advances a value by one tick, and returns its output as numbers.
using Output = std::vector<double>;

inline Output go_on(Axis& axis, Tick tick) {
  Environment environment;
  environment.add(Signal::home, 100, 120);
  environment.index_period = 400;
  const std::int64_t pulses = axis.step(tick, environment);
  return {static_cast<double>(pulses), static_cast<double>(axis.events), axis.sample(tick).speed_u_s};
}

inline Output go_on(PathRun& run, Tick tick) {
  const Point place = run.step(tick);
  return {place[0],
          place[1],
          place[2],
          place[3],
          static_cast<double>(run.completed()),
          run.sample(tick).speed_u_s};
}

inline Output go_on(Coordinated& group, Tick tick) {
  // Axes at the positions of the group: only the group's own state is tested here.
  std::array<Axis, 4> axes;
  for (Axis& axis : axes) {
    axis.switch_servo(true);
    axis.take_part();
    axis.step(tick - 1, {});
  }
  std::array<Environment, 4> environment{};
  std::array<std::int64_t, 4> pulses{};
  group.step(tick, axes, environment, pulses);
  Output all;
  for (const std::int64_t one : pulses) all.push_back(static_cast<double>(one));
  all.push_back(group.engaged ? 1 : 0);
  return all;
}

inline Output go_on(ExternalDrive& drive, Tick tick) {
  const DriveOrder order = watch_inputs(drive, tick % 3 == 0, tick % 5 < 2, tick % 7 < 3);
  return {static_cast<double>(order.what), static_cast<double>(order.pulses),
          static_cast<double>(order.direction)};
}

inline Output go_on(Follower& follower, Tick tick) {
  follower.feed(tick % 11 - 4);
  return {static_cast<double>(follower.step())};
}

inline Output go_on(Profile& profile, Tick tick) {
  const Sample sample = profile.sample(static_cast<double>(tick) * 1e-3);
  return {sample.position_u, sample.speed_u_s, sample.acceleration_u_s2};
}

inline Output go_on(PulseDrive& drive, Tick tick) {
  const std::int64_t pulses = drive.moving() ? drive.step(tick) : 0;
  return {static_cast<double>(pulses), drive.sample({.tick = tick}).speed_u_s};
}

inline Output go_on(Environment& environment, Tick tick) {
  const auto next = environment.steps_until_change(tick * 7 - 1000, tick % 2 == 0 ? 1 : -1);
  return {static_cast<double>(environment.at(tick * 7 - 1000)), static_cast<double>(next.value_or(-1))};
}

/// Collects the outputs and interrupts of a tick's actions.
struct ActingOwner final : EdgeOwner {
  explicit ActingOwner(SyncTable& acting) : table(acting) {}
  void at_edge(SharedTick& now, std::size_t axis, Events events) override {
    const SyncOutcome outcome = act(table, axis, events, now);
    outputs |= outcome.outputs;
    interrupts |= outcome.interrupts;
  }
  SyncTable& table;
  std::uint8_t outputs = 0;
  std::uint8_t interrupts = 0;
};

inline Output go_on(SyncTable& table, Tick tick) {
  std::array<Axis, 4> axes;
  std::array<Environment, 4> environment;
  std::array<std::int64_t, 4> pulses{};
  for (std::size_t i = 0; i < axes.size(); ++i) {
    axes[i].switch_servo(true);
    axes[i].run(i % 2 == 0 ? 1 : -1, by_slope(1000, 1e6), tick - 1);
  }
  ActingOwner owner(table);
  step_together({tick, axes, environment, pulses}, 0b1111, nullptr, &owner);
  Output all{static_cast<double>(owner.outputs), static_cast<double>(owner.interrupts)};
  for (const Axis& axis : axes) all.push_back(axis.moving() ? axis.sample(tick + 1).speed_u_s : -1);
  return all;
}

inline constexpr Tick kSampledAt = 137;  // the last tick that was stepped

template <class T>
T sample_of();

template <>
inline Profile sample_of<Profile>() {
  return plan(5000, {.start_speed_u_s = 10,
                     .top_speed_u_s = 12'000,
                     .up = RampLaw::by_jerk(1e6),
                     .down = RampLaw::by_sections(50'000, 500)});
}

template <>
inline PulseDrive sample_of<PulseDrive>() {
  PulseDrive drive;
  drive.start(sample_of<Profile>(), -1, Instant{.tick = 3, .after_s = 0.00025});
  for (Tick tick = 4; tick <= kSampledAt; ++tick) drive.step(tick);
  return drive;
}

template <>
inline Environment sample_of<Environment>() {
  Environment environment;
  environment.add(Signal::limit_plus, 5000, 9000);
  environment.add(Signal::home, -50, 50);
  environment.add(Signal::near_home, -500, 500);
  environment.set_steady(Signal::in_position, true);
  environment.index_period = 4000;
  environment.index_at = 17;
  environment.index_width = 3;
  environment.encoder = {.counts = 10'000,
                         .pulses = 3600,
                         .origin = -17,
                         .first = -90'000,
                         .last = 90'000,
                         .mirrored = true,
                         .reversed = true,
                         .surplus = 5,
                         .factor = 4,
                         .zero = 33,
                         .divider = 2,
                         .turned = true};
  return environment;
}

template <>
inline Follower sample_of<Follower>() {
  Follower follower{.numerator = -7,
                    .denominator = 3,
                    .period_ticks = 10,
                    .top_speed_pps = 900,
                    .slope_pps = 700,
                    .catches_up = true};
  for (Tick tick = 1; tick <= kSampledAt; ++tick) go_on(follower, tick);
  return follower;
}

template <>
inline ExternalDrive sample_of<ExternalDrive>() {
  ExternalDrive drive{.mode = ExternalDrive::Mode::continuous, .pulses = 100};
  for (Tick tick = 1; tick <= kSampledAt; ++tick) go_on(drive, tick);
  return drive;
}

template <>
inline PathRun sample_of<PathRun>() {
  PathRun run;
  run.set_speed({.start_speed_u_s = 5,
                 .top_speed_u_s = 900,
                 .up = RampLaw::by_jerk(1e5),
                 .down = RampLaw::by_slope(5000),
                 .slow_down_reckoned_by = RampLaw::by_slope(5000)},
                0);
  const Shape arc = Shape::arc(place_of(0, 0), place_of(0, 60), 2.5, 20);
  run.append(arc.path(), kJoin, 0);
  run.append(line(arc.end, place_of(10, -20, 30, -40)), kJoin, 0);
  run.append(spiral(place_of(10, -20, 30, -40), place_of(0, 0, 30, -40), 9, 2), kStop, 0);
  run.start(0);
  for (Tick tick = 1; tick <= kSampledAt; ++tick) {
    run.step(tick);
    if (tick == 50) run.set_override(0.8, 50);
    if (tick == 100) run.pause(100);
    if (tick == 130) run.resume(130);
  }
  return run;
}

template <>
inline Coordinated sample_of<Coordinated>() {
  Bench bench(by_slope(900, 5000));
  bench.group.axis_of = {2, 0, 3, Coordinated::kNone};
  bench.group.scale = {UnitScale{8, 5}, UnitScale{3, 7}, UnitScale{1, 1}, UnitScale{1, 1}};
  bench.add(Shape::arc(place_of(0, 0), place_of(0, 60), 2.5, 20).path());
  bench.begin();
  bench.steps(static_cast<int>(kSampledAt));
  return bench.group;
}

template <>
inline SyncTable sample_of<SyncTable>() {
  SyncTable table;
  table.speeds.fill(by_slope(3000, 10'000));
  table.distance_pulses = {10, 20, 30, 40};
  table.triggers[0] = {.factors = 0xFF, .activates = 0b1111};
  table.triggers[2] = {.factors = 0x10, .activates = 0b0110};
  table.actions[0] = {.drive = SyncAction::Drive::stop_at_once, .latch_command = true};
  table.actions[1] = {.preset = SyncAction::Preset::speed, .preset_value = 77, .output = true};
  table.actions[2] = {.drive = SyncAction::Drive::slow_down, .latch_encoder = true, .interrupt = true};
  go_on(table, kSampledAt);
  return table;
}

template <>
inline Axis sample_of<Axis>() {
  Axis axis;
  AxisSettings settings;
  settings.soft_limit_plus = 4000;
  settings.soft_limit_minus = -4000;
  settings.backlash_pulses = 12;
  settings.backlash_speed_pps = 2000;
  axis.set(settings);
  axis.switch_servo(true);
  axis.set_comparator(0, {.relation = Comparator::Relation::at_least, .value = 150});
  axis.set_comparator(1, {.relation = Comparator::Relation::equal,
                          .counter = {.range = Counter::Range::ring, .ring_top = 99, .offset = 7},
                          .value = 33});
  axis.set_encoder(55);
  axis.move(5, by_slope(1000, 1e6), 0);
  for (Tick tick = 1; tick <= 20; ++tick) go_on(axis, tick);
  axis.move(-900,
            {.start_speed_u_s = 100,
             .top_speed_u_s = 6000,
             .up = RampLaw::by_sections(40'000, 700),
             .down = RampLaw::by_time(0.05)},
            20);
  for (Tick tick = 21; tick <= kSampledAt; ++tick) {
    go_on(axis, tick);
    if (tick == 90) axis.change_speed(by_slope(2000, 30'000), 90);
  }
  return axis;
}

}  // namespace understudy::motion
