// What a power cut leaves of a SUPER-40NC, at random moments of writes, of changes of files and recipes, of
// loads and of running programs, compared with a plain model of its memory. UNDERSTUDY_SEED overrides.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "emulator/device/memory/persistent_memory.h"
#include "emulator/models/super_40nc/programs/files.h"
#include "tests/emulator/models/super_40nc/listings.h"

namespace understudy::emulator::models::super_40nc {
namespace power_cut_test {

constexpr const char* kLatched[] = {"D500", "D777",  "D999",  "M400",        "M511",        "S80",
                                    "S127", "M8650", "D9190", "holding.T60", "holding.C20", "coil.C20"};
constexpr const char* kForgotten[] = {"D0",    "D499",       "M0",      "M399", "S79",
                                      "M8590", "holding.T5", "coil.C5", "D8023"};
constexpr const char* kRecipe[] = {"D500", "D777", "D999"};

/// A C program that shows which one it is.
std::string program(int number) { return "AREA C\nMOV K" + std::to_string(number) + " D0\nEND\n"; }

/// The expected contents after a power cut.
struct StoredRegister {
  std::map<std::string, Value> latched;
  std::map<Value, std::map<std::string, Value>> recipes;
  std::map<Value, int> files;  // except the one in memory
  Value recipe = 0;
  Value file = 0;
  int in_memory = 0;  // which program; 0: none

