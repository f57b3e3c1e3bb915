// The persistent memory of the test controller: an EEPROM with its time, battery RAM, and named texts; in
// images, in states, and through power cuts.
#include "tests/emulator/workbench/memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "emulator/device/register_map/access.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/snapshot_file.h"
#include "tests/emulator/workbench/workbench.h"
#include "tests/emulator/world/same_world.h"

namespace understudy::emulator::workbench {
namespace memory_test {

using namespace std::chrono_literals;

world::Bench bench_with(const std::string& nv = "") {
  const ListedModel models[] = {&model()};
  return world::parse_bench(models,
                            "understudy: 1\nlines:\n  rs485:\n    timing: instant\n    stations:\n"
                            "      - { name: it, model: workbench" +
                                (nv.empty() ? "" : ", nv: " + nv) + " }\n",
                            "bench.yaml", "/nonexistent");
}

struct Rig {
  explicit Rig(const world::Bench& given = bench_with()) : bench(given), world(bench, {}, {}) {}
  Workbench& device() { return dynamic_cast<Workbench&>(world.device(0)); }
  TextBlocks& blocks() { return *device().memory()->text_blocks(); }
  NvImage image() { return device().memory()->nv_image(); }
  void set(const std::string& name, Value value) {
    const auto place = find_register(device().model(), name, 100);
    ASSERT_EQ(write_value(*device().register_bank(), *place, value), Refusal::none);
  }
  std::int64_t kept(const std::string& name) {
    for (const auto& [called, value] : image().registers) {
      if (called == name) return value;
    }
    return -1;
  }
  void fill() {
    for (int i = 0; i < 100; ++i) {
      const std::string number = std::to_string(100 + i).substr(1);
      std::string text;
      while (text.size() < 7000) text += "MOVE " + number + " " + std::to_string(text.size()) + "\n";
      ASSERT_EQ(blocks().put("files", number, SharedText(text)), "");
    }
    ASSERT_EQ(blocks().put("recipes", "03", SharedText("flour 300\nwater 180")), "");
  }
  world::Bench bench;
  world::World world;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream rest(text);
  for (std::string line; std::getline(rest, line);) lines.push_back(line);
  return lines;
}

std::string refusal(const std::string& text) {
  try {
    const NvImage image = parse_nv_image(text);
    Rig rig;
    rig.device().memory()->load_nv(image);
    return "";
  } catch (const NvError& error) {
    return error.what();
  }
}

TEST(WorkbenchMemory, KeepsARowAtOnceBesideAnEeprom) {
  Rig rig;
  rig.world.advance_to(10ms);
  rig.set("Total", 70000);
  rig.set("Speed_X", 200);
  EXPECT_EQ(rig.kept("Total"), 70000);
  EXPECT_EQ(rig.kept("Speed_X"), -1);
  rig.world.switch_power(0, false);
  rig.world.switch_power(0, true);
  EXPECT_EQ(rig.kept("Total"), 70000);
  rig.set("Speed_X", 200);
  rig.world.advance_to(20ms);
  EXPECT_EQ(rig.kept("Speed_X"), 200);
}

TEST(WorkbenchMemory, SurvivesPowerCutsAtAnyMoment) {
  std::mt19937 random(16);
  Rig rig;
  SimTime now = 0ms;
  Value total = 0;
  Value speed_kept = 100;
  std::vector<std::string> files(100);
  for (int round = 0; round < 300; ++round) {
    total = static_cast<Value>(random());
    rig.set("Total", total);
    const auto number = static_cast<std::uint16_t>(random() % 100);
    const auto word = static_cast<std::uint16_t>('A' << 8 | ('a' + round % 26));
    const std::uint16_t words[] = {2, 0, number, word};
    ASSERT_EQ(take_block(rig.device(), {}, words).refusal, Refusal::none);
    files[number] += {'A', static_cast<char>('a' + round % 26)};
    const Value speed = 1 + static_cast<Value>(random() % 4000);
    rig.set("Speed_X", speed);
    const int wait = static_cast<int>(random() % 12);
    now += std::chrono::milliseconds(wait);
    rig.world.advance_to(now);
    // A write after tick n is stored at the end of tick n + 1 + its time.
    if (wait >= kWriteTime + 1) speed_kept = speed;
    rig.world.switch_power(0, false);
    rig.world.switch_power(0, true);
    ASSERT_EQ(rig.kept("Total"), total) << round;
    ASSERT_EQ(rig.kept("Speed_X") == -1 ? 100 : rig.kept("Speed_X"), speed_kept) << round << " " << wait;
    for (int i = 0; i < 100; ++i) {
      const SharedText* const file = rig.blocks().find("files", std::to_string(100 + i).substr(1));
      ASSERT_EQ(file == nullptr ? "" : file->text(), files[static_cast<std::size_t>(i)]) << round;
    }
  }
}

TEST(WorkbenchMemory, IsTheSameReadBackFromItsImage) {
  Rig rig;
  rig.fill();
  for (const char* text :
       {"", "\n", "a", "a\n", "\n\na\n\n", "  two: {x}\t\"q\" \\", "\xC3\xBC\xE2\x82\xAC", "a\r\n"}) {
    ASSERT_EQ(rig.blocks().put("recipes", "01", SharedText(text)), "");
    const NvImage image = rig.image();
    const NvImage again = parse_nv_image(to_json(image));
    EXPECT_EQ(again, image) << text;
    Rig other;
    other.world.switch_power(0, false);
    other.device().memory()->load_nv(again);
    EXPECT_EQ(other.image(), image) << text;
  }
}

TEST(WorkbenchMemory, ChangesOneLineOfItsFileForOneLine) {
  Rig rig;
  rig.fill();
  const auto before = lines_of(to_json(rig.image()));
  std::string text = rig.blocks().find("files", "42")->text();
  text.replace(text.find("MOVE"), 4, "STOP");
  ASSERT_EQ(rig.blocks().put("files", "42", SharedText(text)), "");
  const auto after = lines_of(to_json(rig.image()));
  ASSERT_EQ(before.size(), after.size());
  int changed = 0;
  for (std::size_t i = 0; i < before.size(); ++i) changed += before[i] != after[i] ? 1 : 0;
  EXPECT_EQ(changed, 1);
}

TEST(WorkbenchMemory, ReadsImagesOfAFormerVersion) {
  const NvImage former = parse_nv_image(
      R"({"understudy":1,"kind":"nv-image","model":"workbench","firmware":"1.00","registers":{"Speed_X":7}})");
  EXPECT_TRUE(former.blocks.empty());
  Rig rig;
  rig.fill();
  rig.world.switch_power(0, false);
  rig.device().memory()->load_nv(former);
  EXPECT_EQ(rig.image().registers, former.registers);
  EXPECT_TRUE(rig.image().blocks.empty());
}

TEST(WorkbenchMemory, RefusesBadBlocksByLineAndName) {
  const auto with = [](const std::string& blocks) {
    return refusal(
        "{\"understudy\":1,\"kind\":\"nv-image\",\"model\":\"workbench\",\"firmware\":\"1.00\",\n"
        "\"registers\":{},\n\"blocks\":{\n" +
        blocks + "}}");
  };
  EXPECT_EQ(with("\"files\":{\n\"07\":[\"a\"]}"), "");
  EXPECT_EQ(with("\"files\":{\n\"07\":\"a\"}"),
            "line 5: blocks: files: '07': is not a list of lines; expected one");
  EXPECT_EQ(with("\"files\":{\n\"07\":[\"a\\nb\"]}"),
            "line 5: blocks: files: '07': is not a list of lines; expected one");
  EXPECT_EQ(with("\"files\":[]"), "line 4: blocks: files: is not an object; expected names and lines");
  EXPECT_EQ(with("\"files\":{\n\"07\":[\"a\",\n\"\xFF\"]}"),
            "line 6: blocks: files: '07': is not UTF-8; expected text");
  EXPECT_EQ(with("\"files\":{\n\"07\":[\"a\"],\n\"07\":[\"b\"]}"),
            "line 6: blocks: '07': appears twice; expected it only once");
  // Writes that the device itself refuses.
  EXPECT_EQ(with("\"recipes\":{},\n\"fils\":{\"07\":[\"a\"]}").substr(0, 46),
            "line 5: blocks: 'fils' is not a kind of block;");
  EXPECT_EQ(with("\"files\":{\n\"07\":[\"a\"],\n\n\"A\":[\"a\"]}"),
            "line 7: blocks: files: 'A': is not a number; expected 00 to 99");
  EXPECT_EQ(with("\"recipes\":{\n\"00\":[\"" + std::string(201, 'x') + "\"]}"),
            "line 5: blocks: recipes: '00': has 201 bytes; expected at most 200");
  std::string many;
  for (int i = 0; i < 11; ++i) many += (i == 0 ? "\"" : ",\n\"") + std::to_string(10 + i) + "\":[\"a\"]";
  EXPECT_EQ(with("\"recipes\":{\n" + many + "}"),
            "line 4: blocks: recipes: has 11 entries; expected at most 10");
}

// An image is made on request, of the moment of the request, without the device.
TEST(WorkbenchMemory, IsGivenAwayAsItIsAndMadeIntoAnImageLater) {
  LateImage late;
  NvImage wanted;
  {
    Rig rig;
    rig.fill();
    rig.set("Total", 70000);
    wanted = rig.image();
    late = rig.device().memory()->content_now();
    rig.set("Total", 5);
    ASSERT_EQ(rig.blocks().put("files", "42", SharedText("b\n")), "");
    rig.blocks().erase("files", "43");
    EXPECT_NE(rig.image(), wanted);
  }
  NvImage made;
  std::thread([&] { made = late(); }).join();
  EXPECT_EQ(made, wanted);
}

TEST(WorkbenchMemory, SharesBlocksThatDidNotChangeWithItsImages) {
  Rig rig;
  rig.fill();
  const auto before = rig.blocks().shared();
  EXPECT_EQ(*before, rig.blocks().all());
  rig.set("Total", 70000);
  ASSERT_EQ(rig.blocks().put("files", "42", *rig.blocks().find("files", "42")), "") << "the same again";
  EXPECT_EQ(rig.blocks().shared(), before);
  ASSERT_EQ(rig.blocks().put("files", "42", SharedText("b\n")), "");
  const auto after = rig.blocks().shared();
  EXPECT_NE(after, before);
  EXPECT_EQ(before->at("files").at("42").text().substr(0, 4), "MOVE") << "a shared image is unchanged";
  EXPECT_EQ(*after, rig.blocks().all());
  EXPECT_EQ(&before->at("files").at("41").text(), &after->at("files").at("41").text());
  ASSERT_TRUE(rig.blocks().erase("files", "41"));
  EXPECT_EQ(*rig.blocks().shared(), rig.blocks().all());
  rig.blocks().replace({});
  EXPECT_TRUE(rig.blocks().shared()->empty());
  // From a state that was restored.
  const std::vector<std::byte> none = rig.device().save_state();
  rig.fill();
  EXPECT_FALSE(rig.image().blocks.empty());
  rig.device().restore_state(none);
  EXPECT_TRUE(rig.image().blocks.empty());
}

TEST(WorkbenchMemory, RefusesWhatDoesNotFitAndChangesNothing) {
  Rig rig;
  rig.fill();
  const NvImage before = rig.image();
  const std::uint64_t revision = rig.device().memory()->memory_revision();
  EXPECT_EQ(rig.blocks().put("files", "01", SharedText("a\n\xC0\xAF")),
            "line 2: is not UTF-8; expected text");
  EXPECT_NE(rig.blocks().put("macros", "01", SharedText("a")), "");
  for (int i = 0; i < 10; ++i) rig.blocks().put("recipes", std::to_string(10 + i), SharedText("x"));
  EXPECT_NE(rig.blocks().put("recipes", "50", SharedText("x")), "");
  for (int i = 0; i < 10; ++i) rig.blocks().erase("recipes", std::to_string(10 + i));
  EXPECT_EQ(rig.image(), before);
  EXPECT_GT(rig.device().memory()->memory_revision(), revision);
  NvImage bad = before;
  bad.registers.emplace_back("Nothing", 1);
  bad.blocks.clear();
  rig.world.switch_power(0, false);
  EXPECT_THROW(rig.device().memory()->load_nv(bad), NvError);
  EXPECT_EQ(rig.image(), before);
}

TEST(WorkbenchMemory, CountsOnlyWhatChanges) {
  Rig rig;
  rig.fill();
  const std::uint64_t revision = rig.device().memory()->memory_revision();
  rig.fill();
  rig.set("Total", 0);
  rig.set("Offset", 5);
  rig.world.advance_to(100ms);
  EXPECT_EQ(rig.device().memory()->memory_revision(), revision);
}

TEST(WorkbenchMemory, StandsInABench) {
  Rig rig(bench_with("{ Total: 5, files: { '07': \"a\\nb\\n\" }, recipes: { '01': salt } }"));
  EXPECT_EQ(rig.kept("Total"), 5);
  EXPECT_EQ(rig.blocks().find("files", "07")->text(), "a\nb\n");
  EXPECT_EQ(rig.blocks().find("recipes", "01")->text(), "salt");
  EXPECT_THROW(bench_with("{ files: { A: x } }"), std::runtime_error);
}

TEST(WorkbenchMemory, IsSharedBySnapshotsAndWholeOnDisk) {
  Rig rig;
  rig.fill();
  const world::WorldState first = save(rig.world);
  rig.set("Offset", 5);
  const world::WorldState second = save(rig.world);
  EXPECT_NE(first, second);
  const auto texts = [](const world::WorldState& state) { return state.parts[1].texts; };
  ASSERT_EQ(texts(first).size(), 101U);
  EXPECT_LT(first.parts[1].bytes.size(), 100'000U);
  for (std::size_t i = 0; i < 101; ++i) EXPECT_EQ(&texts(first)[i].text(), &texts(second)[i].text());

  const std::uint64_t of_bench = world::bench_hash(rig.bench);
  const world::WorldState read = world::parse_snapshot(world::to_text(second, of_bench), of_bench);
  EXPECT_EQ(read, second);
  Rig other;
  restore(other.world, read);
  EXPECT_EQ(save(other.world), second);
  EXPECT_TRUE(world::same_state(other.world, rig.world));
  EXPECT_EQ(other.image(), rig.image());

  ASSERT_EQ(other.blocks().put("files", "42", SharedText("b\n")), "");
  EXPECT_NE(world::hash(other.world), world::hash(rig.world));
  EXPECT_NE(world::difference(rig.world, second, save(other.world)).find("it.kept.blocks"),
            std::string::npos);
  EXPECT_EQ(save(rig.world), second);  // what is shared does not change
}

TEST(WorkbenchMemory, RefusesStatesWithOtherTexts) {
  Rig rig;
  rig.fill();
  const world::WorldState good = save(rig.world);
  const auto refuses = [&](const auto& spoil) {
    world::WorldState bad = good;
    spoil(bad.parts[1].texts);
    EXPECT_THROW(restore(rig.world, bad), StateError);
    EXPECT_EQ(save(rig.world), good);
  };
  refuses([](SharedTexts& texts) { texts[50] = SharedText("other"); });
  refuses([](SharedTexts& texts) { texts.pop_back(); });
  refuses([](SharedTexts& texts) { texts.emplace_back("more"); });
  refuses([](SharedTexts& texts) { std::swap(texts[1], texts[2]); });
  const std::vector<std::byte> whole = rig.device().save_state();
  EXPECT_GT(whole.size(), 700'000U);
  rig.device().restore_state(whole);
  EXPECT_EQ(save(rig.world), good);
}

}  // namespace memory_test
}  // namespace understudy::emulator::workbench
