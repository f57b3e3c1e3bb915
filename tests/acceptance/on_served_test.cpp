// `understudy run --on` with a served device has the verdicts of simulated time, over a pseudo-terminal and
// over RFC 2217. These scenarios need nothing but the line.
#include <gtest/gtest.h>

#include <string>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace on_served_test {

const std::string kScenarios = std::string(PROJECT_FOLDER) + "/scenarios/";

struct Case {
  std::string scenario;
  std::string bench;
  std::string line;
};
const Case kCases[] = {
    {"simple2-r3/raw_frames.yaml", "plain.yaml", "rs485"},
    {"simple2-r3/speed_zero.yaml", "plain.yaml", "rs485"},
    {"rs-m8194h/raw_frames.yaml", "four_axes.yaml", "com"},
    {"rs-m8194h/call_a_macro.yaml", "four_axes.yaml", "com"},
    {"slim/straight_line.yaml", "chain.yaml", "rs232"},
};

/// Plays a scenario on the device of its own bench.
Finished on_served(const Case& one, const Words& ports) {
  Words words{"exec", kScenarios + "benches/" + one.bench};
  words.insert(words.end(), ports.begin(), ports.end());
  const std::string run = std::string(UNDERSTUDY_BINARY) + " run " + kScenarios + one.scenario + " --on " +
                          one.line + "=$UNDERSTUDY_PORT --allow-motion";
  words.insert(words.end(), {"--", "sh", "-c", run});
  return understudy(words);
}

TEST(RunOnServed, HasTheVerdictsOfSimulatedTime) {
  for (const Case& one : kCases) {
    for (const Words& ports : {Words{}, Words{"--no-pty", "--listen", "rfc2217://127.0.0.1:0"}}) {
      const Finished on = on_served(one, ports);
      EXPECT_EQ(on.exit_code, 0) << one.scenario << "\n" << on.output << on.errors;
      EXPECT_NE(on.output.find("1 passed, 0 failed;"), std::string::npos) << one.scenario << on.output;
      EXPECT_EQ(on.output.find("skipped"), std::string::npos) << one.scenario << on.output;
    }
  }
}

/// With a hidden option, exactly the case of this option passes.
TEST(RunOnServed, FailsWhereAHiddenOptionDiffers) {
  const PrivateFolder folder;
  const std::string bench =
      folder.write("hidden.yaml",
                   "understudy: 1\nlines: { rs485: { stations: [ { name: d, model: simple2-r3, choices: { "
                   "write_out_of_range: clamped } } ] } }\n");
  const std::string proofs = std::string(PROJECT_FOLDER) + "/docs/fidelity/proofs/simple2-r3/addresses.yaml";
  for (const auto& [name, passes] :
       {std::pair{"write_out_of_range: clamped", true}, std::pair{"write_out_of_range: exception_03", false},
        std::pair{"unmapped_addresses: exception_02", true},
        std::pair{"unmapped_addresses: zero_and_ignored", false}}) {
    const std::string run = std::string(UNDERSTUDY_BINARY) + " run " + proofs + " --filter '" + name +
                            "' --on rs485=$UNDERSTUDY_PORT --allow-motion";
    const Finished on = understudy({"exec", bench, "--", "sh", "-c", run});
    EXPECT_NE(on.output.find(passes ? "1 passed, 0 failed;" : "0 passed, 1 failed;"), std::string::npos)
        << name << "\n"
        << on.output << on.errors;
  }
}

}  // namespace on_served_test
}  // namespace understudy::acceptance
