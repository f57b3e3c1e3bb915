// Options about entering, listing and saving SLIM's programs. The tests of interpreter/slim test the language
// itself.
#include <utility>

#include "base/state/state_error.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/user_program.h"
#include "tests/emulator/device/same_state.h"
#include "tests/emulator/models/slim/dialogue_script.h"

namespace understudy::emulator::models::slim {

namespace options_of_program_entry_test {

TEST(SlimProgramEntryChoices, ProgramSize) {
  const auto lines = [](int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += "DN\n";
    return text;
  };
  for (const auto& [option, size] :
       {std::pair{"1000_lines", 1000}, {"256_lines", 256}, {"4000_lines", 4000}}) {
    SCOPED_TRACE(option);
    const Choices chosen{{"program_size", option}};
    DialogueScript script(1, chosen);
    script.device().user_program()->load_program(lines(size));
    script.play("> PA\n> RET\n< ERR 8\n>\n> PI 0\n< ERR 8\n> SAVE P\n");
    try {
      script.device().user_program()->load_program(lines(size + 1));
      ADD_FAILURE() << "taken";
    } catch (const ProgramError& error) {
      const std::string expected = "at most " + std::to_string(size) + " lines";
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
    EXPECT_EQ(script.device().state().program.size(), size);

    // In a saved state, in memory, in an image.
    DialogueScript other(1, chosen);
    other.device().restore_state(script.device().save_state());
    EXPECT_TRUE(same_state(other.device(), script.device()));
    script.play("off\non\n");
    EXPECT_EQ(script.device().state().program.size(), size);
    NvImage image = script.device().memory()->nv_image();
    for (const bool fits : {true, false}) {
      world::Bench bench = slim_bench(1, chosen);
      bench.devices[0].settings.nv = image;
      const auto make = [&] {
        const world::World world(bench, world::WorldOptions{}, [](const std::string&) {});
      };
      if (fits) {
        EXPECT_NO_THROW(make());
      } else {
        EXPECT_THROW(make(), NvError);
      }
      image.program.emplace_back("DN");
    }
  }
}

TEST(SlimProgramEntryChoices, ProgramCheck) {
  play({}, "> PG\n> NONSENSE\n< ERR 1\n> SET P5\n< ERR 2\n> ?PE\n< ERR 3\n");
  const std::string entered = R"(
> PG
> OUT "A"
> NONSENSE
> SET P5
> ?PE
> OUT "B"
>
> PL
< 0: OUT "A"
< 1: NONSENSE
< 2: SET P5
< 3: ?PE
< 4: OUT "B"
> ULP
< OUT "A"
< NONSENSE
< SET P5
< ?PE
< OUT "B"
< END
> SAVE P
off
on
> ?ERC
< 0
> G
@ 10
< A
)";
  play({{"program_check", "when_it_runs"}}, entered + "> ?ERC\n< 1\n> ?ST\n< 33\n");
  play({{"program_check", "when_it_runs"}, {"failed_line", "is_passed_over"}},
       entered + "< B\n> ?ERC\n< 3,2,1\n");

  DialogueScript late(1, {{"program_check", "when_it_runs"}});
  late.device().user_program()->load_program("; a remark\nOUT \"A\"\n$B NONSENSE\n");
  EXPECT_EQ(late.device().user_program()->program_text(), "OUT \"A\"\n$B NONSENSE\n");
  EXPECT_THROW(late.device().user_program()->load_program("END\n"), ProgramError);
  late.play("> SAVE P\n> G $B\n@ 1\n> ?ERC\n< 1\n");
  world::Bench bench = slim_bench(1, {{"program_check", "when_it_runs"}});
  bench.devices[0].settings.nv = parse_nv_image(to_json(late.device().memory()->nv_image()));
  const world::World again(bench, world::WorldOptions{}, [](const std::string&) {});
  EXPECT_EQ(dynamic_cast<const Slim&>(again.device(0)).program_text(), "OUT \"A\"\n$B NONSENSE\n");

  // A device that checks earlier accepts no state that it cannot have reached.
  DialogueScript early(1);
  EXPECT_THROW(early.device().restore_state(late.device().save_state()), StateError);
}

/// A line that is stored unchecked still fits, and is restored.
TEST(SlimProgramEntryChoices, ProgramCheckOfLinesAsLongAsChosen) {
  for (const auto& [option, longest] : {std::pair{"127_characters_then_error_1", 127},
                                        {"80_characters_then_error_1", 80},
                                        {"255_characters_then_error_1", 255}}) {
    SCOPED_TRACE(option);
    const Choices chosen{{"program_check", "when_it_runs"}, {"longest_line", option}};
    DialogueScript script(1, chosen);
    const std::string line(static_cast<std::size_t>(longest), 'A');
    script.play("> PG\n> " + line + "\n> " + line + "A\n< ERR 1\n>\n> PL\n< 0: " + line + "\n> SAVE P\n");
    try {
      script.device().user_program()->load_program(line + "A");
      ADD_FAILURE() << "taken";
    } catch (const ProgramError&) {
    }
    DialogueScript other(1, chosen);
    other.device().restore_state(script.device().save_state());
    other.play("off\non\n> PL\n< 0: " + line + "\n");
  }
}

TEST(SlimProgramEntryChoices, EditEnd) {
  play({{"edit_end", "exit_or_esc"}}, R"(
> PG
> OUT "A"
>
> OUT "B"
> EXIT
> PL
< 0: OUT "A"
< 1: OUT "B"
> PE 1
>
> OUT "C"
> DLP
>
> RET
> END
> PL
< 0: RET
)");
  DialogueScript script(1, {{"edit_end", "exit_or_esc"}});
  script.play("> PA\n> DN\n>\n");
  script.send("\x1B");
  EXPECT_EQ(script.ask("?PE"), "0");
}

TEST(SlimProgramEntryChoices, ARefusedLine) {
  const std::string begin = "> PG\n> RET\n>\n> PE 0\n> MR\n< ERR 1\n> ?ST\n";
  play({}, begin + "< ERR 3\n> MR 500\n@ 300\n> ?PE\n< 0\n> PL\n< 0: MR 500\n");
  // It was meant for the program.
  play({{"refused_line", "ends_editing"}}, begin + "< 33\n> MR 500\n@ 300\n> ?PE\n< 500\n> PL\n< 0: RET\n");
  // A line that is too long, an empty one, EXIT and ESC.
  for (const std::string end : {"", "EXIT", "\x1B"}) {
    DialogueScript script(1, {{"prompt", "greater_than"}});
    const auto prompted = [&](const std::string& line) {
      script.send(line + "\r");
      return script.device().state().editor.mode;
    };
    EXPECT_EQ(prompted("PI 0"), lang::Editor::Mode::insert);
    EXPECT_EQ(prompted(std::string(128, 'A')), lang::Editor::Mode::insert);
    EXPECT_EQ(prompted("MR"), lang::Editor::Mode::insert);
    EXPECT_EQ(prompted(end), lang::Editor::Mode::none);
    EXPECT_EQ(script.device().state().program.size(), 0);
  }
}

TEST(SlimProgramEntryChoices, Listing) {
  play({{"listing", "text"}}, "> PG\n> $A  MA 5\n> RET\n>\n> PL\n< $A  MA 5\n< RET\n");
}

TEST(SlimProgramEntryChoices, Addresses) {
  play({{"addresses", "line_number_from_1"}}, R"(
> PG
> OUT "ONE"
> JP 4
> OUT "THREE"
> RET
>
> PL
< 1: OUT "ONE"
< 2: JP 4
< 3: OUT "THREE"
< 4: RET
> G
@ 5
< ONE
> G 3
@ 5
< THREE
> G 0
< ERR 13
> G 5
< ERR 13
> PE 0
< ERR 2
> PD 5
< ERR 2
> PI 6
< ERR 2
# JP 4 is not rewritten: it leads to what is the fourth line now
> PI 1
> WT 1
> G
@ 9
< ONE
< THREE
> PD 1
> PE 3
> OUT "3"
> G 3
@ 5
< 3
)");
  for (const bool from_1 : {false, true}) {
    Choices choices{{"prompt", "greater_than"}};
    if (from_1) choices["addresses"] = "line_number_from_1";
    DialogueScript script(1, choices);
    const auto prompted = [&](const std::string& line) {
      script.device().receive_line(line);
      return script.device().take_text();
    };
    EXPECT_EQ(prompted("PG"), from_1 ? "1>" : "0>");
    EXPECT_EQ(prompted("RET"), from_1 ? "2>" : "1>");
    EXPECT_EQ(prompted(""), ">");
    EXPECT_EQ(prompted(from_1 ? "PI 1" : "PI 0"), from_1 ? "1>" : "0>");
  }
}

}  // namespace options_of_program_entry_test

}  // namespace understudy::emulator::models::slim
