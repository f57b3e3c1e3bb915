// The state of running programs, as bytes and back.
#include <gtest/gtest.h>

#include "base/state/difference.h"
#include "base/state/state_error.h"
#include "interpreter/super_40nc/state_fields.h"
#include "tests/interpreter/super_40nc/running.h"

namespace understudy::interpreter::super_40nc {
namespace state_test {

template <class T>
T again(const T& value) {
  StateWriter writer;
  writer.write(value);
  const std::vector<std::byte> bytes = writer.take();
  StateReader reader(bytes);
  T restored;
  reader.read(restored);
  return restored;
}

TEST(Super40ncState, IsTheSameFromItsBytes) {
  Running running(
      "AREA C\nINCC\nCAL K1 K3\nEND\nLAB K1\nTMR K50\nRET\nAREA X\nDRV K1\nEND\nAREA PLC\nLD X0\nPJG K1\n"
      "RPM K9\nINCC\nPLS M0\nOUT T0 K9\nEND\n");
  running.machine.registers[named::kOwnedAxes] = 0;
  running.machine.set(x(0), true);
  running.run_plc();
  running.start(Area::c);
  running.start(Area::x);
  for (int i = 0; i < 5; ++i) {
    running.scan();
    running.tick();
  }
  running.take(Event::hold, Area::x);
  EXPECT_EQ(again(running.plc), running.plc);
  EXPECT_EQ(again(running.steps), running.steps);
  EXPECT_NE(running.steps, StepStates{});
}

TEST(Super40ncState, WhatNoProgramCanDoIsRefused) {
  StepState state;
  state.left_ms = -1;
  EXPECT_THROW(again(state), StateError);
  state = {};
  state.resumes = Phase::held;
  EXPECT_THROW(again(state), StateError);
  state = {};
  state.calls.resize(5000);
  EXPECT_THROW(again(state), StateError);
}

TEST(Super40ncState, AnyStepCanBeLivedOn) {
  for (const int step : {-5, 1, 3, 100000}) {
    Running running("AREA X\nMOV K1 D0\nEND\n");
    running.start(Area::x);
    running.steps.programs[1].step = step;
    running.tick(3);
    EXPECT_EQ(running.phase(Area::x), Phase::idle) << step;
    EXPECT_EQ(running.machine.codes.size(), 1u) << step;
  }
}

}  // namespace state_test
}  // namespace understudy::interpreter::super_40nc
