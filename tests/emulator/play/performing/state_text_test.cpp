// The state in a failure, when the terminals and the registers belong to different moments.
#include "emulator/play/performing/state_text.h"
#include "emulator/models/models.h"

#include <gtest/gtest.h>

#include "emulator/world/bench_file/bench_file.h"

namespace understudy::emulator::play {
namespace state_text_test {

TEST(StateText, SaysThatAnInputIsYetToBeRead) {
  world::World world(
      world::parse_bench(models::all_models(),
                         "understudy: 1\nlines: { a: { stations: [ { name: x, model: simple2-r3 } ] } }\n"
                         "plant: { x.A: { home: { at: 0, width: 5 } } }\n",
                         "bench.yaml", "."),
      {}, {});
  EXPECT_EQ(state_text(world).back(), "x: DIN_4 on") << "inputs are read at power-up";
  world.advance_to(kTickLength);
  world.set_external_input(0, find_terminal(world.device(0).model(), "DIN_1"), 1);
  EXPECT_EQ(state_text(world).back(), "x: DIN_1 on (read at the next tick), DIN_4 on");
  world.advance_to(2 * kTickLength);
  EXPECT_EQ(state_text(world).back(), "x: DIN_1 on, DIN_4 on");
}

}  // namespace state_text_test
}  // namespace understudy::emulator::play
