// Soft limits and paths (3.9.1, 7.2, 7.4): every kind of limit with every kind of path, including one that
// leaves the allowed range and returns before its end. The oracle is the same path without limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tests/emulator/models/rs_m8194h/one_rsm.h"
#include "tests/sanitized.h"

namespace understudy::emulator::models::rs_m8194h {
namespace soft_limits_on_paths_test {

using Commands = std::vector<std::string>;

/// Axis1 reaches its limit; `way` mirrors everything to the minus side.
struct PathKind {
  const char* name;
  bool has_ramps;
  double farthest;  // of axis1
  std::function<Commands(int direction)> commands;
};

std::string arc(const char* plus, const char* minus, int direction) { return direction > 0 ? plus : minus; }
std::string by(int direction, int number) { return std::to_string(direction * number); }

const PathKind kPaths[] = {
    {"line", true, 6000,
     [](int w) {
       return Commands{"RSM_VECTOR_SPEED 1", "RSM_LINE_2D " + by(w, 6000) + " 3000"};
     }},
    {"constant line", false, 6000,
     [](int w) {
       return Commands{"RSM_VECTOR_SPEED 0", "RSM_LINE_2D " + by(w, 6000) + " 3000"};
     }},
    {"line in three axes", true, 6000,
     [](int w) {
       return Commands{"RSM_VECTOR_SPEED 8", "RSM_LINE_3D " + by(w, 6000) + " 3000 -2000"};
     }},
    {"arc", true, 2000,
     [](int w) {
       return Commands{"RSM_VECTOR_SPEED 5", arc("RSM_ARC_CCW", "RSM_ARC_CW", w) + " 0 2000 0 4000"};
     }},
    {"absolute arc", true, 2000,
     [](int w) {
       return Commands{"RSM_VECTOR_SPEED 5", arc("RSM_ABS_ARC_CCW", "RSM_ABS_ARC_CW", w) + " 0 2000 0 4000"};
     }},
    {"constant arc", false, 2000,
     [](int w) {
       return Commands{"RSM_VECTOR_SPEED 0", arc("RSM_ARC_CCW", "RSM_ARC_CW", w) + " 0 2000 0 4000"};
     }},
    {"circle", true, 2000,
     [](int w) {
       return Commands{"RSM_VECTOR_SPEED 5", arc("RSM_CIRCLE_CCW", "RSM_CIRCLE_CW", w) + " 0 2000"};
     }},
    {"stream of lines", true, 2000,
     [](int w) {
       return Commands{
           "RSM_LINE_2D_INITIAL X Y 400 2000 4000", "RSM_LINE_2D_CONTINUE 0 " + by(w, 1900) + " 1900",
           "RSM_LINE_2D_CONTINUE 0 " + by(w, 100) + " 100", "RSM_LINE_2D_CONTINUE 0 " + by(w, -100) + " 100",
           "RSM_LINE_2D_CONTINUE 1 " + by(w, -1900) + " 1900"};
     }},
    {"stream in three axes", true, 2000,
     [](int w) {
       return Commands{"RSM_LINE_3D_INITIAL X Y Z 400 2000 4000",
                       "RSM_LINE_3D_CONTINUE 0 " + by(w, 2000) + " 1500 100",
                       "RSM_LINE_3D_CONTINUE 1 " + by(w, -2000) + " 1500 100"};
     }},
    {"mixed stream", true, 2000,
     [](int w) {
       const std::string turn = w > 0 ? " 3 " : " 2 ";
       return Commands{"RSM_MIX_2D_INITIAL X Y 1 400 2000 4000", "RSM_MIX_2D_CONTINUE 0 1 0 0 0 1000",
                       "RSM_MIX_2D_CONTINUE 0" + turn + "0 2000 0 4000",
                       "RSM_MIX_2D_CONTINUE 1 1 0 0 " + by(w, -1000) + " 0"};
     }},
    {"constant mixed stream", false, 2000,
     [](int w) {
       const std::string turn = w > 0 ? " 3 " : " 2 ";
       return Commands{"RSM_MIX_2D_INITIAL X Y 0 400 2000 4000",
                       "RSM_MIX_2D_CONTINUE 0" + turn + "0 2000 0 4000",
                       "RSM_MIX_2D_CONTINUE 1 1 0 0 " + by(w, -1000) + " 0"};
     }},
    {"rectangle", true, 4000,
     [](int w) {
       return Commands{"RSM_RECTANGLE X Y 1 " + std::string(w > 0 ? "0 0" : "1 1") +
                       " 5000 4000 1000 400 2000 4000 4000"};
     }},
    {"helix", false, 2000,
     [](int w) {
       return Commands{"RSM_HELIX_3D X Y Z " + std::string(w > 0 ? "1" : "0") + " 2000 0 2000 2 500"};
     }},
};

/// The source of EP, and how a limit stops.
struct LimitKind {
  const char* name;
  int source;  // 0 LP, 1 EP
  bool has_encoder;
  bool at_once;
};
constexpr LimitKind kLimits[] = {
    {"on LP", 0, false, false},        {"on LP, at once", 0, false, true},
    {"on EP", 1, false, false},        {"on EP, at once", 1, false, true},
    {"on an encoder", 1, true, false}, {"on an encoder, at once", 1, true, true},
};

/// The limited axis among the three; the others are assigned around it.
struct Run {
  OneRsm rsm;
  std::vector<std::vector<Value>> places;

