// SLIM's persistent memory, and the memory as an image.
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/named_values.h"
#include "tests/emulator/models/slim/dialogue_script.h"

namespace understudy::emulator::models::slim {

namespace memory_test {

TEST(SlimMemory, RefusesAnImageThatDoesNotFit) {
  const auto refusal = [](const NvImage& image) -> std::string {
    world::Bench bench = slim_bench(1);
    bench.devices[0].settings.nv = image;
    try {
      const world::World world(bench, world::WorldOptions{}, [](const std::string&) {});
    } catch (const std::exception& error) {
      return error.what();
    }
    return "(taken)";
  };
  const auto with = [](std::vector<std::pair<std::string, std::int64_t>> registers,
                       std::vector<std::pair<std::string, double>> reals, std::vector<std::string> program) {
    return NvImage{.model = "slim",
                   .firmware = "1.00",
                   .registers = std::move(registers),
                   .reals = std::move(reals),
                   .program = std::move(program)};
  };
  EXPECT_EQ(refusal(with({{"N3", 7}}, {{"PR7", 45.5}}, {"MA 5"})), "(taken)");
  EXPECT_NE(refusal(with({{"N3", 40000}}, {}, {})).find("'N3': 40000 does not fit; expected -32768 to 32766"),
            std::string::npos);
  EXPECT_NE(refusal(with({}, {{"PR7", 200}}, {})).find("'PR7': 200 does not fit; expected 0 to 180"),
            std::string::npos);
  EXPECT_NE(refusal(with({{"N65", 1}}, {}, {})).find("there is no 'N65'"), std::string::npos);
  EXPECT_NE(refusal(with({}, {}, {"NONSENSE"})).find("program: "), std::string::npos);
}

TEST(SlimMemory, LosesWhatWasNotSaved) {
  DialogueScript script(2);
  script.play(R"(
> N3=7
> R3=1.5
> NS(2000)=-12
> RS(5)=0.25
> VM=500
> T1PR3=55.5
> PG
> MA 5
>
off
on
> ?N3
< 0
> ?R3
< 0
> ?VM
< 1000
> ?T1PR3
< 100
> PL
# the arrays are in the flash
> ?NS(2000)
< -12
> ?RS(5)
< 0.25
> N3=7
> R3=1.5
> VM=500
> T1PR3=55.5
> PG
> MA 5
>
> SAVE D
> SAVE C
> SAVE P
off
on
> ?N3
< 7
> ?R3
< 1.5
> ?VM
< 500
> ?T1PR3
< 55.5
> ?PR3
< 100
> PL
< 0: MA 5
> DF
> ?VM
< 1000
> RESET H
> ?VM
< 500
)");
}

/// A display may use an encoding other than UTF-8: its bytes are kept as they are.
TEST(SlimMemory, KeepsTheBytesOfAText) {
  const std::string line = "OUT \"" + std::string(120, '\xFF') + "\"";
  DialogueScript script(1);
  for (const std::string& typed : {std::string("PG"), line, std::string(), std::string("SAVE P")}) {
    script.type(typed);
  }
  const NvImage image = script.device().memory()->nv_image();
  ASSERT_EQ(image.program, std::vector<std::string>{line});
  world::Bench bench = slim_bench(1);
  bench.devices[0].settings.nv = parse_nv_image(to_json(image));
  world::World world(bench, world::WorldOptions{}, [](const std::string&) {});
  EXPECT_EQ(world.device(0).memory()->nv_image(), image);
}

TEST(SlimMemory, IsKeptInAnImage) {
  DialogueScript script(2);
  script.play(R"(
> N3=7
> RS(0)=0.5
> T1VM=77
> PG
> MA 5
>
> SAVE D
> SAVE C
> SAVE P
)");
  const NvImage image = script.device().memory()->nv_image();
  EXPECT_EQ(image.registers, (std::vector<std::pair<std::string, std::int64_t>>{{"N3", 7}}));
  EXPECT_EQ(image.reals, (std::vector<std::pair<std::string, double>>{{"T1PN10", 77}, {"RS(0)", 0.5}}));
  EXPECT_EQ(image.program, (std::vector<std::string>{"MA 5"}));

  world::Bench bench = slim_bench(2);
  bench.devices[0].settings.nv = parse_nv_image(to_json(image));
  world::World world(bench, world::WorldOptions{}, [](const std::string&) {});
  EXPECT_EQ(world.device(0).memory()->nv_image(), image);
  EXPECT_EQ(world.device(0).named_values()->value_named("N3"), 7);
  EXPECT_EQ(world.device(0).named_values()->value_named("T1VM"), 77);
}

}  // namespace memory_test

}  // namespace understudy::emulator::models::slim
