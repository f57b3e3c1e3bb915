// Commands that a device accepts and does not execute: the reply of the bus, and an event, say why, with the
// register or the choice that decides.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "emulator/world/events/event_log.h"
#include "emulator/world/frames/frame_log.h"
#include "tests/emulator/world/faults/faulty_line.h"
#include "tests/emulator/world/two_devices.h"

namespace understudy::emulator::world {
namespace ignored_test {

using namespace std::chrono_literals;
using Texts = std::vector<std::string>;

/// A host that writes registers of a Simple2-R3 with these settings, one after the other.
struct Host {
  explicit Host(const std::string& settings)
      : world(parse_bench(models::all_models(),
                          "understudy: 1\nlines: { a: { stations: [ { device: f, address: 1 } ] } }\n"
                          "devices: { f: { model: simple2-r3" +
                              settings + " } }\n",
                          "b.yaml", "."),
              {}, {}),
        frames(world, 1'000),
        events(world, frames) {
    world.host_opened(0);
    world.advance_to(5s);
  }

  void write(int address, int value) {
    world.receive(0, write_request(1, address, value));
    world.advance_to(world.now() + 100ms);
    take_output(world);
  }
  Texts ignored() {
    Texts texts;
    for (const Event& event : events.since(1, SIZE_MAX))
      if (event.what == "ignored") texts.push_back(event.by + " " + event.device + ": " + event.text);
    return texts;
  }

  World world;
  FrameLog frames;
  EventLog events;
};

constexpr int kPulseLow = 0x1000;
constexpr int kSpeed = 0x1002;
constexpr int kMoveInc = 0x1005;
constexpr int kHome = 0x1011;
constexpr int kServo = 0x1014;
constexpr int kDuty = 0x1019;

struct IgnoredCase {
  std::string settings;
  std::vector<std::pair<int, int>> writes;  // the last one has no effect
  std::string why;
};

TEST(IgnoredCommands, SayWhyOnTheBusAndAmongTheEvents) {
  const std::vector<std::pair<int, int>> moving{{kServo, 1}, {kPulseLow, 30000}, {kSpeed, 60}, {kMoveInc, 1}};
  const auto with = [](std::vector<std::pair<int, int>> writes, std::pair<int, int> last) {
    writes.push_back(last);
    return writes;
  };
  for (const IgnoredCase& c : std::vector<IgnoredCase>{
           {"",
            {{kPulseLow, 100}, {kSpeed, 60}, {kMoveInc, 1}},
            "axis A ignores the move: its servo is off (Aaxis_SVON = 0); "
            "choice command_while_servo_off = dropped"},
           {"",
            {{kHome, 1}},
            "axis A ignores the homing: its servo is off (Aaxis_SVON = 0); "
            "choice command_while_servo_off = dropped"},
           {", choices: { command_while_servo_off: kept_until_servo_on }",
            {{kPulseLow, 100}, {kSpeed, 60}, {kMoveInc, 1}},
            "axis A keeps the move until its servo is on: its servo is off (Aaxis_SVON = 0); "
            "choice command_while_servo_off = kept_until_servo_on"},
           {", choices: { command_while_moving: ignored }", with(moving, {kMoveInc, 1}),
            "axis A ignores the move: it is moving; choice command_while_moving = ignored"},
           {", choices: { mode_change_while_moving: ignored }", with(moving, {kDuty, 50}),
            "axis A ignores the duty: it is moving; choice mode_change_while_moving = ignored"},
           {", choices: { home_unassigned: dropped }",
            {{kServo, 1}, {kHome, 1}},
            "axis A ignores the homing: no input is its home (DIN4_Aaxis_Home = 0; "
            "choice home_unassigned = dropped)"},
           {", choices: { ready_gates: yes }, nv: { DIN1_Aaxis_Ready: 1 }",
            {{kServo, 1}, {kPulseLow, 100}, {kSpeed, 60}, {kMoveInc, 1}},
            "axis A ignores the move: its Ready input is off (DIN1_Aaxis_Ready; choice ready_gates = yes)"},
           {", choices: { pulse_rate_cap: command_dropped }",
            {{kServo, 1}, {kPulseLow, 100}, {kSpeed, 32000}, {kMoveInc, 1}},
            "axis A ignores the move: its speed exceeds 100 kHz (choice pulse_rate_cap = "
            "command_dropped)"}}) {
    Host host(c.settings);
    for (const auto& [address, value] : c.writes) host.write(address, value);
    EXPECT_EQ(host.ignored(), Texts{"host f: " + c.why});
    const auto all = host.frames.since(1, SIZE_MAX);
    ASSERT_FALSE(all.empty());
    EXPECT_EQ(all.back().text, "done, but " + c.why);
    EXPECT_TRUE(all.back().is_ignored);
    EXPECT_EQ(all.back().remark, "");
    for (std::size_t i = 0; i + 1 < all.size(); ++i) EXPECT_FALSE(all[i].is_ignored) << all[i].text;
  }
}

/// Each request gets its reason, even if it is the same as that of the request before.
TEST(IgnoredCommands, AreToldForEachRequest) {
  Host host("");
  for (int i = 0; i < 3; ++i) host.write(kHome, 1);
  EXPECT_EQ(host.ignored().size(), 3U);
  int told = 0;
  for (const auto& frame : host.frames.since(1, SIZE_MAX)) told += frame.is_ignored ? 1 : 0;
  EXPECT_EQ(told, 3);
}

TEST(IgnoredCommands, OfAProgramAreEventsOfNobody) {
  Host host("");
  load_program(host.world.device(0), "        Move_INC_A 100\n        END\n");
  host.write(0x3000, 0);
  host.world.advance_to(host.world.now() + 1s);
  EXPECT_EQ(host.ignored(), Texts{" f: axis A ignores the move: its servo is off (Aaxis_SVON = 0); "
                                  "choice command_while_servo_off = dropped"});
}

}  // namespace ignored_test
}  // namespace understudy::emulator::world