  explicit Run(const LimitKind& limit, const PathKind& path, int direction, Value max) : rsm(given(limit)) {
    rsm.send({"RSM_SET_MAX_V XYZ 80000", "RSM_AXIS_ASSIGN X Y Z", "RSM_SET_VSV 400", "RSM_SET_VV 2000",
              "RSM_SET_VA 4000"});
    rsm.run(3);
    if (max != 0) {
      const std::string plus = std::to_string(direction > 0 ? max : 1'000'000);
      const std::string minus = std::to_string(direction > 0 ? -1'000'000 : -max);
      rsm.send("RSM_SET_SLMT X " + plus + " " + minus + " " + std::to_string(limit.source));
    }
    for (const std::string& command : path.commands(direction)) rsm.send(command);
    do {
      places.push_back(rsm.positions());
      rsm.run(1);
    } while (!rsm.rests() && places.size() < 60'000);
    places.push_back(rsm.positions());
  }

  static GivenRsm given(const LimitKind& limit) {
    // The rest of a stream after a limit would run as a separate stream, so all of it is loaded.
    GivenRsm made{.choices = {{"stream_lookahead", "30"}}};
    if (limit.at_once) made.choices["soft_limit_stop"] = "at_once";
    if (limit.has_encoder) {
      world::PlantSetup plant;
      plant.encoder_counts_per_revolution = plant.pulses_per_revolution = 100;
      made.plant = {{0, plant}};
    }
    return made;
  }
};

double apart(const std::vector<Value>& one, const std::vector<Value>& other) {
  double farthest = 0;
  for (std::size_t a = 0; a < one.size(); ++a) {
    farthest = std::max(farthest, std::abs(static_cast<double>(one[a] - other[a])));
  }
  return farthest;
}

void check(const LimitKind& limit, const PathKind& path, int direction, const Run& free, Value max) {
  SCOPED_TRACE(std::string(path.name) + " meets a limit " + limit.name + " at " +
               std::to_string(direction * max));
  const Run run(limit, path, direction, max);
  EXPECT_EQ(run.rsm.get("DRIVING_AXIS"), 0);
  EXPECT_EQ(run.rsm.get("ERROR_CODE_Y"), 0);
  EXPECT_EQ(run.rsm.get("ERROR_CODE_Z"), 0);
  const bool is_met = static_cast<double>(max) < path.farthest;
  EXPECT_EQ(run.rsm.get("ERROR_CODE_X"), !is_met ? 0 : direction > 0 ? 1 : 2);
  if (!is_met) {
    EXPECT_TRUE(run.places == free.places);
    return;
  }
  // Until the limit is reached, nothing is different.
  std::size_t met = 0;
  while (free.places[met][0] * direction <= max) ++met;
  for (std::size_t t = 0; t < met; ++t) ASSERT_EQ(run.places[t], free.places[t]) << t;
  // It continues along the path with its ramp, from 2,000 to 400 PPS at 4,000 PPS/s: 480 pulses, 240 ticks of
  // the path at full speed. The encoder's count comes a tick later.
  const bool slows = path.has_ramps && !limit.at_once;
  const std::size_t ramp = slows ? 240 : 0;
  if (limit.at_once && !limit.has_encoder) {
    EXPECT_EQ(run.places.back()[0], direction * (max + 1));
  }
  // A line decelerates for its own end there.
  const std::size_t end = std::min(met + ramp, free.places.size() - 1);
  // Its offset, 8 pulses, only applies to the end.
  EXPECT_LE(apart(run.places.back(), free.places[end]), 8) << "tick " << end;
}

/// In the middle; so close to its reversal that it is back before it stops; by one pulse; not at all.
void check_all(const LimitKind& limit, const PathKind& path, int direction) {
  const Run free(limit, path, direction, 0);
  check(limit, path, direction, free, static_cast<Value>(path.farthest * 0.7));
  if (is_sanitized()) return;
  check(limit, path, direction, free, static_cast<Value>(path.farthest * 0.995));
  check(limit, path, direction, free, static_cast<Value>(path.farthest));
}

TEST(RsM8194hSoftLimitsOnPaths, AreHeededByEveryKindOfPath) {
  int number = 0;
  for (const LimitKind& limit : kLimits) {
    for (const PathKind& path : kPaths) {
      if (is_sanitized() && ++number % 4 != 0) continue;
      check_all(limit, path, +1);
      if (!is_sanitized()) check_all(limit, path, -1);
    }
  }
}

/// An arc that leaves the switch, or the encoder's count, before it stops.
TEST(RsM8194hSoftLimitsOnPaths, ALimitSwitchThatIsLeftAgainIsReported) {
  for (const int direction : {+1, -1}) {
    world::PlantSetup plant;
    (direction > 0 ? plant.upper_limit : plant.lower_limit) = direction * 1990;
    OneRsm rsm({.plant = {{0, plant}}});
    rsm.send({"RSM_SET_MAX_V XY 80000", "RSM_AXIS_ASSIGN X Y 0", "RSM_SET_VSV 400", "RSM_SET_VV 2000",
              "RSM_SET_VA 4000", "RSM_LIMITSTOP_MODE XY 1", "RSM_VECTOR_SPEED 5"});
    rsm.send(std::string(direction > 0 ? "RSM_ARC_CCW" : "RSM_ARC_CW") + " 0 2000 0 4000");
    rsm.run_to_rest();
    EXPECT_LT(std::abs(rsm.get("LP_X")), 1990);
    EXPECT_GT(rsm.get("LP_Y"), 2200);
    EXPECT_LT(rsm.get("LP_Y"), 2500);
    EXPECT_EQ(rsm.get("ERROR_CODE_X"), direction > 0 ? 4 : 8);
    EXPECT_EQ(rsm.get("ERROR_CODE_Y"), 0);
    // The error is an old one, and the next drive clears it.
    rsm.send(direction > 0 ? "RSM_LINE_2D -100 0" : "RSM_LINE_2D 100 0");
    EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0);
    rsm.run_to_rest();
    EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0);
  }
}

TEST(RsM8194hSoftLimitsOnPaths, WhoSeesThatItStandsSeesWhyAndMayClearIt) {
  OneRsm rsm;
  rsm.send({"RSM_SET_SLMT X 500 -500 0", "RSM_AXIS_ASSIGN X Y 0", "RSM_SET_VV 1000", "RSM_LINE_2D 2000 0"});
  while (rsm.get("DRIVING_AXIS") != 0) rsm.run(1);
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 1);
  rsm.send("RSM_CLEAR_STOP X");
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0);
  rsm.run(3);
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0);
}

