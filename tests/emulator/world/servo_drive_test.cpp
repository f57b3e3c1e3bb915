// A Simple2-R3 and a servo drive that are wired by their functions: SVON, Ready, ALM, ACLR.
//
//   register or tick    10    11                 61       62       delay 50 ms; times are ticks
//   SVON written  ──────┘
//   drive enabled ────────────┘
//   drive ready   ──────────────────────────────┘
//   STATUS        ────────────────────────────────────────┘        inputs are looked at when a tick begins
#include "tests/emulator/models/simple2_r3/one_simple2.h"

namespace understudy::emulator::models::simple2_r3 {
namespace servo_drive_test {

struct Wiring {
  Tick ready_after = 50;
  bool enabled_by = true;
  Value servo_polarity = 1;
  bool alarm_opens = false;
  Value alarm_polarity = 0;
  Given given{};
};

/// Both axes have a drive, and a machine with limits and an encoder with one count per pulse.
class Servos : public OneSimple2 {
 public:
  explicit Servos(const Wiring& wiring = {}) : OneSimple2(with_drives(wiring)) {}

  bool alarm(char axis) const { return status(0, axis); }
  bool ready(char axis) const { return status(2, axis); }
  bool moves(char axis) const { return status(4, axis); }
  const world::PlantAxis& machine(char axis) { return world().plant(0, axis == 'A' ? 0 : 1); }
  std::size_t inject(world::Fault::Kind kind, char axis, std::int64_t amount = 0) {
    return world().inject({.kind = kind, .device = 0, .place = axis == 'A' ? 0 : 1, .amount = amount});
  }
  /// Moves on at one pulse per tick: after tick n of a move written after tick m, n - m - 6 pulses, from the
  /// tenth on (s = t - 5 with t = 0 in the first tick).
  void start(char axis, Value pulses) {
    set_one_pulse_a_tick(axis, pulses);
    set(name(axis, "Move_INC"), 1);
  }

 private:
  bool status(int bit, char axis) const { return (get("STATUS") >> (bit + (axis == 'A' ? 0 : 1)) & 1) != 0; }

