// Every verb of SLIM's command list has its own action or answer, and has an effect where it is allowed.
#include "emulator/models/slim/actions.h"

#include <gtest/gtest.h>

#include "interpreter/slim/availability.h"
#include "interpreter/slim/options.h"
#include "interpreter/slim/verbs.h"
#include "tests/emulator/models/slim/dialogue_script.h"

namespace understudy::emulator::models::slim {

namespace actions_test {

using lang::Place;

// All that any choice lets through.
constexpr lang::Options kWidest{lang::option("while_program_runs", "reset_too"),
                                lang::option("immediate_column", "taken"),
                                lang::option("first_list_columns", "saves_in_programs_too")};

bool is_allowed_somewhere(lang::Verb verb, Place place) {
  for (std::size_t i = 0; i < lang::kCommands.size(); ++i) {
    const lang::Command command{.verb = verb, .row = static_cast<int>(i)};
    if (lang::kCommands[i].verb == verb && is_allowed(command, place, kWidest)) return true;
  }
  return false;
}

TEST(SlimActions, EachVerbDoesSomethingWhereItMayBeGiven) {
  int walked = 0;
  for (const lang::CommandRow& row : lang::kCommands) {
    if (row.is_query()) continue;
    ++walked;
    const VerbActions& actions = actions_of(row.verb);
    ASSERT_TRUE(actions.stored != nullptr && actions.typed != nullptr) << row.syntax;
    const bool of_flow = lang::is_one_of(lang::kFlowVerbs, row.verb);
    const bool acts_stored = actions.stored != is_refused || of_flow;
    EXPECT_EQ(acts_stored, is_allowed_somewhere(row.verb, Place::program) || row.verb == lang::Verb::reboot ||
                               row.verb == lang::Verb::list_parameters)
        << row.syntax;
    const bool may_be_typed = is_allowed_somewhere(row.verb, Place::immediate);
    const bool asks_only = row.verb == lang::Verb::get_integer || row.verb == lang::Verb::get_real;
    EXPECT_EQ(actions.typed != is_refused, may_be_typed && !asks_only) << row.syntax;
  }
  EXPECT_EQ(walked, 169 - 23);
}

TEST(SlimActions, OnlyTheEmergencyStopIsOne) {
  // Once all that a switch forgot was an emergency stop.
  const Action stop = actions_of(lang::Verb::stop_all).typed;
  for (const lang::CommandRow& row : lang::kCommands) {
    if (row.is_query() || row.verb == lang::Verb::stop_all) continue;
    EXPECT_NE(actions_of(row.verb).typed, stop) << row.syntax;
    EXPECT_NE(actions_of(row.verb).stored, actions_of(lang::Verb::stop_all).stored) << row.syntax;
  }
}

TEST(SlimActions, EachQueryHasAnAnswer) {
  int asked = 0;
  for (const lang::CommandRow& row : lang::kCommands) {
    if (!row.is_query() || row.syntax.find('<') != std::string_view::npos) continue;
    std::string typed(row.syntax);
    if (const std::size_t place = typed.find('#'); place != std::string::npos) typed[place] = '0';
    if (const std::size_t place = typed.find('n'); place != std::string::npos) typed[place] = '1';
    DialogueScript script(4, {});
    const std::string answer = script.ask(typed);
    EXPECT_FALSE(answer.empty() || answer.starts_with("ERR ")) << typed << " -> " << answer;
    ++asked;
  }
  EXPECT_GT(asked, 15);
}

}  // namespace actions_test

}  // namespace understudy::emulator::models::slim