/// A path along one axis decelerates as a drive of that axis does, from the same tick on.
TEST(RsM8194hSoftLimitsOnPaths, APathSlowsDownWhereADriveDoes) {
  for (const LimitKind& limit : kLimits) {
    if (limit.at_once) continue;
    std::vector<std::pair<Value, Tick>> ends;
    for (const char* const way : {"RSM_FIXED_MOVE X 6000", "RSM_LINE_2D 6000 0"}) {
      OneRsm rsm(Run::given(limit));
      rsm.send({"RSM_SET_MAX_V XY 80000", "RSM_SET_SV X 400", "RSM_SET_V X 2000", "RSM_SET_A X 4000",
                "RSM_AXIS_ASSIGN X Y 0", "RSM_VECTOR_SPEED 1", "RSM_SET_VSV 400", "RSM_SET_VV 2000",
                "RSM_SET_VA 4000"});
      rsm.send("RSM_SET_SLMT X 1500 -1500 " + std::to_string(limit.source));
      rsm.run(3);
      rsm.send(way);
      const Tick took = rsm.run_to_rest();
      EXPECT_EQ(rsm.get("ERROR_CODE_X"), 1) << limit.name;
      EXPECT_NEAR(static_cast<double>(rsm.get("LP_X")), 1500 + 480, 4) << limit.name;
      ends.emplace_back(rsm.get("LP_X"), took);
    }
    EXPECT_EQ(ends[0], ends[1]) << limit.name;
  }
}

}  // namespace soft_limits_on_paths_test
}  // namespace understudy::emulator::models::rs_m8194h
