// Two threads that have the world in turn.
#include "emulator/play/executors/turns.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>

namespace understudy::emulator::play {
namespace turns_test {

using namespace std::chrono_literals;

TEST(Turns, GoToTheScenarioWhenItsWaitIsOver) {
  Turns turns;
  std::string order;
  std::thread scenario([&] {
    turns.begin();
    order += "a";
    turns.wait_until(10ms);
    order += "b";
    turns.wait_until(20ms);
    order += "c";
    turns.finish();
  });
  EXPECT_EQ(turns.next_act(), SimTime{0});
  for (const SimTime now : {SimTime{0}, SimTime{5ms}, SimTime{10ms}, SimTime{19ms}, SimTime{30ms}}) {
    turns.act(now);
    order += std::to_string(now / 1ms) + " ";
  }
  EXPECT_EQ(order, "a0 5 b10 19 c30 ");
  EXPECT_EQ(turns.next_act(), std::nullopt);
  turns.act(40ms);
  scenario.join();
}

TEST(Turns, EndAWaitWhenTheScenarioIsGivenUp) {
  Turns turns;
  bool was_given_up = false;
  std::thread scenario([&] {
    turns.begin();
    turns.wait_until(1h);
    was_given_up = turns.is_given_up();
    turns.finish();
  });
  turns.act(0ms);
  turns.act(1ms);
  EXPECT_EQ(turns.next_act(), SimTime{1h});
  turns.give_up();
  turns.act(1ms);
  EXPECT_TRUE(was_given_up);
  scenario.join();
}

TEST(Turns, AreTheScenariosAloneWhenTheWorldIsLeft) {
  Turns turns;
  std::thread scenario([&] {
    turns.begin();
    turns.wait_until(1h);
    turns.wait_until(2h);
    EXPECT_TRUE(turns.is_given_up());
    turns.finish();
  });
  turns.leave();
  scenario.join();
}

}  // namespace turns_test
}  // namespace understudy::emulator::play
