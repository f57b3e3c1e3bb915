// Interrupted streams (7.4): what remains of them, and how it is reported.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace broken_streams_test {

using Commands = std::vector<std::string_view>;

constexpr std::uint8_t kStreamBit = 8;

/// The sides of a square, and their end points.
struct Kind {
  const char* name;
  Commands initial;
  Commands sides;
  Commands next;                        // a separate stream: 700 of Y
  bool is_absolute = false;             // then the rest leads to the positions that it names,
  std::array<Value, 2> rest{-5000, 0};  // otherwise by this distance
};
const Kind kKinds[] = {
    {"LINE_2D",
     {"RSM_LINE_2D_INITIAL X Y 1000 20000 100000"},
     {"RSM_LINE_2D_CONTINUE 0 5000 0", "RSM_LINE_2D_CONTINUE 0 0 5000", "RSM_LINE_2D_CONTINUE 0 -5000 0",
      "RSM_LINE_2D_CONTINUE 1 0 -5000"},
     {"RSM_LINE_2D_CONTINUE 1 0 700"}},
    {"ABS_LINE_2D",
     {"RSM_LINE_2D_INITIAL X Y 1000 20000 100000"},
     {"RSM_ABS_LINE_2D_CONTINUE 0 5000 0", "RSM_ABS_LINE_2D_CONTINUE 0 2000 5000",
      "RSM_ABS_LINE_2D_CONTINUE 0 0 5000", "RSM_ABS_LINE_2D_CONTINUE 1 0 100"},
     {"RSM_LINE_2D_CONTINUE 1 0 700"},
     true,
     {0, 100}},
    {"LINE_3D",
     {"RSM_LINE_3D_INITIAL X Y Z 1000 20000 100000"},
     {"RSM_LINE_3D_CONTINUE 0 5000 0 0", "RSM_LINE_3D_CONTINUE 0 0 5000 0",
      "RSM_LINE_3D_CONTINUE 0 -5000 0 0", "RSM_LINE_3D_CONTINUE 1 0 -5000 0"},
     {"RSM_LINE_3D_CONTINUE 1 0 700 0"}},
    {"MIX_2D",
     {"RSM_MIX_2D_INITIAL X Y 1 1000 20000 100000"},
     {"RSM_MIX_2D_CONTINUE 0 1 0 0 5000 0", "RSM_MIX_2D_CONTINUE 0 1 0 0 0 2000",
      "RSM_MIX_2D_CONTINUE 0 3 -2500 0 -5000 0", "RSM_MIX_2D_CONTINUE 1 1 0 0 0 -2000"},
     {"RSM_MIX_2D_CONTINUE 1 1 0 0 0 700"}},
};

/// An event that ends the first side before its end, and the command that clears its lock.
struct Break {
  const char* name;
  Commands before;
  Commands event;
  Commands behind;
  int signal = -1;  // an input that is on for a few milliseconds,
  bool empties_the_fifo = false;
  bool is_limit = false;  // ... or for good
};
const Break kBreaks[] = {
    {"limit", {}, {}, {}, -1, false, true},
    {"soft limit", {"RSM_SET_SLMT X 2000 -90000 0"}, {}, {}},
    {"alarm", {"RSM_SET_ALARM X 1 0"}, {}, {}, terminal(0, Pin::alarm)},
    {"EMG", {}, {}, {}, kEmergencyPin},
    {"its own comparison", {"RSM_SYNC_ACTION X X 1 6 0 0 0 0 0 0 0 0", "RSM_SET_COMPARE X 0 0 2000"}, {}, {}},
    {"a slow stop by a comparison",
     {"RSM_SYNC_ACTION X X 1 5 0 0 0 0 0 0 0 0", "RSM_SET_COMPARE X 0 0 2000"},
     {},
     {}},
    {"another axis' mark", {"RSM_SYNC_ACTION U Y 128 6 0 0 0 0 0 0 0 0"}, {}, {}, terminal(3, Pin::in3)},
    {"a slow stop", {}, {"RSM_STOP_SLOWLY X"}, {"RSM_CLEAR_STOP X"}},
    {"a sudden stop of the other axis", {}, {"RSM_STOP_SUDDENLY Y"}, {"RSM_CLEAR_STOP Y"}},
    {"VSTOP", {}, {"RSM_VSTOP_SLOWLY"}, {"RSM_CLEAR_VSTOP"}},
    {"a sudden VSTOP", {}, {"RSM_VSTOP_SUDDENLY"}, {"RSM_CLEAR_VSTOP"}},
    {"an emergency stop", {}, {"RSM_EMERGENCY_STOP 0"}, {"RSM_CLEAR_EMERGENCY_STOP"}, -1, true},
};

