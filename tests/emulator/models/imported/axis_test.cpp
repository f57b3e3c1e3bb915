// The axis of a described controller against closed forms and against its table of answers.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "emulator/models/imported/axis_drive.h"
#include "tests/emulator/models/imported/one_described.h"

namespace understudy::emulator::models::imported {
namespace axis_test {

// --- closed forms ----------------------------------------------------------------------------------

struct Trapezoid {
  double distance;  // pulses
  double top_pps;
  double ramp_s;
  double slope() const { return top_pps / ramp_s; }
  bool has_top() const { return distance >= top_pps * ramp_s; }
  double duration_s() const {
    return has_top() ? distance / top_pps + ramp_s : 2 * std::sqrt(distance / slope());
  }
  double place(double t) const {
    const double ramp = has_top() ? ramp_s : duration_s() / 2;
    const double top = slope() * ramp;
    if (t < ramp) return slope() * t * t / 2;
    if (t < duration_s() - ramp) return top * (t - ramp / 2);
    const double left = std::max(duration_s() - t, 0.0);
    return distance - slope() * left * left / 2;
  }
};

TEST(DescribedAxis, MovesByTheClosedFormAtEveryTick) {
  struct Case {
    Value counts, speed, ramp_ms;
    const char* scale;
    double pulses_per_count, pps_per_count;
  };
  const Case kCases[] = {{1000, 1000, 100, "", 1, 1},
                         {-1000, 1000, 100, "", 1, 1},
                         {1, 1000, 100, "", 1, 1},
                         {99, 1000, 100, "", 1, 1},
                         {100, 1000, 100, "", 1, 1},
                         {12'345, 9'876, 321, "", 1, 1},
                         {50, 700, 1500, "", 1, 1},
                         {400, 25, 200, ", pulses_per_count: 25/4, pps_per_count: 80", 6.25, 80},
                         {7, 3, 50, ", pulses_per_count: 1/3, pps_per_count: 0.5", 1.0 / 3, 0.5}};
  for (const Case& one_case : kCases) {
    SCOPED_TRACE(std::to_string(one_case.counts) + " at " + std::to_string(one_case.speed));
    OneDescribed one(axis_model(one_case.scale));
    one.write("TARGET", one_case.counts);
    one.write("SPEED", one_case.speed);
    one.write("RAMP", one_case.ramp_ms);
    one.write("COMMAND", 1);
    EXPECT_EQ(one.read("STATUS.BUSY"), 1) << "the next request sees it";
    EXPECT_EQ(one.read("COMMAND"), 0) << "it is momentary";
    const double sign = one_case.counts < 0 ? -1 : +1;
    const double pulses =
        std::round(std::abs(static_cast<double>(one_case.counts)) * one_case.pulses_per_count);
    const Trapezoid law{pulses, static_cast<double>(one_case.speed) * one_case.pps_per_count,
                        static_cast<double>(one_case.ramp_ms) / 1000};
    std::int64_t sent = 0;
    Tick tick = 0;
    // The move is at its beginning in the first tick.
    for (; one.read("STATUS.BUSY") == 1 && tick < 100'000; ++tick) {
      one.advance(1);
      sent += one.device().axes()->pulses_this_tick(0);
      const double place = law.place(static_cast<double>(tick) / 1000);
      ASSERT_NEAR(static_cast<double>(sent) * sign, std::floor(place + 1e-6), 1) << "tick " << tick;
    }
    EXPECT_NEAR(static_cast<double>(tick - 1), law.duration_s() * 1000, 1);
    EXPECT_EQ(static_cast<double>(sent), sign * pulses);
    EXPECT_EQ(one.read("POSITION"), std::llround(sign * pulses / one_case.pulses_per_count));
    EXPECT_EQ(one.read("STATUS.ARRIVED"), 1);
    EXPECT_EQ(one.read("NOW"), 0);
  }
}

TEST(DescribedAxis, TakesTimesForTheRatedSpeed) {
  // 0 to 2000 in 100 ms: 0 to 500 in 25 ms.
  OneDescribed one(axis_model(", rated_speed: 2000"));
  one.write("SPEED", 500);
  one.write("CONTROL", 2);
  one.advance(26);
  EXPECT_EQ(one.read("NOW"), 500);
  one.write("CONTROL", 0);
  EXPECT_NEAR(static_cast<double>(one.ticks_until_still()), 25, 1);
}

TEST(DescribedAxis, ContinuesToANewTargetWithoutAStop) {
  OneDescribed one;
  one.write("TARGET", 10'000);
  one.write("COMMAND", 1);
  one.advance(2001);
  EXPECT_EQ(one.read("NOW"), 1000);
  const Value here = one.read("POSITION");
  one.write("TARGET", 12'000);
  one.write("COMMAND", 1);
  one.advance(1);
  EXPECT_EQ(one.read("NOW"), 1000) << "it has not stopped";
  // At 1000 up to the ramp down of 100 ms, which covers 50.
  EXPECT_NEAR(static_cast<double>(one.ticks_until_still()), static_cast<double>(12'000 - here - 50) + 100, 3);
  EXPECT_EQ(one.read("POSITION"), 12'000);
  // A target behind it is passed, and the axis returns to it.
  one.write("TARGET", 13'000);
  one.write("COMMAND", 1);
  one.advance(500);
  one.write("TARGET", 12'100);
  one.write("COMMAND", 1);
  EXPECT_GT(one.ticks_until_still(), 0);
  EXPECT_EQ(one.read("POSITION"), 12'100);
  EXPECT_EQ(one.read("STATUS.ARRIVED"), 1);
}

TEST(DescribedAxis, RunsAsHostsHoldIt) {
  OneDescribed one;
  one.write("CONTROL.FORWARD", 1);
  one.advance(101);
  EXPECT_EQ(one.read("NOW"), 1000);
  one.write("SPEED", 1500);
  one.advance(100);
  EXPECT_EQ(one.read("NOW"), 1500) << "a new speed takes effect at once";
  one.write("CONTROL", 4);  // backward: it decelerates and reverses
  one.advance(50);
  EXPECT_GT(one.read("NOW"), 0);
  one.advance(160);
  EXPECT_EQ(one.read("NOW"), -1500);
  one.write("CONTROL", 6);  // both: neither
  EXPECT_NEAR(static_cast<double>(one.ticks_until_still()), 100, 1);
  one.write("CONTROL", 2);
  one.advance(101);
  one.write("COMMAND", 3);  // stopped, it waits for a new command
  one.advance(1000);
  EXPECT_EQ(one.read("STATUS.BUSY"), 0);
  one.write("CONTROL", 0);
  one.write("CONTROL", 2);
  one.advance(1);
  EXPECT_EQ(one.read("STATUS.BUSY"), 1);
  one.advance(50);
  one.write("SPEED", 0);
  EXPECT_NEAR(static_cast<double>(one.ticks_until_still()), 50, 2) << "a speed of 0 is a stop";
  one.write("SPEED", -300);
  one.advance(200);
  EXPECT_EQ(one.read("NOW"), -300) << "a negative speed reverses the direction";
}

TEST(DescribedAxis, MeetsItsSwitchesAtTheirPulse) {
  OneDescribed one(axis_model(", home_position: 250"),
                   "home: { at: -40, width: 20 }, limits: { lower: -700, upper: 333 }");
  one.write("CONTROL", 2);
  EXPECT_GT(one.ticks_until_still(), 0);
  EXPECT_EQ(one.read("POSITION"), 333);
  one.write("CONTROL", 0);
  one.write("CONTROL", 2);
  one.advance(50);
  EXPECT_EQ(one.read("POSITION"), 333) << "only the other direction is free";
  one.write("CONTROL", 0);
  one.write("COMMAND", 5);
  EXPECT_GT(one.ticks_until_still(), 0);
  EXPECT_EQ(one.read("STATUS.HOMED"), 1);
  EXPECT_EQ(one.read("POSITION"), 250);
  EXPECT_EQ(one.world.plant(0, 0).save().position_pulses, -21) << "the switch's edge, met downwards";
  EXPECT_EQ(one.read("SWITCHES"), 1);
  one.write("POSITION", -5);
  EXPECT_EQ(one.read("POSITION"), -5);
  one.write("TARGET", 0);
  one.write("COMMAND", 1);
  one.ticks_until_still();
  EXPECT_EQ(one.world.plant(0, 0).save().position_pulses, -16);
}

TEST(DescribedAxis, NeedsItsEnableAndHeedsItsAlarm) {
  OneDescribed one(axis_model(", enable: CONTROL.ENABLE, while_disabled: refuse, while_busy: refuse"));
  one.write("DISTANCE", 5000);
  EXPECT_EQ(one.write("COMMAND", 2), Refusal::failure);
  EXPECT_EQ(one.write("COMMAND", 3), Refusal::none) << "a stop does not need it";
  EXPECT_EQ(one.read("STATUS"), 0);
  EXPECT_EQ(one.write("CONTROL", 1), Refusal::none);
  EXPECT_EQ(one.read("STATUS"), 0x12);
  EXPECT_EQ(one.write("COMMAND", 2), Refusal::none);
  EXPECT_EQ(one.write("COMMAND", 1), Refusal::busy);
  one.advance(500);
  EXPECT_EQ(one.read("NOW"), 1000);
  one.write("CONTROL", 0);
  EXPECT_EQ(one.read("STATUS"), 0) << "at once";
  const Value here = one.read("POSITION");
  one.advance(100);
  EXPECT_EQ(one.read("POSITION"), here);
  one.write("CONTROL", 3);
  one.advance(200);
  EXPECT_EQ(one.read("NOW"), 1000);
  one.world.set_external_input(0, 3, 1);  // the alarm
  one.advance(2);
  EXPECT_EQ(one.read("STATUS"), 0x30);
}

TEST(DescribedAxis, ShowsItsEncoder) {
  OneDescribed one(axis_model(", pulses_per_revolution: 1000"), "encoder: { per_revolution: 4000 }");
  one.write("DISTANCE", -1500);
  one.write("COMMAND", 2);
  one.ticks_until_still();
  EXPECT_EQ(one.read("COUNTS"), -6000);
}

// --- the table of answers ------------------------------------------------------------------------------

/// The rows of the table in docs/import.md, by command: a word for each activity.
std::map<std::string, std::vector<std::string>> printed_answers() {
  std::ifstream page(PROJECT_FOLDER "/docs/import.md");
  std::map<std::string, std::vector<std::string>> rows;
  bool is_present = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("| command |")) is_present = true;
    if (line.empty()) is_present = false;
    if (!is_present || !line.starts_with("| `")) continue;
    std::vector<std::string> cells;
    std::istringstream parts(line.substr(2));
    for (std::string cell; std::getline(parts, cell, '|');) {
      cell.erase(cell.find_last_not_of(' ') + 1);
      cells.push_back(cell.substr(std::min(cell.find_first_not_of(' '), cell.size())));
    }
    const std::string command = cells[0].substr(1, cells[0].rfind('`') - 1);
    rows[command] = {cells.begin() + 1, cells.end()};
  }
  return rows;
}

/// Puts an axis into each activity, gives it each command, and checks the result.
class Answers : public testing::Test {
 protected:
  static std::string happened(Command command, Activity activity) {
    const bool is_enable = command == Command::enable;
    OneDescribed one(axis_model(", enable: CONTROL.ENABLE"), "home: { at: -9000, width: 20 }");
    one.write("CONTROL", 1);
    one.write("TARGET", 4000);
    one.write("DISTANCE", 3000);
    const std::map<Command, Value> codes{{Command::start, 1},
                                         {Command::start_relative, 2},
                                         {Command::stop, 3},
                                         {Command::stop_at_once, 4},
                                         {Command::home, 5}};
    switch (activity) {
      case Activity::rests: break;
      case Activity::moves: one.write("COMMAND", 1); break;
      case Activity::runs: one.write("CONTROL", 3); break;
      case Activity::homes: one.write("COMMAND", 5); break;
      case Activity::stops: one.write("COMMAND", 1); break;
    }
    one.advance(500);
    if (activity == Activity::stops) {
      one.write("COMMAND", 3);
      one.advance(50);
    }
    const Value speed = one.read("NOW");
    one.write("TARGET", 6000);
    if (is_enable) {
      one.write("CONTROL", 0);
    } else {
      one.write("COMMAND", codes.at(command));
    }
    if (one.read("STATUS.BUSY") == 0) return speed == 0 ? "-" : "halts";
    one.advance(20);
    const Value after = one.read("NOW");
    if (speed == 0) return "begins";
    const bool is_slower = std::abs(after) < std::abs(speed) - 100;
    if (is_slower && activity != Activity::stops) return "slows down";
    const bool has_end = one.ticks_until_still() >= 0;
    const Value end = one.read("POSITION");
    switch (activity) {
      case Activity::rests: break;
      case Activity::moves: return end == 4000 ? "-" : "continues";
      case Activity::runs: return has_end ? "continues" : "-";
      case Activity::homes: return one.read("STATUS.HOMED") == 1 && end == 0 ? "-" : "continues";
      case Activity::stops: return end < 1000 ? "-" : "continues";
    }
    return "?";
  }
};

TEST_F(Answers, AreThoseThatThePagePrints) {
  const auto printed = printed_answers();
  const std::pair<Command, std::string> kRows[] = {
      {Command::start, "start"}, {Command::start_relative, "start_relative"}, {Command::home, "home"},
      {Command::stop, "stop"},   {Command::stop_at_once, "stop_at_once"},     {Command::enable, "enable"}};
  ASSERT_EQ(printed.size(), std::size(kRows));
  for (const auto& [command, name] : kRows) {
    ASSERT_TRUE(printed.contains(name)) << name;
    ASSERT_EQ(printed.at(name).size(), kActivities) << name;
    for (std::size_t activity = 0; activity < kActivities; ++activity) {
      EXPECT_EQ(happened(command, static_cast<Activity>(activity)), printed.at(name)[activity])
          << name << " but it is in column " << activity;
    }
  }
}

TEST(DescribedAxis, LeavesAStartAloneWhereItIsToBeIgnored) {
  OneDescribed one(axis_model(", while_busy: ignore"));
  one.write("TARGET", 2000);
  one.write("COMMAND", 1);
  one.advance(300);
  one.write("TARGET", 9000);
  EXPECT_EQ(one.write("COMMAND", 1), Refusal::none);
  one.ticks_until_still();
  EXPECT_EQ(one.read("POSITION"), 2000);
}

TEST(DescribedAxis, TakesABitWhenItComesOn) {
  OneDescribed one(
      axis_model().replace(axis_model().find("start: COMMAND == 1"), 19, "start: CONTROL.START  "));
  one.write("TARGET", 100);
  one.write("CONTROL", 0x100);
  one.ticks_until_still();
  one.write("TARGET", 200);
  one.write("CONTROL", 0x100);  // it is on already
  one.advance(10);
  EXPECT_EQ(one.read("STATUS.BUSY"), 0);
  one.write("CONTROL", 0);
  one.write("CONTROL", 0x100);
  EXPECT_EQ(one.read("STATUS.BUSY"), 1);
}

}  // namespace axis_test
}  // namespace understudy::emulator::models::imported
