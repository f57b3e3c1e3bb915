// Which processes of a host end as programs without the library, in whatever order their messages are read.
#include "emulator/serve/host_time/host_greetings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "pty/host_time/protocol.h"

namespace understudy::emulator::serve {
namespace host_greetings_test {

using host_time::Message;
using host_time::MessageKind;

constexpr int kFirst = 100;
constexpr int kChild = 101;

Message message(int process, MessageKind what, int value = 0) {
  Message message{};
  message.what = what;
  message.process = process;
  message.value = value;
  return message;
}

const Message kProgramBegins = message(kChild, MessageKind::hello, 1);
const Message kForkGreets = message(kChild, MessageKind::hello);
const Message kLeaves = message(kChild, MessageKind::leaves);
const Message kStays = message(kChild, MessageKind::stays);
const Message kForked = message(kChild, MessageKind::child);
const Message kSpawned = message(kChild, MessageKind::child, 1);

TEST(HostGreetings, AChildIsSilentIfItsLastProgramHasNotGreeted) {
  struct Row {
    const char* what;
    std::vector<Message> messages;
    bool is_silent;
  };
  const std::vector<Row> rows{
      {"forked", {kForked, kForkGreets}, false},
      {"forked, became a program", {kForked, kForkGreets, kLeaves, kProgramBegins}, false},
      {"forked, became one without the library", {kForked, kForkGreets, kLeaves}, true},
      {"forked, found no program", {kForked, kForkGreets, kLeaves, kStays}, false},
      {"became two programs", {kForkGreets, kLeaves, kProgramBegins, kLeaves, kProgramBegins}, false},
      {"became two, the last without it", {kForkGreets, kLeaves, kProgramBegins, kLeaves}, true},
      {"spawned", {kSpawned, kProgramBegins}, false},
      {"spawned without the library", {kSpawned}, true},
      {"spawned, with another thread", {kSpawned, kProgramBegins, kForkGreets}, false},
      {"spawned, became one without it", {kSpawned, kProgramBegins, kLeaves}, true},
  };
  for (const Row& row : rows) {
    std::vector<std::size_t> order(row.messages.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    do {
      HostGreetings greetings;
      greetings.on_message(message(kFirst, MessageKind::hello, 1));
      for (const std::size_t i : order) greetings.on_message(row.messages[i]);
      EXPECT_EQ(greetings.is_silent(kChild), row.is_silent) << row.what;
      EXPECT_FALSE(greetings.is_silent(kFirst)) << row.what;
      EXPECT_TRUE(greetings.was_reached()) << row.what;
    } while (std::ranges::next_permutation(order).found);
  }
}

TEST(HostGreetings, AHostIsReachedIfItsFirstProcessIsAndSomethingWaits) {
  HostGreetings none;
  EXPECT_FALSE(none.was_reached());

  HostGreetings first;
  first.on_message(message(kFirst, MessageKind::hello, 1));
  EXPECT_TRUE(first.was_reached());
  first.on_message(message(kFirst, MessageKind::wait));
  first.on_message(message(kFirst, MessageKind::leaves));
  ASSERT_TRUE(first.is_silent(kFirst));
  EXPECT_FALSE(first.silent_one_ended(kFirst));
  EXPECT_FALSE(first.was_reached());

  HostGreetings child;
  child.on_message(message(kFirst, MessageKind::hello, 1));
  child.on_message(kSpawned);
  EXPECT_TRUE(child.silent_one_ended(kChild));
  EXPECT_FALSE(child.is_silent(kChild));
  EXPECT_FALSE(child.was_reached());
  child.on_message(kSpawned);
  EXPECT_FALSE(child.silent_one_ended(kChild)) << "one is reported";
  child.on_message(message(kFirst, MessageKind::wait));
  EXPECT_TRUE(child.was_reached());
}

}  // namespace host_greetings_test
}  // namespace understudy::emulator::serve
