// Every cell of pauses.h, with each option, with a path, a move and a jog in progress.
#include "emulator/models/slim/rules/pauses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "emulator/models/slim/rules/choices.h"
#include "tests/emulator/models/slim/one_chain.h"

namespace understudy::emulator::models::slim {

namespace pauses_test {

const std::string kPauseNames[kPauses] = {"no pause", "PZ's pause", "TAPZ's pause", "both pauses"};
const std::string kWhatNames[kInPause] = {"PZ",    "REDO",   "CLR BUF", "TAPZ",     "TAREDO",
                                          "TAUPZ", "TASTOP", "RESET",   "a motion", "a jog"};

// The running motion: T0 and T1 on a line with another one after it, a move of T5 with another one, T6's jog.
constexpr int kOnPath = 0;
constexpr int kOnMove = 5;
constexpr int kOnJog = 6;
constexpr int kIdle = 7;

struct Speeds {
  double path, move, jog;

  bool operator==(const Speeds&) const = default;
};
constexpr Speeds kStanding{0, 0, 0};

class PauseCell {
 public:
  PauseCell(const PauseRow& row, const ChainOptions& options)
      : row_(row), options_(options), bench_(options) {
    bench_.map({0, 1});
    bench_.line({3000, 4000});
    bench_.line({1, 1});
    chain().move(kOnMove, false, 5'000'000);
    chain().move(kOnMove, false, 1);
    chain().jog(kOnJog, +1);
    bench_.steps(501);
    running_ = speeds();
    if (has_pz(row.pauses)) chain().pause_queues();
    if (has_tapz(row.pauses)) chain().pause();
    if (row.pauses != Pauses::none) bench_.steps(500);
  }

  void check() {
    const PauseResult expected = pause_result(options_, row_.pauses, row_.what);
    const Chain before = chain();
    const std::int64_t travel = bench_.travel(kOnPath);
    const Error error = act();
    EXPECT_EQ(slim::pauses_of(chain().queues_paused(), chain().paused()), expected.left);
    if (expected.outcome == PauseOutcome::in_vain) {
      EXPECT_EQ(chain(), before);
      EXPECT_EQ(error,
                options_.chose(option("ineffective_pause", "error_3")) ? Error::not_allowed : Error::none);
      return;
    }
    EXPECT_EQ(error, expected.outcome == PauseOutcome::is_refused ? Error::paused : Error::none);
    bench_.steps(500);
    const bool stands = expected.left != Pauses::none;
    switch (expected.outcome) {
      case PauseOutcome::slows_down: return expect_kept(2, true);
      case PauseOutcome::continues: return expect_kept(2, stands);
      case PauseOutcome::clears: return expect_kept(1, stands);
      case PauseOutcome::gives_up: return expect_nothing();
      case PauseOutcome::stops: EXPECT_EQ(bench_.travel(kOnPath), travel); return expect_nothing();
      case PauseOutcome::resets: return expect_reset(travel, stands);
      case PauseOutcome::is_taken: EXPECT_NE(bench_.travel(kIdle), 0); return expect_kept(2, false);
      case PauseOutcome::waits: return expect_waiting();
      default: EXPECT_EQ(chain().module_at(kIdle).fifo.size(), 0U); return expect_kept(2, true);
    }
  }

 private:
  Chain& chain() { return bench_.chain; }
  Speeds speeds() {
    return {chain().speed_pps(kOnPath), chain().speed_pps(kOnMove), chain().speed_pps(kOnJog)};
  }

  Error act() {
    switch (row_.what) {
      case InPause::pz: return chain().pause_queues();
      case InPause::redo: return chain().resume_queues();
      case InPause::clear_buffer: return chain().clear_queues();
      case InPause::tapz: return chain().pause();
      case InPause::taredo: return chain().resume();
      case InPause::taupz: return chain().discard();
      case InPause::tastop: return chain().emergency_stop();
      case InPause::reset: return chain().reset(0);
      case InPause::motion: return give_motions();
      case InPause::jog: break;
    }
    const Error error = chain().thrust(kIdle, 5);
    EXPECT_EQ(chain().jog(kIdle, -1), error);
    EXPECT_EQ(chain().jog(kIdle, +1), error);
    return error;
  }

  /// All kinds have the same reply.
  Error give_motions() {
    const Error error = chain().move(kIdle, false, 100);
    EXPECT_EQ(chain().home(4), error);
    if (error == Error::none) return error;  // the next commands would be in the buffers that are counted
    EXPECT_EQ(chain().move_axis(Letter::x, true, 1), error);
    EXPECT_EQ(bench_.line({1, 1}), error);
    EXPECT_EQ(chain().arc({.centre_x_units = 1, .sweep_deg = 10}), error);
    EXPECT_EQ(chain().spiral(1, 0, 10, 1), error);
    return error;
  }

  /// This many of two commands each remain, and the jog; they are at rest, or run as before.
  void expect_kept(std::size_t commands, bool stands) {
    EXPECT_EQ(chain().module_at(kOnPath).fifo.size(), commands);
    EXPECT_EQ(chain().module_at(kOnMove).fifo.size(), commands);
    EXPECT_TRUE(chain().busy(kOnJog));
    EXPECT_EQ(speeds(), stands ? kStanding : running_);
    // Held motion is reported as what it is.
    EXPECT_EQ(chain().status(kOnPath).mode, Mode::coordinated);
    EXPECT_EQ(chain().status(kOnMove).mode, Mode::position);
    EXPECT_EQ(chain().status(kOnJog).mode, Mode::jog);
    EXPECT_EQ(chain().status(kOnPath).paused, stands);
    if (!stands) return;
    end_pauses();
    bench_.steps(500);
    EXPECT_EQ(speeds(), running_);
  }

