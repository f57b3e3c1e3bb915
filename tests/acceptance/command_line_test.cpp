// Bad usage gets one clear line and the documented exit code; commands that only print succeed.
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace command_line_test {

struct BadUsage {
  const char* name;
  Words words;
  const char* reported;  // part of the printed line: the error, or what was expected
  int exit_code = 2;

  friend void PrintTo(const BadUsage& usage, std::ostream* out) { *out << usage.name; }
};

// A program that starts by mistake ends with the test, and its files are in the folder that {} stands for.
const std::vector<BadUsage> kBadUsages = {
    {"NoCommand", {}, "expected"},
    {"UnknownCommand", {"serv"}, "serv"},
    {"UnknownFlag", {"serve", "--model", "simple2-r3", "--bogus"}, "--bogus"},
    {"FlagWithoutValue", {"serve", "--model"}, "--model"},
    {"WordTooMany", {"models", "extra"}, "extra"},
    {"UnknownModel", {"serve", "--model", "simple3-r3"}, "simple2-r3"},
    {"NeitherBenchNorModel", {"serve"}, "--model"},
    {"BothBenchAndModel", {"serve", "{}/good.yaml", "--model", "simple2-r3"}, "bench"},
    {"StationWithABench", {"serve", "{}/good.yaml", "--station", "2"}, "--station"},
    {"StationNoNumber", {"serve", "--model", "simple2-r3", "--station", "x"}, "--station"},
    {"StationTooHigh",
     {"serve", "--model", "simple2-r3", "--station", "16"},
     "--station: 16 is not a station"},
    {"StationNegative", {"serve", "--model", "simple2-r3", "--station", "-1"}, "0 to 15"},
    {"BaudUnknownToTheModel",
     {"serve", "--model", "simple2-r3", "--baud", "9600"},
     "--baud: 9600 is not a speed"},
    {"BaudZero", {"serve", "--model", "simple2-r3", "--baud", "0"}, "115200"},
    {"BaudNegative", {"serve", "--model", "simple2-r3", "--baud", "-19200"}, "115200"},
    {"FirmwareUnknown",
     {"serve", "--model", "simple2-r3", "--firmware", "9.99"},
     "--firmware: '9.99' is unknown"},
    {"FirmwareNoVersion", {"serve", "--model", "simple2-r3", "--firmware", "new"}, "1.52"},
    {"SpeedUnknown", {"serve", "--model", "simple2-r3", "--speed", "fast"}, "manual"},
    {"SpeedZero", {"serve", "--model", "simple2-r3", "--speed", "0"}, "manual"},
    {"SpeedNegative", {"serve", "--model", "simple2-r3", "--speed", "-2x"}, "manual"},
    {"SpeedInfinite", {"serve", "--model", "simple2-r3", "--speed", "inf"}, "manual"},
    {"GroupUnknown", {"serve", "--model", "simple2-r3", "--group", "no-such-group"}, "dialout"},
    {"LinksFolderMissing", {"serve", "--model", "simple2-r3", "--links", "{}/none"}, "existing", 3},
    {"TimingUnknown", {"serve", "--model", "simple2-r3", "--timing", "slow"}, "instant"},
    {"ControlPathTooLong", {"serve", "--model", "simple2-r3", "--control", "{}/{120}"}, "characters", 3},
    {"LinkOfTwoLines", {"serve", "--model", "simple2-r3", "--link", "a\nb"}, "--link: a\\nb: has a control"},
    {"NvIsNoFolder",
     {"serve", "{}/good.yaml", "--nv", "/dev/null"},
     "--nv: /dev/null is not a folder; expected a folder"},
    {"ScenarioToServe", {"serve", "{}/play.yaml"}, "play.yaml:1:1: bench: is a scenario; expected a bench"},
    {"BenchToRun", {"run", "{}/good.yaml"}, "good.yaml:1:1: scenario: is a bench; expected a scenario"},
    {"VeryLongValue", {"serve", "{}/good.yaml", "--timing", "{120}"}, "xxx...' is unknown; expected wire or"},
    {"BenchMissing", {"serve", "{}/missing.yaml"}, "missing.yaml"},
    {"BenchIsAFolder", {"serve", "{}"}, "bench"},
    {"BenchWithUnknownKey", {"serve", "{}/unknown-key.yaml"}, "unknown-key.yaml:4:15: "},
    {"BenchWithUnknownModel", {"serve", "{}/unknown-model.yaml"}, "unknown-model.yaml:5:27: "},
    {"BenchThatIsNoYaml", {"serve", "{}/no-yaml.yaml"}, "no-yaml.yaml:3:8: "},
    {"BenchWithTheSameAddressTwice", {"serve", "{}/same-address.yaml"}, "same-address.yaml:6:9: "},
    {"CheckWithoutFile", {"check"}, "FILE"},
    {"AsmMissingFile", {"asm", "{}/missing.lst"}, "missing.lst: cannot be read"},
    {"DisasmMissingFile", {"disasm", "{}/missing.txt"}, "missing.txt: cannot be read"},
    {"CheckMissingFile", {"check", "{}/missing.yaml"}, "missing.yaml"},
    {"CheckStrayComma", {"check", "{}/comma.yaml"}, "comma.yaml:1:1: file: is not YAML: "},
    {"CheckBadBench", {"check", "{}/unknown-key.yaml"}, "unknown-key.yaml:4:15: "},
    {"DescribeUnknownModel", {"describe", "simpel2", "registers"}, "simple2-r3"},
    {"DescribeUnknownSheet", {"describe", "simple2-r3", "register"}, "registers"},
    {"DescribeUnknownFormat", {"describe", "simple2-r3", "registers", "--format", "xml"}, "markdown"},
    {"CtlWithoutVerb", {"ctl"}, "expected"},
    {"CtlUnknownVerb", {"ctl", "frobnicate"}, "frobnicate"},
    {"CtlAdvanceWithoutUnit", {"ctl", "--control", "{}/none", "advance", "250"}, "250ms"},
    {"CtlAdvanceWithoutDuration", {"ctl", "--control", "{}/none", "advance"}, "250ms"},
    {"CtlAdvanceNegative", {"ctl", "--control", "{}/none", "advance", "-5ms"}, "250ms"},
    {"CtlSpansOfAKind", {"ctl", "--control", "{}/none", "spans", "kind=wait"}, "from=1s or to=2s"},
    {"CtlGetNothing", {"ctl", "--control", "{}/none", "get"}, "name"},
    {"CtlSetNothing", {"ctl", "--control", "{}/none", "set"}, "NAME=VALUE"},
    {"CtlSetTwice", {"ctl", "--control", "{}/none", "set", "STATUS=1", "STATUS=2"}, "twice"},
    {"CtlWithoutDaemon", {"ctl", "--control", "{}/none", "status"}, "none", 3},
    {"PollWithoutPort", {"poll"}, "PORT"},
    {"PollNothing", {"poll", "{}/none"}, "expected"},
    {"PollNoPort", {"poll", "{}/none", "0x0001"}, "none", 3},
    {"PollPortIsAFile", {"poll", "{}/good.yaml", "0x0001"}, "good.yaml", 3},
    {"PollUnknownName", {"poll", "{}/none", "--model", "simple2-r3", "Cord_Q"}, "Cord_A"},
    {"PollNameWithoutModel", {"poll", "{}/none", "Cord_A"}, "--model"},
    {"PollAddressTooHigh", {"poll", "{}/none", "0x10000"}, "0xFFFF"},
    {"PollRangeTooLong", {"poll", "{}/none", "0x4000:126"}, "125"},
    {"PollValueTooWide", {"poll", "{}/none", "0x1002=70000"}, "65535"},
    {"PollBadParity", {"poll", "{}/none", "0x0001", "--parity", "mark"}, "even"},
    {"PollBadType", {"poll", "{}/none", "0x0001", "--type", "float"}, "u16"},
    {"PollBadFunction", {"poll", "{}/none", "0x0001", "--function", "5"}, "3 or 4"},
    {"PollBadTimeout", {"poll", "{}/none", "0x0001", "--timeout", "soon"}, "500ms"},
    {"PollBadStation", {"poll", "{}/none", "0x0001", "--station", "300"}, "247"},
    {"PollBadBaud", {"poll", "{}/none", "0x0001", "--baud", "0"}, "baud"},
    {"PollBadStopBits", {"poll", "{}/none", "0x0001", "--stop-bits", "3"}, "1 or 2"},
    {"PollBadTimes", {"poll", "{}/none", "0x0001", "--times", "-1"}, "times"},
};

constexpr const char* kGoodBench = R"(understudy: 1
lines:
  bus:
    link: ./bus.port
    stations:
      - { name: a, model: simple2-r3, address: 1 }
      - { name: b, model: simple2-r3, address: 2 }
)";