/// Where the rest of the stream is when it is interrupted.
enum class Rest { in_the_fifo, sent_later, in_a_macro };

struct Course {
  const Kind& kind;
  const Break& broken;
  Rest rest = Rest::in_the_fifo;
};

std::string macro_of(const Kind& kind) {
  std::string text = "MP 59\n";
  const auto line = [&](std::string_view command) {
    std::string mine(command);
    const bool is_absolute = mine.starts_with("RSM_ABS_");
    mine.insert(is_absolute ? 8 : 4, "MACRO_");
    text += "  " + mine + "\n";
  };
  for (const auto each : kind.initial) line(each);
  for (const auto each : kind.sides) line(each);
  return text + "END\n";
}

void break_off(OneRsm& rsm, const Break& broken) {
  rsm.run(120);
  for (const auto each : broken.event) rsm.send(each);
  if (broken.signal >= 0) {
    rsm.input(broken.signal, true);
    rsm.run(5);
    rsm.input(broken.signal, false);
  }
  rsm.run(400);
  for (const auto each : broken.behind) rsm.send(each);
}

GivenRsm given(const Course& course, const std::string& option) {
  GivenRsm made{.choices = {{"broken_stream", option}}};
  if (course.broken.is_limit) {
    made.plant[0].lower_limit = -50000;
    made.plant[0].upper_limit = 2000;
  }
  if (course.rest == Rest::in_a_macro) made.program = macro_of(course.kind);
  return made;
}

