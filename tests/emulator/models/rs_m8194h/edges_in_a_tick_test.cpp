// The effects of an edge belong to its pulse. The table is kind of motion x kind of edge x effect x affected
// axis, at speeds from one pulse in 100 ms to 4,000 in one, compared with closed forms. X moves at `speed`, Y
// at another one, both from the same moment: at X's pulse n, Y has sent floor(n y / x).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "emulator/world/faults/fault.h"
#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace edges_in_a_tick_test {

enum class Motion : std::uint8_t {
  move,            // during the motion
  last_of_a_move,  // the edge lies in the millisecond in which it ends
  endless,
  to_a_limit,  // a limit switch ends it in the millisecond of the edge
  line,
  last_of_a_line,
  stream,
  homing,
};
constexpr Motion kMotions[] = {Motion::move, Motion::last_of_a_move, Motion::endless, Motion::to_a_limit,
                               Motion::line, Motion::last_of_a_line, Motion::stream,  Motion::homing};

enum class Edge : std::uint8_t { lp, ep, ep_of_encoder, mark };
constexpr Edge kEdges[] = {Edge::lp, Edge::ep, Edge::ep_of_encoder, Edge::mark};

/// nDRV, nLATCH, nPRESET of an activated axis.
struct Action {
  const char* what;
  int drive, latch, preset;
};
constexpr Action kActions[] = {{"LPSAV", 0, 1, 0},          {"EPSAV", 0, 2, 0},           {"LPSET", 0, 0, 1},
                               {"EPSET", 0, 0, 2},          {"LPSAV and LPSET", 0, 1, 1}, {"ISTOP", 6, 0, 0},
                               {"ISTOP and LPSAV", 6, 1, 0}};

