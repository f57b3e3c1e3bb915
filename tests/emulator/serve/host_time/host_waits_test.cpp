// The bench's knowledge of the threads of a host in simulated time.
#include "emulator/serve/host_time/host_waits.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "base/simulated_time.h"
#include "pty/host_time/protocol.h"

namespace understudy::emulator::serve {
namespace host_waits_test {

using host_time::Message;
using host_time::MessageKind;

struct Reported {
  int number;
  HostAnswer answer;
  std::uint32_t sequence;
  bool operator==(const Reported&) const = default;
};

class HostWaitsTest : public testing::Test {
 protected:
  void hear(int number, MessageKind what, std::uint32_t sequence = 0) {
    Message message = wait_;
    message.what = what;
    message.sequence = sequence;
    message.process = 100;
    message.thread = 100 + number;
    waits_.on_message(number, message);
  }
  HostState state(int number) const { return waits_.threads().at(number).state; }
  /// A thread that waits until a time, for a line.
  void add_waiting(int number, std::int64_t until, int line = 7) {
    waits_.add(number);
    hear(number, MessageKind::hello);
    wait_.until_ns = until;
    wait_.line_count = 1;
    wait_.lines[0] = line;
    hear(number, MessageKind::wait, 1);
  }

  Message wait_{};
  std::vector<Reported> reported_;
  HostWaits waits_{[this](int number, HostAnswer answer, const HostWaits::Thread& thread) {
    reported_.push_back({number, answer, thread.wait.sequence});
  }};
};

/// Brings a thread into a state by messages alone.
void bring(HostWaits& waits, HostState state) {
  waits.add(1);
  Message message{};
  message.process = 100;
  if (state == HostState::unknown) return;
  message.what = MessageKind::hello;
  waits.on_message(1, message);
  message.what = state == HostState::gone ? MessageKind::hello : MessageKind::wait;
  message.until_ns = 50;
  message.line_count = 1;
  message.lines[0] = 7;
  if (state != HostState::running) waits.on_message(1, message);
}

/// Causes an event through the member that stands for it. Returns false if a thread in that state cannot have
/// it.
bool happen(HostWaits& waits, HostEvent event) {
  Message message{};
  message.process = 100;
  switch (event) {
    case HostEvent::hello: message.what = MessageKind::hello; break;
    case HostEvent::wait:
      message.what = MessageKind::wait;
      message.until_ns = host_time::kNever;
      break;
    case HostEvent::cancel: message.what = MessageKind::cancel; break;
    case HostEvent::time: return waits.time_is(SimTime{50}), true;
    case HostEvent::line: return waits.line_has_news(7), true;
    case HostEvent::left: return waits.process_ended(100), true;
  }
  waits.on_message(1, message);
  return true;
}

TEST(HostSteps, HoldInEveryCell) {
  for (std::size_t state = 0; state < kHostStates; ++state) {
    for (std::size_t event = 0; event < kHostEvents; ++event) {
      // A process is known from the greeting of its threads, so the end of an unknown process is not
      // reported.
      const auto what = static_cast<HostEvent>(event);
      const bool is_stranger = static_cast<HostState>(state) == HostState::unknown && what == HostEvent::left;
      if (is_stranger) continue;
      std::vector<HostAnswer> answers;
      HostWaits waits([&](int, HostAnswer answer, const HostWaits::Thread&) { answers.push_back(answer); });
      bring(waits, static_cast<HostState>(state));
      ASSERT_EQ(waits.threads().at(1).state, static_cast<HostState>(state));
      answers.clear();
      happen(waits, what);
      const HostStep step = kHostSteps[state][event];
      EXPECT_EQ(waits.threads().at(1).state, step.next) << "state " << state << ", event " << event;
      const std::vector<HostAnswer> expected =
          step.answer == HostAnswer::nothing ? std::vector<HostAnswer>{} : std::vector{step.answer};
      EXPECT_EQ(answers, expected) << "state " << state << ", event " << event;
    }
  }
}

TEST_F(HostWaitsTest, EndAtTheFirstOfTheirTimes) {
  add_waiting(1, 300);
  add_waiting(2, 200);
  add_waiting(3, host_time::kNever);
  EXPECT_EQ(waits_.next_end(), SimTime{200});
  EXPECT_FALSE(waits_.time_is(SimTime{199}));
  EXPECT_TRUE(waits_.time_is(SimTime{200}));
  EXPECT_EQ(reported_, (std::vector<Reported>{{2, HostAnswer::go, 1}}));
  EXPECT_EQ(waits_.next_end(), SimTime{300});
  EXPECT_TRUE(waits_.time_is(SimTime{300}));
  EXPECT_EQ(waits_.next_end(), std::nullopt);
  EXPECT_TRUE(waits_.is_any_waiting());
}

TEST_F(HostWaitsTest, EndByNewsOfTheirOwnLine) {
  add_waiting(1, host_time::kNever, 7);
  add_waiting(2, host_time::kNever, 8);
  wait_.line_count = host_time::kAnyLine;
  waits_.add(3);
  hear(3, MessageKind::hello);
  hear(3, MessageKind::wait, 1);
  EXPECT_TRUE(waits_.is_line_waited_for(9)) << "by the one that waits for any line";
  EXPECT_TRUE(waits_.line_has_news(8));
  EXPECT_EQ(reported_, (std::vector<Reported>{{2, HostAnswer::go, 1}, {3, HostAnswer::go, 1}}));
  EXPECT_FALSE(waits_.is_line_waited_for(8));
  EXPECT_FALSE(waits_.line_has_news(8));
  EXPECT_EQ(state(1), HostState::waiting);
}

TEST_F(HostWaitsTest, OfADrainDoNotEndByBytes) {
  wait_.is_for_drain = 1;
  add_waiting(1, host_time::kNever, 7);
  EXPECT_FALSE(waits_.line_has_news(7));
  EXPECT_TRUE(waits_.line_is_drained(7));
  EXPECT_EQ(state(1), HostState::running);
}

TEST_F(HostWaitsTest, AreTakenUpAgainAfterASignalHandler) {
  add_waiting(1, 500);
  wait_.until_ns = 100;
  hear(1, MessageKind::wait, 2);  // the handler sleeps
  EXPECT_EQ(waits_.next_end(), SimTime{100});
  waits_.time_is(SimTime{100});
  wait_.until_ns = 500;
  hear(1, MessageKind::wait, 1);
  EXPECT_EQ(waits_.next_end(), SimTime{500});
  EXPECT_EQ(reported_, (std::vector<Reported>{{1, HostAnswer::go, 2}}));
}

TEST_F(HostWaitsTest, CountThreadsThatWaitElsewhere) {
  add_waiting(1, 500);
  EXPECT_FALSE(waits_.is_any_outside());
  waits_.add(2);
  hear(2, MessageKind::hello);
  hear(2, MessageKind::outside);
  EXPECT_TRUE(waits_.is_any_outside());
  hear(2, MessageKind::inside);
  EXPECT_FALSE(waits_.is_any_outside());
}

}  // namespace host_waits_test
}  // namespace understudy::emulator::serve
