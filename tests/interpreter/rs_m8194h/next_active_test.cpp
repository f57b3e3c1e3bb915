// When macros must run again.
#include <gtest/gtest.h>

#include <cstdint>

#include "base/simulated_time.h"
#include "interpreter/rs_m8194h/run.h"
#include "tests/interpreter/rs_m8194h/scripted_machine.h"

namespace understudy::interpreter::rs_m8194h {
namespace next_active_test {

/// A line that has been able to run for some time does not count as past.
TEST(RsM8194hNextActive, NeverLiesBehindWhatIsDone) {
  ScriptedMachine machine;
  machine.store("MP 1\nRSM_MACRO_TIMER 50\nEND\nISR 1\nRSM_MACRO_SET_VAR VAR1 1\nEND\n");
  Execution execution;
  EXPECT_EQ(next_active_ms(execution, 7), kNever);
  start_mp(execution, 1, 5, machine);
  for (const std::int64_t done : {0, 3, 4}) EXPECT_EQ(next_active_ms(execution, done), 5) << done;
  for (const std::int64_t done : {5, 7, 100}) EXPECT_EQ(next_active_ms(execution, done), done + 1) << done;
  machine.now_ms = 5;
  run_tick(execution, 5, 8, false, {}, machine);
  EXPECT_EQ(next_active_ms(execution, 5), 55);
  EXPECT_EQ(next_active_ms(execution, 60), 61);
  start_isr(execution, 1, 20, machine);
  EXPECT_EQ(next_active_ms(execution, 5), 20);
  EXPECT_EQ(next_active_ms(execution, 30), 31);
}

}  // namespace next_active_test
}  // namespace understudy::interpreter::rs_m8194h
