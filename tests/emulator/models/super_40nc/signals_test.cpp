// An axis of a SUPER-40NC gets its machine as levels of inputs, which become signals at the right places:
// with either polarity, and for an axis that counts against the motor's direction.
#include <gtest/gtest.h>

#include "emulator/device/machine_edges.h"
#include "emulator/models/super_40nc/rows/terminals.h"
#include "motion/environment.h"
#include "tests/emulator/models/super_40nc/one_super40nc.h"

namespace understudy::emulator::models::super_40nc {
namespace signals_test {

bool index_is_on(OneSuper40nc& one, std::int64_t travel) {
  return (one.it().parts().axes.chips.environment(0).at(travel) & motion::bit(motion::Signal::index)) != 0;
}

/// The input changes at 100 to 102 and every 1000 pulses from there.
TEST(Super40ncSignals, AnIndexThatIsOffInsideIsOnOutside) {
  for (const bool level_inside : {true, false}) {
    for (const bool is_inverted : {false, true}) {
      OneSuper40nc one({.set = {{"D9100", is_inverted ? 3 : 0}}});
      // X0, the direction of the motor, takes effect with the next start.
      one.press("M8103");
      one.run(300);
      ASSERT_EQ(one.it().parts().axes.chips.chip(0).inverted, is_inverted);
      MachineEdges edges;
      edges.index = {
          .input = pin_of(0, kIndexPin), .level_inside = level_inside, .at = 100, .width = 3, .period = 1000};
      one.it().set_edges(0, edges);
      for (std::int64_t place = -2100; place <= 2100; ++place) {
        const std::int64_t in_period = ((place - 100) % 1000 + 1000) % 1000;
        const bool is_inside = in_period < 3;
        EXPECT_EQ(index_is_on(one, is_inverted ? -place : place), is_inside == level_inside)
            << place << (level_inside ? "" : ", OFF inside") << (is_inverted ? ", inverted" : "");
      }
    }
  }
}

}  // namespace signals_test
}  // namespace understudy::emulator::models::super_40nc
