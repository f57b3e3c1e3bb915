// SLIM's state during programs: saved and restored into another device, it continues in the same way; damaged
// bytes are refused or harmless; skipped quiet ticks make no difference; and what a power cut leaves.
#include <memory>
#include <vector>

#include "base/state/state_error.h"
#include "emulator/device/axes.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/named_values.h"
#include "emulator/device/terminals.h"
#include "tests/emulator/device/same_state.h"
#include "tests/emulator/models/slim/dialogue_script.h"
#include "tests/sanitized.h"

namespace understudy::emulator::models::slim {

namespace state_test {

/// A script up to a moment in the middle of something, and its continuation.
struct Moment {
  const char* name;
  std::string until;
  std::string afterwards = "";  // typed or switched within the time that is compared
};

std::string program(const std::string& lines) { return "> PG\n" + lines + ">\n> G\n"; }

/// A buffer with all its 32 places occupied.
std::string full_buffer() {
  std::string lines = "> MR 300000\n";
  for (int i = 0; i < 31; ++i) lines += i % 3 == 0 ? "> CHG P4\n" : "> MR 1000\n";
  return lines + "> MR 7\n< ERR 8\n";
}

std::vector<Moment> moments() {
  const std::string path = "> TX=0\n> TY=1\n> TZ=2\n";
  return {
      {"fresh", "", "> MR 700\n@ 100\n"},
      {"moving", program("> P1SET P2,80000\n> MR 100000\n> DN\n> OUT \"END\"\n") + "@ 300\n"},
      {"on a path",
       program("> TX=0\n> TY=1\n> CM 1\n> 2MR 30,0\n> AR 0,20,90\n> 2MR 0,40\n> XDN\n> OUT N7\n") +
           "@ 450\n"},
      {"two groups", path + "> TZ=8\n> 2MR 100,20\n> TX=2\n> TY=3\n> AR 0,30,-200\n@ 511\n"},
      {"in a helix", path + program("> SAR 20,0,540,15\n> ZDN\n> OUT \"BORED\"\n") + "@ 700\n"},
      {"slowing into a pause", path + "> 2MR 100,50\n> MR 9\n@ 501\n> TAPZ\n@ 40\n",
       "@ 300\n> TAREDO\n@ 9\n"},
      {"paused", path + program("> 2MR 100,50\n> 2MR 5,5\n> XDN\n> OUT \"END\"\n") + "@ 501\n> TAPZ\n@ 200\n",
       "@ 100\n> TAREDO\n"},
      // 20 units take 300 ms, of which the last 100 decelerate: the pause comes at the end.
      {"paused on the end of a path", path + "> 2MR 20,0\n@ 270\n> TAPZ\n@ 76\n", ""},
      {"held", "> MR 100000\n> T1MR 5\n> T1MR -20000\n@ 301\n> PZ\n@ 40\n", "@ 200\n> REDO\n"},
      {"a program in front of a pause", path + "> TAPZ\n" + program("> 2MR 9,9\n> OUT \"END\"\n") + "@ 50\n",
       "@ 30\n> TAREDO\n"},
      {"in WT", program("> WT 1000\n> OUT \"LATER\"\n") + "@ 400\n"},
      {"in WI", program("> WI 2\n> OUT \"ON\"\n> WNI 2\n> OUT \"OFF\"\n") + "@ 400\n",
       "@ 50\nIN2 = 1\n@ 70\n< ON\nIN2 = 0\n@ 5\n< OFF\n"},
      {"in JTI", program("> JTI 2,900,$A\n> OUT \"PASSED\"\n> $A OUT \"A\"\n") + "@ 400\n"},
      {"in DN", program("> T2MR 50000\n> T2DN\n> OUT \"THERE\"\n> T1MR 5\n") + "@ 200\n"},
      {"in GETI", program("> N4=GETI\n> OUT N4\n> R4=GETR\n> MA R4\n> DN\n> OUT R4\n") + "@ 400\n",
       "> 17\n@ 30\n< 17\n> x\n< ERR 1\n> 900.5\n"},
      {"with a number that is not taken yet", program("> N4=GETI\n> OUT N4\n") + "@ 10\n> 17\n"},
      {"in an event routine",
       "> SET EV3 I,1\n> ON EV3,$E\n> SET EV4 NZ,N0\n> ON EV4,$F\n" +
           program("> MR 100000\n> WT 800\n> OUT \"END\"\n> RET\n> $E\n> PZ\n> N0=1\n> WT 200\n> REDO\n"
                   "> OUT \"E\"\n> RET\n> $F OUT \"F\"\n> RET\n") +
           "@ 300\nIN1 = 1\n@ 100\n"},
      {"in a subroutine", program("> N1=0\n> $L CALL $S\n> JNG 40,N1,$L\n> OUT N1\n> RET\n> $S\n> MR 100\n"
                                  "> DN\n> N1=41\n> WT 20\n> RET\n") +
                              "@ 25\n"},
      {"editing", "> PG\n> MA 5\n> WT 3\n", "> MA 6\n>\n> PL\n< 0: MA 5\n< 1: WT 3\n< 2: MA 6\n"},
      {"about to insert", "> PG\n> MA 5\n>\n> PI 0\n", "> WT 100\n> PL\n< 0: WT 100\n< 1: MA 5\n> G\n"},
      {"with a full buffer", full_buffer() + "@ 500\n", "> MR 8\n< ERR 8\n"},
      {"a program in front of a full buffer", "> PG\n> $L MR 3000\n> CHG P1\n> JP $L\n>\n> G\n@ 200\n"},
      {"jogging by the analog input", "AIN = 300\n@ 1\n> AVM\n> JGF\n> T1JGR\n@ 200\n",
       "AIN = 700\n@ 100\nAIN = 0\n@ 90\nAIN = 50\n@ 300\n> JG0\n"},
      // Nothing else happens that could wake it.
      {"jogging without a speed", "> AVM\n> JGF\n@ 100\n",
       "@ 50\nAIN = 400\n@ 200\nAIN = 0\n@ 200\nAIN = 90\n"},
      {"turning a jog round", "> JGF\n@ 100\n> JGR\n@ 4\n", "@ 400\n> JG0\n"},
      {"pushing", "> T1FT 300\n@ 20\n> T1MR 500\n", "@ 50\n> T1JG0\n"},
      {"homing", program("> H\n> DN\n> OUT \"HOME\"\n") + "@ 100\n",
       "@ 30\nHORG = 1\n@ 60\n< HOME\nHORG = 0\n"},
      {"pulses out", "> PWM P1,7,35\n> PLS P2,90\n> SET P3\n@ 200\n"},
      {"after errors",
       "> FOO\n< ERR 1\n> T1MR x\n< ERR 1\n> N0=40000\n< ERR 2\n> HOFF\n@ 5\n> MR 5\n< ERR 9\n",
       "> ?ERC\n< 9,2,1,1\n> HON\n> MR 5\n"},
      {"with numbers in memory", "> N5=6\n> R5=0.25\n> NS(9)=3\n> RS(2000)=-1e9\n> SAVE D\n> N5=7\n> TM=40\n",
       "> ?N5\n< 7\n> ?TM\n< 40\noff\non\n> ?N5\n< 6\n> ?RS(2000)\n< -1000000000\n"},
  };
}

constexpr int kModulesHere = 4;
constexpr Tick kCompared = 3000;

/// Everything that a host and a machine can see of it.
std::string seen_of(DialogueScript& script) {
  std::string seen;
  for (std::string line = script.next(); line != "(nothing)"; line = script.next()) seen += line + "|";
  const Slim& device = script.device();
  for (int m = 0; m < kModulesHere; ++m) {
    const std::string prefix = "T" + std::to_string(m);
    for (const char* name : {"PE", "ST", "MD", "ERR"}) {
      const auto value = device.named_values()->value_named(prefix + name);
      seen += value ? std::to_string(*value) + " " : "- ";
    }
    for (int i = 0; i < kOutputs; ++i)
      seen += device.terminals()->output(terminal(m, kFirstOutput + i)) ? "1" : "0";
    seen += " ";
  }
  return seen + std::to_string(device.state_hash());
}

/// Everything from now on, every millisecond for a while and then at longer steps.
std::vector<std::string> lived(DialogueScript& script, const Moment& moment) {
  std::vector<std::string> all{seen_of(script)};
  const auto live = [&](Tick span, Tick step) {
    for (Tick passed = 0; passed < span; passed += step) {
      script.pass(step);
      all.push_back(seen_of(script));
    }
  };
  live(20, 1);
  // The script itself compares the text in between, unless the program has sent it by then.
  script.play(moment.afterwards);
  live(kCompared - 20, 37);
  return all;
}

/// The levels from outside belong to the device's environment, not to its state.
void put_inputs(DialogueScript& from, DialogueScript& to) {
  const world::World& world = from.world();
  for (int i = 0; i < static_cast<int>(model().terminals.size()); ++i) {
    if (world.external_input(0, i) != 0) to.world().set_external_input(0, i, world.external_input(0, i));
  }
}

Tick tick_of(DialogueScript& script) { return script.world().now().count() / 1'000'000; }

TEST(SlimState, ContinuesInAnotherDeviceAsItDidInTheFirst) {
  for (const Moment& moment : moments()) {
    SCOPED_TRACE(moment.name);
    DialogueScript first(kModulesHere);
    first.play(moment.until);
    DialogueScript second(kModulesHere);
    second.play("> MR 12345\n> N9=9\n> SET P2\n");  // something else until now
    second.pass(tick_of(first));
    put_inputs(first, second);
    const std::vector<std::byte> saved = first.device().save_state();
    ASSERT_NE(second.device().save_state(), saved);
    second.device().restore_state(saved);
    ASSERT_EQ(second.device().save_state(), saved);
    ASSERT_TRUE(same_state(second.device(), first.device()));

    const std::vector<std::string> one = lived(first, moment);
    const std::vector<std::string> other = lived(second, moment);
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t i = 0; i < one.size(); ++i) ASSERT_EQ(other[i], one[i]) << "look " << i;
  }
}

TEST(SlimState, TheMomentsAreWhatTheySay) {
  const auto state_at = [](const std::string& name) {
    for (const Moment& moment : moments()) {
      if (moment.name != name) continue;
      DialogueScript script(kModulesHere);
      script.play(moment.until);
      return script.device().state();
    }
    ADD_FAILURE() << name;
    return State{};
  };
  EXPECT_TRUE(state_at("moving").chain.moving(0));
  EXPECT_EQ(state_at("two groups").chain.groups_running(), 2);
  EXPECT_TRUE(state_at("paused").chain.paused());
  EXPECT_EQ(state_at("in WT").execution.hold, lang::Hold::timer);
  EXPECT_EQ(state_at("in WI").execution.hold, lang::Hold::input);
  EXPECT_EQ(state_at("in JTI").execution.hold, lang::Hold::window);
  EXPECT_EQ(state_at("in DN").execution.hold, lang::Hold::machine);
  EXPECT_EQ(state_at("a program in front of a pause").execution.hold, lang::Hold::machine);
  EXPECT_EQ(state_at("in GETI").execution.hold, lang::Hold::number);
  EXPECT_TRUE(state_at("with a number that is not taken yet").execution.has_number);
  const State routine = state_at("in an event routine");
  ASSERT_EQ(routine.execution.stack.size(), 1u);
  EXPECT_TRUE(routine.execution.stack[0].of_event);
  EXPECT_EQ(routine.execution.hold, lang::Hold::timer);
  EXPECT_EQ(state_at("in a subroutine").execution.stack.size(), 1u);
  EXPECT_TRUE(is_editing(state_at("editing").editor));
  EXPECT_EQ(state_at("about to insert").editor.mode, lang::Editor::Mode::insert);
  EXPECT_TRUE(state_at("with a full buffer").chain.full(0));
  EXPECT_TRUE(state_at("a program in front of a full buffer").chain.full(0));
}

/// Changes each byte of `stride`: the state is refused without changes, or it can continue.
TEST(SlimState, SpoiltBytesAreRefusedOrCanBeLivedOn) {
  int refused = 0;
  int taken = 0;
  std::size_t first = 0;
  const std::size_t step = is_sanitized() ? 397 : 97;
  for (const Moment& moment : moments()) {
    SCOPED_TRACE(moment.name);
    DialogueScript script(kModulesHere);
    script.play(moment.until);
    const std::vector<std::byte> good = script.device().save_state();
    for (std::size_t i = first++ % step; i < good.size(); i += step) {
      std::vector<std::byte> bad = good;
      bad[i] ^= static_cast<std::byte>(1U << (i % 8));
      try {
        script.device().restore_state(bad);
      } catch (const StateError&) {
        ++refused;
        ASSERT_EQ(script.device().save_state(), good) << "byte " << i;
        continue;
      }
      ++taken;
      script.pass(3);
      script.ask("?PE");
      script.send("\x1b");
      script.ask("?ST");
      script.device().save_state();
      script.device().restore_state(good);
    }
    EXPECT_THROW(script.device().restore_state(std::span(good).first(good.size() - 1)), StateError);
    std::vector<std::byte> longer = good;
    longer.push_back(std::byte{0});
    EXPECT_THROW(script.device().restore_state(longer), StateError);
  }
  std::cout << refused << " refused, " << taken << " taken\n";
  EXPECT_GT(refused, fewer_if_sanitized(100, 4));
  EXPECT_GT(taken, fewer_if_sanitized(500, 4));
}

TEST(SlimState, QuietTicksMakeNoDifference) {
  std::uint64_t skipped = 0;
  for (const Moment& moment : moments()) {
    SCOPED_TRACE(moment.name);
    DialogueScript bulk(kModulesHere);
    DialogueScript single(kModulesHere);
    single.world().set_bulk_ticks(false);
    for (DialogueScript* script : {&bulk, &single}) {
      script->play(moment.until);
      script->play(moment.afterwards);
    }
    for (const Tick span : {Tick{1}, Tick{3}, Tick{199}, Tick{1500}, Tick{9000}}) {
      bulk.pass(span);
      single.pass(span);
      ASSERT_EQ(seen_of(bulk), seen_of(single)) << "after " << span << " ms more";
      ASSERT_TRUE(saves_the_same(bulk.device(), single.device()));
      ASSERT_TRUE(same_state(bulk.device(), single.device()));
    }
    EXPECT_EQ(single.world().ticks_skipped(), 0u);
    skipped += bulk.world().ticks_skipped();
  }
  EXPECT_GT(skipped, 100'000u);
}

/// It returns like a device that has only kept its memory, and stays so.
TEST(SlimState, APowerCutLeavesOnlyWhatIsKept) {
  for (const Moment& moment : moments()) {
    SCOPED_TRACE(moment.name);
    DialogueScript cut(kModulesHere);
    cut.play(moment.until);
    const NvImage kept = cut.device().memory()->nv_image();
    cut.world().switch_power(0, false);
    cut.pass(100);
    EXPECT_EQ(cut.ask("?PE"), "(nothing)");
    EXPECT_EQ(cut.device().named_values()->value_named("PE"), std::nullopt);
    for (int m = 0; m < kModulesHere; ++m) {
      for (int i = 0; i < kOutputs; ++i)
        EXPECT_FALSE(cut.device().terminals()->output(terminal(m, kFirstOutput + i)));
      EXPECT_EQ(cut.device().axes()->pulses_this_tick(m), 0);
    }
    EXPECT_EQ(cut.device().memory()->nv_image(), kept);

    // It is also saved while it has no power.
    const std::vector<std::byte> dead = cut.device().save_state();
    cut.device().restore_state(dead);
    ASSERT_EQ(cut.device().save_state(), dead);

    cut.world().switch_power(0, true);
    EXPECT_EQ(cut.ask("?ERC"), "0");
    for (const std::string query : {"?PE", "?T1PE", "?T2PE", "?MD", "?TM", "?AC"}) {
      EXPECT_EQ(cut.ask(query), query == "?AC" ? "24" : "0") << query;
    }
    EXPECT_EQ(cut.ask("?time"), "0:00:00");
    EXPECT_EQ(cut.ask("XMA 5"), "ERR 4") << "the map of PN37";
    EXPECT_EQ(cut.ask("G"), "ERR 13") << "no program is stored";
    cut.play("> RESET\n");
    for (int i = 0; i < 30; ++i) {
      cut.pass(100);
      ASSERT_EQ(cut.ask("?PE"), "0");
      ASSERT_EQ(cut.ask("?ST"), "1");
    }
    cut.play("> MR 10000\n@ 200\n> ?PE\n< 10000\n");
  }
}

/// A stored program starts only on command, from its beginning.
TEST(SlimState, AKeptProgramIsStartedAgainAfterAPowerCut) {
  DialogueScript script(kModulesHere);
  script.play(R"(
> PG
> OUT "A"
> MR 10000
> DN
> WT 500
> OUT "B"
>
> SAVE P
> G
@ 300
< A
off
@ 1000
on
@ 2000
> ?PE
< 0
> G
@ 300
< A
> ?PE
< 10000
@ 370
< B
> ?ST
< 1
)");
}

}  // namespace state_test

}  // namespace understudy::emulator::models::slim
