// Every cell of transitions.h, caused by the host, by a line of a program and by the routine of an event.
#include "emulator/models/slim/rules/transitions.h"
#include "emulator/device/terminals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/emulator/models/slim/dialogue_script.h"

namespace understudy::emulator::models::slim {

namespace transitions_test {

using Lines = std::vector<std::string>;

const std::string kNames[kActiveTasks] = {"line",      "move",       "homing",   "jog",     "thrust",
                                          "a program", "GETI waits", "WT waits", "DN waits"};
const std::string kCommands[kEvents] = {"TAPZ", "TAREDO", "TAUPZ", "TASTOP", "PZ", "REDO"};

bool is_of_program(ActiveTask task) { return task >= ActiveTask::program_runs; }

/// The lines that start a long motion.
Lines motion_of(ActiveTask task) {
  switch (task) {
    case ActiveTask::line: return {"TX=0", "TY=1", "2MR 3000,4000"};
    case ActiveTask::move: return {"MR 5000000"};
    case ActiveTask::homing: return {"H"};
    case ActiveTask::jog: return {"JGF"};
    case ActiveTask::thrust: return {"FT 500"};
    default: return {};
  }
}

/// Lines of a program that cause it, and then print B.
Lines lines_of(ActiveTask task) {
  const Lines loop{"OUT \"B\"", "$L CHG P1", "JP $L"};
  Lines lines;
  switch (task) {
    case ActiveTask::program_waits_for_number: lines = {"N0=GETI"}; break;
    case ActiveTask::program_waits_for_time: lines = {"WT 5000"}; break;
    case ActiveTask::program_waits_for_motion: lines = {"MR 5000000", "DN"}; break;
    default: break;
  }
  const bool waits = is_of_program(task) && task != ActiveTask::program_runs;
  lines.insert(lines.end(), loop.begin() + (waits ? 0 : 1), loop.end());
  return lines;
}

/// The pause that a command ends; empty for others.
std::string pause_before(Event event) {
  switch (event) {
    case Event::resume:
    case Event::give_up: return "TAPZ";
    case Event::resume_q: return "PZ";
    default: return "";
  }
}

class Cell {
 public:
  Cell(const Transition& row, From from)
      : row_(row), from_(from), command_(kCommands[static_cast<std::size_t>(row.event)]) {}

  void check() {
    const Outcome expected = row_.outcomes[static_cast<std::size_t>(from_)];
    type_all(motion_of(row_.task));
    script_.pass(400);
    const Mode mode = chain().status(0).mode;
    const double speed_pps = chain().speed_pps(0);
    enter_program();
    if (from_ == From::event_routine || (is_of_program(row_.task) && from_ == From::host)) go();
    if (!pause_before(row_.event).empty()) {
      script_.type(pause_before(row_.event));
      script_.pass(400);
    }
    const std::int64_t travel = chain().axis(0).travel_pulses;
    bring_about();
    script_.pass(400);
    EXPECT_EQ(script_.next(), from_ == From::event_routine ? "R" : reply_to(expected));
    if (is_of_program(row_.task)) return check_program(expected);
    switch (expected) {
      case Outcome::decelerates:
        EXPECT_EQ(chain().speed_pps(0), 0);
        EXPECT_TRUE(chain().busy(0));
        break;
      case Outcome::continues_as_before:
        EXPECT_EQ(chain().status(0).mode, mode);
        EXPECT_DOUBLE_EQ(chain().speed_pps(0), speed_pps);
        break;
      case Outcome::is_dropped:
        EXPECT_EQ(chain().status(0).mode, Mode::idle);
        EXPECT_FALSE(chain().busy(0));
        break;
      default:
        EXPECT_EQ(expected, Outcome::stops_at_once);
        EXPECT_EQ(chain().axis(0).travel_pulses, travel);
        EXPECT_EQ(chain().status(0).mode, Mode::idle);
        EXPECT_FALSE(chain().busy(0));
        break;
    }
  }

 private:
  const Chain& chain() { return script_.device().state().chain; }
  const lang::Execution& execution() { return script_.device().state().execution; }

  void type_all(const Lines& lines) {
    for (const std::string& line : lines) {
      script_.type(line);
      EXPECT_EQ(script_.next(), "(nothing)") << line;
    }
  }

  void enter_program() {
    Lines lines{"PG"};
    const auto add = [&](const Lines& more) { lines.insert(lines.end(), more.begin(), more.end()); };
    if (from_ == From::event_routine) add({"SET EV1 I,8", "ON EV1,$E"});
    if (from_ == From::program) add({command_});
    add(lines_of(row_.task));
    if (from_ == From::event_routine) add({"RET", "$E " + command_, "OUT \"R\"", "RET"});
    add({"EXIT"});
    type_all(lines);
  }
  void go() {
    type_all({"G"});
    script_.pass(20);
    if (row_.task == ActiveTask::program_runs || !is_of_program(row_.task)) return;
    const lang::Hold holds[] = {lang::Hold::number, lang::Hold::timer, lang::Hold::machine};
    EXPECT_EQ(execution().hold, holds[static_cast<std::size_t>(row_.task) -
                                      static_cast<std::size_t>(ActiveTask::program_waits_for_number)]);
  }

  void bring_about() {
    switch (from_) {
      case From::host: script_.type(command_); break;
      case From::program: script_.type("G"); break;
      case From::event_routine: script_.play("IN8 = 1"); break;
    }
  }

  /// The program prints something only if the motion that DN waits for is abandoned.
  std::string reply_to(Outcome expected) const {
    const bool is_over = row_.task == ActiveTask::program_waits_for_motion && row_.event == Event::give_up;
    return is_over && expected == Outcome::continues ? "B" : "(nothing)";
  }

  void check_program(Outcome expected) {
    if (from_ == From::event_routine) {
      EXPECT_EQ(script_.next(), reply_to(expected));
    }
    EXPECT_EQ(script_.next(), "(nothing)");
    EXPECT_EQ(execution().running, expected == Outcome::continues);
    if (row_.task != ActiveTask::program_runs || expected != Outcome::continues) return;
    const auto level = [&] { return script_.device().terminals()->output(terminal(0, kFirstOutput)); };
    const bool before = level();
    script_.pass(2);  // CHG and JP
    EXPECT_NE(level(), before);
  }

  const Transition& row_;
  From from_;
  std::string command_;
  DialogueScript script_{2};
};

TEST(SlimMeetings, ComeOutAsTheTableSays) {
  int cells = 0;
  for (const Transition& row : kTransitions) {
    for (const From from : {From::host, From::program, From::event_routine}) {
      if (row.outcomes[static_cast<std::size_t>(from)] == Outcome::cannot_be) continue;
      SCOPED_TRACE(kNames[static_cast<std::size_t>(row.task)] + ", " +
                   kCommands[static_cast<std::size_t>(row.event)] + " from " +
                   (from == From::host      ? "the host"
                    : from == From::program ? "a program"
                                            : "an event"));
      Cell(row, from).check();
      ++cells;
    }
  }
  // A waiting program prints nothing itself.
  EXPECT_EQ(cells, static_cast<int>(kActiveTasks * kEvents * kSources - 3 * kEvents));
}

TEST(SlimMeetings, NameTheListOrARowOfTheChoices) {
  for (const Transition& row : kTransitions) {
    const bool is_row = std::ranges::any_of(kChoices, [&](const ChoiceRow& c) { return c.id == row.by; });
    EXPECT_TRUE(is_row || row.by.starts_with("list, ")) << row.by;
  }
}

}  // namespace transitions_test

}  // namespace understudy::emulator::models::slim
