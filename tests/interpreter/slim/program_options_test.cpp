// Options about programs: how fast lines run, how often events are checked, how lines are numbered, what is
// refused when a line is entered.
#include <gtest/gtest.h>

#include <utility>

#include "interpreter/slim/availability.h"
#include "interpreter/slim/editor.h"
#include "tests/interpreter/slim/scripted_machine.h"

namespace understudy::interpreter::slim {
namespace program_options_test {

using Lines = std::vector<std::string>;

/// Lines 0 and 1 define the event.
Lines interrupted(const std::string& waiting) {
  return {"SET EV1 I,8", "ON EV1,$PPZ", waiting, "SET P1", "RET", "$PPZ ISET P4", "RET"};
}

Error edit(Editor& editor, Program& program, std::string_view text, const Options& options) {
  if (is_editing(editor)) return enter_line(editor, program, text, options);
  const ParseResult result = parse_line(text);
  EXPECT_EQ(result.error, Error::none) << text;
  return begin_edit(editor, program, *result.line.command, options);
}

TEST(SlimProgramOptions, FourLinesATick) {
  ProgramRun run({"$A SET P1", "JP $A"}, {option("lines_a_tick", "four_a_millisecond")});
  run.begin();
  run.until(2);
  EXPECT_EQ(run.machine.log, (Log{"1 SET P1", "1 SET P1", "2 SET P1", "2 SET P1"}));

  // A line that waits is the last of its tick, and so is one that fails.
  ProgramRun waits({"SET P1", "WI 1", "SET P2", "T3MA 5", "SET P3", "N0=GETI", "SET P4"},
                   {option("lines_a_tick", "four_a_millisecond"), option("failed_line", "is_passed_over")});
  waits.machine.refusals = {{"T3MA 5.0", Error::not_linked}};
  waits.begin();
  waits.until(9);
  EXPECT_EQ(waits.machine.log, (Log{"1 SET P1"}));
  waits.machine.inputs = {1};  // at 10: WI, SET P2, T3MA; at 11: SET P3, GETI
  waits.until(20);
  EXPECT_EQ(waits.machine.log, (Log{"1 SET P1", "10 SET P2", "11 SET P3"}));
  EXPECT_EQ(waits.errors, (std::vector{Error::not_linked}));
  EXPECT_EQ(give_number(waits.execution, waits.program, "7"), Error::none);
  waits.until(30);
  EXPECT_EQ(waits.machine.log, (Log{"1 SET P1", "10 SET P2", "11 SET P3", "21 N0=7", "21 SET P4"}));
}

/// Lines at 4, 8, 12 ...
TEST(SlimProgramOptions, OneLineInFourTicks) {
  const Options slow{option("lines_a_tick", "one_in_4_milliseconds")};
  ProgramRun timed({"SET P1", "WT 5", "SET P2", "WT 4", "SET P3"}, slow);
  timed.begin();
  timed.until(30);
  // WT 5 at 8: until 13, detected at 16 with the line after it. WT 4 at 20: until 24.
  EXPECT_EQ(timed.machine.log, (Log{"4 SET P1", "16 SET P2", "24 SET P3"}));

  ProgramRun input({"WI 1", "SET P1"}, slow);
  input.begin();
  input.until(9);
  input.machine.inputs = {1};  // WI checks at 12
  input.until(20);
  EXPECT_EQ(input.machine.log, (Log{"16 SET P1"}));

  ProgramRun window({"JTI 1,10,$A", "SET P1", "RET", "$A SET P2"}, slow);
  window.begin();
  window.until(40);
  // JTI at 4: until 14, so it checks for the last time at 16.
  EXPECT_EQ(window.machine.log, (Log{"20 SET P1"}));

  ProgramRun asking({"N0=GETI", "SET P1"}, slow);
  asking.begin();
  asking.until(5);
  EXPECT_EQ(give_number(asking.execution, asking.program, "7"), Error::none);
  asking.until(20);
  EXPECT_EQ(asking.machine.log, (Log{"8 N0=7", "12 SET P1"}));
}

TEST(SlimProgramOptions, SlowLinesMissNoEvent) {
  ProgramRun run(interrupted("WT 1000"), {option("lines_a_tick", "one_in_4_milliseconds")});
  run.begin();
  run.until(48);
  run.machine.inputs = {8};  // seen only at 49
  run.until(49);
  run.machine.inputs = {};
  run.until(70);
  EXPECT_EQ(run.machine.log, (Log{"52 ISET P4"}));
}

TEST(SlimProgramOptions, EventsLookedAtInEachFourthTick) {
  for (const auto& every_ms :
       {option("event_check", "each_millisecond"), option("event_check", "each_4_milliseconds")}) {
    ProgramRun run(interrupted("WT 1000"), {every_ms});
    run.begin();
    run.until(48);
    run.machine.inputs = {8};  // at 49, 50 and 51
    run.until(51);
    run.machine.inputs = {};
    run.until(60);
    run.machine.inputs = {8};  // from 61 on
    run.until(80);
    EXPECT_EQ(run.machine.log, (every_ms.number == 0 ? Log{"49 ISET P4", "61 ISET P4"} : Log{"64 ISET P4"}));
  }
}

/// A line that checks its input itself still sees it in each tick.
TEST(SlimProgramOptions, RareLooksAreThoseOfEventsOnly) {
  ProgramRun run({"SET EV1 NZ,NS(N0)", "ON EV1,$E", "WI 1", "SET P1", "RET", "$E SET P2", "RET"},
                 {option("event_check", "each_4_milliseconds")});
  run.begin();
  run.until(20);
  run.machine.inputs = {1};
  run.until(21);
  EXPECT_EQ(run.machine.log, (Log{}));
  run.until(22);
  EXPECT_EQ(run.machine.log, (Log{"22 SET P1"}));

  // A condition that cannot be tested is detected at a check.
  ProgramRun wrong({"SET EV1 NZ,NS(N0)", "ON EV1,$E", "$E WT 1000"},
                   {option("event_check", "each_4_milliseconds")});
  wrong.begin();
  wrong.until(20);
  wrong.machine.variables["N0"] = 2001;
  wrong.until(23);
  EXPECT_TRUE(wrong.execution.running);
  wrong.until(24);
  EXPECT_EQ(wrong.execution.error, Error::range);
}

TEST(SlimProgramOptions, TimedJumpsInFourMilliseconds) {
  // At 1: until 1 + 10 x 4 = 41. WT stays in milliseconds.
  ProgramRun late({"JTI 2,10,$A", "SET P1", "WT 10", "SET P3", "RET", "$A SET P2"},
                  {option("time_unit", "4_milliseconds")});
  late.begin();
  late.until(70);
  EXPECT_EQ(late.machine.log, (Log{"42 SET P1", "53 SET P3"}));

  ProgramRun in_time({"JTI 2,10,$A", "SET P1", "RET", "$A SET P2"}, {option("time_unit", "4_milliseconds")});
  in_time.begin();
  in_time.until(40);
  in_time.machine.inputs = {2};
  in_time.until(50);
  EXPECT_EQ(in_time.machine.log, (Log{"42 SET P2"}));
}

TEST(SlimProgramOptions, FewerEvents) {
  const Options four{option("events", "4_with_the_conditions_of_jumps")};
  for (const std::string_view line : {"SET EV5 I,1", "ON EV5,$A", "SET EV8 NZ,N0", "ON EV8,3"}) {
    EXPECT_EQ(parse_line(line).error, Error::none) << line;
    EXPECT_EQ(parse_line(line, four).error, Error::range) << line;
  }
  for (const std::string_view line : {"SET EV4 I,1", "ON EV4,$A"}) {
    EXPECT_EQ(parse_line(line, four).error, Error::none) << line;
  }
  EXPECT_EQ(parse_line("ON EV9,$A").error, Error::range);
  for (const char* const line : {"NS(2001)=1", "NS(-1)=1", "RS(-7)=1", "N0=NS(-1)", "NS(N100)=1"})
    EXPECT_EQ(parse_line(line).error, Error::range) << line;
  for (const char* const line : {"NS(-)=1", "NS()=1", "NS(--1)=1"})
    EXPECT_EQ(parse_line(line).error, Error::syntax) << line;
  EXPECT_EQ(parse_line("ON P1,$A", four).error, Error::syntax);

  // A restored program cannot contain one either.
  ProgramRun run({"SET EV5 I,1", "ON EV5,$A", "$A RET"});
  run.begin();
  run.until(2);
  EXPECT_TRUE(is_sound(run.execution, run.program, run.options));
  EXPECT_FALSE(is_sound(run.execution, run.program, four));
}

TEST(SlimProgramOptions, LinesNumberedFromOne) {
  const Options options{option("addresses", "line_number_from_1")};
  Editor editor;
  Program program;
  const auto give = [&](std::string_view text) { return edit(editor, program, text, options); };
  for (const std::string_view line : {"PG", "JP 3", "SET P2", "SET P3", ""}) give(line);
  EXPECT_EQ(program.listing(options), (Lines{"1: JP 3", "2: SET P2", "3: SET P3"}));
  for (const std::string_view wrong : {"PE 0", "PE 4", "PI 0", "PI 5", "PD 0", "PD 4"}) {
    EXPECT_EQ(give(wrong), Error::range) << wrong;
    EXPECT_FALSE(is_editing(editor)) << wrong;
  }
  EXPECT_EQ(give("PE 2"), Error::none);
  EXPECT_EQ(next_line_number(editor, program, options), 2);
  EXPECT_EQ(give("CLR P2"), Error::none);
  EXPECT_EQ(give("PI 1"), Error::none);
  EXPECT_EQ(give("WT 0"), Error::none);
  EXPECT_EQ(give("PI 5"), Error::none);
  EXPECT_EQ(give("RET"), Error::none);
  EXPECT_EQ(program.texts(), (Lines{"WT 0", "JP 3", "CLR P2", "SET P3", "RET"}));
  EXPECT_EQ(give("PD 5"), Error::none);
  EXPECT_EQ(program.size(), 4);
  EXPECT_EQ(give("PA"), Error::none);
  EXPECT_EQ(next_line_number(editor, program, options), 5);

  // PI does not rewrite plain numbers: JP 3 jumps to the present third line.
  const auto find = [&](std::string_view jump) {
    return program.find(parse_line(jump).line.command->operands[0], options);
  };
  EXPECT_EQ(find("JP 3"), 2);
  EXPECT_EQ(find("JP 1"), 0);
  EXPECT_EQ(find("JP 4"), 3);
  EXPECT_EQ(find("JP 0"), std::nullopt);
  EXPECT_EQ(find("JP 5"), std::nullopt);
}

TEST(SlimProgramOptions, EveryAddressCountsFromOne) {
  const Options options{option("addresses", "line_number_from_1")};
  // Each goes to line 4, which is the last one.
  for (const std::string line : {"JP 4", "CALL 4", "JI 3,4", "JZ N0,4", "JTI 3,5,4", "JE 0,N0,4"}) {
    ProgramRun run({line, "SET P2", "RET", "SET P4"}, options);
    run.machine.inputs = {3};
    ASSERT_EQ(start(run.execution, run.program, nullptr, options), Error::none);
    run.until(2);
    EXPECT_EQ(run.machine.log, (Log{"2 SET P4"})) << line;
  }
  ProgramRun event({"SET EV1 I,8", "ON EV1,5", "WT 50", "RET", "ISET P4", "RET"}, options);
  event.machine.inputs = {8};
  event.begin("1");
  event.until(10);
  EXPECT_EQ(event.machine.log, (Log{"3 ISET P4"}));

  ProgramRun nowhere({"JP 0"}, options);
  EXPECT_EQ(nowhere.begin("0"), Error::address);
  EXPECT_EQ(nowhere.begin("2"), Error::address);
  EXPECT_EQ(nowhere.begin("1"), Error::none);
  nowhere.until(5);
  EXPECT_EQ(nowhere.execution.error, Error::address);
  ProgramRun empty({}, options);
  EXPECT_EQ(start(empty.execution, empty.program, nullptr, options), Error::address);
}

TEST(SlimProgramOptions, LinesCheckedAsTheyRun) {
  const Options late{option("program_check", "when_it_runs")};
  const Lines lines{"SET P1", "NONSENSE", "SET P5", "?PE", "G", "SET P2"};
  ProgramRun ends(lines, late);
  EXPECT_EQ(ends.program.texts(), lines);
  ends.begin();
  ends.until(10);
  EXPECT_EQ(ends.machine.log, (Log{"1 SET P1"}));
  EXPECT_EQ(ends.execution.ending, Ending::failed);
  EXPECT_EQ(ends.execution.error, Error::syntax);
  EXPECT_EQ(ends.execution.line, 1);

  const Options passing{option("program_check", "when_it_runs"), option("failed_line", "is_passed_over")};
  ProgramRun passes(lines, passing);
  passes.begin();
  passes.until(10);
  EXPECT_EQ(passes.machine.log, (Log{"1 SET P1", "6 SET P2"}));
  EXPECT_EQ(passes.errors,
            (std::vector{Error::syntax, Error::range, Error::not_allowed, Error::not_allowed}));

  // Skipped lines do not matter; a label before nonsense is a label.
  ProgramRun jumps({"JP $B", "NONSENSE", "$B", "SET P1", "$C NONSENSE", "SET P2"}, passing);
  jumps.begin();
  jumps.until(10);
  EXPECT_EQ(jumps.machine.log, (Log{"3 SET P1", "5 SET P2"}));
  EXPECT_EQ(jumps.errors, (std::vector{Error::syntax}));
  EXPECT_EQ(jumps.begin("$C"), Error::none);
  EXPECT_EQ(jumps.begin("$D"), Error::address);
}

TEST(SlimProgramOptions, WhatIsNoLineAtAllIsRefusedAsItIsEntered) {
  const Options options{option("program_check", "when_it_runs")};
  Editor editor;
  Program program;
  const auto give = [&](std::string_view text) { return edit(editor, program, text, options); };
  for (const std::string_view line : {"PG", "one", "two"}) EXPECT_EQ(give(line), Error::none);
  EXPECT_EQ(give("END"), Error::syntax);  // it would end a download
  EXPECT_EQ(give(std::string(128, 'x')), Error::syntax);
  EXPECT_EQ(give(""), Error::none);
  EXPECT_FALSE(is_editing(editor));
  EXPECT_EQ(program.texts(), (Lines{"one", "two"}));
  EXPECT_EQ(give("PE 1"), Error::none);
  EXPECT_EQ(give(" three "), Error::none);
  EXPECT_EQ(give("PI 9"), Error::range);
  EXPECT_EQ(program.upload(), (Lines{"one", "three", "END"}));

  Program restored;
  EXPECT_TRUE(restored.set_texts(program.texts(), options));
  EXPECT_EQ(restored, program);
  EXPECT_FALSE(restored.set_texts(program.texts()));
  for (const std::string wrong : {"", "exit", "a\x1B"}) {
    EXPECT_FALSE(restored.set_texts({wrong}, options)) << wrong;
  }
}

// Whichever was entered first: a saved program is read from its first line to its last.
TEST(SlimProgramOptions, OfLinesWithOneLabelTheFirstIsGood) {
  const Options options{option("program_check", "when_it_runs")};
  const struct {
    const char* what;
    Error (*change)(Program& program, const Options& options);
    Lines lines;
    std::vector<Error> errors;
  } kCases[] = {
      {"entered behind another",
       [](Program& program, const Options& with) { return program.insert(1, "$A SET P2", with); },
       {"$A SET P1", "$A SET P2", "DN"},
       {Error::none, Error::address, Error::none}},
      {"entered before another",
       [](Program& program, const Options& with) { return program.insert(0, "$A SET P2", with); },
       {"$A SET P2", "$A SET P1", "DN"},
       {Error::none, Error::address, Error::none}},
      {"the first is deleted",
       [](Program& program, const Options& with) {
         EXPECT_EQ(program.insert(1, "$A SET P2", with), Error::none);
         return program.remove(0, with);
       },
       {"$A SET P2", "DN"},
       {Error::none, Error::none}},
      {"the first is replaced",
       [](Program& program, const Options& with) {
         EXPECT_EQ(program.insert(1, "$A SET P2", with), Error::none);
         return program.replace(0, "$B SET P3", with);
       },
       {"$B SET P3", "$A SET P2", "DN"},
       {Error::none, Error::none, Error::none}},
      {"the last gets a label that is taken",
       [](Program& program, const Options& with) { return program.replace(1, "$A NONSENSE", with); },
       {"$A SET P1", "$A NONSENSE"},
       {Error::none, Error::syntax}},
      {"nonsense is a place to jump to",
       [](Program& program, const Options& with) { return program.insert(0, "$A NONSENSE", with); },
       {"$A NONSENSE", "$A SET P1", "DN"},
       {Error::syntax, Error::address, Error::none}},
  };
  for (const auto& one : kCases) {
    Program program;
    ASSERT_TRUE(program.set_texts({"$A SET P1", "DN"}, options));
    EXPECT_EQ(one.change(program, options), Error::none) << one.what;
    EXPECT_EQ(program.texts(), one.lines) << one.what;
    std::vector<Error> errors;
    for (int i = 0; i < program.size(); ++i) errors.push_back(program.line(i).error);
    EXPECT_EQ(errors, one.errors) << one.what;
    Program restored;
    EXPECT_TRUE(restored.set_texts(program.texts(), options)) << one.what;
    EXPECT_EQ(restored, program) << one.what;
  }
}

TEST(SlimProgramOptions, EmptyLinesEndEditingOrAreIgnored) {
  const Options options{option("edit_end", "exit_or_esc")};
  Editor editor;
  Program program;
  const auto give_all = [&](const Lines& lines) {
    for (const std::string& line : lines) EXPECT_EQ(edit(editor, program, line, options), Error::none);
  };
  for (const std::string end : {"EXIT", "exit ", "\x1B"}) {
    give_all({"PG", "SET P1", "", "  ", "SET P2"});
    EXPECT_TRUE(is_editing(editor));
    give_all({end, "PA", "", "DN", end});
    EXPECT_FALSE(is_editing(editor));
    EXPECT_EQ(program.texts(), (Lines{"SET P1", "SET P2", "DN"}));
    // These two wait for their line.
    give_all({"PE 1", "", "CLR P2", "PI 0", "  ", "WT 5"});
    EXPECT_FALSE(is_editing(editor));
    EXPECT_EQ(program.texts(), (Lines{"WT 5", "SET P1", "CLR P2", "DN"}));
    give_all({"PE 1", end});
    EXPECT_EQ(program.texts(), (Lines{"WT 5", "SET P1", "CLR P2", "DN"}));
    give_all({"DLP", "", "RET", "END"});
    EXPECT_FALSE(is_editing(editor));
    EXPECT_EQ(program.texts(), (Lines{"RET"}));
  }
}

TEST(SlimProgramOptions, ListsTheTextOnly) {
  const Options options{option("listing", "text")};
  Program program;
  ASSERT_TRUE(program.set_texts({"SET P1", "$A RET"}));
  EXPECT_EQ(program.listing(options), (Lines{"SET P1", "$A RET"}));
  EXPECT_EQ(program.upload(), (Lines{"SET P1", "$A RET", "END"}));
}

TEST(SlimProgramOptions, HoldsAsManyLinesAsChosen) {
  for (const auto& [capacity, chosen] : {std::pair{256, option("program_size", "256_lines")},
                                         {1000, option("program_size", "1000_lines")},
                                         {4000, option("program_size", "4000_lines")}}) {
    const Options options{chosen};
    Editor editor;
    Program program;
    ASSERT_TRUE(program.set_texts(Lines(static_cast<std::size_t>(capacity), "DN"), options));
    EXPECT_EQ(program.insert(0, "DN", options), Error::buffer_full);
    EXPECT_EQ(edit(editor, program, "PI 0", options), Error::buffer_full);
    EXPECT_EQ(edit(editor, program, "PD 0", options), Error::none);
    EXPECT_EQ(edit(editor, program, "PI 0", options), Error::none);
    EXPECT_FALSE(program.set_texts(Lines(static_cast<std::size_t>(capacity) + 1, "DN"), options));
  }
}

TEST(SlimProgramOptions, SavesInPrograms) {
  const Options options{option("first_list_columns", "saves_in_programs_too")};
  for (const std::string_view line : {"SAVE C", "SAVE D", "SAVE P", "DF"}) {
    const Command command = *parse_line(line).line.command;
    EXPECT_FALSE(is_allowed(command, Place::program)) << line;
    EXPECT_TRUE(is_allowed(command, Place::program, options)) << line;
    EXPECT_TRUE(is_allowed(command, Place::immediate, options)) << line;
    EXPECT_FALSE(is_allowed(command, Place::external, options)) << line;
  }
  for (const std::string_view line : {"RESET H", "ULC", "PL", "G", "?PE", "PG"}) {
    EXPECT_FALSE(is_allowed(*parse_line(line).line.command, Place::program, options)) << line;
  }
}

}  // namespace program_options_test
}  // namespace understudy::interpreter::slim
