// Programs on the command line, in any language: checked, converted to numbers and back. This program also
// knows the test controller.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace program_text_test {

Finished with_workbench(Words arguments) {
  arguments.insert(arguments.begin(), WORKBENCH_BINARY);
  return run(arguments);
}

constexpr const char* kGood = "AREA MAIN\nagain: MOVE X -1000\nWAIT *\nJUMP again\n";

TEST(ProgramTexts, AreCheckedInTheLanguageOfAModel) {
  const PrivateFolder folder;
  const std::string good = folder.write("good.wb", kGood);
  const Finished checked = with_workbench({"check", "--model", "workbench", good});
  EXPECT_EQ(checked.exit_code, 0) << checked.errors;
  EXPECT_EQ(checked.output, good + ": workbench program with 4 lines\n");

  const std::string bad = folder.write("bad.wb", "AREA MAIN\n MOVE W 5\n FLY\n");
  const std::string mistakes = bad + ":2:7: axis: 'W' is not one; expected X, Y or Z\n" + bad +
                               ":3:2: 'FLY' is not an instruction; expected one\n";
  const Finished both = with_workbench({"check", "--model", "workbench", good, bad, folder / "none.wb"});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_EQ(both.output, good + ": workbench program with 4 lines\n");
  EXPECT_EQ(both.errors, mistakes + (folder / "none.wb") +
                             ": cannot be read (No such file or directory); expected a file\n");
  // Returns the files of a folder with the language's ending.
  folder.write("other.lst", "NOP\n");
  EXPECT_EQ(with_workbench({"check", "--model", "workbench", folder / "."}).errors.find("other"),
            std::string::npos);
}

TEST(ProgramTexts, WarningsDoNotCountAsMistakes) {
  const PrivateFolder folder;
  const std::string odd = folder.write("odd.lst", "AREA C\nLAB K1\nCJN K2\nLAB K1\nJMP K9\nEND\n");
  const std::string loads = folder.write("loads.lst", "AREA C\nLAB K1\nLAB K1\nJMP K9\nEND\n");
  const std::string twice = loads + ":3:1: warning: label K1 appears twice; expected one, as in line 2\n";
  const std::string missing =
      loads + ":4:1: warning: JMP K9 names a label that the area does not have; expected LAB K9\n";
  const Finished checked = understudy({"check", "--model", "super-40nc", loads});
  EXPECT_EQ(checked.exit_code, 0);
  EXPECT_EQ(checked.output, loads + ": SUPER-40NC listing with 5 lines\n");
  EXPECT_EQ(checked.errors, twice + missing);
  // If there is a mistake, only the mistake is reported.
  const Finished refused = understudy({"check", "--model", "super-40nc", odd});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.errors, odd + ":3:1: CJN K2 has no condition; expected contacts before it\n");
  // With this option, it is an error.
  EXPECT_EQ(
      understudy({"check", "--model", "super-40nc", "--choice", "duplicate_label=refused_at_load", loads})
          .exit_code,
      2);

  const auto form = [&](const char* name) {
    return understudy({"check", "--model", "super-40nc", "--format", name, loads}).output;
  };
  EXPECT_NE(form("github").find("::warning file="), std::string::npos);
  EXPECT_EQ(form("github").find("::error"), std::string::npos);
  EXPECT_NE(form("sarif").find("\"level\": \"warning\""), std::string::npos);
  EXPECT_NE(form("json").find("\"level\": \"warning\""), std::string::npos);
  EXPECT_NE(form("json").find("\"is\": \"SUPER-40NC listing with 5 lines\""), std::string::npos);
}

TEST(ProgramTexts, AreCheckedForAFirmwareAndForOptions) {
  const PrivateFolder folder;
  const std::string file = folder.write("good.wb", kGood);
  const Finished full = with_workbench({"check", "--model", "workbench", "--choice", "longest_area=2", file});
  EXPECT_EQ(full.exit_code, 2);
  EXPECT_EQ(full.errors, file + ":4:1: the area is full; expected at most 2 steps\n");
  const std::pair<Words, const char*> wrong[] = {
      {{"--choice", "longest_area=3"}, "longest_area"},
      {{"--choice", "longest_area"}, "expected ID=OPTION"},
      {{"--firmware", "9.99"}, "9.99"},
      {{"--firmware", "new"}, "'new' is unknown for "},
  };
  for (const auto& [flags, why] : wrong) {
    Words words{"check", "--model", "workbench", file};
    words.insert(words.end(), flags.begin(), flags.end());
    const Finished refused = with_workbench(words);
    EXPECT_EQ(refused.exit_code, 2) << why;
    EXPECT_NE(refused.errors.find(why), std::string::npos) << refused.errors;
  }
  const Finished bench = with_workbench({"check", "--firmware", "1.00", file});
  EXPECT_EQ(bench.exit_code, 2);
  EXPECT_NE(bench.errors.find("need --model"), std::string::npos) << bench.errors;
}