  void expect_nothing() {
    EXPECT_EQ(speeds(), kStanding);
    for (int module = 0; module < kModules; ++module) {
      EXPECT_FALSE(chain().busy(module));
      EXPECT_EQ(chain().status(module).mode, Mode::idle);
    }
    end_pauses();
    bench_.steps(500);
    EXPECT_EQ(speeds(), kStanding);
  }

  void expect_reset(std::int64_t travel, bool stands) {
    EXPECT_EQ(bench_.travel(kOnPath), travel);
    EXPECT_FALSE(chain().busy(kOnPath));
    EXPECT_EQ(speeds(), stands ? kStanding : (Speeds{0, running_.move, running_.jog}));
    EXPECT_EQ(chain().module_at(kOnMove).fifo.size(), 2U);
    EXPECT_TRUE(chain().busy(kOnJog));
  }

  void expect_waiting() {
    EXPECT_EQ(bench_.travel(kIdle), 0);
    EXPECT_EQ(chain().module_at(kIdle).fifo.size(), 1U);
    expect_kept(2, true);
    EXPECT_EQ(bench_.travel(kIdle), 100);
  }

  void end_pauses() {
    chain().resume();
    chain().resume_queues();
  }

  const PauseRow& row_;
  ChainOptions options_;
  OneChain bench_;
  Speeds running_{};
};

/// Returns true if PZ's pause is possible with these options.
bool can_be(Pauses pauses, const ChainOptions& options) {
  return !options.chose(option("pauses", "one_pause")) || !has_pz(pauses);
}

TEST(SlimPauses, ComeOutAsTheTableSays) {
  int cells = 0;
  for (unsigned bits = 0; bits < 16; ++bits) {
    ChainOptions options;
    if ((bits & 1) != 0) options.choose(option("pauses", "one_pause"));
    if ((bits & 2) != 0) options.choose(option("clear_buffer_in_pause", "what_waits"));
    if ((bits & 4) != 0) options.choose(option("reset", "pause_too"));
    if ((bits & 8) != 0) options.choose(option("ineffective_pause", "error_3"));
    for (const PauseRow& row : pauses::kRows) {
      if (!can_be(row.pauses, options)) continue;
      SCOPED_TRACE(kWhatNames[static_cast<std::size_t>(row.what)] + " in " +
                   kPauseNames[static_cast<std::size_t>(row.pauses)] + ", options " + std::to_string(bits));
      PauseCell(row, options).check();
      ++cells;
    }
  }
  EXPECT_EQ(cells, 8 * static_cast<int>(kPauses * kInPause) + 8 * static_cast<int>(2 * kInPause));
}

TEST(SlimPauses, NameTheListOrARowOfTheChoices) {
  for (const PauseRow& row : pauses::kRows) {
    const bool is_row = std::ranges::any_of(kChoices, [&](const ChoiceRow& c) { return c.id == row.by; });
    EXPECT_TRUE(is_row || row.by.starts_with("list, ")) << row.by;
    // A cell that an option changes does not come from a list.
    EXPECT_TRUE(!row.other.chosen || row.other.result != row.result) << row.by;
  }
}

TEST(SlimPauses, OfT0AloneHoldNoOthers) {
  ChainOptions options;
  options.choose(option("pause_scope", "t0"));
  OneChain bench(options);
  bench.chain.pause_queues();
  EXPECT_EQ(bench.chain.jog(0, +1), Error::paused);
  EXPECT_EQ(bench.chain.jog(5, +1), Error::none);
  EXPECT_EQ(bench.chain.move(6, false, 50), Error::none);
  bench.chain.move(0, false, 50);
  bench.steps(300);
  EXPECT_EQ(bench.travel(0), 0);
  EXPECT_EQ(bench.travel(6), 50);
  EXPECT_NE(bench.chain.speed_pps(5), 0);
  // CLR BUF ends it only there; TAPZ holds all of them.
  bench.chain.clear_queues();
  EXPECT_NE(bench.chain.speed_pps(5), 0);
  EXPECT_FALSE(bench.chain.busy(0));
  bench.chain.pause_queues();
  bench.chain.pause();
  EXPECT_EQ(bench.chain.jog(5, +1), Error::paused);
}

TEST(SlimPauses, ResetOfAnotherModuleEndsNone) {
  ChainOptions options;
  options.choose(option("reset", "pause_too"));
  OneChain bench(options);
  bench.chain.jog(5, +1);
  bench.chain.pause();
  bench.steps(100);
  EXPECT_EQ(bench.chain.reset(4), Error::none);
  EXPECT_TRUE(bench.chain.paused());
  EXPECT_TRUE(bench.chain.busy(5));
  EXPECT_EQ(bench.chain.reset(0), Error::none);
  EXPECT_FALSE(bench.chain.paused());
  EXPECT_FALSE(bench.chain.busy(5));
}

}  // namespace pauses_test

}  // namespace understudy::emulator::models::slim
