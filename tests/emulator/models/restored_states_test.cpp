// Any changed byte of a snapshot, or number of a memory image, is refused without changes, or gives a state
// that survives moves, ticks and writes. For every model. UNDERSTUDY_SEED; UNDERSTUDY_FLIPS: the number of
// changes per model.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <random>

#include "base/state/state_error.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/models/models.h"
#include "emulator/models/rs_m8194h/rows/registers.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/snapshot.h"
#include "interpreter/rs_m8194h/text.h"
#include "interpreter/rs_m8194h/window.h"
#include "tests/emulator/model_file/described.h"
#include "tests/emulator/world/stepping.h"

namespace understudy::emulator::models {
namespace restored_states_test {

using namespace std::chrono_literals;
using world::World;

/// The commands that a device gets repeatedly: "NAME=VALUE", "RSM_...", or a line of text.
struct Life {
  std::string model;
  std::string settings;
  std::string axis;
  std::vector<std::string> acts;
};

const std::vector<Life>& lives() {
  static const std::vector<Life> all{
      {"simple2-r3",
       "",
       "A",
       {"Aaxis_SVON=1",      "Baxis_SVON=1",           "Aaxis_Pulse=3200",          "Aaxis_Speed=300",
        "Aaxis_AccTime=10",  "Aaxis_DecTime=10",       "Aaxis_Move_INC=1",          "Aaxis_STOP=1",
        "Aaxis_Move_ABS=1",  "Aaxis_DirectmRPM=90000", "Aaxis_DirectmRPM=0",        "Aaxis_SyncMode=1",
        "Baxis_Pulse=-9000", "Baxis_Speed=200",        "Baxis_Move_INC=1",          "Baxis_GoHome=1",
        "ALL_STOP=1",        "MAIN_LINE0_CMD=1",       "PROG_MAIN_RunTime_START=0", "Aaxis_DirectPWM=40",
        "PROG_MEM3=77"}},
      {"super-40nc",
       R"(, set: { D9003: 4, D9181: 1 }, program: "AREA C\nF K20000\nLIN K20000 K-10000\nEND\nAREA X\nINCC\nRPM K100\nDRV K20000\nEND\nAREA PLC\nLD M5\nOUT M6\nEND\n")",
       "X",
       {"M8000=1", "M8100=1", "M5=1", "M5=0", "D100=77", "M8200=1", "D8005=50", "M8000=0", "D9012=3",
        "M8001=1"}},
      {"rs-m8194h",
       R"(, program: "MP 1\nRSM_MACRO_FOR 5\nRSM_MACRO_TIMER 7\nRSM_MACRO_FIXED_MOVE Z 70\nRSM_MACRO_NEXT\nEND\n")",
       "X",
       {"RSM_SET_V XYZU 9000",
        "RSM_SET_SV XYZU 100",
        "RSM_SET_A XYZU 90000",
        "RSM_FIXED_MOVE X 4000",
        "RSM_LINE_2D_INITIAL Y Z 100 9000 90000",
        "RSM_LINE_2D_CONTINUE 0 400 300",
        "RSM_LINE_2D_CONTINUE 0 100 -300",
        "RSM_LINE_2D_CONTINUE 1 -400 300",
        "RSM_STOP_SLOWLY X",
        "RSM_CLEAR_STOP XYZU",
        "RSM_CONTINUE_MOVE U -5000",
        "RSM_SET_V U 2000",
        "RSM_STOP_SUDDENLY U",
        "RSM_MP_CALL 1",
        "RSM_SET_HOME_MODE X 1 0 2 0 0",
        "RSM_HOME_START X",
        "RSM_EXD_FP Y 100",
        "RSM_SET_SLMT Y 90000 -90000 0",
        "RSM_SYNC_ACTION X Y 1 1 1 1 1 1 0 0 0 0",
        "RSM_SET_COMPARE X 0 0 985",
        "RSM_DRV_HOLD X",
        "RSM_DRV_START X",
        "RSM_VSTOP_SLOWLY",
        "RSM_CLEAR_VSTOP",
        "VAR3=99",
        "MD5=7",
        "MD100=9"}},
      {"slim",
       ", modules: 2",
       "T0",
       {"TX=0", "TY=1", "MA 30000", "2MA 3000,-1500", "MR -300", "ST", "JG 100", "ST", "?PN1", "GH", "N1=7",
        "LOOP 3", "MV"}},
      {PROJECT_FOLDER "/examples/import/drive.yaml", "", "X", {}},
  };
  return all;
}

World make_world(const Life& life) {
  const bool is_file = life.model.find('/') != std::string::npos;
  const std::string drives = life.model == "simple2-r3" ? "" : ", drive: { ready_after: 3ms }";
  return World(
      world::parse_bench(
          model_file::with_described(),
          "understudy: 1\nlines: { a: { timing: instant, stations: [ { name: d, model: " + life.model +
              life.settings + (is_file ? ", address: 1" : "") + " } ] } }\n" + "plant: { d." + life.axis +
              ": { travel: [-50000, 50000], home: { at: 900, width: 200 }, limits: { "
              "lower: -40000, upper: 40000 }, encoder: { per_revolution: 1000, "
              "motor_pulses_per_revolution: 800 }" +
              drives + " } }\n",
          "bench.yaml", "."),
      {}, {});
}

class Living {
 public:
  Living(const Life& life, std::uint64_t seed) : world(make_world(life)), life_(life), random_(seed) {}