void write_benches(const PrivateFolder& folder) {
  folder.write("good.yaml", kGoodBench);
  folder.write("play.yaml", "understudy: 1\nbench: good.yaml\nsteps: [ advance: 1ms ]\n");
  folder.write("unknown-key.yaml",
               "understudy: 1\nlines:\n  bus:\n    baudrate: 19200\n    stations: [ { name: a, model: "
               "simple2-r3 } ]\n");
  folder.write("unknown-model.yaml",
               "understudy: 1\nlines:\n  bus:\n    stations:\n      - { name: a, model: simple2-r4 }\n");
  folder.write("comma.yaml", ",");
  folder.write("no-yaml.yaml", "understudy: 1\nlines:\n  bus: ]\n");
  folder.write("same-address.yaml",
               "understudy: 1\nlines:\n  bus:\n    stations:\n      - { name: a, model: simple2-r3 }\n"
               "      - { name: b, model: simple2-r3 }\n");
}

class BadUsageOf : public testing::TestWithParam<BadUsage> {};

TEST_P(BadUsageOf, GetsOneClearLine) {
  const PrivateFolder folder;
  write_benches(folder);
  Words words;
  for (std::string word : GetParam().words) {
    for (const auto& [mark, text] :
         {std::pair<std::string, std::string>{"{}", folder.path()}, {"{120}", std::string(120, 'x')}}) {
      if (const auto at = word.find(mark); at != std::string::npos) word.replace(at, mark.size(), text);
    }
    words.push_back(word);
  }
  words.insert(words.begin(), UNDERSTUDY_BINARY);
  Process process(words, {{"XDG_RUNTIME_DIR", folder.path()}});
  const auto exit_code = process.wait(Wait(3000));
  EXPECT_EQ(exit_code, GetParam().exit_code) << process.errors();
  EXPECT_EQ(lines_of(process.errors()).size(), 1U) << process.errors();
  EXPECT_TRUE(process.errors().ends_with('\n'));
  EXPECT_NE(process.errors().find(GetParam().reported), std::string::npos) << process.errors();
  EXPECT_EQ(process.output(), "");
}

