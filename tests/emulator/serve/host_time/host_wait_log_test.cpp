// Tests how the waits of a host in simulated time are described.
#include "emulator/serve/host_time/host_wait_log.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/serve/host_time/host_waits.h"
#include "pty/host_time/protocol.h"

namespace understudy::emulator::serve {
namespace host_wait_log_test {

using host_time::Message;
using host_time::MessageKind;
using std::chrono::milliseconds;

constexpr int kTerminal = 7;

/// A thread that waits as the tests say, on a bench of one line.
class HostWaitLogTest : public testing::Test {
 protected:
  HostWaitLogTest() { greet(); }
  void greet() {
    waits_.add(1);
    Message hello{};
    hello.what = MessageKind::hello;
    waits_.on_message(1, hello);
  }
  void leave() { waits_.remove(1); }
  void time_out() { waits_.time_is(now_); }
  /// Waits from now on for this long; at the end the line sends so many bytes.
  void wait(Message message, milliseconds length, std::uint64_t sent = 0) {
    message.what = MessageKind::wait;
    message.sequence = ++sequence_;
    waits_.on_message(1, message);
    log_.begin(waits_, lines_, now_);
    now_ += length;
    lines_[0].bytes_out += sent;
    log_.end(lines_, now_);
  }
  static Message message_for_line() {
    Message message{};
    message.until_ns = host_time::kNever;
    message.line_count = 1;
    message.lines[0] = kTerminal;
    return message;
  }
  void wait_for_line(milliseconds length, std::uint64_t sent = 0) { wait(message_for_line(), length, sent); }
  void sleep(milliseconds length) {
    Message message{};
    message.until_ns = SimTime(now_ + length).count();
    wait(message, length);
  }
  void host_writes(std::uint64_t bytes) { lines_[0].bytes_in += bytes; }
  const std::vector<HostWait>& reported() {
    log_.finish(lines_);
    return reported_;
  }
  std::vector<HostWait> under_way() const { return log_.under_way(waits_, lines_); }
  const std::vector<HostWait>& reported_before() const { return reported_; }