struct Speeds {
  std::int64_t x, y, edge;  // pulses per second; X's pulse with the edge
  const char* max;          // MAX_V, of which a speed is a whole number of 8000ths
};
constexpr Speeds kSpeeds[] = {{10, 7, 3, "8000"},
                              {1000, 701, 14, "8000"},
                              {100'000, 70'100, 1234, "800000"},
                              {4'000'000, 2'800'500, 25'001, "4000000"}};

std::string text(std::int64_t number) { return std::to_string(number); }

struct Cell {
  Motion motion;
  Edge edge;
  Action action;
  bool on_y;  // the affected axis: Y, or else X itself
  Speeds speeds;

  bool on_path() const {
    return motion == Motion::line || motion == Motion::last_of_a_line || motion == Motion::stream;
  }
  /// On a path of two axes the vector has no more than MAX_V by the root of 2.
  std::int64_t speed_of_x() const {
    return on_path() ? std::min<std::int64_t>(speeds.x, 2'828'000) : speeds.x;
  }
  /// Pulses of X after the edge that are sent in the same millisecond, or much later.
  std::int64_t total() const {
    const bool is_last = motion == Motion::last_of_a_move || motion == Motion::last_of_a_line;
    return speeds.edge + (is_last ? 1 + speeds.x / 10'000 : 4 * speeds.edge);
  }
  std::string name() const {
    return std::to_string(static_cast<int>(motion)) + " edge " + std::to_string(static_cast<int>(edge)) +
           " " + action.what + (on_y ? " of Y at " : " of X at ") + text(speeds.x);
  }
};

GivenRsm bench_of(const Cell& cell) {
  world::PlantSetup x;
  if (cell.edge == Edge::mark)
    x.mark = world::SwitchSetup{.on = {cell.speeds.edge, cell.speeds.edge + 50'000}};
  if (cell.motion == Motion::to_a_limit) x.upper_limit = cell.speeds.edge + 1 + cell.speeds.x / 10'000;
  GivenRsm given;
  if (cell.edge == Edge::ep_of_encoder) {
    x.encoder_counts_per_revolution = x.pulses_per_revolution = 1000;
    given.plant[1] = x;
    given.plant[1].upper_limit.reset();
  }
  given.plant[0] = x;
  return given;
}

void begin(OneRsm& rsm, const Cell& cell) {
  const Speeds& by = cell.speeds;
  const char* const other = cell.on_path() ? "Z" : "Y";
  rsm.send({std::string("RSM_SET_MAX_V XYZU ") + by.max, "RSM_SET_SV X " + text(by.x),
            "RSM_SET_V X " + text(by.x)});
  for (const char* const verb : {"RSM_SET_SV ", "RSM_SET_V "})
    rsm.send(verb + std::string(other) + " " + text(by.y));
  rsm.run(5);
  if (cell.on_path()) {
    rsm.send({"RSM_AXIS_ASSIGN X Y 0", "RSM_VECTOR_SPEED 0", "RSM_SET_VSV " + text(cell.speed_of_x()),
              "RSM_SET_VV " + text(cell.speed_of_x())});
  }
  const std::string whom = cell.on_y ? other : "X";
  rsm.send("RSM_SYNC_ACTION X " + whom + (cell.edge == Edge::mark ? " 0x80 " : " 1 ") +
           text(cell.action.drive) + " " + text(cell.action.latch) + " " + text(cell.action.preset) +
           " 0 0 0 0 0 0");
  const bool by_lp = cell.edge == Edge::lp;
  if (cell.edge != Edge::mark) {
    rsm.send(std::string("RSM_SET_COMPARE X 0 ") + (by_lp ? "0 " : "1 ") + text(by.edge));
  }
  rsm.send("RSM_SET_PRESET XYZ -100000000");
  rsm.run(10);
  rsm.send("RSM_DRV_HOLD XYZ");
  rsm.run(2);
  rsm.send("RSM_FIXED_MOVE " + std::string(other) + " " + text(20 * by.edge));
  switch (cell.motion) {
    case Motion::move:
    case Motion::last_of_a_move: rsm.send("RSM_FIXED_MOVE X " + text(cell.total())); break;
    case Motion::endless:
    case Motion::to_a_limit: rsm.send("RSM_CONTINUE_MOVE X " + text(by.x)); break;
    case Motion::homing:
      // The home switch is far away; HV is the speed.
      rsm.send({"RSM_SET_HV X " + text(by.x), "RSM_SET_HOME_MODE X 0 1 0 0 0", "RSM_HOME_START X"});
      break;
    case Motion::line:
    case Motion::last_of_a_line: rsm.send("RSM_LINE_2D " + text(cell.total()) + " 0"); break;
    case Motion::stream:
      rsm.send("RSM_LINE_2D_INITIAL X Y " + text(cell.speed_of_x()) + " " + text(cell.speed_of_x()) + " " +
               text(2 * by.x));
      rsm.send("RSM_LINE_2D_CONTINUE 0 " + text(by.edge / 2) + " 0");
      rsm.send("RSM_LINE_2D_CONTINUE 0 " + text(by.edge) + " 0");
      rsm.send("RSM_LINE_2D_CONTINUE 1 " + text(by.edge) + " 0");
      break;
  }
  rsm.run(5);
  rsm.send("RSM_DRV_START XYZ");
}

void expect_closed_form(const Cell& cell) {
  SCOPED_TRACE(cell.name());
  OneRsm rsm(bench_of(cell));
  begin(rsm, cell);
  const Speeds& by = cell.speeds;
  rsm.run(6 * by.edge * 1000 / by.x + 20);
  const char axis = !cell.on_y ? 'X' : cell.on_path() ? 'Z' : 'Y';
  const auto value = [&](const char* name) { return rsm.get(std::string(name) + axis); };
  // Where it was at the edge; a pulse of Y at that very moment may have been sent or not. On a path X is at
  // the nearest whole pulse, there half a pulse earlier.
  const std::int64_t halves = 2 * by.edge - (cell.on_path() ? 1 : 0);
  const std::int64_t place = cell.on_y ? halves * by.y / (2 * cell.speed_of_x()) : by.edge;
  const std::int64_t min = place - (cell.on_y && halves * by.y % (2 * cell.speed_of_x()) == 0 ? 1 : 0);
  // The preset value is far below C+, which is reached once.
  constexpr std::int64_t kPreset = -100'000'000;
  const auto expect_place = [&](std::int64_t found) {
    // The chip's steps of a vector speed are a microsecond by then.
    const std::int64_t steps = cell.on_y && cell.on_path() ? by.x / 1'000'000 : 0;
    EXPECT_GE(found, min - steps);
    EXPECT_LE(found, place + steps);
  };
  EXPECT_GE(rsm.get("ABS_X"), by.edge);  // it has arrived there
  if (cell.action.latch != 0) expect_place(value("LATCH_"));
  if (cell.action.preset == 1) expect_place(value("ABS_") - value("LP_") + kPreset);
  if (cell.action.preset == 2) expect_place(value("ABS_") - value("EP_") + kPreset);
  if (cell.action.drive == 6) expect_place(value("ABS_"));
}

TEST(RsM8194hEdgesInATick, AreOfTheirPulseInEveryCellOfTheTable) {
  for (const Speeds& speeds : kSpeeds) {
    for (const Motion motion : kMotions) {
      for (const Edge edge : kEdges) {
        for (const Action& action : kActions) {
          for (const bool on_y : {false, true}) {
            expect_closed_form({motion, edge, action, on_y, speeds});
            if (HasFailure()) return;
          }
        }
      }
    }
  }
}

/// X's edge on a path of X and Y stops Z, and X's edge stops the path of Y and Z.
TEST(RsM8194hEdgesInATick, StopAPathOfOtherAxesWhereItIs) {
  for (const Speeds& by : kSpeeds) {
    OneRsm rsm;
    rsm.send({std::string("RSM_SET_MAX_V XYZU ") + by.max, "RSM_SET_SV X " + text(by.x),
              "RSM_SET_V X " + text(by.x), "RSM_AXIS_ASSIGN Y Z 0", "RSM_VECTOR_SPEED 0",
              "RSM_SET_VSV " + text(by.y), "RSM_SET_VV " + text(by.y),
              "RSM_SYNC_ACTION X Y 1 6 1 0 0 0 0 0 0 0", "RSM_SET_COMPARE X 0 0 " + text(by.edge)});
    rsm.run(20);
    rsm.send({"RSM_DRV_HOLD XYZ", "RSM_FIXED_MOVE X " + text(5 * by.edge),
              "RSM_LINE_2D " + text(10 * by.edge) + " " + text(-10 * by.edge)});
    rsm.run(5);
    rsm.send("RSM_DRV_START XYZ");
    rsm.run(7 * by.edge * 1000 / by.x + 20);
    const double place = static_cast<double>(by.edge * by.y) / static_cast<double>(by.x) / std::sqrt(2.0);
    EXPECT_NEAR(static_cast<double>(rsm.get("LP_Y")), place, 2) << by.x;
    EXPECT_EQ(rsm.get("LP_Z"), -rsm.get("LP_Y")) << by.x;
    EXPECT_EQ(rsm.get("LATCH_Y"), rsm.get("LP_Y")) << by.x;
    EXPECT_EQ(rsm.get("LP_X"), 5 * by.edge) << by.x;
  }
}

/// Several edges in a millisecond act in order, each once.
TEST(RsM8194hEdgesInATick, ActInTheirOrderAndAreCountedEach) {
  for (const bool is_late : {false, true}) {
    OneRsm rsm;
    rsm.send({"RSM_SET_MAX_V XYZU 4000000", "RSM_SET_SV XYZ 4000000", "RSM_SET_V XYZ 4000000"});
    rsm.run(5);
    rsm.send({"RSM_SYNC_ACTION X Z 1 0 1 0 1 0 0 0 0 0", "RSM_SYNC_ACTION Y Z 1 0 1 0 1 0 0 0 0 0"});
    rsm.send({is_late ? "RSM_SET_COMPARE X 0 0 5800" : "RSM_SET_COMPARE X 0 0 5200",
              "RSM_SET_COMPARE Y 0 0 5500", "RSM_SET_OUT Z 1 0", "RSM_SYNC_ACTION U X 0 0 0 0 0 0 0 0 0 0"});
    rsm.run(5);
    rsm.send("RSM_FIXED_MOVE XYZ 20000");
    rsm.run(50);
    EXPECT_EQ(rsm.get("LATCH_Z"), is_late ? 5800 : 5500);
  }
  // LPSET at C+ repeatedly: every 100 pulses, 40 times per millisecond, and as many output pulses.
  OneRsm rsm;
  rsm.send({"RSM_SET_MAX_V X 4000000", "RSM_SET_SV X 4000000", "RSM_SET_V X 4000000"});
  rsm.run(5);
  rsm.send({"RSM_SET_COMPARE X 0 0 100", "RSM_SYNC_ACTION X X 1 0 1 1 1 0 0 0 0 0"});
  rsm.run(5);
  rsm.send("RSM_FIXED_MOVE X 20050");
  rsm.run(50);
  EXPECT_EQ(rsm.get("ABS_X"), 20'050);
  EXPECT_EQ(rsm.get("LP_X"), 50);
  EXPECT_EQ(rsm.ports().output_pulses(kFirstOut), 200);
}

struct EncoderCase {
  int counts, pulses;
  bool reversed;
  Value limit;  // of EP
  Value x;      // where X stops: the first pulse with a count beyond it
};
/// Soft limits on EP (without ramps: at once), at any scale of the encoder.
TEST(RsM8194hEdgesInATick, ASoftLimitOnAnEncoderIsMetAtItsPulse) {
  constexpr EncoderCase kCases[] = {{1000, 1000, false, 50'001, 50'002},
                                    {2000, 1000, false, 50'001, 25'001},
                                    {1000, 4000, false, 10'000, 40'004},
                                    {1000, 3000, false, 5'000, 15'003}};
  for (const EncoderCase& each : kCases) {
    for (const char* const pps : {"200000", "4000000"}) {
      world::PlantSetup plant;
      plant.encoder_counts_per_revolution = each.counts;
      plant.pulses_per_revolution = each.pulses;
      OneRsm rsm({.plant = {{0, plant}}});
      rsm.send({"RSM_SET_MAX_V X 4000000", std::string("RSM_SET_SV X ") + pps,
                std::string("RSM_SET_V X ") + pps, "RSM_SET_SLMT X " + text(each.limit) + " -1000 1"});
      rsm.run(10);
      rsm.send("RSM_FIXED_MOVE X 900000");
      rsm.run(800);
      EXPECT_EQ(rsm.get("LP_X"), each.x) << each.counts << " " << pps;
      EXPECT_EQ(rsm.get("ERROR_CODE_X"), 1);
      EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
    }
  }
}

/// The machine may have been pushed, and may lose pulses: the encoder's count decides.
TEST(RsM8194hEdgesInATick, AnEncoderThatDoesNotFollowCountsAsRequested) {
  for (const bool is_pushed : {false, true}) {
    world::PlantSetup plant;
    plant.encoder_counts_per_revolution = plant.pulses_per_revolution = 1000;
    OneRsm rsm({.plant = {{0, plant}}});
    rsm.send({"RSM_SET_SV X 100000", "RSM_SET_V X 100000", "RSM_SYNC_ACTION X X 1 6 0 0 0 0 0 0 0 0",
              "RSM_SET_COMPARE X 0 1 5001"});
    rsm.run(5);
    world::Fault fault;
    fault.kind = is_pushed ? world::Fault::Kind::slip : world::Fault::Kind::lost_steps;
    fault.amount = is_pushed ? 1000 : 2;
    rsm.world().inject(fault);
    rsm.run(5);
    rsm.send("RSM_FIXED_MOVE X 90000");
    rsm.run(2000);
    // Pushed by 1,000; or every second pulse lost, which is detected after the tick: 100 pulses.
    if (is_pushed) {
      EXPECT_EQ(rsm.get("LP_X"), 4001);
      EXPECT_EQ(rsm.get("EP_X"), 5001);
    } else {
      EXPECT_NEAR(static_cast<double>(rsm.get("EP_X")), 5001, 100);
    }
  }
}

}  // namespace edges_in_a_tick_test
}  // namespace understudy::emulator::models::rs_m8194h