/// Sends a stream that is interrupted. Afterwards all of it has been sent.
void play(OneRsm& rsm, const Course& course) {
  const Kind& kind = course.kind;
  for (const auto each : course.broken.before) rsm.send(each);
  if (course.rest == Rest::in_a_macro) {
    rsm.send("RSM_MP_CALL 59");
    rsm.run(1);  // its first line is executed in the next tick
    break_off(rsm, course.broken);
  } else {
    for (const auto each : kind.initial) rsm.send(each);
    const std::size_t sent = course.rest == Rest::sent_later ? 1 : kind.sides.size();
    for (std::size_t i = 0; i < sent; ++i) rsm.send(kind.sides[i]);
    break_off(rsm, course.broken);
    for (std::size_t i = sent; i < kind.sides.size(); ++i) rsm.send(kind.sides[i]);
  }
  rsm.run_to_rest(20'000);
}

/// Returns where the first side ends if nothing follows it.
std::vector<Value> place_of_break(const Course& course) {
  OneRsm rsm(given({course.kind, course.broken}, "is_void_to_its_last_segment_or_initial"));
  for (const auto each : course.broken.before) rsm.send(each);
  for (const auto each : course.kind.initial) rsm.send(each);
  rsm.send(course.kind.sides[0]);
  break_off(rsm, course.broken);
  rsm.run_to_rest();
  return rsm.positions();
}

template <class Visit>
void for_each_course(Visit visit) {
  for (const Kind& kind : kKinds) {
    for (const Break& broken : kBreaks) {
      for (const Rest rest : {Rest::in_the_fifo, Rest::sent_later, Rest::in_a_macro}) {
        SCOPED_TRACE(std::string(kind.name) + ", " + broken.name + ", " +
                     std::to_string(static_cast<int>(rest)));
        visit(Course{kind, broken, rest});
      }
    }
  }
}

TEST(BrokenStreams, AreVoidToTheirLastSegment) {
  for_each_course([](const Course& course) {
    OneRsm rsm(given(course, "is_void_to_its_last_segment_or_initial"));
    play(rsm, course);
    const std::vector<Value> stopped = place_of_break(course);
    EXPECT_GT(stopped[0], 0);
    EXPECT_LT(stopped[0], 5000);
    EXPECT_EQ(rsm.positions(), stopped);
    EXPECT_EQ(rsm.get("RINT_STATE_ALL") & kStreamBit, kStreamBit);
    // An emergency stop has emptied the FIFO: the last segment never came.
    if (course.broken.empties_the_fifo && course.rest == Rest::in_the_fifo) rsm.send(course.kind.sides[3]);
    for (const auto each : course.kind.next) rsm.send(each);
    rsm.run_to_rest();
    EXPECT_EQ(rsm.get("LP_Y"), stopped[1] + 700);
    EXPECT_EQ(rsm.get("RINT_STATE_ALL") & kStreamBit, 0);
  });
}

TEST(BrokenStreams, AreVoidToTheirInitial) {
  for_each_course([](const Course& course) {
    OneRsm rsm(given(course, "is_void_to_its_initial"));
    play(rsm, course);
    const std::vector<Value> stopped = place_of_break(course);
    for (const auto each : course.kind.next) rsm.send(each);
    rsm.run_to_rest();
    EXPECT_EQ(rsm.positions(), stopped);
    EXPECT_EQ(rsm.get("RINT_STATE_ALL") & kStreamBit, kStreamBit);
    for (const auto each : course.kind.initial) rsm.send(each);
    EXPECT_EQ(rsm.get("RINT_STATE_ALL") & kStreamBit, 0);
    for (const auto each : course.kind.next) rsm.send(each);
    rsm.run_to_rest();
    EXPECT_EQ(rsm.get("LP_Y"), stopped[1] + 700);
  });
}

TEST(BrokenStreams, RunAllTheSameFromWhereTheyStopped) {
  for_each_course([](const Course& course) {
    // Commands that arrive while it is locked, or while its input is on, are void.
    const bool is_obstructed = !course.broken.behind.empty() ||
                               course.broken.signal == terminal(0, Pin::alarm) ||
                               course.broken.signal == kEmergencyPin;
    if (is_obstructed && course.rest != Rest::sent_later) return;
    OneRsm rsm(given(course, "runs_all_the_same"));
    play(rsm, course);
    const std::vector<Value> stopped = place_of_break(course);
    const Kind& kind = course.kind;
    const Value x = kind.is_absolute ? kind.rest[0] : stopped[0] + kind.rest[0];
    const Value y = kind.is_absolute ? kind.rest[1] : stopped[1] + kind.rest[1];
    EXPECT_EQ(rsm.get("LP_X"), x);
    EXPECT_EQ(rsm.get("LP_Y"), y);
    EXPECT_EQ(rsm.get("RINT_STATE_ALL") & kStreamBit, kStreamBit);
  });
}

TEST(BrokenStreams, KeepTheBitsOfWhatBrokeThem) {
  for (const std::string_view option :
       {"is_void_to_its_last_segment_or_initial", "is_void_to_its_initial", "runs_all_the_same"}) {
    for (const Rest rest : {Rest::in_the_fifo, Rest::sent_later, Rest::in_a_macro}) {
      const Course course{kKinds[0], kBreaks[0], rest};
      OneRsm rsm(given(course, std::string(option)));
      play(rsm, course);
      EXPECT_EQ(rsm.get("ERROR_CODE_X"), 4) << option;
      EXPECT_EQ(rsm.get("RINT_STATE_ALL") & 0x48, 0x48) << option;
      rsm.send({"RSM_LINE_2D_INITIAL X Y 1000 20000 100000", "RSM_LINE_2D_CONTINUE 1 -100 0"});
      rsm.run_to_rest();
      EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0) << option;
    }
  }
}

