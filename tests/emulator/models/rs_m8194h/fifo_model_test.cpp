// The FIFO against a list: random courses of commands, busy answers, stops and clearings.
#include <gtest/gtest.h>

#include <deque>

#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace fifo_model_test {

struct Waiting {
  int blocks = 1;
  int value = 0;  // that SET_LP gives Y; 0: another command
};

/// What the box should do, as plainly as it can be said.
struct Model {
  std::deque<Waiting> waiting{};
  bool blocked = false;
  int lp = 0;

  int free() const {
    int left = 30;
    for (const Waiting& each : waiting) left -= each.blocks;
    return left;
  }
  void tick() {
    for (int i = 0; i < 8 && !blocked && !waiting.empty(); ++i) {
      if (waiting.front().value != 0) lp = waiting.front().value;
      waiting.pop_front();
    }
  }
};

TEST(RsM8194hFifoModel, RandomCoursesAreThoseOfAList) {
  for (std::uint32_t first = 1; first <= 60; ++first) {
    std::uint32_t seed = first;
    const auto draw = [&](std::uint32_t most) {
      seed = seed * 1664525 + 1013904223;
      return static_cast<int>((seed >> 8) % most);
    };
    OneRsm rsm;
    Model model;
    std::string course;
    const auto send = [&](const std::string& command) {
      course += command + "\n";
      return rsm.exception(command);
    };
    int next_value = 1;
    for (int step = 0; step < 150; ++step) {
      const int what = draw(12);
      if (what == 0 && !model.blocked && model.waiting.empty()) {
        ASSERT_EQ(send("RSM_CONTINUE_MOVE X 1000"), 0) << course;
        ASSERT_EQ(send("RSM_STOP_WAIT X"), 0) << course;
        model.blocked = true;
      } else if (what == 1 && model.blocked) {
        ASSERT_EQ(send("RSM_STOP_SUDDENLY X"), 0) << course;
        ASSERT_EQ(rsm.get("DRIVING_AXIS"), 0) << course;
        model.blocked = false;
        rsm.run(1);
        model.tick();
        // It has to be unlocked in its turn.
        while (!model.waiting.empty()) {
          rsm.run(1);
          model.tick();
        }
        ASSERT_EQ(send("RSM_CLEAR_STOP X"), 0) << course;
        rsm.run(1);
      } else if (what == 2) {
        ASSERT_EQ(send("RSM_CLEAR_CARD_BUFFER"), 0) << course;
        model.waiting.clear();
      } else if (what == 3) {
        rsm.run(1);
        model.tick();
      } else if (model.blocked) {
        const bool is_long = what < 6;
        Waiting command{.blocks = is_long ? 2 : 1, .value = is_long ? 0 : next_value};
        const std::string text = is_long ? "RSM_SYNC_ACTION Z U 0 0 0 0 0 0 0 0 0 0"
                                         : "RSM_SET_LP Y " + std::to_string(next_value);
        const int answer = send(text);
        if (command.blocks > model.free()) {
          ASSERT_EQ(answer, 6) << course;
        } else {
          ASSERT_EQ(answer, 0) << course;
          model.waiting.push_back(command);
          next_value += is_long ? 0 : 1;
        }
      }
      ASSERT_EQ(rsm.get("FREE_BUFFER_SIZE"), model.free()) << course;
      ASSERT_EQ(rsm.get("LP_Y"), model.lp) << course;
    }
  }
}

}  // namespace fifo_model_test
}  // namespace understudy::emulator::models::rs_m8194h
