// Which device keeps its memory in which file, and that the files follow the memories.
#include "emulator/serve/daemon/nv_keeper.h"
#include "emulator/models/models.h"

#include <fstream>
#include <thread>

#include "pty/port_link.h"
#include "tests/emulator/serve/control/daemon_rig.h"

namespace understudy::emulator::serve {
namespace nv_keeper_test {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}
void put(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

std::string image_text(const std::vector<std::pair<std::string, std::int64_t>>& registers,
                       const std::string& model = "simple2-r3") {
  return to_json({.model = model, .firmware = "1.52", .registers = registers});
}

/// feeder and turner, with the given settings.
world::Bench bench_of(const TestFolder& folder, const std::string& feeder = "",
                      const std::string& turner = "") {
  return world::parse_bench(models::all_models(),
                            "understudy: 1\n"
                            "lines:\n"
                            "  rs485:\n"
                            "    timing: instant\n"
                            "    stations:\n"
                            "      - { name: feeder, model: simple2-r3, address: 1" +
                                feeder +
                                " }\n"
                                "      - { name: turner, model: simple2-r3, address: 2" +
                                turner + " }\n",
                            "bench.yaml", folder.path);
}

std::string diagnostic(world::Bench bench, const std::string& folder) {
  try {
    read_memories(bench, folder);
    return "";
  } catch (const FileError& error) {
    return error.what();
  } catch (const NvError& error) {
    return error.what();
  }
}

bool eventually(const std::function<bool()>& holds) {
  const auto until = std::chrono::steady_clock::now() + 10s;
  while (!holds()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

// --- which file ------------------------------------------------------------------------------------------

TEST(ReadMemories, GivesEachDeviceAFileNamedAfterItInANewFolder) {
  const TestFolder folder;
  const std::string nv = folder.path + "/a/b";
  world::Bench bench = bench_of(folder);
  read_memories(bench, nv);
  EXPECT_TRUE(fs::is_directory(nv));
  EXPECT_EQ(bench.devices[0].nv_path, nv + "/feeder.json");
  EXPECT_EQ(bench.devices[1].nv_path, nv + "/turner.json");
  EXPECT_FALSE(bench.devices[0].settings.nv) << "it does not exist yet";
  EXPECT_TRUE(fs::is_empty(nv)) << "reading writes nothing";
}

TEST(ReadMemories, KeepsTheFileFromTheBenchRelativeToTheBench) {
  const TestFolder folder;
  put(folder.path + "/mine.json", image_text({{"Parms_Speed1", 5}}));
  world::Bench bench = bench_of(folder, ", nv: ./mine.json");
  read_memories(bench, folder.path + "/nv");
  EXPECT_EQ(bench.devices[0].nv_path, folder.path + "/mine.json");
  ASSERT_TRUE(bench.devices[0].settings.nv);
  EXPECT_EQ(bench.devices[0].settings.nv->registers.front().second, 5);
  EXPECT_EQ(bench.devices[1].nv_path, folder.path + "/nv/turner.json");
}

TEST(ReadMemories, GivesNoneWithoutAFolder) {
  const TestFolder folder;
  world::Bench bench = bench_of(folder, ", nv: mine.json");
  read_memories(bench, "");
  EXPECT_EQ(bench.devices[0].nv_path, folder.path + "/mine.json");
  EXPECT_EQ(bench.devices[1].nv_path, "");
}

TEST(ReadMemories, RefusesOneFileForTwoDevicesHoweverItIsSpelled) {
  const TestFolder folder;
  fs::create_directory(folder.path + "/nv");
  fs::create_symlink(folder.path + "/nv", folder.path + "/also");
  for (const char* spelled : {"nv/feeder.json", "./nv/../nv/feeder.json", "also/feeder.json"}) {
    const std::string found =
        diagnostic(bench_of(folder, "", std::string(", nv: ") + spelled), folder.path + "/nv");
    EXPECT_NE(found.find("is the memory of 'feeder' and of 'turner'"), std::string::npos) << spelled << found;
    EXPECT_EQ(found.find('\n'), std::string::npos);
  }
  EXPECT_EQ(diagnostic(bench_of(folder, "", ", nv: nv/other.json"), folder.path + "/nv"), "");
  // The bench names both: one path is relative to it, one is absolute.
  const std::string both =
      diagnostic(bench_of(folder, ", nv: nv/one.json", ", nv: " + folder.path + "/also/one.json"), "");
  EXPECT_NE(both.find("is the memory of 'feeder' and of 'turner'"), std::string::npos) << both;
}

TEST(ReadMemories, RefusesWhatIsNoMemoryOfTheDeviceAndLeavesItAlone) {
  const TestFolder folder;
  const std::string whole = image_text({{"Parms_Speed1", 5}});
  const std::pair<std::string, const char*> cases[] = {
      {whole.substr(0, whole.size() / 2), ": is damaged or not JSON"},
      {"", "turner.json:1: is damaged or not JSON"},
      {"{}", "understudy: is missing"},
      {image_text({}, "super-40nc"), "model: is the memory of a 'super-40nc'"},
      {image_text({{"Parms_Speed17", 5}}), "'Parms_Speed17'"},
      {image_text({{"Parms_Speed1", 70'000}}), "'Parms_Speed1': 70000 does not fit"},
      {image_text({{"Cord_A", 1}}), "'Cord_A' is not persistent"},
      {to_json({.model = "simple2-r3", .firmware = "9.99"}),
       "turner.json: firmware: '9.99' is unknown for simple2-r3; expected one of 1.39, "},
      {to_json({.model = "simple2-r3", .firmware = "new"}), "firmware: 'new' is unknown for simple2-r3"},
      {to_json({.model = "simple2-r3", .firmware = ""}), "firmware: is empty; expected the version"},
  };
  for (const auto& [text, why] : cases) {
    const std::string path = folder.path + "/turner.json";
    put(path, text);
    const std::string found = diagnostic(bench_of(folder), folder.path);
    EXPECT_EQ(found.rfind(path + ":", 0), 0u) << found;
    EXPECT_NE(found.find(why), std::string::npos) << found;
    EXPECT_NE(found.find("; "), std::string::npos) << found;
    EXPECT_EQ(found.find('\n'), std::string::npos) << found;
    EXPECT_EQ(text_of(path), text);
  }
}

TEST(ReadMemories, ReportsAllErrorsOfAllOfThem) {
  const TestFolder folder;
  const std::string feeder = folder.path + "/feeder.json";
  const std::string turner = folder.path + "/turner.json";
  put(feeder, to_json({.model = "simple2-r3",
                       .firmware = "9.99",
                       .registers = {{"Cord_A", 1}, {"Parms_Speed1", 70'000}, {"Parms_Speed2", 5}}}));
  put(turner, "{\n");
  try {
    world::Bench bench = bench_of(folder);
    read_memories(bench, folder.path);
    ADD_FAILURE() << "they are in use";
  } catch (const FileError& error) {
    ASSERT_EQ(error.diagnostics().size(), 4u) << error.what();
    const std::string begins[] = {
        feeder + ": firmware: '9.99' is unknown", feeder + ": registers: 'Cord_A' is",
        feeder + ": registers: 'Parms_Speed1': 70000 does", turner + ":2: is damaged or not JSON"};
    for (std::size_t i = 0; i < std::size(begins); ++i) {
      EXPECT_EQ(error.diagnostics()[i].text.rfind(begins[i], 0), 0u) << error.diagnostics()[i].text;
    }
    EXPECT_EQ(error.diagnostics()[3].place.line, 2);
  }
  // There may be a hundred wrong values: no more are reported than for a bench.
  NvImage wild{.model = "simple2-r3", .firmware = "1.52"};
  for (int i = 0; i < 100; ++i) wild.registers.emplace_back("N" + std::to_string(i), 1);
  put(feeder, to_json(wild));
  const std::string many = diagnostic(bench_of(folder), folder.path);
  EXPECT_EQ(std::count(many.begin(), many.end(), '\n'), 20) << many;
}

TEST(ReadMemories, OfAFolderThatCannotBeMadeIsAnError) {
  const TestFolder folder;
  put(folder.path + "/file", "");
  world::Bench bench = bench_of(folder);
  try {
    read_memories(bench, folder.path + "/file");
    ADD_FAILURE() << "was not refused";
  } catch (const NvError& error) {
    EXPECT_EQ(error.what(), "--nv: " + folder.path + "/file is not a folder; expected a folder");
  }
  EXPECT_THROW(read_memories(bench, folder.path + "/file/nv"), std::system_error);
}

TEST(ReadMemories, KeepsTheBenchsOwnRegistersUntilThereIsAFile) {
  const TestFolder folder;
  world::Bench bench = bench_of(folder, ", nv: { Parms_Speed1: 5 }");
  read_memories(bench, folder.path);
  ASSERT_TRUE(bench.devices[0].settings.nv);
  EXPECT_EQ(bench.devices[0].settings.nv->registers.front().second, 5);
  put(folder.path + "/feeder.json", image_text({{"Parms_Speed1", 6}}));
  bench = bench_of(folder, ", nv: { Parms_Speed1: 5 }");
  read_memories(bench, folder.path);
  EXPECT_EQ(bench.devices[0].settings.nv->registers.front().second, 6);
}

// --- the files follow -------------------------------------------------------------------------------------

struct KeptBench {
  explicit KeptBench(const std::string& feeder = "") : bench(bench_of(folder, feeder)) {
    read_memories(bench, folder.path);
    world = std::make_unique<world::World>(bench, world::WorldOptions{}, [](const std::string&) {});
  }
  void start() {
    keeper =
        std::make_unique<NvKeeper>(bench, *world, [this](const std::string& line) { log.push_back(line); });
  }
  std::string path(const std::string& device = "feeder") const {
    return folder.path + "/" + device + ".json";
  }
  void write(const std::string& name, Value value) {
    const world::RegisterName found = world::find_register(world->known(), name);
    EXPECT_EQ(write_value(*world->device(found.device).register_bank(), found.place, value), Refusal::none);
  }
  void run(Tick ticks) { world->advance_to(world->now() + time_of(ticks)); }
  std::optional<std::int64_t> in_file(const std::string& name, const std::string& device = "feeder") const {
    const auto image = read_nv_file(path(device));
    if (!image) return std::nullopt;
    for (const auto& [known, value] : image->registers) {
      if (known == name) return value;
    }
    return 0;
  }
  /// Polls as a loop would, from `from` on, until it wants nothing more; returns how often that was.
  int look_until_quiet(WallTime from) {
    int looks = 0;
    EXPECT_TRUE(eventually([&] {
      if (!keeper->next_poll()) return true;
      keeper->poll(from + ++looks * 1ms);
      return false;
    }));
    return looks;
  }

  TestFolder folder;
  world::Bench bench;
  std::unique_ptr<world::World> world;
  std::vector<std::string> log;
  std::unique_ptr<NvKeeper> keeper;
};

TEST(NvKeeper, WritesWhatIsNotThereYetAtOnce) {
  KeptBench kept(", set: { Parms_Speed3: 33 }");
  kept.start();
  EXPECT_TRUE(
      eventually([&] { return kept.in_file("Parms_Speed3") == 33 && kept.in_file("PROG_MEM0", "turner"); }));
  kept.keeper.reset();
  EXPECT_EQ(text_of(kept.path("turner")), image_text({}));
  EXPECT_TRUE(kept.log.empty());
}

TEST(NvKeeper, LeavesAFileAloneThatSaysTheSame) {
  KeptBench kept;
  // In another order and layout, or from another firmware: none of that is a reason to change the file.
  const std::string text =
      R"({"registers": {"Parms_Speed1": 5, "PROG_MEM1": -1}, "firmware": "1.40", "model": "simple2-r3",)"
      R"( "kind": "nv-image", "understudy": 1})";
  put(kept.path(), text);
  kept.bench = bench_of(kept.folder);
  read_memories(kept.bench, kept.folder.path);
  kept.world = std::make_unique<world::World>(kept.bench, world::WorldOptions{}, [](const std::string&) {});
  kept.start();
  kept.keeper.reset();
  EXPECT_EQ(text_of(kept.path()), text);
}

TEST(NvKeeper, FollowsWhatTheEepromHasKeptNotWhatWaits) {
  KeptBench kept;
  kept.start();
  kept.look_until_quiet(1s);
  kept.write("feeder.Parms_Speed1", 77);  // stored in tick 6
  kept.run(5);
  kept.keeper->poll(10s);
  EXPECT_EQ(kept.keeper->next_poll(), std::nullopt) << "nothing has been stored";
  kept.run(1);
  kept.keeper->poll(11s);
  kept.look_until_quiet(11s);
  EXPECT_EQ(kept.in_file("Parms_Speed1"), 77);
  EXPECT_EQ(kept.in_file("Parms_Speed1", "turner"), 0);
}

TEST(NvKeeper, HandsOverOnceInATenthOfASecondAndTheLatest) {
  KeptBench kept;
  kept.start();
  kept.look_until_quiet(1s);
  kept.write("feeder.PROG_MEM0", 1);
  kept.run(20);
  kept.keeper->poll(10s);  // passed on at once
  for (int i = 2; i <= 30; ++i) {
    kept.write("feeder.PROG_MEM0", i);
    kept.run(20);
    kept.keeper->poll(10s + i * 1ms);
    ASSERT_EQ(kept.keeper->next_poll(), 10s + NvWriter::kCoalesce) << i;
  }
  kept.keeper->poll(10s + NvWriter::kCoalesce);
  kept.look_until_quiet(10s + NvWriter::kCoalesce);
  EXPECT_EQ(kept.in_file("PROG_MEM0"), 30);
}

TEST(NvKeeper, WritesTheRestWhenItGoes) {
  KeptBench kept;
  kept.start();
  kept.write("feeder.PROG_MEM0", 123);
  kept.write("turner.PROG_MEM0", 456);
  kept.run(20);
  kept.keeper.reset();
  EXPECT_EQ(kept.in_file("PROG_MEM0"), 123);
  EXPECT_EQ(kept.in_file("PROG_MEM0", "turner"), 456);
}

TEST(NvKeeper, KeepsOnlyWhatTheEepromHadStoredBeforeAPowerCut) {
  KeptBench kept;
  kept.start();
  kept.write("feeder.PROG_MEM0", 1);
  kept.write("feeder.PROG_MEM1", 2);
  kept.run(11);  // MEM0 is stored in tick 11, MEM1 would be in 21
  kept.world->switch_power(0, false);
  kept.run(100);
  kept.keeper.reset();
  EXPECT_EQ(kept.in_file("PROG_MEM0"), 1);
  EXPECT_EQ(kept.in_file("PROG_MEM1"), 0);
}

TEST(NvKeeper, ReportsAnUnwritableFileEvenInAQuietWorld) {
  KeptBench kept;
  kept.bench.devices[0].nv_path = kept.folder.path + "/gone/feeder.json";
  kept.start();
  // The world has nothing due; only the keeper wakes its owner.
  ASSERT_TRUE(kept.keeper->next_poll()) << "it waits for the result";
  kept.look_until_quiet(1s);
  ASSERT_EQ(kept.log.size(), 1u);
  EXPECT_EQ(kept.log[0], kept.folder.path +
                             "/gone/feeder.json: cannot be written (No such file or directory); the file "
                             "keeps its previous contents");
  // Once it can be written, this is reported, and the file has everything.
  fs::create_directory(kept.folder.path + "/gone");
  kept.write("feeder.PROG_MEM0", 9);
  kept.run(20);
  kept.keeper->poll(2s);
  kept.look_until_quiet(2s);
  ASSERT_EQ(kept.log.size(), 2u);
  EXPECT_EQ(read_nv_file(kept.folder.path + "/gone/feeder.json")->registers.front().second, 9);
}

TEST(NvKeeper, WithoutFilesWantsNothing) {
  TestFolder folder;
  world::Bench bench = bench_of(folder);
  read_memories(bench, "");
  world::World world(bench, {}, {});
  NvKeeper keeper(bench, world, [](const std::string&) {});
  keeper.poll(1s);
  EXPECT_EQ(keeper.next_poll(), std::nullopt);
}

// --- one keeper ------------------------------------------------------------------------------------------
TEST(NvKeeper, IsTheOnlyOneOfAFile) {
  const TestFolder folder;
  world::Bench bench = bench_of(folder);
  read_memories(bench, folder.path + "/nv");
  const world::World world(bench, {}, {});
  std::optional<NvKeeper> first;
  first.emplace(bench, world, [](const std::string&) {});
  world::Bench other = bench_of(folder, ", nv: other.json", ", nv: nv/../nv/turner.json");
  read_memories(other, "");
  const world::World other_world(other, {}, {});
  const auto keep = [&] { NvKeeper(other, other_world, [](const std::string&) {}); };
  try {
    keep();
    FAIL();
  } catch (const pty::PortError& error) {
    EXPECT_EQ(error.what(), folder.path +
                                "/nv/turner.json: nv: another running understudy uses this memory; expected "
                                "a separate file, or a separate folder with --nv, for each");
  }
  first.reset();
  EXPECT_NO_THROW(keep());
  for (const auto& entry : fs::recursive_directory_iterator(folder.path)) {
    EXPECT_FALSE(entry.path().string().ends_with(".lock")) << entry.path() << " is left over";
  }
}

}  // namespace nv_keeper_test
}  // namespace understudy::emulator::serve
