// Options about SLIM's line: where lines end, how long they can be, and flow control.
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/user_program.h"
#include "emulator/world/snapshot.h"
#include "tests/emulator/models/slim/dialogue_script.h"

namespace understudy::emulator::models::slim {

namespace options_of_the_line_test {

using namespace std::chrono_literals;
/// A line as raw bytes, without any idea of where lines end.
struct Wire {
  explicit Wire(const Choices& choices, pty::Timing timing = pty::Timing::instant)
      : bench(slim_bench(1, choices)) {
    bench.lines[0].timing = timing;
    world = std::make_unique<world::World>(bench, world::WorldOptions{}, [](const std::string&) {});
  }
  void send(std::string_view text) {
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    world->receive(0, bytes);
    pass(SimTime{0});
  }
  void pass(SimTime time) { world->advance_to(world->now() + time); }
  /// Returns what has arrived since the last call.
  std::string received() {
    const pty::Line& line = world->line(0).line;
    const std::string text(line.output().begin(), line.output().end());
    world->take_output(0, text.size());
    return text;
  }
  std::string answer(std::string_view text) {
    send(text);
    return received();
  }
  Slim& device() { return dynamic_cast<Slim&>(world->device(0)); }

  world::Bench bench;
  std::unique_ptr<world::World> world;
};

TEST(SlimLineOptions, WhereALineEnds) {
  EXPECT_EQ(Wire(Choices{}).answer("?P\nE\r"), "ERR 1\r\nERR 1\r\n");
  Wire wire(Choices{{"line_end", "cr_alone"}});
  EXPECT_EQ(wire.answer("?PE\n"), "");
  EXPECT_EQ(wire.answer("\r\n"), "0\r\n");
  EXPECT_EQ(wire.answer("\n?P\nE\r\n?PE\n\r"), "0\r\n0\r\n");
}

TEST(SlimLineOptions, WhatEndsALineThatIsSaid) {
  Wire wire(Choices{{"output_end", "cr"}, {"prompt", "greater_than"}});
  EXPECT_EQ(wire.answer("?PE\r"), "0\r>");
  EXPECT_EQ(wire.answer("nonsense\r"), "ERR 1\r>");
  Wire terminal(Choices{{"output_end", "cr"}, {"echo", "on"}});
  EXPECT_EQ(terminal.answer("?PE\r"), "?PE\r0\r");
  EXPECT_EQ(Wire(Choices{{"echo", "on"}}).answer("?PE\r"), "?PE\r\n0\r\n");
  terminal.send("PG\rOUT 5\rOUT \"A\"\r\rPL\rG\r");
  terminal.received();
  terminal.pass(10ms);
  EXPECT_EQ(terminal.received(), "A\r");
}

TEST(SlimLineOptions, LongLines) {
  const auto padded = [](std::size_t size) { return "?PE" + std::string(size - 3, ' ') + "\r"; };
  struct Case {
    const char* option;
    std::size_t longest;
  };
  for (const Case& one : {Case{"127_characters_then_error_1", 127}, Case{"80_characters_then_error_1", 80},
                          Case{"255_characters_then_error_1", 255}}) {
    Wire wire(Choices{{"longest_line", one.option}});
    EXPECT_EQ(wire.answer(padded(one.longest)), "0\r\n") << one.option;
    EXPECT_EQ(wire.answer(padded(one.longest + 1)), "ERR 1\r\n") << one.option;
    // A program's lines, whichever way they are entered: OUT "..." of that length.
    const std::string text(one.longest - 6, 'x');
    const std::string line = "OUT \"" + text + "\"";
    EXPECT_EQ(wire.answer("PG\r" + line + "\r\rSAVE P\r"), "") << one.option;
    EXPECT_THROW(wire.device().user_program()->load_program(line + " "), ProgramError) << one.option;
    wire.device().user_program()->load_program(line);
    wire.world->switch_power(0, false);
    wire.world->switch_power(0, true);
    wire.send("G\r");
    const world::WorldState state = world::save(*wire.world);
    Wire other(Choices{{"longest_line", one.option}});
    world::restore(*other.world, state);
    other.pass(5ms);
    EXPECT_EQ(other.received(), text + "\r\n") << one.option;
  }
}

TEST(SlimLineOptions, ALineThatIsTooLongForAnotherChoiceDoesNotFit) {
  Wire long_lines(Choices{{"longest_line", "255_characters_then_error_1"}});
  long_lines.send("PG\rOUT \"" + std::string(200, 'x') + "\"\r\rSAVE P\r");
  Wire ours(Choices{});
  EXPECT_THROW(ours.device().restore_state(long_lines.device().save_state()), StateError);
  ours.world->switch_power(0, false);
  EXPECT_THROW(ours.device().memory()->load_nv(long_lines.device().memory()->nv_image()), NvError);
}

TEST(SlimLineOptions, WithoutFlowControlXoffIsACharacter) {
  Wire wire(Choices{});
  EXPECT_EQ(wire.answer("?P\x13"
                        "E\r"),
            "ERR 1\r\n");
  EXPECT_EQ(wire.answer("?PE\r"), "0\r\n");
}

TEST(SlimLineOptions, XoffHoldsWhatIsSaidAndXonLetsItContinue) {
  Wire wire(Choices{{"flow_control", "xon_xoff"}});
  EXPECT_EQ(wire.answer("?P\x13"
                        "E\r"),
            "");  // it receives
  EXPECT_EQ(wire.answer("nonsense\r\x13"), "");
  wire.pass(5s);
  EXPECT_EQ(wire.received(), "");
  EXPECT_EQ(wire.answer("\x11"), "0\r\nERR 1\r\n");
  EXPECT_EQ(wire.answer("\x11?PE\r"), "0\r\n");
  // Without a request too: a program has its text ready, and that follows the previous reply.
  EXPECT_EQ(wire.answer("PG\rOUT \"A\"\rWT 20\rOUT \"B\"\r\r\x13G\r?PE\r"), "");
  wire.pass(10ms);
  wire.send("?PE\r");
  wire.pass(1s);
  EXPECT_EQ(wire.answer("?"), "");
  EXPECT_EQ(wire.answer("\x11"), "0\r\nA\r\n0\r\nB\r\n");
}

TEST(SlimLineOptions, WhatIsEchoedIsHeldToo) {
  Wire wire(Choices{{"flow_control", "xon_xoff"}, {"echo", "on"}});
  EXPECT_EQ(wire.answer("?P"), "?P");
  EXPECT_EQ(wire.answer("\x13"
                        "E\r?V"),
            "");
  EXPECT_EQ(wire.answer("\x11"), "E\r\n0\r\n?V");
  EXPECT_EQ(wire.answer("M\r"), "M\r\n1000\r\n");
}

TEST(SlimLineOptions, ThePowersEndForgetsXoff) {
  Wire wire(Choices{{"flow_control", "xon_xoff"}});
  EXPECT_EQ(wire.answer("\x13?PE\r"), "");
  wire.world->switch_power(0, false);
  wire.world->switch_power(0, true);
  EXPECT_EQ(wire.answer("?PE\r"), "0\r\n");
}

TEST(SlimLineOptions, XoffOutlivesASnapshot) {
  const Choices choices{{"flow_control", "xon_xoff"}};
  Wire wire(choices);
  EXPECT_EQ(wire.answer("\x13?PE\r"), "");
  Wire other(choices);
  world::restore(*other.world, world::save(*wire.world));
  EXPECT_EQ(other.answer("?VM\r"), "");
  EXPECT_EQ(other.answer("\x11"), "0\r\n1000\r\n");
}

TEST(SlimLineOptions, OnAWireXoffHoldsFromTheNextCharacterOn) {
  // 9600 8N1: ten bits per character, 1.0417 ms. "?VM" and CR end after 4.167 ms, XOFF after 5.208 ms. By
  // then one character of "1000" has left, and the second should not start, but it starts at the very moment
  // at which XOFF ends. So the host sends XOFF half a character later: the second one is then already on the
  // wire.
  Wire wire(Choices{{"flow_control", "xon_xoff"}}, pty::Timing::wire);
  wire.send("?VM\r");
  wire.pass(SimTime{4'687'500});
  wire.send("\x13");  // ends at 5.729 ms; the second character ends at 6.250 ms
  wire.pass(100ms);
  EXPECT_EQ(wire.received(), "10");
  wire.send("\x11");
  wire.pass(SimTime{1'041'667});  // XON itself
  EXPECT_EQ(wire.received(), "");
  wire.pass(100ms);
  EXPECT_EQ(wire.received(), "00\r\n");
}

}  // namespace options_of_the_line_test

}  // namespace understudy::emulator::models::slim