TEST(ProgramTexts, BecomeNumbersAndTextAgain) {
  const PrivateFolder folder;
  const std::string file = folder.write("good.wb", kGood);
  const Finished cells = with_workbench({"asm", "--model", "workbench", file});
  EXPECT_EQ(cells.exit_code, 0) << cells.errors;
  EXPECT_EQ(cells.output, "0 2561 0 -1000\n0 5 -2147483648\n0 4 0\n");
  const std::string written = folder.write("good.cells", cells.output);
  const Finished text = with_workbench({"disasm", "--model", "workbench", written});
  EXPECT_EQ(text.output, "AREA MAIN\ns0:\tMOVE X -1000\n\tWAIT *\n\tJUMP s0\n");
  const std::string wrong = folder.write("wrong.cells", "0 2561 0 -1000\n0 4 7\n0 99\n");
  EXPECT_EQ(with_workbench({"disasm", "--model", "workbench", wrong}).errors,
            wrong + ":3: is not a step; expected an area, a code and its operands\n");
  // Without --model, it is the listing of Simple2-R3.
  const std::string listing = folder.write("a.lst", "END\n");
  EXPECT_EQ(with_workbench({"asm", listing}).output, "255 0 0 0\n");
  EXPECT_EQ(with_workbench({"asm", "--model", "simple2-r3", listing}).output, "255 0 0 0\n");
}

TEST(ProgramTexts, OfSlimAreCheckedAndAreNoNumbers) {
  const PrivateFolder folder;
  const std::string file = folder.write("a.slim", "; a remark\nMA 100\n  NONSENSE\n$A DN\n$A DN\n");
  EXPECT_EQ(with_workbench({"check", "--model", "slim", file}).errors,
            file +
                ":3:3: 'NONSENSE' is not a command; expected one of `understudy describe slim commands`\n" +
                file + ":5:1: begins with a label that another line has\n");
  const Finished cells = with_workbench({"asm", "--model", "slim", file});
  EXPECT_EQ(cells.exit_code, 2);
  EXPECT_NE(cells.errors.find("is not sent as numbers"), std::string::npos) << cells.errors;
}

TEST(ProgramTexts, AreDescribed) {
  const Finished table = with_workbench({"describe", "workbench", "instructions"});
  EXPECT_EQ(table.exit_code, 0) << table.errors;
  EXPECT_TRUE(table.output.starts_with("opcode  mnemonic  operands")) << table.output;
  EXPECT_NE(with_workbench({"models"}).output.find("workbench  a controller for tests"), std::string::npos);
}

/// However a program is loaded, `check` reports its warnings for each file, and `run` and `serve` report each
/// one once.
TEST(ProgramTexts, WarningsOfBenchesAndScenariosAreReported) {
  const PrivateFolder folder;
  const std::string listing = folder.write("lab.lst", "AREA C\nLAB K1\nLAB K1\nJMP K2\nEND\n");
  const std::string head =
      "understudy: 1\nlines: { a: { timing: instant, stations: [ { device: m, port: RS232 } ] } }\n"
      "devices: { m: { model: super-40nc, program: ";
  const std::string bench = folder.write("bench.yaml", head + "lab.lst } }\n");
  const std::string inside =
      folder.write("inside.yaml", head + "\"AREA X\\nLAB K4\\nLAB K4\\nEND\\n\" } }\n");
  const std::string scenario = folder.write(
      "scenario.yaml",
      "understudy: 1\nname: warns\nbench: bench.yaml\nsteps:\n  - for:\n      each: [ 1, 2 ]\n"
      "      as: n\n      steps:\n        - program:\n            m: |\n              AREA X\n"
      "              LAB K4\n              LAB K4\n              END\n  - program: { m: lab.lst }\n");
  const std::string of_listing =
      listing + ":3:1: warning: label K1 appears twice; expected one, as in line 2\n" + listing +
      ":4:1: warning: JMP K2 names a label that the area does not have; expected LAB K2\n";
  const std::string of_step = scenario +
                              ":13:15: warning: steps[0].for.steps[0].program.m: label K4 appears twice; "
                              "expected one, as in line 2\n";
  const Finished checked = understudy({"check", bench});
  EXPECT_EQ(checked.exit_code, 0);
  EXPECT_EQ(checked.errors, of_listing);
  EXPECT_EQ(understudy({"check", inside}).errors, inside +
                                                      ":3:45: warning: devices.m.program: line 3, column 1: "
                                                      "label K4 appears twice; expected one, as in line 2\n");
  EXPECT_EQ(understudy({"check", scenario}).errors, of_listing + of_step);
  EXPECT_EQ(understudy({"run", scenario, scenario}).errors, of_listing + of_step);
  EXPECT_EQ(understudy({"run", "--filter", "*other*", scenario}).errors.find("warning"), std::string::npos);
  const std::string served = understudy({"exec", bench, "--", "true"}).errors;
  EXPECT_NE(served.find("understudy: " + of_listing.substr(0, of_listing.find('\n') + 1)), std::string::npos)
      << served;
  EXPECT_EQ(served.find("appears twice"), served.rfind("appears twice"));
}

}  // namespace program_text_test
}  // namespace understudy::acceptance