INSTANTIATE_TEST_SUITE_P(Of, BadUsageOf, testing::ValuesIn(kBadUsages),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

// --- successful commands ---------------------------------------------------------------------------

TEST(Help, OfEachCommandEndsWell) {
  for (const Words& command : std::vector<Words>{{},
                                                 {"models"},
                                                 {"describe"},
                                                 {"serve"},
                                                 {"ctl"},
                                                 {"ctl", "status"},
                                                 {"ctl", "get"},
                                                 {"ctl", "set"},
                                                 {"ctl", "input"},
                                                 {"ctl", "advance"},
                                                 {"ctl", "pause"},
                                                 {"ctl", "resume"},
                                                 {"poll"},
                                                 {"check"}}) {
    Words words = command;
    words.push_back("--help");
    const Finished finished = understudy(words);
    EXPECT_EQ(finished.exit_code, 0) << testing::PrintToString(words);
    EXPECT_NE(finished.output.find("Usage"), std::string::npos) << finished.output;
    EXPECT_EQ(finished.errors, "");
  }
}

TEST(Models, AreListed) {
  const Finished finished = understudy({"models"});
  EXPECT_EQ(finished.exit_code, 0);
  std::string names;
  std::istringstream lines(finished.output);
  for (std::string line; std::getline(lines, line);) names += line.substr(0, line.find(' ')) + "\n";
  EXPECT_EQ(names, "rs-m8194h\nsimple2-r3\nslim\nsuper-40nc\n") << finished.output;
  EXPECT_EQ(finished.errors, "");
}

TEST(Describe, PrintsEverySheetInEveryFormat) {
  for (const char* sheet : {"registers", "parameters", "instructions", "commands", "choices"}) {
    for (const char* format : {"table", "csv", "json", "markdown"}) {
      const Finished finished = understudy({"describe", "simple2-r3", sheet, "--format", format});
      EXPECT_EQ(finished.exit_code, 0) << sheet << " " << format << ": " << finished.errors;
      EXPECT_EQ(finished.errors, "");
      EXPECT_NE(finished.output, "") << sheet << " " << format;
      if (std::string(format) == "json") {
        EXPECT_TRUE(nlohmann::json::accept(finished.output)) << sheet;
      }
    }
    EXPECT_EQ(understudy({"describe", "simple2-r3", sheet}).output,
              understudy({"describe", "simple2-r3", sheet, "--format", "table"}).output);
  }
}

TEST(Describe, SaysThatAModelHasNoneOfASheet) {
  EXPECT_EQ(understudy({"describe", "slim", "registers"}).output, "slim has no registers\n");
  EXPECT_EQ(understudy({"describe", "simple2-r3", "commands"}).output, "simple2-r3 has no commands\n");
  EXPECT_EQ(understudy({"describe", "simple2-r3", "commands", "--format", "csv"}).output,
            "command,syntax,meaning\n");
}

TEST(Describe, PrintsTheDocumentedColumnsAsCsv) {
  const auto header = [](const char* sheet) {
    return lines_of(understudy({"describe", "simple2-r3", sheet, "--format", "csv"}).output).at(0);
  };
  EXPECT_EQ(header("registers"), "table,address,name,access,width,signed,min,max,unit,persistent,default");
  EXPECT_EQ(header("parameters"), "number,name,address,width,persistent");
  EXPECT_EQ(header("instructions"), "opcode,mnemonic,data1,data2,meaning");
  EXPECT_EQ(header("commands"), "command,syntax,meaning");
  EXPECT_EQ(header("choices"),
            "id,section,question,chosen,alternatives,confidence,why,scenario,section_english");
}

TEST(ProgramText, GoesToCellsAndBack) {
  const PrivateFolder folder;
  // The manual's opcodes: three pulses of DOUT_0.
  const std::string listing = folder.write("blink.lst",
                                           "again: Out DOUT_0 ON\n Delay_mSec 500\n Out 0 OFF\n"
                                           " Delay_mSec 500\n Loop again 3\n END ; three times\n");
  const Finished assembled = understudy({"asm", listing});
  EXPECT_EQ(assembled.exit_code, 0) << assembled.errors;
  const std::string cells = "5 0 1 1\n2 244 1 0\n5 0 0 0\n2 244 1 0\n4 1 3 0\n255 0 0 0\n";
  EXPECT_EQ(assembled.output, cells);
  const Finished text = understudy({"disasm", folder.write("blink.cells", cells)});
  EXPECT_EQ(text.exit_code, 0) << text.errors;
  EXPECT_EQ(understudy({"asm", folder.write("again.lst", text.output)}).output, cells);
}

TEST(ProgramText, ReportsEveryErrorWithItsPlace) {
  const PrivateFolder folder;
  const Finished bad = understudy({"asm", folder.write("bad.lst", "NOP\nJumpp 1\nOut DOUT_9 ON\n")});
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_EQ(bad.output, "");
  EXPECT_EQ(lines_of(bad.errors).size(), 2U) << bad.errors;
  EXPECT_NE(bad.errors.find("bad.lst:2:1: mnemonic: "), std::string::npos) << bad.errors;
  for (const char* cells : {"1 2 3\n", "1 2 3 4 5\n", "1 2 3 256\n", "1 2 3 x\n"}) {
    const Finished refused =
        understudy({"disasm", folder.write("bad.cells", std::string("0 0 0 0\n") + cells)});
    EXPECT_EQ(refused.exit_code, 2) << cells;
    EXPECT_NE(refused.errors.find("bad.cells:2:"), std::string::npos) << refused.errors;
  }
}

TEST(Check, AcceptsAGoodBench) {
  const PrivateFolder folder;
  const Finished finished = understudy({"check", folder.write("good.yaml", kGoodBench)});
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_EQ(finished.errors, "");
}

TEST(Check, AcceptsWhatIsShipped) {
  for (const auto& entry : std::filesystem::directory_iterator(PROJECT_FOLDER "/scenarios")) {
    if (entry.path().extension() != ".yaml") continue;
    EXPECT_EQ(understudy({"check", entry.path().string()}).exit_code, 0) << entry.path();
  }
}

TEST(Check, ReportsEveryBadFile) {
  const PrivateFolder folder;
  write_benches(folder);
  const Finished finished =
      understudy({"check", folder / "unknown-key.yaml", folder / "good.yaml", folder / "no-yaml.yaml"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_EQ(lines_of(finished.errors).size(), 2U) << finished.errors;
  EXPECT_NE(finished.output.find("good.yaml"), std::string::npos) << finished.output;
}

}  // namespace command_line_test
}  // namespace understudy::acceptance