  void change_recipe(Value number) {
    if (number < 0 || number > 99 || number == recipe) return;
    for (const char* name : kRecipe) {
      recipes[recipe][name] = latched[name];
      latched[name] = recipes[number][name];
    }
    recipe = number;
  }
  void change_file(Value number) {
    if (number < 0 || number >= 20 || number == file) return;
    files[file] = in_memory;
    in_memory = files[number];
    file = number;
  }
};

void expect_kept(OneSuper40nc& one, StoredRegister& kept, const std::string& when) {
  for (const char* name : kLatched) ASSERT_EQ(one.get(name), kept.latched[name]) << name << when;
  for (const char* name : kForgotten) ASSERT_EQ(one.get(name), 0) << name << when;
  ASSERT_EQ(one.get("D9001"), kept.file) << when;
  ASSERT_EQ(one.get("D9002"), kept.recipe) << when;
  ASSERT_EQ(positions(one), Places{}) << when;
  for (const char* contact : {"M8000", "M8100", "M8195"}) ASSERT_FALSE(one.on(contact)) << when;
  one.set("M8000", 1);
  one.run(3);
  ASSERT_EQ(one.get("D0"), kept.in_memory) << when;
  one.set("D0", 0);
}

/// The contents of a memory file make the same controller.
void expect_same_by_its_file(OneSuper40nc& one, StoredRegister kept, const std::string& when) {
  const std::string text = to_json(one.device().memory()->nv_image());
  OneSuper40nc other;
  other.world().switch_power(0, false);
  other.device().memory()->load_nv(parse_nv_image(text));
  other.world().switch_power(0, true);
  EXPECT_EQ(to_json(other.device().memory()->nv_image()), text) << when;
  expect_kept(other, kept, when + ", by its file");
  for (const Value number : {0, 1, 2, 3}) {
    other.set("D9001", number);
    kept.change_file(number);
    other.set("D9002", number);
    kept.change_recipe(number);
    for (const char* name : kLatched) ASSERT_EQ(other.get(name), kept.latched[name]) << name << when;
    other.set("M8000", 1);
    other.run(3);
    ASSERT_EQ(other.get("D0"), kept.in_memory) << when << ", file " << number;
    other.set("D0", 0);
  }
}

TEST(Super40ncPowerCut, LeavesWhatIsKeptWhole) {
  const char* const given_seed = std::getenv("UNDERSTUDY_SEED");
  const std::uint64_t first = given_seed != nullptr ? std::stoull(given_seed) : 1;
  for (std::uint64_t seed = first; seed < first + 40; ++seed) {
    std::mt19937_64 random(seed);
    const auto below = [&](int max) { return std::uniform_int_distribution<int>(0, max - 1)(random); };
    // X moves all the time, so that motion is interrupted.
    OneSuper40nc one({.program = "AREA X\nLAB K1\nDRV K9000\nDRV K0\nJMP K1\nEND\n"});
    StoredRegister kept;
    for (int acts = 0; acts < 60; ++acts) {
      const std::string when = ", seed " + std::to_string(seed) + ", act " + std::to_string(acts);
      switch (below(8)) {
        case 0:
        case 1: {
          const std::string name = kLatched[below(std::size(kLatched))];
          const bool is_contact = name[0] == 'M' || name[0] == 'S' || name.starts_with("coil");
          const Value value = is_contact ? below(2) : below(2'000'000) - 1'000'000;
          one.set(name, value);
          kept.latched[name] = value;
          break;
        }
        case 2: {
          const std::string name = kForgotten[below(std::size(kForgotten))];
          one.set(name, 1);
          break;
        }
        case 3: {
          const Value number = below(10) == 0 ? 100 : below(4);
          one.set("D9002", number);
          kept.change_recipe(number);
          break;
        }
        case 4: {
          const Value number = below(10) == 0 ? 20 : below(4);
          one.set(below(2) == 0 ? "D9001" : "D8002", number);
          kept.change_file(number);
          break;
        }
        case 5: {
          kept.in_memory = 1 + below(900);
          one.it().load_program(program(kept.in_memory));
          break;
        }
        case 6: one.set("M8100", 1); break;
        default: {
          one.world().switch_power(0, false);
          one.run(below(3));
          one.world().switch_power(0, true);
          expect_kept(one, kept, when);
          if (HasFatalFailure()) return;
          if (acts % 4 == 0) expect_same_by_its_file(one, kept, when);
        }
      }
      one.run(below(4) == 0 ? below(300) : below(2));
    }
  }
}

/// The text of a recipe that cannot be valid names the line.
TEST(Super40ncPowerCut, ARecipeThatCannotBeSaysWhere) {
  const auto kind = std::find_if(block_kinds().begin(), block_kinds().end(),
                                 [](const BlockKind& one) { return one.name == kRecipes; });
  ASSERT_NE(kind, block_kinds().end());
  EXPECT_EQ(kind->why_not_text("D500 1\nD999 -2147483648\n"), "");
  for (const char* wrong : {"D499 1", "D1000 1", "X500 1", "D500", "D500 2147483648", "D500 1 2"}) {
    EXPECT_EQ(kind->why_not_text(wrong).substr(0, 8), "line 1: ") << wrong;
    EXPECT_EQ(kind->why_not_text("D500 1\n" + std::string(wrong) + "\nD501 2\n").substr(0, 8), "line 2: ")
        << wrong;
  }
  for (const char* name : {"00", "99"}) EXPECT_EQ(kind->why_not_called(name), "");
  for (const char* name : {"", "0", "100", "1a", "-1"}) EXPECT_NE(kind->why_not_called(name), "") << name;
}

/// A program changes recipes forever: each number keeps its own, whichever tick the power fails in.
TEST(Super40ncPowerCut, RecipesInACycleAreNeverMixed) {
  const std::string text =
      "AREA X\nLAB K1\nMOV K1 D9002\nMOV K111 D500\nMOV K111 D999\nTMR K3\nMOV K2 D9002\nMOV K222 D500\n"
      "MOV K222 D999\nINC D400\nTMR K2\nJMP K1\nEND\n";
  for (Tick cut = 1; cut < 40; ++cut) {
    OneSuper40nc one({.program = text});
    one.set("M8100", 1);
    one.run(cut);
    one.world().switch_power(0, false);
    one.world().switch_power(0, true);
    const Value now = one.get("D9002");
    ASSERT_TRUE(now == 1 || now == 2) << cut;
    for (const Value number : {now, 3 - now}) {
      one.set("D9002", number);
      const bool was_written = number == now || cut >= 4;
      EXPECT_EQ(one.get("D500"), was_written ? 111 * number : 0) << cut;
      EXPECT_EQ(one.get("D999"), one.get("D500")) << cut;
    }
    EXPECT_EQ(one.get("D400"), 0);
  }
}

/// After a power cut, both or neither of two registers that one slice writes have changed.
TEST(Super40ncPowerCut, ASliceIsKeptWholeOrNotAtAll) {
  for (Tick cut = 1; cut < 30; ++cut) {
    OneSuper40nc one({.program = "AREA C\nLAB K1\nINC D600\nMOV D600 D601\nJMP K1\nEND\n"
                                 "AREA PLC\nLD M8003\nINC D602\nMOV D602 D603\nEND\n"});
    one.set("M8000", 1);
    one.run(cut);
    one.world().switch_power(0, false);
    one.world().switch_power(0, true);
    EXPECT_EQ(one.get("D600"), cut);
    EXPECT_EQ(one.get("D601"), cut);
    EXPECT_EQ(one.get("D602"), cut);
    EXPECT_EQ(one.get("D603"), cut);
  }
}

}  // namespace power_cut_test
}  // namespace understudy::emulator::models::super_40nc
