#include "motion/homing_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "motion/bad_motion.h"
#include "motion/environment.h"
#include "motion/homing.h"
#include "motion/ramp.h"

namespace understudy::motion {

namespace {

using Does = HomingPhase::Does;
using Then = HomingPhase::Then;
constexpr std::int8_t kFail = HomingPhase::kFail;
constexpr std::int8_t kNext = HomingPhase::kNext;
constexpr std::int8_t kAwait = HomingPhase::kAwait;

// Indices of a program's speed laws.
constexpr std::int8_t kFast = 0;
constexpr std::int8_t kCreep = 1;

std::int8_t sign(int direction) { return direction < 0 ? std::int8_t{-1} : std::int8_t{+1}; }
std::int8_t opposite(int direction) { return direction < 0 ? std::int8_t{+1} : std::int8_t{-1}; }
Signal limit_towards(int direction) { return direction < 0 ? Signal::limit_minus : Signal::limit_plus; }

HomingProgram hanging(int direction) {
  HomingProgram program;
  program.add({.does = Does::move_at_zero_speed, .direction = sign(direction)});
  return program;
}

// ---- SUPER-40NC

enum class At : std::uint8_t { dog, limit };

/// The step after the DOG or the limit.
enum class After : std::uint8_t { nothing, edge_again, off_again, index };
enum class Direction : std::uint8_t { on, back };
enum class Law : std::uint8_t { fast, creep };

struct Mode {
  At at;      // the target of the search at Vh
  Then then;  // how the axis stops there
  After after;
  Direction direction;
  Law law;
  Then then_2;
  bool zero;  // ends with a move to COUNTER2 = 0, the reference
};

constexpr Then kStop = Then::stop_at_once;
constexpr Then kSlowDown = Then::slow_down;
constexpr Then kRunOn = Then::run_on;

// clang-format off
constexpr std::array<Mode, 13> kModes{{
    // at        then       after              direction        law         then       to zero
    {At::dog,   kSlowDown, After::nothing,    Direction::on,   Law::fast,  kStop,     false},  // 0
    {At::dog,   kSlowDown, After::edge_again, Direction::on,   Law::creep, kStop,     false},  // 1
    {At::dog,   kRunOn,    After::index,      Direction::on,   Law::creep, kStop,     false},  // 2
    {At::dog,   kRunOn,    After::index,      Direction::on,   Law::fast,  kSlowDown, false},  // 3
    {At::dog,   kSlowDown, After::index,      Direction::back, Law::creep, kStop,     false},  // 4
    {At::dog,   kSlowDown, After::index,      Direction::back, Law::fast,  kSlowDown, false},  // 5
    {At::limit, kSlowDown, After::off_again,  Direction::back, Law::creep, kStop,     false},  // 6
    {At::limit, kSlowDown, After::index,      Direction::back, Law::creep, kStop,     false},  // 7
    {At::limit, kSlowDown, After::index,      Direction::back, Law::fast,  kSlowDown, false},  // 8
    {At::dog,   kSlowDown, After::nothing,    Direction::on,   Law::fast,  kStop,     true},   // 9
    {At::dog,   kRunOn,    After::index,      Direction::on,   Law::fast,  kSlowDown, true},   // 10
    {At::dog,   kSlowDown, After::index,      Direction::back, Law::fast,  kSlowDown, true},   // 11
    {At::limit, kSlowDown, After::index,      Direction::back, Law::fast,  kSlowDown, true},   // 12
}};
// clang-format on

const Mode& mode_row(int mode) {
  if (mode < 0 || mode > 12) {
    throw BadMotion(Refusal::out_of_range, "homing", "mode must be 0 to 12; it is " + std::to_string(mode));
  }
  return kModes[static_cast<std::size_t>(mode)];
}

}  // namespace

bool super40nc_homes_by_limit(int mode) { return mode_row(mode).at == At::limit; }

HomingProgram super40nc_homing(const Super40ncHoming& how) {
  const Mode& mode = mode_row(how.mode);
  const std::int8_t on = sign(how.direction);
  const std::int8_t back = opposite(how.direction);
  HomingProgram program{.speeds = {how.fast, how.creep}};

  if (mode.at == At::dog) {
    program.add({.does = Does::go,
                 .speed = how.leaves_fast ? kFast : kCreep,
                 .again_while = bit(Signal::home),
                 .distance_pulses = back * std::max<std::int64_t>(how.leave_pulses, 1)});
  }
  const std::int8_t search = program.phase_count;
  const bool at_once = mode.at == At::limit && how.limit_stops_at_once;
  // Beyond the switch, an index search would start in the wrong place (note of 《X32.》; not modes 0 and 9).
  const bool must_stay = mode.then == kSlowDown && mode.after != After::nothing;
  program.add({.direction = on,
               .speed = kFast,
               .until = mode.at == At::dog ? Signal::home : limit_towards(how.direction),
               .then = at_once ? kStop : mode.then,
               .marks = mode.after == After::nothing,
               .if_gone = must_stay && !how.plate_may_be_short ? kFail : kNext});

  const std::int8_t law = mode.law == Law::fast ? kFast : kCreep;
  switch (mode.after) {
    case After::nothing: break;
    case After::edge_again:
      program.add({.direction = back, .speed = law, .until = Signal::home, .until_on = false, .then = kStop});
      program.add({.direction = on, .speed = law, .until = Signal::home, .then = mode.then_2, .marks = true});
      break;
    case After::off_again:
      program.add({.direction = back,
                   .speed = law,
                   .until = limit_towards(how.direction),
                   .until_on = false,
                   .then = mode.then_2,
                   .marks = true});
      break;
    case After::index:
      program.add({.direction = mode.direction == Direction::on ? on : back,
                   .speed = law,
                   .until = Signal::index,
                   .then = mode.then_2,
                   .marks = true,
                   .count = how.index_count,
                   .if_already = kAwait});
      break;
  }
  const std::int8_t last = how.offset_creeps ? kCreep : kFast;
  if (mode.zero) program.add({.does = Does::go_back, .speed = last});
  program.add({.does = Does::go, .speed = last, .distance_pulses = how.offset_pulses});
  if (mode.at != At::dog || !how.turns_at_limit) return program;
  // An extra row after the last one passes the DOG and repeats the search. It is skipped if home is found.
  const std::int8_t past = program.phase_count;
  program.phases[static_cast<std::size_t>(search)].if_limit = past;
  program.phases[static_cast<std::size_t>(past - 1)].next = static_cast<std::int8_t>(past + 1);
  program.add({.direction = back,
               .speed = kFast,
               .until = Signal::home,
               .until_on = false,
               .next = search,
               .if_already = HomingPhase::kAwait});
  return program;
}

HomingProgram super40nc_mark(const Super40ncMark& how) {
  if (how.search_pulses == 0) {
    throw BadMotion(Refusal::out_of_range, "mark search", "distance must not be 0");
  }
  const std::int8_t direction = how.search_pulses < 0 ? std::int8_t{-1} : std::int8_t{+1};
  const Signal mark = limit_towards(direction);
  HomingProgram program{.speeds = {how.fast, how.creep}};
  const std::int64_t search = std::abs(how.search_pulses);
  const bool continues = how.distance_pulses * direction > 0;
  std::int64_t behind = 0;  // the distance beyond the target within which the axis slows down
  if (how.slows_behind && continues && how.fast.top_speed_u_s > how.creep.top_speed_u_s) {
    const double braking = ramp_distance(how.fast.down, how.creep.top_speed_u_s, how.fast.top_speed_u_s);
    behind = std::min(static_cast<std::int64_t>(std::ceil(braking)), search - 1);
  }
  program.add({.does = Does::go,
               .speed = kFast,
               .then = kRunOn,
               .distance_pulses = how.distance_pulses + direction * behind,
               .ignores = how.searches_all_the_way ? Signals{0} : bit(mark),
               .if_limit = how.searches_all_the_way ? HomingPhase::kRowBelow : kFail});
  program.add({.direction = direction,
               .speed = kCreep,
               .until = mark,
               .then = how.mark_slows ? kSlowDown : kStop,
               .marks = true,
               .within_pulses = search - behind,
               .if_already = how.needs_edge ? HomingPhase::kAwait : HomingPhase::kNext,
               .if_far = HomingPhase::kRowBelow});
  return program;
}

// ---- RS-M8194H

HomingProgram rsm8194h_homing(const Rsm8194hHoming& how) {
  const auto& [direction_1, direction_2, direction_3, direction_4] = how.directions;
  constexpr std::int8_t kDrive = 0;
  constexpr std::int8_t kHome = 1;
  HomingProgram program{.speeds = {how.drive, how.home}, .soft_limits_lead_on = how.soft_limits_lead_on};
  if (direction_1 != 0) {
    program.add({.direction = sign(direction_1),
                 .speed = kDrive,
                 .until = how.limit_is_near_home ? limit_towards(direction_1) : Signal::near_home,
                 .then = kSlowDown,
                 .code = 3,
                 .if_limit = HomingPhase::kRowBelow});
  }
  if (direction_2 != 0) {
    const Signal home = how.limit_is_home ? limit_towards(direction_2) : Signal::home;
    const std::int8_t search = program.phase_count;
    const auto leave = static_cast<std::int8_t>(search + 1);      // irregular (a): home is already on
    const auto come_back = static_cast<std::int8_t>(search + 2);  // irregular (b) and (c): the limit is on
    const auto step_3 = static_cast<std::int8_t>(search + 3);
    program.add({.direction = sign(direction_2),
                 .speed = kHome,
                 .until = home,
                 .then = kStop,
                 .marks = true,
                 .code = 15,
                 .next = step_3,
                 .if_already = leave,
                 .if_limit = come_back});
    program.add({.direction = opposite(direction_2),
                 .speed = kHome,
                 .until = home,
                 .until_on = false,
                 .then = kStop,
                 .code = 12,
                 .next = search});
    program.add({.direction = opposite(direction_2),
                 .speed = kHome,
                 .until = home,
                 .then = kRunOn,
                 .code = 8,
                 .next = leave});
  }
  if (direction_3 != 0) {
    program.add({.direction = sign(direction_3),
                 .speed = kHome,
                 .until = Signal::index,
                 .then = kStop,
                 .marks = true,
                 .code = 20,
                 .if_already = kFail});
  }
  if (direction_4 != 0) {
    program.add({.does = Does::go,
                 .speed = kDrive,
                 .code = 25,
                 .distance_pulses = sign(direction_4) * how.offset_pulses});
  }
  return program;
}

// ---- Simple2-R3

HomingProgram simple2_homing(const Simple2Homing& how) {
  if (how.speed.top_speed_u_s == 0) {
    // At a limit, it reverses, even at speed 0.
    HomingProgram both_ways;
    both_ways.add({.does = Does::move_at_zero_speed, .direction = sign(how.direction), .if_limit = 1});
    both_ways.add({.does = Does::move_at_zero_speed, .direction = opposite(how.direction)});
    return both_ways;
  }
  // The numbers of the rows to which other rows refer.
  constexpr std::int8_t kLeave = 1;
  constexpr std::int8_t kOtherWay = 2;
  constexpr std::int8_t kBeyond = 3;
  constexpr std::int8_t kReturn = 5;
  const std::int8_t on = sign(how.direction);
  const std::int8_t back = opposite(how.direction);
  HomingProgram program{.speeds = {how.speed}};
  program.add({.direction = on, .marks = true, .next = kReturn, .if_already = kLeave, .if_limit = kOtherWay});
  program.add({.direction = back, .until_on = false, .next = 0});
  program.add({.direction = back, .then = kRunOn, .next = kBeyond});
  program.add({.direction = back, .until_on = false});
  program.add({.direction = on, .marks = true});
  program.add({.does = Does::go_back});
  return program;
}

// ---- SLIM

HomingProgram slim_homing(const SlimHoming& how) {
  if (how.jog.top_speed_u_s == 0) return hanging(how.direction);
  HomingProgram program{.speeds = {how.jog}};
  program.add({.direction = sign(how.direction), .then = kSlowDown, .marks = true});
  return program;
}

}  // namespace understudy::motion
