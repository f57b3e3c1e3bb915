// Every form of SLIM's command list at the device: its effect, what refuses it, and where it is allowed.
#include <map>
#include <set>

#include "interpreter/slim/parse.h"
#include "tests/emulator/models/slim/effects_of_one_motor.h"
#include "tests/emulator/models/slim/effects_of_several_motors.h"

namespace understudy::emulator::models::slim {

namespace effects_test {

std::vector<Effect> all_effects() {
  std::vector<Effect> all(std::begin(kOneMotorEffects), std::end(kOneMotorEffects));
  all.insert(all.end(), std::begin(kSeveralMotorsEffects), std::end(kSeveralMotorsEffects));
  return all;
}

/// Returns a line of its steps that has exactly this form; nothing if there is none.
std::string sample_of(const Effect& effect) {
  for (const std::string& step : expanded(effect.steps)) {
    const lang::ParseResult parsed = lang::parse_line(typed_by(step));
    if (parsed.error != Error::none || !parsed.line.command) continue;
    const auto row = static_cast<std::size_t>(parsed.line.command->row);
    if (lang::kCommands[row].syntax == effect.syntax) return typed_by(step);
  }
  return "";
}

TEST(SlimEffects, NoFormIsLeftOut) {
  std::map<std::string_view, int> covered;
  for (const Effect& effect : all_effects()) {
    ++covered[effect.syntax];
    EXPECT_NE(sample_of(effect), "") << effect.syntax << " is not typed in its own steps";
  }
  for (const auto& row : lang::kCommands) EXPECT_EQ(covered[row.syntax], 1) << row.syntax;
  EXPECT_EQ(covered.size(), 169u);
  EXPECT_EQ(lang::kCommands.size(), 169u);
}

TEST(SlimEffects, EachFormDoesWhatItSaysAndIsRefusedWhereItMustBe) {
  for (const Effect& effect : all_effects()) play_effect(effect);
}

/// The forms that get ERR 3 when they are typed.
template <typename Prepare>
std::set<std::string_view> not_allowed(Prepare prepare, const std::map<std::string, std::string>& choices) {
  std::set<std::string_view> refused;
  for (const Effect& effect : all_effects()) {
    DialogueScript script(4, choices);
    prepare(script);
    if (script.ask(sample_of(effect)) == "ERR 3") refused.insert(effect.syntax);
  }
  return refused;
}

void run_a_program(DialogueScript& script) { script.play("> PG\n> WI 8\n>\n> G\n@ 2\n"); }

std::set<std::string_view> all_but(const std::set<std::string_view>& some) {
  std::set<std::string_view> rest;
  for (const auto& row : lang::kCommands) {
    if (!some.contains(row.syntax)) rest.insert(row.syntax);
  }
  return rest;
}

/// The column 外部, strictly: three forms have it, and the commands that end a program, because nothing else
/// could.
TEST(SlimEffects, WhatAHostMaySayBesidesAProgramByTheColumnAlone) {
  EXPECT_EQ(not_allowed(run_a_program, {{"while_program_runs", "external_column_only"}}),
            all_but({"TAPZ", "TASTOP", "TVM=f32", "EXIT"}));
}

TEST(SlimEffects, WhatAHostMaySayBesidesAProgram) {
  std::set<std::string_view> taken{"TAPZ", "TASTOP",  "TVM=f32", "EXIT", "TAREDO", "TAUPZ",  "PZ",
                                   "REDO", "ISET Pn", "ICLR Pn", "IHON", "IHOFF",  "CLR BUF"};
  for (const auto& row : lang::kCommands) {
    if (row.syntax.starts_with('?')) taken.insert(row.syntax);
  }
  EXPECT_EQ(taken.size(), 13u + 23u);
  EXPECT_EQ(not_allowed(run_a_program, {}), all_but(taken));
  taken.insert({"RESET", "TpRESET"});
  EXPECT_EQ(not_allowed(run_a_program, {{"while_program_runs", "reset_too"}}), all_but(taken));
}

/// What can only be stored: the flow of a program, and forms without a mark under 立即. GETI and GETR have
/// nothing to give their number to.
TEST(SlimEffects, WhatCannotBeTyped) {
  const std::set<std::string_view> flow{"JP addr",
                                        "JI i,addr",
                                        "JNI i,addr",
                                        "JZ #int,addr",
                                        "JNZ #int,addr",
                                        "JE c,#var,addr",
                                        "JNE c,#var,addr",
                                        "JG c,#var,addr",
                                        "JNG c,#var,addr",
                                        "JTI i,tm,addr",
                                        "JNTI i,tm,addr",
                                        "CALL addr",
                                        "RET",
                                        "WI i",
                                        "WNI i",
                                        "WT tm",
                                        "DN",
                                        "TpDN",
                                        "GETI",
                                        "GETR"};
  const std::set<std::string_view> of_variables{
      "2MR Rn,Rm",   "3MA Rx,Ry,Rz", "3MR Rx,Ry,Rz",    "4MA Rx,Ry,Rz,Rw", "4MR Rx,Ry,Rz,Rw",
      "AA Rx,Ry,Ra", "AR Rx,Ry,Ra",  "SAA Rx,Ry,Ra,Rz", "SAR Rx,Ry,Ra,Rz", "XMA Rn",
      "YMA Rn",      "ZMA Rn",       "WMA Rn",          "XMR Rn",          "YMR Rn",
      "ZMR Rn",      "WMR Rn"};
  const std::set<std::string_view> waits{"XDN", "YDN", "ZDN", "WDN"};
  std::set<std::string_view> stored = flow;
  stored.insert(waits.begin(), waits.end());
  const auto nothing = [](DialogueScript&) {};
  // If its column is misread, a form of variables is refused for its meaning, if at all.
  EXPECT_EQ(not_allowed(nothing, {{"immediate_column", "taken"}}), stored);
  stored.insert(of_variables.begin(), of_variables.end());
  EXPECT_EQ(not_allowed(nothing, {}), stored);
}

}  // namespace effects_test

}  // namespace understudy::emulator::models::slim
