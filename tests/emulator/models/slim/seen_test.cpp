// What observers see of a chain: its modules, and AIN as a number.
#include <algorithm>
#include <set>

#include "emulator/models/models.h"
#include "emulator/play/performing/state_text.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/trace/trace.h"
#include "tests/emulator/models/slim/dialogue_script.h"
#include "tests/emulator/world/bench_file/without_columns.h"

namespace understudy::emulator::models::slim {

namespace seen_test {

std::set<std::string> names_of(const world::World& world) {
  std::set<std::string> names;
  for (const world::TraceSignal& signal : world::trace_signals(world, {})) names.insert(signal.name);
  return names;
}

TEST(SlimSeen, TracesHaveTheModulesThatTheChainHas) {
  const auto names = names_of(DialogueScript(2).world());
  for (const char* name :
       {"robot.T0.pulses", "robot.T1.position", "robot.IN8", "robot.T1AIN", "robot.T1P4"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  for (const std::string& name : names) EXPECT_FALSE(name.starts_with("robot.T2")) << name;
  EXPECT_EQ(names_of(DialogueScript(8).world()).count("robot.T7.pulses"), 1u);
}

TEST(SlimSeen, AModuleThatIsLinkedLaterIsThere) {
  DialogueScript script(2);
  const auto shown = [&](const std::string& axis) {
    const auto texts = play::state_text(script.world());
    return std::ranges::any_of(texts, [&](const std::string& text) { return text.starts_with(axis + ": "); });
  };
  EXPECT_TRUE(shown("robot.T1"));
  EXPECT_FALSE(shown("robot.T2"));
  script.type("PN50=5");  // T0 and T2: T1 is still at its position
  EXPECT_TRUE(shown("robot.T1"));
  EXPECT_TRUE(shown("robot.T2"));
  EXPECT_FALSE(shown("robot.T3"));
}

TEST(SlimSeen, TheAnalogInputIsANumber) {
  const auto bench = [](const std::string& level) {
    const std::string text =
        "understudy: 1\nlines: { a: { stations: [ { name: robot, model: slim } ] } }\ninputs: { robot.AIN: " +
        level + " }\n";
    try {
      const world::World world(world::parse_bench(all_models(), text, "b.yaml", "."), world::WorldOptions{},
                               [](const std::string&) {});
      return play::state_text(world).back();
    } catch (const std::exception& error) {
      return world::without_columns(error.what());
    }
  };
  EXPECT_EQ(bench("300"), "robot: AIN 300");
  EXPECT_EQ(bench("2.5V"), "b.yaml:3: inputs.robot.AIN: '2.5V' is not a level; expected a number");
  EXPECT_EQ(bench("on"), "b.yaml:3: inputs.robot.AIN: 'on' is not a level; expected a number");
  EXPECT_EQ(bench("1001"), "b.yaml:3: inputs.robot.AIN: robot.AIN: 1001 is not a level; expected 0 to 1000");
}

}  // namespace seen_test

}  // namespace understudy::emulator::models::slim
