// Blocks of text everywhere in memories: files that follow them, steps that compare and save them, power
// cycles; and their description, with that of ports.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <thread>

#include "emulator/device/describe/describe.h"
#include "emulator/device/memory/nv_file.h"
#include "emulator/models/models.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/reading/scenario_file.h"
#include "emulator/play/results/result_text.h"
#include "emulator/serve/control/messages.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/daemon/nv_keeper.h"
#include "emulator/world/trace/world_capture.h"
#include "tests/emulator/workbench/two_lines.h"

namespace understudy::emulator::workbench {
namespace blocks_kept_test {

using namespace std::chrono_literals;
using Json = nlohmann::json;

class Folder {
 public:
  Folder() { EXPECT_NE(mkdtemp(path_.data()), nullptr); }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string path(const std::string& name) const { return path_ + "/" + name; }
  const std::string& path() const { return path_; }

 private:
  std::string path_ = "/tmp/workbench-blocks-XXXXXX";
};

world::Bench bench_of(const std::string& nv = "") {
  return workbench_bench(
      "understudy: 1\nlines:\n  rs485:\n    timing: instant\n    stations:\n"
      "      - { name: it, model: workbench" +
      nv + " }\n");
}

TextBlocks& blocks_of(world::World& world) { return *world.device(0).memory()->text_blocks(); }

bool eventually(const std::function<bool()>& holds) {
  const auto until = std::chrono::steady_clock::now() + 10s;
  while (!holds()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

TEST(PersistentBlocks, AFileFollowsThemAndIsBegunWith) {
  const Folder folder;
  world::Bench bench = bench_of();
  serve::read_memories(bench, folder.path());
  {
    world::World world(bench, {}, {});
    serve::NvKeeper keeper(bench, world, [](const std::string&) {});
    ASSERT_EQ(blocks_of(world).put("files", "07", SharedText("one\ntwo\n")), "");
    EXPECT_EQ(blocks_of(world).put("recipes", "00", SharedText("salt")), "");
    keeper.poll(1s);
    EXPECT_TRUE(eventually([&] {
      const auto image = read_nv_file(folder.path("it.json"));
      return image && image->blocks == blocks_of(world).all();
    }));
    blocks_of(world).erase("recipes", "00");
  }
  // The block that was erased last no longer exists.
  world::Bench again = bench_of();
  serve::read_memories(again, folder.path());
  world::World world(again, {}, {});
  ASSERT_NE(blocks_of(world).find("files", "07"), nullptr);
  EXPECT_EQ(blocks_of(world).find("files", "07")->text(), "one\ntwo\n");
  EXPECT_EQ(blocks_of(world).find("recipes", "00"), nullptr);
}

TEST(PersistentBlocks, AFileThatTheDeviceRefusesIsReportedWithItsLine) {
  const Folder folder;
  std::ofstream(folder.path("it.json"))
      << "{\"understudy\": 1, \"kind\": \"nv-image\", \"model\": \"workbench\", \"firmware\": \"1.00\",\n"
         "\"registers\": {},\n\"blocks\": {\n  \"files\": {\n    \"07\": [\"a\"],\n    \"B\": [\"a\"]\n}}}\n";
  world::Bench bench = bench_of();
  try {
    serve::read_memories(bench, folder.path());
    ADD_FAILURE() << "it is accepted";
  } catch (const FileError& error) {
    EXPECT_EQ(error.what(),
              folder.path("it.json") + ":6: blocks: files: 'B': is not a number; expected 00 to 99");
  }
}

/// All of them, each in its place.
TEST(PersistentBlocks, ThoseOfABenchAreReportedWithTheirLines) {
  const std::string text =
      "understudy: 1\nlines:\n  rs485:\n    stations:\n      - name: it\n        model: workbench\n"
      "        nv:\n          files:\n            \"07\": good\n            \"B\": no number\n"
      "            \"08\": \"\xFF\"\n          fils:\n            \"01\": a\n          Nix: 1\n          "
      "Nix2: MAIN\n"
      "          Gain_Y: 11\n";
  try {
    world::parse_bench(kWorkbenchModels, text, "bench.yaml", "/tmp");
    ADD_FAILURE() << "it is accepted";
  } catch (const FileError& error) {
    std::string reported;
    for (const FileError::Diagnostic& diagnostic : error.diagnostics()) {
      reported += diagnostic.text + "\n";
    }
    EXPECT_EQ(
        reported,
        "bench.yaml:10:18: lines.rs485.stations[0].nv.files.B: is not a number; expected 00 to 99\n"
        "bench.yaml:11:19: lines.rs485.stations[0].nv.files.08: line 1: is not UTF-8; expected text\n"
        "bench.yaml:13:13: lines.rs485.stations[0].nv.fils: 'fils' is not a kind of block; the nearest "
        "is 'files'\n"
        "bench.yaml:14:16: lines.rs485.stations[0].nv.Nix: no register is called 'Nix'; expected one such as "
        "'Speed_X'\n"
        "bench.yaml:15:17: lines.rs485.stations[0].nv.Nix2: no register is called 'Nix2'; expected one such "
        "as 'Speed_X' (texts of a kind are a map, as in `files: { NAME: TEXT }`)\n"
        "bench.yaml:16:19: lines.rs485.stations[0].nv.Gain_Y: 'Gain_Y': 11 does not fit; expected 0 to 10\n");
  }
}

/// Empty if it passes.
std::string failure_of(const Folder& folder, const std::string& steps, const std::string& nv) {
  const std::string text =
      "understudy: 1\nname: blocks\nbench: { lines: { rs485: { stations: [ { name: it, model: "
      "workbench" +
      nv + " } ] } } }\nsteps:\n" + steps;
  const auto scenario = play::parse_scenarios(kWorkbenchModels, text, folder.path("s.yaml")).front();
  std::string reported;
  for (const std::string& line : play::failure_lines(play::run_scenario(scenario, {}).front()))
    reported += line + "\n";
  return reported;
}

TEST(PersistentBlocks, StepsSaveAndCompareThem) {
  const Folder folder;
  const std::string first = ", nv: { files: { '07': \"a\\nb\\n\" }, recipes: { '01': salt } }";
  EXPECT_EQ(failure_of(folder, "  - save: { it: kept.json }\n", first), "");
  const std::string compare = "  - memory: { it: kept.json }\n";
  EXPECT_EQ(failure_of(folder, "  - power: { it: cycle }\n" + compare, first), "");
  const std::string other = failure_of(folder, compare, ", nv: { files: { '07': \"a\\nc\\n\", '08': d } }");
  EXPECT_NE(other.find("files '07' line 2 is 'c'; expected 'b'"), std::string::npos) << other;
  EXPECT_NE(other.find("files '08' exists; expected no such text"), std::string::npos) << other;
  EXPECT_NE(other.find("recipes '01' is missing; expected it in the memory"), std::string::npos) << other;
}

TEST(PersistentBlocks, OutliveThePowerThatCtlSwitches) {
  serve::DaemonOptions options;
  options.speed.kind = serve::Speed::Kind::manual;
  options.watch_signals = false;
  serve::Daemon daemon(bench_of(", nv: { files: { '07': a } }"), options, [](const std::string&) {});
  const auto ask = [&](const Json& message) {
    Json reply;
    serve::handle_message(daemon, message.dump(),
                          [&](const std::string& line) { reply = Json::parse(line); });
    return reply;
  };
  ASSERT_EQ(blocks_of(daemon.world()).put("files", "08", SharedText("b")), "");
  const NamedBlocks before = blocks_of(daemon.world()).all();
  for (const char* to : {"off", "on", "cycle"}) {
    EXPECT_EQ(ask({{"do", "power"}, {"device", "it"}, {"to", to}}), (Json{{"ok", true}}));
    EXPECT_EQ(blocks_of(daemon.world()).all(), before) << to;
  }
  EXPECT_EQ(ask({{"do", "program"}, {"device", "it"}})["text"], "FILE 07\na\nEND\nFILE 08\nb\nEND\n");
}

TEST(PersistentBlocks, AndPortsAreDescribed) {
  const auto csv = [](const Model& of, const char* what) {
    return format_sheet(*describe(of, what, SheetFormat::csv), SheetFormat::csv);
  };
  EXPECT_EQ(csv(model(), "blocks"), "kind,most,longest\nfiles,100,8192\nrecipes,10,200\nareas,2,4096\n");
  EXPECT_EQ(csv(*find_model(models::all_models(), "simple2-r3"), "blocks"), "kind,most,longest\n");
  EXPECT_EQ(csv(model(), "ports"),
            "name,kind,bauds,framing,protocol\nPC,RS485,115200 9600,8E1,Modbus\nHMI,RS232,19200 "
            "38400,8N1,Modbus\n");
  EXPECT_EQ(csv(*find_model(models::all_models(), "simple2-r3"), "ports"),
            "name,kind,bauds,framing,protocol\nRS485,RS485,19200 115200,8E1,Modbus\n");
}

TEST(Ports, ACaptureNamesThemBesideTheLine) {
  const Folder folder;
  const auto captured = [&](const std::string& name) {
    world::World world(workbench_bench(two_lines_text("timing: instant, ")), {}, {});
    world::WorldCapture capture(world, folder.path(name), [](const std::string&) {});
    capture.begin();
    world.host_opened(0);
    world.receive(0, frame_of("01 03 00 64 00 01"));
    world.advance_to(10ms);
  };
  captured("a.pcapng");
  captured("a.txt");
  const auto text_of = [&](const std::string& name) {
    std::ifstream file(folder.path(name), std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(file), {}};
  };
  EXPECT_NE(text_of("a.pcapng").find("pc (mill PC)"), std::string::npos);
  EXPECT_NE(text_of("a.pcapng").find("hmi (mill HMI)"), std::string::npos);
  EXPECT_NE(text_of("a.txt").find(" pc "), std::string::npos) << text_of("a.txt");
  EXPECT_EQ(text_of("a.txt").find("(mill"), std::string::npos) << text_of("a.txt");
}

// A command has its name next to its bytes.
TEST(Ports, ACaptureNamesCommands) {
  const Folder folder;
  for (const char* name : {"a.pcapng", "a.txt"}) {
    {
      world::World world(workbench_bench(two_lines_text("timing: instant, ")), {}, {});
      world::WorldCapture capture(world, folder.path(name), [](const std::string&) {});
      capture.begin();
      world.host_opened(0);
      world.receive(0, frame_of("01 10 1F 40 00 04 08 0A 01 00 01 FF FF FC 18"));
      world.advance_to(10ms);
      world.receive(0, frame_of("01 10 00 64 00 01 02 00 05"));
      world.advance_to(20ms);
    }
    std::ifstream file(folder.path(name), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::size_t first = text.find("mill: MOVE Y -1000");
    EXPECT_NE(first, std::string::npos) << text;
    EXPECT_EQ(text.find("mill: ", first + 1), std::string::npos) << "only commands and requests: " << text;
  }
}

}  // namespace blocks_kept_test
}  // namespace understudy::emulator::workbench
