// PWM and the pulse format for observers: conditions, traces, messages.
#include <algorithm>

#include "emulator/device/axes.h"
#include "emulator/world/probe/probes.h"
#include "emulator/world/trace/trace.h"
#include "tests/emulator/models/simple2_r3/choice_cases.h"

namespace understudy::emulator::models::simple2_r3 {
namespace duty_test {

world::Number value_of(const world::Probes& probes, std::string_view name) {
  return probes.value(probes.resolve(name).handle);
}

TEST(Duty, IsWhatComesOutAndNotWhatTheRegisterSays) {
  ReadySimple2 feeder;
  const world::Probes probes(feeder.world());
  feeder.set("DIN0_Aaxis_Alarm", 1);
  EXPECT_EQ(value_of(probes, "feeder.A.pwm"), world::Number(0));
  feeder.set("Aaxis_DirectPWM", 50);
  feeder.run(1);
  EXPECT_EQ(value_of(probes, "feeder.A.pwm"), world::Number(50));
  EXPECT_EQ(value_of(probes, "feeder.B.pwm"), world::Number(0));
  feeder.input(0, true);
  feeder.run(1);
  EXPECT_EQ(value_of(probes, "feeder.A.pwm"), world::Number(0));
  EXPECT_EQ(feeder.get("Aaxis_DirectPWM"), 50);
  EXPECT_FALSE(feeder.moving('A'));
  feeder.set("Aaxis_DirectPWM", 80);  // dropped
  feeder.input(0, false);
  feeder.run(10);
  EXPECT_EQ(value_of(probes, "feeder.A.pwm"), world::Number(0));
  feeder.set("Aaxis_DirectPWM", 20);
  feeder.world().switch_power(0, false);
  EXPECT_EQ(value_of(probes, "feeder.A.pwm"), world::Number(0));
}

TEST(Duty, CanBeSwitchedOffDuringAnAlarm) {
  // Where it would come back afterwards, too.
  ReadySimple2 feeder(with("after_alarm", "resumes"));
  const world::Probes probes(feeder.world());
  feeder.set("DIN0_Aaxis_Alarm", 1);
  feeder.set("Aaxis_DirectPWM", 50);
  feeder.input(0, true);
  feeder.run(5);
  feeder.set("Aaxis_DirectPWM", 0);
  feeder.input(0, false);
  feeder.run(5);
  EXPECT_EQ(value_of(probes, "feeder.A.pwm"), world::Number(0));
  EXPECT_EQ(feeder.get("Aaxis_Mode"), 2);
}

TEST(PulseFormat, IsThatOfTheSwitchAtPowerUp) {
  OneSimple2 feeder;
  const world::Probes probes(feeder.world());
  EXPECT_EQ(value_of(probes, "feeder.pulse_format"), world::Number(0));
  feeder.world().set_external_input(0, 21, true);  // DIP2
  feeder.run(5);
  EXPECT_EQ(value_of(probes, "feeder.pulse_format"), world::Number(0));
  switch_off_and_on(feeder);
  EXPECT_EQ(value_of(probes, "feeder.pulse_format"), world::Number(1));
  EXPECT_EQ(feeder.device().axes()->pulse_format(), "PLS/DIR");
}

TEST(Duty, IsAColumnOfEveryTrace) {
  OneSimple2 feeder;
  const std::vector<world::TraceSignal> signals = world::trace_signals(feeder.world(), {});
  for (const char* name : {"feeder.A.pwm", "feeder.B.pwm", "feeder.pulse_format"}) {
    EXPECT_TRUE(std::any_of(signals.begin(), signals.end(), [&](const auto& signal) {
      return signal.name == name;
    })) << name;
  }
}

}  // namespace duty_test
}  // namespace understudy::emulator::models::simple2_r3
