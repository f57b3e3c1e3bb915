// The FIFO compared with a list: 10,000 random sequences of commands of one to four blocks, of waiting
// drives, of stops, busy replies, clears and resets. A difference is printed as steps that can be pasted into
// a scenario.
#include <gtest/gtest.h>

#include <deque>
#include <functional>
#include <random>

#include "emulator/world/snapshot.h"
#include "tests/emulator/models/rs_m8194h/one_rsm.h"
#include "tests/sanitized.h"

namespace understudy::emulator::models::rs_m8194h {
namespace fifo_model_test {

enum class What : std::uint8_t { nothing, lp, drive, stop_wait, clear_stop };

struct Waiting {
  What what = What::nothing;
  int blocks = 1;
  int value = 0;  // of LP Y
};

/// The expected behaviour of the device, as plainly as possible. X drives without an end; Z and U are locked,
/// so their paths are void.
struct Model {
  static constexpr int kSteps = 8;
  std::deque<Waiting> waiting{};
  int steps = kSteps;  // remaining commands of this tick
  bool waits = false;  // a STOP_WAIT has started
  bool moves = false;
  bool locked = false;
  bool emergency = false;
  int lp = 0;

  int free() const {
    int left = 30;
    for (const Waiting& each : waiting) left -= each.blocks;
    return left;
  }
  void run() {
    for (;;) {
      if (waits && moves) return;
      waits = false;
      if (waiting.empty() || steps == 0) return;
      const Waiting first = waiting.front();
      switch (first.what) {
        case What::nothing: break;
        case What::lp: lp = first.value; break;
        case What::drive:
          if (moves && !locked && !emergency) return;
          moves = moves || (!locked && !emergency);
          break;
        case What::stop_wait: waits = true; break;
        case What::clear_stop: locked = false; break;
      }
      waiting.pop_front();
      --steps;
    }
  }
  void tick() {
    steps = kSteps;
    run();
  }
  /// Returns true if there is room.
  bool add(const Waiting& command) {
    if (command.blocks > free()) return false;
    waiting.push_back(command);
    if (waiting.size() == 1) run();
    return true;
  }
};

struct Queued {
  const char* command;
  Waiting becomes;
};
const Queued kQueued[] = {
    {"RSM_SYNC_ACTION Z U 0 0 0 0 0 0 0 0 0 0", {What::nothing, 2}},
    {"RSM_HELIX_3D Y Z U 0 1000 100 0 1 10", {What::nothing, 3}},
    {"RSM_RECTANGLE Z U 0 0 0 100 100 10 500 500 9000 9000", {What::nothing, 4}},
    {"RSM_CONTINUE_MOVE X 1000", {What::drive}},
    {"RSM_CONTINUE_MOVE X -1000", {What::drive}},
    {"RSM_STOP_WAIT X", {What::stop_wait}},
    {"RSM_CLEAR_STOP X", {What::clear_stop}},
};

class Course {
 public:
  Course(OneRsm& rsm, unsigned seed) : rsm_(rsm), random_(seed) {}

  void step() {
    switch (below(20)) {
      case 0:
        at_once("RSM_STOP_SUDDENLY X", [](Model& it) {
          it.moves = false;
          it.locked = true;
        });
        break;
      case 1: at_once("RSM_CLEAR_CARD_BUFFER", [](Model& it) { it.waiting.clear(); }); break;
      case 2:
        if (below(3) != 0) break;
        at_once("RSM_EMERGENCY_STOP 0", [](Model& it) {
          it.moves = it.waits = false;
          it.emergency = true;
          it.waiting.clear();
        });
        break;
      case 3: at_once("RSM_CLEAR_EMERGENCY_STOP", [](Model& it) { it.emergency = false; }); break;
      case 4:
        if (below(6) != 0) break;
        at_once("RSM_RESET_CARD", [](Model& it) { it = Model{.steps = it.steps}; });
        at_once("RSM_STOP_SUDDENLY ZU", [](Model&) {});
        break;
      case 5:
      case 6:
      case 7:
        text_ += "  - advance: 1ms\n";
        rsm_.run(1);
        model_.tick();
        break;
      case 8: write_two(); break;
      case 9:
      case 10:
      case 11:
      case 12: {
        const int value = ++last_value_;
        queue("RSM_SET_LP Y " + std::to_string(value), {What::lp, 1, value});
        break;
      }
      default: {
        const Queued& one = kQueued[static_cast<std::size_t>(below(std::size(kQueued)))];
        queue(one.command, one.becomes);
      }
    }
  }
  void expect_alike() const {
    ASSERT_EQ(rsm_.get("FREE_BUFFER_SIZE"), model_.free()) << text_;
    ASSERT_EQ(rsm_.get("LP_Y"), model_.lp) << text_;
    ASSERT_EQ(rsm_.get("DRIVING_AXIS"), model_.moves ? 1 : 0) << text_;
    ASSERT_EQ(rsm_.get("EMERGENCY_STOP"), model_.emergency ? 1 : 0) << text_;
  }
  int busy() const { return busy_; }

 private:
  int below(std::size_t count) { return static_cast<int>(random_() % count); }

  void at_once(const std::string& command, const std::function<void(Model&)>& effect) {
    text_ += "  - command: { cell: " + command + " }\n";
    ASSERT_EQ(rsm_.exception(command), 0) << text_;
    effect(model_);
  }
  void queue(const std::string& command, const Waiting& becomes) {
    text_ += "  - command: { cell: " + command + " }\n";
    const bool fits = model_.add(becomes);
    if (!fits) text_ += "    exception: 6\n";
    busy_ += fits ? 0 : 1;
    ASSERT_EQ(rsm_.exception(command), fits ? 0 : 6) << text_;
  }
  /// LP of Y and Z through the table: one command each, and both or neither.
  void write_two() {
    const int value = ++last_value_;
    const auto word = static_cast<std::uint16_t>(value);
    text_ += "  - write: { cell.LP_Y: " + std::to_string(value) + ", cell.LP_Z: 0 }\n";
    const bool fits = model_.free() >= 2;
    if (!fits) text_ += "    exception: 6\n";
    busy_ += fits ? 0 : 1;
    const std::string reply = rsm_.ask(world::write_request(92, {0, word, 0, 0}));
    ASSERT_EQ(reply.starts_with("90"), !fits) << text_;
    if (!fits) return;
    model_.add({What::lp, 1, value});
    model_.add({What::nothing});
  }

  OneRsm& rsm_;
  Model model_;
  std::mt19937 random_;
  std::string text_ = "steps:\n  - command: { cell: RSM_STOP_SUDDENLY ZU }\n";
  int last_value_ = 0;
  int busy_ = 0;
};

TEST(RsM8194hFifoModel, RandomCoursesAreThoseOfAList) {
  const unsigned courses = fewer_if_sanitized(10'000U, 5U);
  OneRsm rsm;
  rsm.send("RSM_STOP_SUDDENLY ZU");
  rsm.run(1);
  const std::function<void()> begin_anew = world::read_state(rsm.world(), world::save(rsm.world()));
  int busy = 0;
  for (unsigned seed = 0; seed < courses; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    begin_anew();
    Course course(rsm, seed);
    for (int i = 0; i < 60; ++i) {
      course.step();
      course.expect_alike();
      if (HasFatalFailure()) return;
    }
    busy += course.busy();
  }
  EXPECT_GT(busy, fewer_if_sanitized(1'000, 5));
}

}  // namespace fifo_model_test
}  // namespace understudy::emulator::models::rs_m8194h
