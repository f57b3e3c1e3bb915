// Homing at the device from everywhere, with each combination of its steps, at three speeds. The end comes
// from a closed form of what each step searches for (6.3, 4.8).
#include <gtest/gtest.h>

#include <optional>

#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace homing_places_test {

// The positions of the machine's switches. All are whole pulses; both ends belong to a switch.
constexpr std::int64_t kHomeFirst = -40;
constexpr std::int64_t kHomeLast = 40;
constexpr std::int64_t kNearFirst = -600;
constexpr std::int64_t kNearLast = 300;
constexpr std::int64_t kLimit = 1000;  // and further, on both sides
constexpr std::int64_t kIndexAt = 140;
constexpr std::int64_t kIndexWidth = 4;
constexpr std::int64_t kIndexPeriod = 400;
constexpr std::int64_t kOffset = 130;

world::PlantSetup machine(std::int64_t from) {
  world::PlantSetup plant;
  plant.position_pulses = from;
  plant.home = world::PulseSpan{kHomeFirst, kHomeLast};
  plant.near_home = world::SwitchSetup{.on = {kNearFirst, kNearLast}};
  plant.lower_limit = -kLimit;
  plant.upper_limit = kLimit;
  plant.index = world::IndexSetup{.at = kIndexAt, .width = kIndexWidth, .period = kIndexPeriod};
  return plant;
}

struct Speeds {
  const char* name;
  bool is_constant;
  std::vector<std::string_view> commands;
};
const Speeds kSpeeds[] = {
    {"slow", true, {"RSM_SET_SV X 1000", "RSM_SET_V X 1000", "RSM_SET_HV X 1000"}},
    {"with ramps",
     false,
     {"RSM_SET_SV X 100", "RSM_SET_V X 8000", "RSM_SET_HV X 5000", "RSM_SET_A X 100000"}},
    // The whole machine lies within one tick.
    {"highest",
     true,
     {"RSM_SET_MAX_V X 4000000", "RSM_SET_SV X 4000000", "RSM_SET_V X 4000000", "RSM_SET_HV X 4000000"}},
};

/// Beyond, on, beside and between all switches, and on an index.
constexpr std::int64_t kPlaces[] = {-1100, -1000, -999, -700, -601, -300, -41,  -40,
                                    0,     40,    41,   141,  301,  999,  1000, 1100};

struct Steps {
  int directions[4];  // 1: +, 2: -, 0: left out
  bool limit_is_home;
};
int sign_of(int direction) { return direction == 1 ? +1 : direction == 2 ? -1 : 0; }

struct End {
  std::int64_t place;
  int error;
};

std::int64_t index_phase(std::int64_t place) {
  return ((place - kIndexAt) % kIndexPeriod + kIndexPeriod) % kIndexPeriod;
}

/// A limit prevents a drive from continuing, or from starting.
bool meets_limit(std::int64_t from, std::int64_t to, int sign) {
  return sign > 0 ? to >= kLimit || from >= kLimit : to <= -kLimit || from <= -kLimit;
}
End at_limit(std::int64_t from, int sign) {
  return {sign > 0 ? std::max(from, kLimit) : std::min(from, -kLimit), sign > 0 ? 4 : 8};
}

/// Returns nothing if the place is the end of a ramp.
std::optional<End> closed_form(const Steps& steps, std::int64_t place, bool is_constant) {
  const int w1 = sign_of(steps.directions[0]);
  const int w2 = sign_of(steps.directions[1]);
  const int w3 = sign_of(steps.directions[2]);
  const int w4 = sign_of(steps.directions[3]);
  const bool is_near = place >= kNearFirst && place <= kNearLast;
  if (w1 != 0 && !is_near && w2 == 0) {
    if (!is_constant) return {};
    const bool lies_ahead = w1 > 0 ? place < kNearFirst : place > kNearLast;
    place = !lies_ahead ? at_limit(place, w1).place : w1 > 0 ? kNearFirst : kNearLast;
  }
  // Wherever step 1 has ended, step 2 reaches the first edge in its direction.
  if (w2 != 0) place = steps.limit_is_home ? w2 * kLimit : w2 > 0 ? kHomeFirst : kHomeLast;
  if (w3 != 0) {
    const std::int64_t phase = index_phase(place);
    if (phase < kIndexWidth) return End{place, 0x80};
    const std::int64_t edge = w3 > 0 ? place + kIndexPeriod - phase : place - (phase - (kIndexWidth - 1));
    if (meets_limit(place, edge, w3)) return at_limit(place, w3);
    place = edge;
  }
  if (w4 != 0) {
    // A limit that the last pulse reaches counts as reached.
    if (meets_limit(place, place + w4 * kOffset, w4)) return at_limit(place, w4);
    place += w4 * kOffset;
  }
  return End{place, 0};
}

