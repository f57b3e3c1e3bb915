// The language of the test controller: checked, loaded, saved, listed, converted to numbers and back,
// described; everywhere that programs are read, with the places of all errors.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/version.h"
#include "emulator/device/describe/describe.h"
#include "emulator/play/performing/performance_recorder.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/reading/scenario_file.h"
#include "emulator/play/results/result_text.h"
#include "emulator/serve/control/messages.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/bench/bench_text.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/recording/recorder.h"
#include "emulator/world/recording/replay.h"
#include "tests/emulator/workbench/workbench.h"

namespace understudy::emulator::workbench {
namespace language_test {

using Json = nlohmann::json;

const ListedModel kModels[] = {&model()};

const std::string kGood =
    "; two areas and a file\n"
    "AREA MAIN\n"
    "again:  MOVE X -1000\n"
    "        SET D5 12\n"
    "        WAIT *\n"
    "        JUMP again\n"
    "AREA ALARM\n"
    "  STOP\n"
    "FILE 07\n"
    "  anything: ; even this\n"
    "END\n";
/// As the device lists it.
const std::string kListed =
    "AREA MAIN\nagain:\tMOVE X -1000\n\tSET D5 12\n\tWAIT *\n\tJUMP again\nAREA ALARM\n\tSTOP\n"
    "FILE 07\n  anything: ; even this\nEND\n";

struct Wrong {
  std::string text;
  std::vector<std::string> mistakes;
};
const Wrong kWrong[] = {
    {"AREA MAIN\n  FLY X 1\n", {"line 2, column 3: 'FLY' is not an instruction; expected one"}},
    {"AREA MAIN\n MOVE W 5\n MOVE X 1000001\n",
     {"line 2, column 7: axis: 'W' is not one; expected X, Y or Z",
      "line 3, column 9: target: '1000001' is not one; expected -1000000 to 1000000"}},
    {"AREA ALARM\nMOVE X 1\n", {"line 2, column 1: MOVE may not stand in ALARM; expected MAIN"}},
    {"AREA MAIN\nMOVE X * ; unset where it may not be\nWAIT *\n",
     {"line 2, column 8: target: '*' is not one; expected -1000000 to 1000000"}},
    {"AREA MAIN\nSET D125 1\nSET E5 1\nSET D5\nSTOP 1\n",
     {"line 2, column 5: register: 'D125' is not one; expected D0 to D124",
      "line 3, column 5: register: 'E5' is not one; expected D0 to D124",
      "line 4, column 1: has 1 operands; expected 2", "line 5, column 6: has 1 operands; expected 0"}},
    {"AREA MAIN\nthere: STOP\n\tJUMP nowhere\nAREA MAINS\nSTOP\n",
     {"line 3, column 7: no step of MAIN is labelled 'nowhere'; expected one",
      "line 4, column 6: is not an area; expected MAIN or ALARM"}},
    {"STOP\n", {"line 1, column 1: stands before the first area; expected AREA MAIN or AREA ALARM"}},
    {"AREA MAIN\n:\tSTOP\n a-b: STOP\nlooooooooooooooooooooooooooooooong: STOP\n",
     {"line 2, column 1: '' is not a label; expected letters and digits",
      "line 3, column 2: 'a-b' is not a label; expected letters and digits",
      "line 4, column 1: 'looooooooooooooooooooooooooooooong' is not a label; expected letters and digits"}},
    {"FILE -5\na\n\xC3\xBC\xFF\nEND\n",
     {"line 1, column 6: is not a number; expected 00 to 99",
      "line 3, column 3: is not UTF-8; expected text"}},
    {"FILE 05\n" + std::string(8191, 'a') + "\nEND\nFILE 06\n" + std::string(8191, 'a') + "\n\n\nEND\n",
     {"line 6: the file is too long; expected at most 8192 bytes"}},
    {"FILE 3\n",
     {"line 1, column 6: is not a number; expected 00 to 99", "line 2: FILE 3 has no end; expected END"}},
};

std::vector<std::string> reported(const std::vector<ProgramMistake>& mistakes) {
  std::vector<std::string> texts;
  for (const ProgramMistake& mistake : mistakes) texts.push_back(in_text(mistake));
  return texts;
}

DeviceSettings settings_with(const std::string& option = "8") {
  DeviceSettings settings;
  settings.name = "it";
  settings.choices = {{"longest_area", option}};
  return settings;
}

TEST(Languages, AllMistakesOfATextHaveLineAndColumn) {
  EXPECT_EQ(reported(check_program(model(), kGood, {})), std::vector<std::string>{});
  for (const Wrong& wrong : kWrong)
    EXPECT_EQ(reported(check_program(model(), wrong.text, {})), wrong.mistakes) << wrong.text;
}

TEST(Languages, ADeviceRefusesWhatTheCheckRefuses) {
  const auto device = make_device(model(), settings_with());
  load_program(*device, kGood);
  for (const Wrong& wrong : kWrong) {
    try {
      load_program(*device, wrong.text);
      ADD_FAILURE() << wrong.text;
    } catch (const ProgramError& error) {
      EXPECT_EQ(reported(error.mistakes), wrong.mistakes);
      EXPECT_EQ(error.what(), error.mistakes.front().what);
    }
    EXPECT_EQ(device->user_program()->program_text(), kListed) << "it is unchanged";
  }
}

TEST(Languages, TheOptionsOfADeviceDecideAsWell) {
  const std::string three = "AREA MAIN\nSTOP\nSTOP\n STOP\n";
  EXPECT_TRUE(check_program(model(), three, settings_with()).empty());
  const std::vector<std::string> full{"line 4, column 2: the area is full; expected at most 2 steps"};
  EXPECT_EQ(reported(check_program(model(), three, settings_with("2"))), full);
  DeviceSettings settings = settings_with("2");
  settings.program = three;
  EXPECT_THROW(make_device(model(), settings), ProgramError);
  EXPECT_THROW(check_program(model(), three, settings_with("3")), SettingError);
  settings.firmware = 7;
  EXPECT_THROW(check_program(model(), three, settings), SettingError);
}

TEST(Languages, AProgramIsListedKeptAndTakenBack) {
  const auto device = make_device(model(), settings_with());
  load_program(*device, kGood);
  EXPECT_EQ(device->user_program()->program_text(), kListed);
  EXPECT_EQ(read_value(*device->register_bank(), *find_register(model(), "D5", 100)), 12);
  device->switch_power(false);
  device->switch_power(true);
  DeviceSettings settings = settings_with();
  settings.nv = device->memory()->nv_image();
  const auto heir = make_device(model(), settings);
  EXPECT_EQ(heir->user_program()->program_text(), kListed);
  load_program(*heir, kListed);
  EXPECT_EQ(heir->user_program()->program_text(), kListed);
}

// --- where programs are read -------------------------------------------------------------------------

class Folder {
 public:
  Folder() { EXPECT_NE(mkdtemp(path_.data()), nullptr); }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ + "/" + name) << text;
    return path_ + "/" + name;
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_ = "/tmp/workbench-language-XXXXXX";
};

std::string bench_text(const std::string& more) {
  return "understudy: 1\nlines:\n  rs485:\n    stations:\n      - { name: it, model: workbench" + more +
         " }\n";
}

TEST(Languages, ABenchReportsAllMistakesWhereTheFileHasThem) {
  const Folder folder;
  const std::string file = folder.write("wrong.wb", kWrong[1].text);
  try {
    world::parse_bench(kModels, bench_text(", program: wrong.wb"), "bench.yaml", folder.path());
    ADD_FAILURE();
  } catch (const FileError& error) {
    EXPECT_EQ(error.what(), file + ":2:7: axis: 'W' is not one; expected X, Y or Z\n" + file +
                                ":3:9: target: '1000001' is not one; expected -1000000 to 1000000");
  }
}

std::string scenario_text(const std::string& steps) {
  return "understudy: 1\nname: a program\nbench: { lines: { rs485: { stations: [ { name: it, model: "
         "workbench } ] "
         "} } }\nsteps:\n" +
         steps;
}

TEST(Languages, AScenarioLoadsAProgramAndReportsAllMistakes) {
  const Folder folder;
  folder.write("wrong.wb", kWrong[1].text);
  const auto diagnostic = [&](const std::string& steps) -> std::string {
    try {
      play::parse_scenarios(kModels, scenario_text(steps), folder.path() + "/s.yaml");
      return "";
    } catch (const FileError& error) {
      return error.what();
    }
  };
  const std::string in_a_file = diagnostic("  - program: { it: wrong.wb }\n");
  EXPECT_NE(in_a_file.find("wrong.wb:2:7: axis: 'W'"), std::string::npos) << in_a_file;
  EXPECT_NE(in_a_file.find("wrong.wb:3:9: target: '1000001'"), std::string::npos) << in_a_file;
  const std::string in_the_step =
      diagnostic("  - program:\n      it: |\n        AREA MAIN\n         MOVE W 5\n         FLY\n");
  EXPECT_NE(in_the_step.find("s.yaml:8:15: steps[0].program.it: axis: 'W'"), std::string::npos)
      << in_the_step;
  EXPECT_NE(in_the_step.find("s.yaml:9:10: steps[0].program.it: 'FLY'"), std::string::npos) << in_the_step;

  const std::string good =
      "  - program:\n      it: |\n        AREA MAIN\n        SET D5 12\n        FILE 07\n        text\n      "
      "  END\n"
      "  - expect: { it.D5: 12, it.Program_Refused: 0 }\n";
  const auto result =
      play::run_scenario(play::parse_scenarios(kModels, scenario_text(good), "s.yaml").front(), {}).front();
  std::string why;
  for (const std::string& line : play::failure_lines(result)) why += line + "\n";
  EXPECT_EQ(result.verdict, play::ScenarioResult::Verdict::passed) << why;
}

TEST(Languages, AScenarioExpectsThatAProgramIsRefused) {
  const auto failure = [](const std::string& steps) {
    const auto result =
        play::run_scenario(play::parse_scenarios(kModels, scenario_text(steps), "s.yaml").front(), {})
            .front();
    std::string why;
    for (const std::string& line : play::failure_lines(result)) why += line + "\n";
    return why;
  };
  const std::string wrong = "  - program: { it: \"AREA MAIN\\nFLY\\n\" }\n";
  const std::string good = "  - program: { it: \"AREA MAIN\\nSTOP\\n\" }\n";
  EXPECT_EQ(failure(wrong + "    refused: true\n  - expect: { it.Program_Refused: 1 }\n"), "");
  EXPECT_EQ(failure(wrong + "    refused: \"line 2, column 1: 'FLY'\"\n"), "");
  EXPECT_NE(
      failure(wrong + "    refused: is full\n").find("it refused the program for a different reason: line 2"),
      std::string::npos);
  EXPECT_NE(failure(good + "    refused: true\n").find("it accepted the program; expected a refusal"),
            std::string::npos);
  // Because of what the device is doing, not because of the text.
  EXPECT_EQ(failure("  - write: { it.Absent: 1 }\n" + good +
                    "    refused: the module is absent\n  - expect: { it.Program_Refused: 1 }\n"),
            "");
  EXPECT_THROW(play::parse_scenarios(kModels, scenario_text(good + "    refused: false\n"), "s.yaml"),
               FileError);
  EXPECT_THROW(play::parse_scenarios(kModels, scenario_text("  - say: x\n    refused: true\n"), "s.yaml"),
               FileError);
  const auto read = play::parse_scenarios(kModels, scenario_text(wrong + "    refused: true\n"), "s.yaml");
  EXPECT_EQ(read.front().steps[0].text, "program it (refused)");
}

struct Served {
  Served()
      : daemon(world::parse_bench(kModels, bench_text(""), "bench.yaml", "/tmp"), options(),
               [](const std::string&) {}) {}
  static serve::DaemonOptions options() {
    serve::DaemonOptions made;
    made.speed.kind = serve::Speed::Kind::manual;
    made.watch_signals = false;
    return made;
  }
  Json ask(const Json& message) {
    Json reply;
    serve::handle_message(daemon, message.dump(),
                          [&](const std::string& line) { reply = Json::parse(line); });
    return reply;
  }
  serve::Daemon daemon;
};

TEST(Languages, TheControlSocketLoadsListsAndReportsAllMistakes) {
  Served served;
  EXPECT_EQ(served.ask({{"do", "program"}, {"device", "it"}, {"text", kGood}}), (Json{{"ok", true}}));
  const Json listed{{"ok", true}, {"text", kListed}};
  EXPECT_EQ(served.ask({{"do", "program"}, {"device", "it"}}), listed);
  const Json refused = served.ask({{"do", "program"}, {"device", "it"}, {"text", kWrong[1].text}});
  EXPECT_EQ(refused["ok"], false);
  EXPECT_EQ(refused["error"], kWrong[1].mistakes[0] + " (and 1 more)");
  EXPECT_EQ(refused["mistakes"],
            Json::parse(R"([{"line":2,"column":7,"what":"axis: 'W' is not one; expected X, Y or Z"},
                            {"line":3,"column":9,
                             "what":"target: '1000001' is not one; expected -1000000 to 1000000"}])"));
  EXPECT_EQ(served.ask({{"do", "program"}, {"device", "it"}}), listed);
  const Json single = served.ask({{"do", "program"}, {"device", "it"}, {"text", kWrong[0].text}});
  EXPECT_EQ(single["error"], kWrong[0].mistakes[0]);
}

// A device may show that a program was refused: a recording contains that as well, even if its text is valid.
TEST(Languages, ARefusedProgramIsRecordedAndRefusedAgain) {
  struct Case {
    std::string text;
    bool is_absent;
  };
  for (const auto& [program, is_absent] : {Case{kWrong[0].text, false}, Case{kGood, true}}) {
    const world::Bench bench = world::parse_bench(kModels, bench_text(""), "bench.yaml", "/tmp");
    world::World world(bench, {}, {});
    std::string text;
    std::uint64_t refused = 0;
    const auto shown = [](world::World& of) {
      return static_cast<std::uint64_t>(static_cast<Workbench&>(of.device(0)).state.program_refused);
    };
    {
      const world::RecordingHeader header{.version = std::string(program_version()),
                                          .bench = world::to_text(bench),
                                          .options = {},
                                          .seed = 1,
                                          .snapshot = {}};
      world::Recorder recorder(world, header, [&](std::string_view line) { text += line; });
      world.advance_to(std::chrono::milliseconds(3));
      EXPECT_TRUE(!world.command(0, "MOVE X 1000"));
      PreparedWrite write;
      const auto absent = world::find_register(world.known(), "it.Absent");
      prepare_value(*world.device(0).register_bank(), absent.place, is_absent ? 1 : 0, write);
      world.write(0, write);
      EXPECT_THROW(world.load_program(0, program), ProgramError);
      EXPECT_EQ(world.command(0, "STOP").refusal, is_absent ? Refusal::failure : Refusal::none);
      world.advance_to(std::chrono::milliseconds(5));
      recorder.finish();
    }
    EXPECT_EQ(shown(world), 1U);
    EXPECT_NE(text.find("\"refused\":true"), std::string::npos) << text;
    EXPECT_NE(text.find("\"do\":\"command\",\"device\":0,\"text\":\"MOVE X 1000\""), std::string::npos)
        << text;
    std::istringstream file(text);
    std::size_t waiting = 0;
    const auto again = world::replay(kModels, file, "a.jsonl", {}, {}, [&](world::World& of) {
      refused = shown(of);
      waiting = static_cast<Workbench&>(of.device(0)).state.fifo.size();
    });
    EXPECT_EQ(again.result.verdict, world::ReplayResult::Verdict::same) << again.result.difference;
    EXPECT_EQ(refused, 1U);
    EXPECT_EQ(waiting, is_absent ? 1U : 2U);
  }
}

// --- numbers ----------------------------------------------------------------------------------------

const std::string kAreasAlone =
    "AREA MAIN\nagain: MOVE X -1000\nSET D5 12\nWAIT *\nJUMP again\nAREA ALARM\nSTOP\n";
const std::string kCells = "0 2561 0 -1000\n0 3 5 12\n0 5 -2147483648\n0 4 0\n1 2562\n";

TEST(Languages, RowsOfNumbersMayDifferInLength) {
  const ProgramCells& cells = *model().language->cells();
  EXPECT_EQ(to_text(cells.assemble(kAreasAlone, settings_with())), kCells);
  const std::string text = cells.disassemble(read_cells(kCells, cells.cell_form()), settings_with());
  EXPECT_EQ(text, "AREA MAIN\ns0:\tMOVE X -1000\n\tSET D5 12\n\tWAIT *\n\tJUMP s0\nAREA ALARM\n\tSTOP\n");
  EXPECT_EQ(to_text(cells.assemble(text, settings_with())), kCells);
  EXPECT_THROW(cells.assemble(kGood, settings_with()), ProgramError) << "a file has no numbers";
  try {
    cells.disassemble(read_cells("\n1 2562\n0 77 1\n", cells.cell_form()), settings_with());
    ADD_FAILURE();
  } catch (const ProgramError& error) {
    EXPECT_EQ(in_file(error.first(), "a"), "a:3: is not a step; expected an area, a code and its operands");
  }
}

// --- describe ---------------------------------------------------------------------------------------

TEST(Languages, DescribeHasOperandsAreasSizesAndCosts) {
  EXPECT_EQ(format_sheet(*describe(model(), "instructions", SheetFormat::csv), SheetFormat::csv),
            "opcode,mnemonic,operands,areas,size,cost,meaning\n"
            "0x0A01,MOVE,\"axis (X, Y or Z); target (-1000000 to 1000000)\",MAIN,2,until the axis stands,"
            "Moves an axis to a target\n"
            "0x0A02,STOP,,MAIN ALARM,1,,Stops all axes\n"
            "0x03,SET,register (D0 to D124); value (0 to 65535),MAIN ALARM,1,,"
            "Sets a register when the program is loaded\n"
            "0x04,JUMP,a label,MAIN,1,,Goes on at a label of its area\n"
            ",WAIT,[ms (0 to 60000)],MAIN ALARM,1,,\"Waits so long, or for the next start\"\n");
}

TEST(Languages, DescribeHasParametersByTheirOwnNumbers) {
  const std::string text = format_sheet(*describe(model(), "parameters", SheetFormat::csv), SheetFormat::csv);
  EXPECT_TRUE(
      text.starts_with("number,name,address,width,persistent\n"
                       "P20,Speed_X,0x0000,16,1\n"
                       "P20,Speed_Y,0x0001,16,1\n"
                       "P20,Speed_Z,0x0002,16,1\n"
                       "D100,D0,0x0064,16,0\n"
                       "D101,D1,0x0065,16,0\n"))
      << text;
  EXPECT_TRUE(text.ends_with("D224,D124,0x00E0,16,0\n7,Offset,0x0008,16,0\n")) << text;
  const Sheet reported = *describe(model(), "parameters", SheetFormat::json);
  EXPECT_EQ(reported.columns.back(), "meaning");
  EXPECT_EQ(reported.rows[1].back(), "speed of axis Y");
  EXPECT_EQ(reported.rows.back().back(), "");
}

/// Its devices accept programs, but the model has no language for them.
const Model& silent() {
  static const Model made = [] {
    Model silent = model();
    silent.language = nullptr;
    silent.make = [](const DeviceSettings& settings) -> std::unique_ptr<Device> {
      return std::make_unique<Workbench>(language_test::silent(), settings);
    };
    return silent;
  }();
  return made;
}

TEST(Languages, AModelAndItsDevicesAgreeOnThem) {
  EXPECT_THROW(make_device(silent(), settings_with()), std::logic_error);
  EXPECT_EQ(reported(check_program(silent(), "", {})),
            std::vector<std::string>{"workbench cannot load a program from a file; expected none"});
}

}  // namespace language_test
}  // namespace understudy::emulator::workbench