  std::size_t between(std::size_t low, std::size_t high) { return low + random_() % (high - low + 1); }

  void act() {
    Device& device = world.device(0);
    if (!device.powered()) return;
    if (!life_.acts.empty() && between(0, 3) != 0) {
      const std::string& what = life_.acts[between(0, life_.acts.size() - 1)];
      const std::size_t sign = what.find('=');
      if (what.starts_with("RSM_")) {
        const auto parsed = interpreter::rs_m8194h::parse_command(what);
        ASSERT_TRUE(parsed.command) << what;
        (void)write_words(
            *device.register_bank(), Table::holding, rs_m8194h::kWindow,
            interpreter::rs_m8194h::encode(*parsed.command, interpreter::rs_m8194h::WordOrder::high_first));
      } else if (device.register_bank() != nullptr) {
        const auto named = device.register_bank()->find(what.substr(0, sign));
        ASSERT_TRUE(named) << what;
        (void)write_value(*device.register_bank(), *named, std::stoll(what.substr(sign + 1)));
      } else {
        const std::string line = what + "\r";
        world.receive(0, std::vector<std::uint8_t>(line.begin(), line.end()));
      }
      return;
    }
    if (between(0, 4) == 0) {
      const std::size_t input = between(0, device.model().terminals.size() - 1);
      const TerminalRow& row = device.model().terminals[input];
      const bool is_input =
          row.kind == TerminalRow::Kind::digital_in || row.kind == TerminalRow::Kind::counted_in;
      if (is_input)
        world.set_external_input(0, static_cast<int>(input), static_cast<std::int32_t>(between(0, 1)));
    } else if (device.register_bank() != nullptr) {
      write_something(*device.register_bank());
    }
  }
  void live(int acts, std::size_t max_ms) {
    for (int i = 0; i < acts; ++i) {
      act();
      world.advance_to(world.now() + std::chrono::milliseconds(between(1, max_ms)));
    }
  }

  World world;