 private:
  HostWaits waits_{[](int, HostAnswer, const HostWaits::Thread&) {}};
  std::vector<HostWait> reported_;
  HostWaitLog log_{[](int terminal) { return std::size_t{terminal == kTerminal ? 0U : 1U}; },
                   [this](const HostWait& wait) { reported_.push_back(wait); }};
  HostWaitLog::Lines lines_{{.name = "rs485"}};
  std::uint32_t sequence_ = 0;
  SimTime now_{0};
};

HostWait reported_wait(milliseconds begin, milliseconds end, const char* text) {
  return {.thread = 1, .begin = begin, .end = end, .text = text};
}

TEST_F(HostWaitLogTest, TellsTheBytesOfAReplyAsOneWait) {
  host_writes(8);
  wait_for_line(milliseconds(5), 1);
  wait_for_line(milliseconds(1), 1);
  wait_for_line(milliseconds(1), 1);
  sleep(milliseconds(20));
  EXPECT_EQ(reported(), (std::vector<HostWait>{
                            reported_wait(milliseconds(0), milliseconds(7), "waits for a reply"),
                            reported_wait(milliseconds(7), milliseconds(27), "sleeps"),
                        }));
}

TEST_F(HostWaitLogTest, TellsTimeoutsApart) {
  host_writes(8);
  for (int attempt = 0; attempt < 2; ++attempt) {
    Message message = message_for_line();
    message.until_ns = SimTime(milliseconds(300 * (attempt + 1))).count();
    wait(message, milliseconds(300));
  }
  EXPECT_EQ(reported(), (std::vector<HostWait>{
                            reported_wait(milliseconds(0), milliseconds(300), "waits for a reply in vain"),
                            reported_wait(milliseconds(300), milliseconds(600), "waits for a reply in vain"),
                        }));
}

TEST_F(HostWaitLogTest, TellsRequestsApart) {
  host_writes(8);
  wait_for_line(milliseconds(500));
  host_writes(8);
  wait_for_line(milliseconds(4), 7);
  wait_for_line(milliseconds(3));
  EXPECT_EQ(reported(), (std::vector<HostWait>{
                            reported_wait(milliseconds(0), milliseconds(500), "waits for a reply in vain"),
                            reported_wait(milliseconds(500), milliseconds(507), "waits for a reply"),
                        }));
}

// A host that asks again as soon as it has the reply, without a pause.
TEST_F(HostWaitLogTest, TellsRequestsWithoutAPauseApart) {
  for (int request = 0; request < 2; ++request) {
    host_writes(8);
    wait_for_line(milliseconds(4), 7);
  }
  EXPECT_EQ(reported(), (std::vector<HostWait>{
                            reported_wait(milliseconds(0), milliseconds(4), "waits for a reply"),
                            reported_wait(milliseconds(4), milliseconds(8), "waits for a reply"),
                        }));
}

TEST_F(HostWaitLogTest, TellsSleepsApartAndWaitsByTheirKind) {
  sleep(milliseconds(10));
  sleep(milliseconds(10));
  wait_for_line(milliseconds(1));
  Message message{};
  message.until_ns = host_time::kNever;
  message.has_others = message.is_on_word = 1;
  wait(message, milliseconds(2));
  message = message_for_line();
  message.is_for_drain = 1;
  wait(message, milliseconds(3));
  message = message_for_line();
  message.line_count = host_time::kAnyLine;
  message.has_others = 1;
  wait(message, milliseconds(4));
  wait(message, milliseconds(0));
  EXPECT_EQ(reported(),
            (std::vector<HostWait>{
                reported_wait(milliseconds(0), milliseconds(10), "sleeps"),
                reported_wait(milliseconds(10), milliseconds(20), "sleeps"),
                reported_wait(milliseconds(20), milliseconds(21), "waits for data"),
                reported_wait(milliseconds(21), milliseconds(23), "waits for another thread"),
                reported_wait(milliseconds(23), milliseconds(26), "waits until its bytes are sent"),
                reported_wait(milliseconds(26), milliseconds(30), "waits"),
            }));
}

// A new connection gets the lowest free descriptor, often that of a thread that has just ended.
TEST_F(HostWaitLogTest, NumbersAThreadAnewThatHasADescriptorOfBefore) {
  sleep(milliseconds(10));
  leave();
  greet();
  sleep(milliseconds(10));
  EXPECT_EQ(reported(),
            (std::vector<HostWait>{
                {.thread = 1, .begin = milliseconds(0), .end = milliseconds(10), .text = "sleeps"},
                {.thread = 2, .begin = milliseconds(10), .end = milliseconds(20), .text = "sleeps"},
            }));
}

TEST_F(HostWaitLogTest, TellsTheWaitThatIsUnderWay) {
  EXPECT_EQ(under_way(), std::vector<HostWait>{});
  sleep(milliseconds(10));
  host_writes(8);
  wait_for_line(milliseconds(5));
  EXPECT_EQ(under_way(), (std::vector<HostWait>{
                             reported_wait(milliseconds(10), milliseconds(15), "waits for a reply"),
                         }));
  EXPECT_EQ(reported_before(),
            (std::vector<HostWait>{reported_wait(milliseconds(0), milliseconds(10), "sleeps")}));
  Message message = message_for_line();
  message.until_ns = SimTime(milliseconds(315)).count();
  wait(message, milliseconds(300));
  EXPECT_EQ(under_way().at(0).text, "waits for a reply");
  time_out();
  EXPECT_EQ(under_way().at(0).text, "waits for a reply in vain");
  reported();
  EXPECT_EQ(under_way(), std::vector<HostWait>{}) << "it has ended";
}

}  // namespace host_wait_log_test
}  // namespace understudy::emulator::serve