  static Given with_drives(const Wiring& wiring) {
    Given given = wiring.given;
    for (const int axis : {0, 1}) {
      world::PlantSetup plant;
      plant.drive = world::DriveSetup{.ready_after = wiring.ready_after,
                                      .enabled_by = wiring.enabled_by,
                                      .alarm_opens = wiring.alarm_opens};
      plant.lower_limit = -5000;
      plant.upper_limit = 5000;
      plant.encoder_counts_per_revolution = plant.pulses_per_revolution = 1;
      given.plant[axis] = plant;
    }
    for (const char* assignment :
         {"DOUT0_Aaxis_SVON", "DIN1_Aaxis_Ready", "DIN0_Aaxis_Alarm", "DOUT1_Aaxis_ACLR", "DOUT2_Baxis_SVON",
          "DIN6_Baxis_Ready", "DIN5_Baxis_Alarm", "DOUT3_Baxis_ACLR"}) {
      given.set.emplace_back(assignment, 1);
    }
    for (const char axis : {'A', 'B'}) {
      given.set.emplace_back(name(axis, "SVON_Polarity"), wiring.servo_polarity);
      given.set.emplace_back(name(axis, "ALM_Polarity"), wiring.alarm_polarity);
    }
    return given;
  }
};

TEST(ServoDrive, ReadyComesAfterItsDelayToTheMillisecond) {
  for (const char axis : {'A', 'B'}) {
    for (const Tick delay : {0, 1, 50, 1000}) {
      for (const bool straight : {true, false}) {  // SVON_Polarity 1, or 0 and a drive that "off" enables
        Servos servos({.ready_after = delay, .enabled_by = straight, .servo_polarity = straight});
        servos.run_to(10);
        servos.set(servos.name(axis, "SVON"), 1);
        servos.run_to(11 + delay);
        EXPECT_TRUE(servos.machine(axis).ready()) << delay;
        EXPECT_FALSE(servos.ready(axis)) << delay;
        servos.run(1);
        EXPECT_TRUE(servos.ready(axis)) << delay;
        EXPECT_FALSE(servos.ready(axis == 'A' ? 'B' : 'A'));

        servos.run_to(2000);
        servos.set(servos.name(axis, "SVON"), 0);
        servos.run_to(2001);
        EXPECT_FALSE(servos.machine(axis).ready());
        EXPECT_TRUE(servos.ready(axis));
        servos.run_to(2002);
        EXPECT_FALSE(servos.ready(axis));
      }
    }
  }
}

TEST(ServoDrive, WithTheWrongPolarityIsReadyWhileTheServoIsOff) {
  for (const bool by : {true, false}) {
    Servos servos({.enabled_by = by, .servo_polarity = by ? 0 : 1});
    servos.run_to(50);  // enabled with the power, at 0
    EXPECT_FALSE(servos.ready('A'));
    servos.run_to(51);
    EXPECT_TRUE(servos.ready('A'));
    servos.set("Aaxis_SVON", 1);
    servos.run_to(53);
    EXPECT_FALSE(servos.ready('A'));
    servos.start('A', 100);
    servos.run_to(300);
    EXPECT_EQ(servos.coordinate('A'), 100);
    EXPECT_EQ(servos.machine('A').position_pulses(), 0);
    EXPECT_EQ(servos.get("ENCA"), 0);
  }
}

TEST(ServoDrive, WithoutTheFunctionAssignedFollowsThePlainOutput) {
  Servos servos;
  servos.set("DOUT0_Aaxis_SVON", 0);
  servos.set("Aaxis_SVON", 1);
  servos.run_to(100);
  EXPECT_FALSE(servos.ready('A')) << "SVON is not connected";
  servos.set("DOUT_0", 1);
  servos.run_to(151);
  EXPECT_FALSE(servos.ready('A'));
  servos.run_to(152);
  EXPECT_TRUE(servos.ready('A'));
}

TEST(ServoDrive, LosesWhatTheControllerMovesBeforeItIsReady) {
  // 1 pulse per tick from tick 11 on; the drive is ready at the end of tick 61, where 50 - 5 = 45 have been
  // sent.
  Servos servos;
  servos.run_to(10);
  servos.set("Aaxis_SVON", 1);
  servos.start('A', 300);
  servos.run_to(400);
  EXPECT_EQ(servos.coordinate('A'), 300);
  EXPECT_EQ(servos.machine('A').position_pulses(), 255);
  EXPECT_EQ(servos.machine('A').lost_pulses(), 45);
  EXPECT_EQ(servos.get("ENCA"), 255);
}

struct Contact {
  bool opens;
  Value polarity;
};
constexpr Contact kRightContacts[] = {{false, 0}, {true, 1}};

TEST(ServoDrive, AnAlarmStopsMotionAndIsClearedOnceItsCauseIsGone) {
  for (const char axis : {'A', 'B'}) {
    for (const Contact& contact : kRightContacts) {
      SCOPED_TRACE(std::string(1, axis) + (contact.opens ? " opens" : " closes"));
      Servos servos({.alarm_opens = contact.opens, .alarm_polarity = contact.polarity});
      servos.set(servos.name(axis, "SVON"), 1);
      servos.run_to(100);
      ASSERT_TRUE(servos.ready(axis));
      ASSERT_FALSE(servos.alarm(axis));
      servos.start(axis, 1000);
      servos.run_to(200);  // t = 99 ms
      EXPECT_EQ(servos.coordinate(axis), 94);

      const std::size_t cause = servos.inject(world::Fault::Kind::alarm, axis);
      servos.run_to(201);  // the motor does not move, the contact switches
      EXPECT_EQ(servos.coordinate(axis), 95);
      EXPECT_TRUE(servos.moves(axis));
      EXPECT_FALSE(servos.alarm(axis));
      servos.run_to(202);  // the controller sees it
      EXPECT_TRUE(servos.alarm(axis));
      EXPECT_FALSE(servos.ready(axis));
      EXPECT_FALSE(servos.moves(axis));
      EXPECT_EQ(servos.coordinate(axis), 95);
      EXPECT_EQ(servos.machine(axis).position_pulses(), 94);
      EXPECT_EQ(servos.machine(axis).lost_pulses(), 1);
      EXPECT_FALSE(servos.alarm(axis == 'A' ? 'B' : 'A'));

      servos.start(axis, 5);
      EXPECT_FALSE(servos.moves(axis)) << "commands are dropped while it is on";

      servos.set(servos.name(axis, "ACLR"), 1);  // too early: the cause persists
      servos.run_to(500);
      EXPECT_EQ(servos.get(servos.name(axis, "ACLR")), 0);
      EXPECT_TRUE(servos.alarm(axis));
      ASSERT_TRUE(servos.world().clear_fault(cause));
      servos.run_to(600);
      EXPECT_TRUE(servos.alarm(axis)) << "latched by the drive";

      servos.set(servos.name(axis, "ACLR"), 1);
      servos.run_to(601);
      EXPECT_FALSE(servos.machine(axis).in_alarm());
      EXPECT_TRUE(servos.alarm(axis));
      servos.run_to(602);
      EXPECT_FALSE(servos.alarm(axis));
      EXPECT_FALSE(servos.ready(axis)) << "enabled again at 601, ready at 651";
      servos.run_to(651);
      EXPECT_FALSE(servos.ready(axis));
      servos.run_to(652);
      EXPECT_TRUE(servos.ready(axis));
      servos.start(axis, 6);
      servos.run_to(1000);
      EXPECT_EQ(servos.coordinate(axis), 101);
      EXPECT_EQ(servos.machine(axis).position_pulses(), 100);
    }
  }
}

TEST(ServoDrive, OnlyACauseThatGoesWhileAclrIsOnIsCleared) {
  for (const auto& [gone_after, cleared] :
       std::vector<std::pair<Tick, bool>>{{5, true}, {199, true}, {202, false}}) {
    Servos servos;
    servos.set("Aaxis_SVON", 1);
    const std::size_t cause = servos.inject(world::Fault::Kind::alarm, 'A');
    servos.run_to(100);
    servos.set("Aaxis_ACLR", 1);  // on in ticks 101 to 300
    servos.run_to(100 + gone_after);
    EXPECT_TRUE(servos.alarm('A'));
    servos.world().clear_fault(cause);
    servos.run_to(100 + gone_after + 2);
    EXPECT_EQ(servos.alarm('A'), !cleared) << gone_after;
    servos.run_to(2000);
    EXPECT_EQ(servos.alarm('A'), !cleared) << gone_after;
  }
}

TEST(ServoDrive, WithTheWrongAlarmPolarityIsInAlarmUntilItReallyIs) {
  for (const Contact& contact : {Contact{false, 1}, Contact{true, 0}}) {
    Servos servos({.alarm_opens = contact.opens, .alarm_polarity = contact.polarity});
    servos.run_to(1);
    servos.set("Aaxis_SVON", 1);
    servos.run_to(100);
    EXPECT_TRUE(servos.alarm('A'));
    servos.start('A', 100);
    EXPECT_FALSE(servos.moves('A'));
    servos.inject(world::Fault::Kind::alarm, 'A');
    servos.run_to(102);
    EXPECT_FALSE(servos.alarm('A'));
  }
}

TEST(ServoDrive, WithoutThePowerOfItsControllerSeesItsOutputsOpen) {
  for (const bool by : {true, false}) {
    Servos servos({.enabled_by = by, .servo_polarity = by});
    servos.set("Aaxis_SVON", 1);
    servos.run_to(100);
    ASSERT_TRUE(servos.ready('A'));
    servos.world().switch_power(0, false);
    servos.run_to(200);
    EXPECT_EQ(servos.machine('A').ready(), !by) << "enabled by an open output";
    servos.world().switch_power(0, true);
    servos.run_to(202);
    // After power-up the assignments are back (they are persistent), and the servo is off.
    EXPECT_FALSE(servos.machine('A').ready());
    EXPECT_FALSE(servos.ready('A'));
  }
}

TEST(ServoDrive, AnAlarmOutlivesThePowerOfTheController) {
  Servos servos;
  servos.set("Aaxis_SVON", 1);
  const std::size_t cause = servos.inject(world::Fault::Kind::alarm, 'A');
  servos.run_to(100);
  servos.world().switch_power(0, false);
  servos.world().clear_fault(cause);
  servos.run_to(200);
  servos.world().switch_power(0, true);
  servos.run_to(202);
  EXPECT_TRUE(servos.alarm('A'));
  servos.set("Aaxis_ACLR", 1);
  servos.run_to(204);
  EXPECT_FALSE(servos.alarm('A'));
}

TEST(Stall, ShowsAsAnEncoderThatStopsWhileTheCoordinateMoves) {
  Servos servos({.ready_after = 0});
  servos.set("Aaxis_SVON", 1);
  servos.set("ENCA_Resoultion", 1000);
  servos.run_to(100);
  servos.start('A', 1000);
  servos.run_to(301);  // t = 200 ms
  EXPECT_EQ(servos.get("ENCA"), 195);
  EXPECT_EQ(servos.get("ENCA_RPM"), 60);  // 1000 counts per second at 1000 per revolution
  const std::size_t stall = servos.inject(world::Fault::Kind::stall, 'A');
  servos.run_to(401);
  EXPECT_EQ(servos.coordinate('A'), 295);
  EXPECT_EQ(servos.get("ENCA"), 195);
  EXPECT_EQ(servos.get("ENCA_RPM"), 0) << "over the last 100 ms";
  EXPECT_TRUE(servos.moves('A'));
  EXPECT_FALSE(servos.alarm('A')) << "the controller cannot see it";
  servos.world().clear_fault(stall);
  servos.run_to(1200);
  EXPECT_EQ(servos.coordinate('A'), 1000);
  EXPECT_EQ(servos.get("ENCA"), 900);
  EXPECT_EQ(servos.machine('A').lost_pulses(), 100);
}

TEST(LostSteps, OpenARegularGapBetweenCoordinateAndEncoder) {
  Servos servos({.ready_after = 0});
  servos.set("Baxis_SVON", 1);
  servos.run_to(100);
  servos.inject(world::Fault::Kind::lost_steps, 'B', 20);
  servos.start('B', 1000);
  for (Tick tick = 111; tick <= 1000; tick += 7) {
    servos.run_to(tick);
    const Value made = tick - 106;
    EXPECT_EQ(servos.coordinate('B'), made);
    EXPECT_EQ(servos.get("ENCB"), made - made / 20);
  }
  servos.run_to(1300);
  servos.start('B', -1000);  // and back: every 20th again, the other way
  servos.run_to(2600);
  EXPECT_EQ(servos.coordinate('B'), 0);
  EXPECT_EQ(servos.get("ENCB"), 0);
  EXPECT_EQ(servos.machine('B').lost_pulses(), 100);
}

}  // namespace servo_drive_test
}  // namespace understudy::emulator::models::simple2_r3
