// Downloads: sizes, costs, blocks, labels, and what inputs 110 to 114 show.
#include "interpreter/rs_m8194h/download.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "interpreter/rs_m8194h/text.h"
#include "interpreter/rs_m8194h/window.h"
#include "tests/interpreter/rs_m8194h/printed.h"

namespace understudy::interpreter::rs_m8194h {
namespace download_test {

Command line_of(const std::string& text) {
  const ParsedCommand parsed = parse_command("RSM_MACRO_" + text);
  EXPECT_TRUE(parsed.command) << (parsed.error ? to_string(*parsed.error) : "");
  return parsed.command.value_or(Command{});
}

std::vector<Command> repeated(int count, const std::string& text) {
  return std::vector<Command>(static_cast<std::size_t>(count), line_of(text));
}

struct Outcome {
  std::vector<Fault> answers;  // of the lines that were refused, CLOSE's last
  DownloadStatus status;
  bool is_stored = false;
};
Outcome download(const MacroName& name, const std::vector<Command>& lines, const Options& options = {}) {
  Download activity{.name = name};
  Outcome outcome;
  for (const Command& line : lines) {
    if (const Fault fault = add(activity, line, options); fault != Fault::none)
      outcome.answers.push_back(fault);
  }
  const Closed closed = close(activity, options);
  if (closed.fault != Fault::none) outcome.answers.push_back(closed.fault);
  outcome.is_stored = closed.macro.has_value();
  outcome.status = status_of(activity, {.mp = 7, .isr = 3}, options);
  return outcome;
}
Outcome download(const std::vector<std::string>& texts, const Options& options = {}) {
  std::vector<Command> lines;
  for (const std::string& text : texts) lines.push_back(line_of(text));
  return download({false, 156}, lines, options);
}

/// The manual's 177 macros and their sizes.
TEST(RsM8194hDownload, MacrosHaveTheSizesOfTheManual) {
  const auto size_of = [](const MacroName& name) {
    if (name.is_isr) return name.number <= 6 ? 8 : name.number <= 15 ? 16 : name.number <= 18 ? 32 : 64;
    return name.number <= 40    ? 8
           : name.number <= 90  ? 16
           : name.number <= 130 ? 32
           : name.number <= 150 ? 64
           : name.number <= 155 ? 128
                                : 512;
  };
  int count = 0;
  for (const bool is_isr : {false, true}) {
    for (int number = -1; number <= 260; ++number) {
      const MacroName name{is_isr, number};
      if (!exists(name)) continue;
      ++count;
      const int size = size_of(name);
      EXPECT_EQ(capacity_of(name), size) << to_string(name);
      EXPECT_TRUE(download(name, repeated(size, "SET_VAR VAR1 1")).is_stored) << to_string(name);
      const Outcome full = download(name, repeated(size + 1, "SET_VAR VAR1 1"));
      EXPECT_FALSE(full.is_stored);
      EXPECT_EQ(full.status.error, 0x01);
      EXPECT_EQ(full.status.line, size);
      EXPECT_EQ(full.status.command, 0x0AD2);
    }
  }
  EXPECT_EQ(count, 177);
}

TEST(RsM8194hDownload, LongCommandsTakeSeveralLines) {
  const std::string helix = "HELIX_3D X Y Z 0 1000 0 1000 1 10";
  const std::string rectangle = "RECTANGLE X Y 0 0 0 100 100 10 1 1 1 1";
  const std::string arc = "ARC_CW 0 10 0 20";
  EXPECT_TRUE(download({false, 1}, repeated(2, rectangle)).is_stored);
  EXPECT_TRUE(download({false, 1}, repeated(4, arc)).is_stored);
  EXPECT_FALSE(download({false, 1}, repeated(5, arc)).is_stored);
  std::vector<Command> lines = repeated(2, helix);
  lines.push_back(line_of("ARC_CCW 0 10 0 20"));
  EXPECT_TRUE(download({false, 1}, lines).is_stored);
  lines.push_back(line_of("NEXT"));
  const Outcome full = download({false, 1}, lines);
  EXPECT_EQ(full.answers, std::vector{Fault::macro_memory});  // before any other error in it
  EXPECT_EQ(full.status.line, 3);
}

struct ErrorCase {
  int error;
  std::vector<std::string> lines;
  std::vector<Fault> answers;
  int command;
  int line;
};

std::vector<std::string> nested(int depth, const std::string& open, const std::string& close) {
  std::vector<std::string> lines;
  for (int i = 0; i < depth; ++i) lines.push_back(open);
  for (int i = 0; i < depth; ++i) lines.push_back(close);
  return lines;
}

TEST(RsM8194hDownload, EachErrorShowsItsLineCommandAndCode) {
  const ErrorCase kCases[] = {
      {0x02, nested(8, "IF 1 < 2", "END_IF"), {Fault::if_too_deep, Fault::end_if_outside}, 0x0AD7, 7},
      {0x03, {"SET_VAR VAR1 1", "ELSE"}, {Fault::else_outside}, 0x0AD8, 1},
      {0x03, {"IF 1 < 2", "ELSE", "ELSE", "END_IF"}, {Fault::else_outside}, 0x0AD8, 2},
      {0x03, {"IF 1 < 2", "FOR 2", "ELSE", "NEXT", "END_IF"}, {Fault::else_outside}, 0x0AD8, 2},
      {0x04, {"END_IF"}, {Fault::end_if_outside}, 0x0AD9, 0},
      {0x04, {"FOR 2", "END_IF", "NEXT"}, {Fault::end_if_outside}, 0x0AD9, 1},
      {0x05, {"SET_VAR VAR1 1", "IF 1 < 2"}, {Fault::if_open}, 0x0AD7, 1},
      {0x07, nested(8, "FOR 2", "NEXT"), {Fault::for_too_deep, Fault::next_outside}, 0x0AD5, 7},
      {0x08, {"EXIT_FOR"}, {Fault::exit_for_outside}, 0x0ADE, 0},
      {0x08, {"FOR 1", "NEXT", "IF 1 < 2", "EXIT_FOR", "END_IF"}, {Fault::exit_for_outside}, 0x0ADE, 3},
      {0x09, {"NEXT"}, {Fault::next_outside}, 0x0AD6, 0},
      {0x09, {"FOR 2", "IF 1 < 2", "NEXT", "END_IF", "NEXT"}, {Fault::next_outside}, 0x0AD6, 2},
      {0x0A, {"FOR 2", "SET_VAR VAR1 1"}, {Fault::for_open}, 0x0AD5, 0},
      {0x0A, {"SET_VAR VAR1 1", "FOR 2", "IF 1 < 2"}, {Fault::for_open}, 0x0AD5, 1},
      {0x05, {"IF 1 < 2", "FOR 2", "GOTO 1"}, {Fault::if_open}, 0x0AD7, 0},
      {0x0B, {"LABEL 1", "LABEL 2", "LABEL 1"}, {Fault::label_twice}, 0x0AE1, 2},
      {0x0C, {"IF 1 < 2", "LABEL 1", "END_IF"}, {Fault::label_in_if}, 0x0AE1, 1},
      {0x0D, {"FOR 2", "LABEL 1", "NEXT"}, {Fault::label_in_for}, 0x0AE1, 1},
      {0x0D, {"IF 1 < 2", "FOR 2", "LABEL 1", "NEXT", "END_IF"}, {Fault::label_in_for}, 0x0AE1, 2},
      {0x0E, {"LABEL 1", "GOTO 1", "GOTO 0"}, {Fault::goto_without_label}, 0x0ADF, 2},
  };
  for (const ErrorCase& one : kCases) {
    const Outcome outcome = download(one.lines);
    SCOPED_TRACE(one.lines.back() + " of error " + std::to_string(one.error));
    EXPECT_EQ(outcome.answers, one.answers);
    EXPECT_EQ(outcome.status, (DownloadStatus{.mp = 156,
                                              .isr = 3,
                                              .command = static_cast<std::uint16_t>(one.command),
                                              .line = static_cast<std::uint16_t>(one.line),
                                              .error = static_cast<std::uint16_t>(one.error)}));
    EXPECT_FALSE(outcome.is_stored);
    const Outcome as_sent = download(one.lines, {option("download_command", "as_sent")});
    EXPECT_EQ(as_sent.status.command, one.command + 0x200);
  }
}

TEST(RsM8194hDownload, WrongOperatorsAndOperandsAreErrorsToo) {
  struct Case {
    const char* text;
    std::size_t parameter;
    std::uint32_t value;
    int error;
  };
  constexpr Case kCases[] = {
      {"IF VAR1 < 2", 1, 0x3E3C, 0x06},
      {"IF VAR1 < 2", 1, 0, 0x06},
      {"VAR_CALCULATE VAR1 + 2 VAR3", 1, '%', 0x10},
      {"VAR_CALCULATE VAR1 + 2 VAR3", 1, 0, 0x10},
      {"VAR_CALCULATE VAR1 + 2 VAR3", 0, 2'000'000'001, 0x10},
      {"VAR_CALCULATE VAR1 + 2 VAR3", 2, 0x7FFF0200, 0x10},
      {"VAR_CALCULATE VAR1 + 2 VAR3", 3, 3, 0x10},
  };
  for (const Case& one : kCases) {
    Command wrong = line_of(one.text);
    wrong.values[one.parameter] = one.value;
    const Outcome outcome = download({false, 1}, {line_of("LABEL 0"), wrong});
    EXPECT_EQ(outcome.answers.size(), 1U);
    EXPECT_EQ(outcome.status.error, one.error) << one.text << " " << one.value;
    EXPECT_EQ(outcome.status.line, 1);
    EXPECT_EQ(row_of(outcome.answers[0]).reason_12_1_12, 2);
  }
}

TEST(RsM8194hDownload, UndefinedCommandsSpoilItOthersAreLeftOut) {
  const auto close_behind = [](std::uint16_t code, Fault fault, const Options& options) {
    Download activity{.name = {true, 4}};
    EXPECT_EQ(add(activity, line_of("EXIT_MACRO"), options), Fault::none);
    refuse(activity, code, fault, options);
    const bool is_stored = close(activity).macro.has_value();
    return std::pair(is_stored, status_of(activity, {.mp = 9, .isr = 1}, options));
  };
  EXPECT_EQ(close_behind(0x0C22, Fault::undefined_command, {}),
            std::pair(false, (DownloadStatus{9, 4, 0x0A22, 1, 0x0F})));
  for (const Fault fault :
       {Fault::parameter, Fault::register_count, Fault::real_time_in_macro, Fault::mp_in_isr}) {
    EXPECT_EQ(close_behind(0x0C4E, fault, {}), std::pair(true, (DownloadStatus{9, 4, 0, 0, 0})));
    const Options strict{option("refused_lines", "spoil_the_download")};
    EXPECT_FALSE(close_behind(0x0C4E, fault, strict).first);
  }
}

TEST(RsM8194hDownload, SevenBlocksOfEachKindFit) {
  std::vector<std::string> lines;
  for (int i = 0; i < 7; ++i) lines.insert(lines.end(), {"FOR 1", "IF 1 < 2", "EXIT_FOR"});
  for (int i = 0; i < 7; ++i) lines.insert(lines.end(), {"END_IF", "NEXT"});
  const Outcome outcome = download(lines);
  EXPECT_EQ(outcome.answers, std::vector<Fault>{});
  EXPECT_TRUE(outcome.is_stored);
  EXPECT_EQ(outcome.status, (DownloadStatus{.mp = 156, .isr = 3}));
}

TEST(RsM8194hDownload, FirstErrorIsTheOneThatCounts) {
  const Outcome outcome = download({"NEXT", "ELSE", "FOR 1"});
  EXPECT_EQ(outcome.answers, (std::vector{Fault::next_outside, Fault::else_outside, Fault::for_open}));
  EXPECT_EQ(outcome.status.error, 0x09);
  EXPECT_EQ(outcome.status.line, 0);
}

TEST(RsM8194hDownload, LastErrorIsTheOneThatCountsIfChosen) {
  const Options options{option("kept_error", "the_last")};
  const Outcome outcome = download({"NEXT", "SET_VAR VAR1 1", "ELSE"}, options);
  EXPECT_EQ(outcome.status.error, 0x03);
  EXPECT_EQ(outcome.status.line, 1);
  EXPECT_FALSE(outcome.is_stored);
  EXPECT_EQ(download({"NEXT", "FOR 1"}, options).status.error, 0x0A);
  EXPECT_EQ(download({"GOTO 0", "NEXT"}, options).status.error, 0x0E) << "CLOSE finds it last";
}

TEST(RsM8194hDownload, OnlyGotoStaysInItsBlockIfChosen) {
  const Options options{option("goto_out_of_blocks", "is_refused_as_without_its_label")};
  const Outcome inside = download({"LABEL 0", "FOR 1", "SET_VAR VAR1 1", "NEXT", "GOTO 0"}, options);
  EXPECT_EQ(inside.answers, std::vector<Fault>{});
  EXPECT_TRUE(inside.is_stored);
  EXPECT_EQ(download({"LABEL 0", "FOR 1", "GOTO 0", "NEXT"}, options).answers,
            std::vector{Fault::goto_without_label});
  EXPECT_TRUE(download({"LABEL 0", "FOR 1", "GOTO 0", "NEXT"}).is_stored);
}

TEST(RsM8194hDownload, CloseTakesALineIfChosen) {
  const Options options{option("close_line", "one_line")};
  EXPECT_TRUE(download({false, 1}, repeated(7, "NEXT"), options).answers.size() == 7U);
  EXPECT_TRUE(download({false, 1}, repeated(7, "SET_VAR VAR1 1"), options).is_stored);
  EXPECT_EQ(download({false, 1}, repeated(8, "SET_VAR VAR1 1"), options).status.error, 0x01);
}

/// Each in its own download, after the lines that must be open for it.
TEST(RsM8194hDownload, EveryPrintedMacroFrameIsALine) {
  int count = 0;
  for (const auto& registers : printed::window_frames()) {
    if (!is_macro_code(registers[0])) continue;
    ++count;
    SCOPED_TRACE(name_of(registers[0]));
    const bool is_of_isr = !find_code(registers[0])->use.in_mp;
    Download activity{.name = is_of_isr ? MacroName{true, 20} : MacroName{false, 156}};
    const Decoded decoded = decode(registers, is_of_isr ? State::isr_download : State::mp_download);
    ASSERT_EQ(decoded.fault, Fault::none);
    const Verb verb = decoded.command.verb();
    if (verb == Verb::else_ || verb == Verb::end_if) add(activity, line_of("IF 1 < 2"));
    if (verb == Verb::next || verb == Verb::exit_for) add(activity, line_of("FOR 2"));
    const std::size_t before = activity.lines.size();
    if (decoded.command.row().closes()) continue;
    EXPECT_EQ(add(activity, decoded.command), Fault::none);
    EXPECT_EQ(activity.lines.size(), before + 1);
  }
  EXPECT_GT(count, 100);
}

/// Its 15 commands, one of which takes two lines, fill the 16 lines of MP59.
TEST(RsM8194hDownload, PrintedProgramFillsItsMacro) {
  std::vector<Command> lines;
  for (const char* text : {"SET_MAX_V XY 20000", "NORMAL_SPEED XY 0", "SET_V XY 2000", "SET_A XY 100000",
                           "SET_SV XY 2000", "SET_LP XY 0", "ENABLE_INT", "SET_OUT X 0 0", "SET_PRESET Y 0",
                           "SYNC_ACTION X X 1 0 1 0 1 1 1 0 0 0", "SET_COMPARE X 0 0 1000",
                           "FIXED_MOVE X 10000", "STOP_WAIT X", "CLEAR_SYNC_ACTION X", "DISABLE_INT"}) {
    lines.push_back(line_of(text));
  }
  EXPECT_EQ(lines_used(lines), 16);
  EXPECT_TRUE(download({false, 59}, lines).is_stored);
  lines.push_back(line_of("EXIT_MACRO"));
  EXPECT_EQ(download({false, 59}, lines).status.error, 0x01);
}

}  // namespace download_test
}  // namespace understudy::interpreter::rs_m8194h