TEST(BrokenStreams, AreSuchWhoseFirstSegmentMayNotBegin) {
  struct Case {
    const char* name;
    Commands before;
    int signal = -1;
    Commands behind;
  };
  const Case cases[] = {
      {"a lock", {"RSM_STOP_SUDDENLY X"}, -1, {"RSM_CLEAR_STOP X"}},
      {"a lock of paths", {"RSM_AXIS_ASSIGN X Y 0", "RSM_VSTOP_SUDDENLY"}, -1, {"RSM_CLEAR_VSTOP"}},
      {"an alarm", {"RSM_SET_ALARM X 1 0"}, terminal(0, Pin::alarm), {}},
      {"EMG", {}, kEmergencyPin, {}},
      {"a limit", {}, terminal(0, Pin::limit_plus), {}},
      {"a soft limit", {"RSM_SET_LP X 10", "RSM_SET_SLMT X 10 -9000 0"}, -1, {}},
      {"the emergency state", {"RSM_EMERGENCY_STOP 0"}, -1, {"RSM_CLEAR_EMERGENCY_STOP"}},
  };
  for (const Case& each : cases) {
    SCOPED_TRACE(each.name);
    OneRsm rsm;
    for (const auto command : each.before) rsm.send(command);
    if (each.signal >= 0) rsm.input(each.signal, true);
    rsm.run(2);
    const std::vector<Value> before = rsm.positions();
    rsm.send(kKinds[0].initial[0]);
    rsm.send(kKinds[0].sides[0]);
    rsm.run(5);
    if (each.signal >= 0) rsm.input(each.signal, false);
    rsm.run(5);
    for (const auto command : each.behind) rsm.send(command);
    for (std::size_t i = 1; i < 4; ++i) rsm.send(kKinds[0].sides[i]);
    rsm.run_to_rest();
    EXPECT_EQ(rsm.positions(), before);
    EXPECT_EQ(rsm.get("RINT_STATE_ALL") & kStreamBit, kStreamBit);
    rsm.send(kKinds[0].next[0]);
    rsm.run_to_rest();
    EXPECT_EQ(rsm.get("LP_Y"), 700);
  }
}

TEST(BrokenStreams, AreSuchThatWereHeldAndDropped) {
  OneRsm rsm;
  rsm.send({"RSM_DRV_HOLD XY", kKinds[0].initial[0], kKinds[0].sides[0], kKinds[0].sides[1]});
  rsm.run(5);
  rsm.send(
      {"RSM_STOP_SLOWLY X", "RSM_CLEAR_STOP X", "RSM_DRV_START XY", kKinds[0].sides[2], kKinds[0].sides[3]});
  rsm.run_to_rest();
  EXPECT_EQ(rsm.positions(), (std::vector<Value>{0, 0, 0, 0}));
  EXPECT_EQ(rsm.get("RINT_STATE_ALL") & kStreamBit, kStreamBit);
}

TEST(BrokenStreams, OfOneKindLeaveTheOthersAsTheyAre) {
  OneRsm rsm;
  rsm.send({kKinds[2].initial[0], kKinds[0].initial[0], kKinds[0].sides[0]});
  rsm.run(100);
  rsm.send({"RSM_STOP_SUDDENLY X", "RSM_CLEAR_STOP X"});
  const std::vector<Value> stopped = rsm.positions();
  rsm.send({"RSM_LINE_3D_CONTINUE 0 100 0 0", "RSM_LINE_3D_CONTINUE 1 0 100 0"});
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("LP_X"), stopped[0] + 100);
  EXPECT_EQ(rsm.get("LP_Y"), stopped[1] + 100);
  rsm.send({kKinds[0].sides[1]});
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("LP_Y"), stopped[1] + 100);
}

}  // namespace broken_streams_test
}  // namespace understudy::emulator::models::rs_m8194h