void expect_end(const Speeds& speeds, const Steps& steps, std::int64_t from) {
  const std::optional<End> end = closed_form(steps, from, speeds.is_constant);
  if (!end) return;
  OneRsm rsm({.plant = {{0, machine(from)}}});
  for (const std::string_view command : speeds.commands) rsm.send(command);
  rsm.send({"RSM_SET_AO X 0", steps.limit_is_home ? "RSM_HOME_LIMIT X 1" : "RSM_HOME_LIMIT X 0"});
  std::string mode = "RSM_SET_HOME_MODE X";
  for (const int direction : steps.directions) mode += " " + std::to_string(direction);
  mode += " " + std::to_string(kOffset);
  rsm.send(mode);
  rsm.run(5);
  rsm.send("RSM_HOME_START X");
  int looks = 0;
  do {
    rsm.run(50);
  } while (rsm.get("DRIVING_AXIS") != 0 && ++looks < 1000);
  SCOPED_TRACE(std::string(speeds.name) + ", " + mode + " from " + std::to_string(from) +
               (steps.limit_is_home ? ", the limit is home" : ""));
  EXPECT_EQ(rsm.world().plant(0, 0).save().position_pulses, end->place);
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), end->error);
  EXPECT_EQ(rsm.get("INT_HMEND"), end->error == 0 ? 1 : 0);
  EXPECT_EQ(rsm.get("HOME_STATE_X"), 0);
}

TEST(RsM8194hHomingPlaces, EachWayEndsByItsClosedForm) {
  for (const Speeds& speeds : kSpeeds) {
    for (int combination = 0; combination < 81; ++combination) {
      const Steps steps{{combination % 3, combination / 3 % 3, combination / 9 % 3, combination / 27}, false};
      for (const std::int64_t from : kPlaces) expect_end(speeds, steps, from);
    }
  }
}

TEST(RsM8194hHomingPlaces, TheLimitAsHomeIsMetAtItsPulse) {
  for (const Speeds& speeds : kSpeeds) {
    for (const int direction : {1, 2}) {
      for (const int back : {0, 1, 2}) {
        for (const std::int64_t from : kPlaces) expect_end(speeds, {{0, direction, 0, back}, true}, from);
      }
    }
  }
}

struct Irregular {
  const char* name;
  std::int64_t from;
  int direction;
  std::vector<Value> states;
};
const Irregular kIrregular[] = {
    {"regular", 300, 2, {15, 0}},
    {"regular", -300, 1, {15, 0}},
    {"a: on it already", 0, 2, {12, 15, 0}},
    {"a: on its edge", -40, 1, {12, 15, 0}},
    {"b: on the limit", -1000, 2, {8, 12, 15, 0}},
    {"b: beyond the limit", 1100, 1, {8, 12, 15, 0}},
    {"c: the limit comes first", -300, 2, {15, 8, 12, 15, 0}},
    {"c: the limit comes first", 300, 1, {15, 8, 12, 15, 0}},
};

TEST(RsM8194hHomingPlaces, IrregularWaysPassTheirStates) {
  for (const Irregular& row : kIrregular) {
    OneRsm rsm({.plant = {{0, machine(row.from)}}});
    // Half a pulse a tick: no phase is shorter than a tick.
    rsm.send({"RSM_SET_SV X 500", "RSM_SET_V X 500", "RSM_SET_HV X 500",
              "RSM_SET_HOME_MODE X 0 " + std::to_string(row.direction) + " 0 0 0"});
    rsm.run(5);
    rsm.send("RSM_HOME_START X");
    std::vector<Value> states;
    for (int tick = 0; tick < 20'000; ++tick) {
      const Value now = rsm.get("HOME_STATE_X");
      if (states.empty() || states.back() != now) states.push_back(now);
      if (now == 0) break;
      rsm.run(1);
    }
    EXPECT_EQ(states, row.states) << row.name << " " << row.from;
    EXPECT_EQ(rsm.world().plant(0, 0).save().position_pulses, row.direction == 1 ? kHomeFirst : kHomeLast)
        << row.name << " " << row.from;
  }
}

/// A Z signal that is active outside its mark is reached where the mark ends.
TEST(RsM8194hHomingPlaces, AnIndexMayBeActiveBetweenItsMarks) {
  for (const int direction : {1, 2}) {
    OneRsm rsm({.plant = {{0, machine(kIndexAt + 1)}}});
    rsm.send({"RSM_SET_SV X 1000", "RSM_SET_V X 1000", "RSM_SET_HV X 1000", "RSM_SET_ENCODER X 0 0 1"});
    rsm.send("RSM_SET_HOME_MODE X 0 0 " + std::to_string(direction) + " 0 0");
    rsm.run(3);
    rsm.send("RSM_HOME_START X");
    rsm.run_to_rest();
    EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0) << direction;
    EXPECT_EQ(rsm.get("LP_X"), direction == 1 ? kIndexWidth - 1 : -2) << direction;
  }
}

}  // namespace homing_places_test
}  // namespace understudy::emulator::models::rs_m8194h