 private:
  /// Returns a register that can be written, and a valid value.
  void write_something(RegisterBank& bank) {
    const auto rows = bank.map().rows();
    const RegisterRow& row = rows[between(0, rows.size() - 1)];
    if (row.access == Access::read || row.message != nullptr || !bank.has_row(row)) return;
    const TypeLimits limits = limits_of(row.type);
    const Value low = row.ranged ? row.min : limits.lowest;
    const Value high = row.ranged ? row.max : std::min<Value>(limits.highest, 30'000);
    const auto named = bank.find(bank.map().unique_name(row, static_cast<int>(between(0, row.count - 1))));
    const auto span = static_cast<std::uint64_t>(high - low);
    if (named) (void)write_value(bank, *named, low + static_cast<Value>(random_() % (span + 1)));
  }

  const Life& life_;
  std::mt19937_64 random_;
};

std::string refusal_of(World& world, const world::WorldState& state) {
  try {
    restore(world, state);
    return "";
  } catch (const StateError& error) {
    return error.what();
  }
}

int flips() {
  const char* const given = std::getenv("UNDERSTUDY_FLIPS");
  return given != nullptr ? std::atoi(given) : 400;
}

/// Changes a number: one byte of it, or the whole to the minimum or maximum.
void flip(std::vector<std::byte>& bytes, Living& life) {
  const std::size_t at = life.between(0, bytes.size() - 1);
  const std::size_t kind = life.between(0, 5);
  if (kind > 1) {
    bytes[at] ^= static_cast<std::byte>(life.between(1, 255));
    return;
  }
  for (std::size_t i = at / 8 * 8; i < std::min(at / 8 * 8 + 8, bytes.size()); ++i) {
    bytes[i] = kind == 0 ? std::byte{0} : std::byte{0xFF};
  }
}

TEST(RestoredStates, AreTriedByActsThatThereAre) {
  for (const Life& life : lives()) {
    const Living living(life, 1);
    const RegisterBank* const bank = living.world.device(0).register_bank();
    for (const std::string& act : life.acts) {
      if (bank == nullptr || act.starts_with("RSM_")) continue;
      EXPECT_TRUE(bank->find(act.substr(0, act.find('=')))) << act;
    }
  }
}

TEST(RestoredStates, ThereIsALifeForEveryModel) {
  for (const Model* model : all_models()) {
    const bool is_present = std::ranges::any_of(
        lives(), [&](const Life& life) { return std::string_view(life.model) == model->name; });
    EXPECT_TRUE(is_present) << model->name;
  }
}

TEST(RestoredStates, FlippedBytesAreRefusedOrCanBeLivedOn) {
  const std::uint64_t seed = world::seed_or(90'001);
  std::cout << "seed " << seed << "\n";
  for (const Life& life : lives()) {
    SCOPED_TRACE(life.model);
    int refused = 0;
    int taken = 0;
    constexpr int kOfOneState = 40;
    for (int i = 0; i < flips() && !testing::Test::HasFailure(); i += kOfOneState) {
      Living living(life, seed + static_cast<std::uint64_t>(i));
      living.live(12, 40);
      const world::WorldState good = save(living.world);
      ASSERT_EQ(refusal_of(living.world, good), "");
      for (int k = 0; k < kOfOneState; ++k) {
        world::WorldState bad = good;
        flip(bad.parts[living.between(0, bad.parts.size() - 1)].bytes, living);
        const std::string refusal = refusal_of(living.world, bad);
        if (!refusal.empty()) {
          ++refused;
          ASSERT_EQ(save(living.world), good) << refusal;
          continue;
        }
        ++taken;
        ASSERT_NO_THROW(living.live(6, 25));
        restore(living.world, good);
      }
    }
    std::cout << life.model << ": " << refused << " refused, " << taken << " lived on\n";
    EXPECT_GT(refused, 0);
    EXPECT_GT(taken, flips() / 4);
  }
}

/// A different number, or a different letter of a text.
void change(NvImage& image, Living& living) {
  const std::size_t texts = image.blocks.size() + image.program.size();
  const std::size_t numbers = image.registers.size() + image.reals.size();
  if (texts + numbers == 0) return;
  const auto letter = [&](std::string& text) {
    if (!text.empty()) text[living.between(0, text.size() - 1)] = static_cast<char>(living.between(' ', '~'));
  };
  if (living.between(0, numbers + 3) < numbers) {
    const std::size_t which = living.between(0, numbers - 1);
    const auto wide =
        static_cast<std::int64_t>(living.between(0, UINT64_C(0x2'0000'0000))) - INT64_C(0x1'0000'0000);
    const std::int64_t made = wide >> (living.between(0, 32));
    if (which < image.registers.size()) image.registers[which].second = made;
    if (which >= image.registers.size())
      image.reals[which - image.registers.size()].second = static_cast<double>(made);
  } else if (!image.program.empty()) {
    letter(image.program[living.between(0, image.program.size() - 1)]);
  } else if (!image.blocks.empty()) {
    auto& kind = std::next(image.blocks.begin(),
                           static_cast<std::ptrdiff_t>(living.between(0, image.blocks.size() - 1)))
                     ->second;
    if (kind.empty()) return;
    SharedText& text =
        std::next(kind.begin(), static_cast<std::ptrdiff_t>(living.between(0, kind.size() - 1)))->second;
    std::string changed(text.text());
    letter(changed);
    text = SharedText(changed);
  }
}

TEST(RestoredStates, ImagesThatAreChangedAreRefusedOrCanBeLivedOn) {
  const std::uint64_t seed = world::seed_or(91'001);
  std::cout << "seed " << seed << "\n";
  for (const Life& life : lives()) {
    SCOPED_TRACE(life.model);
    int taken = 0;
    for (int i = 0; i < flips() / 8 && !testing::Test::HasFailure(); ++i) {
      Living living(life, seed + static_cast<std::uint64_t>(i));
      living.live(12, 30);
      PersistentMemory& memory = *living.world.device(0).memory();
      memory.settle_memory();
      living.world.switch_power(0, false);
      const NvImage good = memory.nv_image();
      ASSERT_NO_THROW(memory.load_nv(good)) << to_json(good);
      NvImage bad = good;
      change(bad, living);
      try {
        memory.load_nv(bad);
        ++taken;
      } catch (const NvError&) {
        ASSERT_TRUE(holds_the_same(memory.nv_image(), good));
      }
      living.world.switch_power(0, true);
      ASSERT_NO_THROW(living.live(10, 25)) << to_json(bad);
    }
    EXPECT_GT(taken, 0);
  }
}

}  // namespace restored_states_test
}  // namespace understudy::emulator::models
