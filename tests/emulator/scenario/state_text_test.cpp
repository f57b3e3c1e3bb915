// The state that a failure tells of, where the terminals and the registers are of different moments.
#include "emulator/scenario/state_text.h"

#include <gtest/gtest.h>

#include "emulator/bench/bench_file.h"

namespace understudy::emulator {
namespace {

TEST(StateText, SaysThatAnInputIsYetToBeRead) {
  World world(parse_bench("understudy: 1\nlines: { a: { stations: [ { name: x, model: simple2-r3 } ] } }\n"
                          "plant: { x.A: { home: { at: 0, width: 5 } } }\n",
                          "bench.yaml", "."),
              {}, {});
  EXPECT_EQ(state_text(world).back(), "x: DIN_4 on (to be read at the next tick)");
  world.advance_to(kTickLength);
  EXPECT_EQ(state_text(world).back(), "x: DIN_4 on");
}

}  // namespace
}  // namespace understudy::emulator
