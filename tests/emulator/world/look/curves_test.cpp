// Curves and the history of a recording against the world itself, sampled in every tick and every frame.
#include "emulator/world/look/curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "emulator/world/events/history.h"
#include "emulator/world/look/program_spans.h"
#include "emulator/world/recording/replay.h"
#include "emulator/world/recording/timeline.h"
#include "tests/emulator/world/recording/busy_world.h"

namespace understudy::emulator::world {
namespace curves_test {

using namespace std::chrono_literals;

const std::vector<std::string> kNames = {"feeder.A.position", "feeder.A.speed", "turner.B.position",
                                         "turner.DOUT_0", "feeder.Cord_A"};

struct Collector final : ReplayWatcher {
  Collector(std::vector<RecordedEvent>& all, World& world, History& its, std::size_t& frame_count)
      : events(all),
        there(world),
        log(world, 4'096),
        event_log(world, log),
        history(its),
        count(frame_count) {}
  void happened(const RecordedEvent& event, std::size_t) override {
    if (event.what != RecordedEvent::What::end) events.push_back(event);
    history.collect(there, log, event_log);
  }
  void ended() override {
    history.collect(there, log, event_log);
    for (const FrameLog::Decoded& frame : log.since(1, SIZE_MAX)) count += frame.text.empty() ? 0U : 1U;
  }
  std::vector<RecordedEvent>& events;
  World& there;
  FrameLog log;
  EventLog event_log;
  History& history;
  std::size_t& count;
};

/// A recording of a busy world, with all that is needed to play it again.
struct Played {
  explicit Played(std::uint64_t seed) {
    BusyWorld busy(seed);
    busy.play(200);
    std::istringstream file(busy.finish());
    replayed = replay(models::all_models(), file, "a", {}, [&](World& world) {
      begin = save(world);
      return std::make_unique<Collector>(events, world, history, frames);
    });
  }
  World make() const { return World(replayed.bench, replayed.header.options, {}); }

  std::vector<RecordedEvent> events;
  std::optional<WorldState> begin;
  History history;
  std::size_t frames = 0;
  Replayed replayed;
};

TEST(Curves, HaveTheLeastAndGreatestOfEveryTick) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Played played(seed);
    World world = played.make();
    World other = played.make();
    World stepped = played.make();
    const Timeline timeline(world, *played.begin, played.events, played.replayed.result.reached, [] {});
    for (const auto& [from, length, dots] : {std::tuple{SimTime{700ms}, SimTime{3s}, std::size_t{37}},
                                             std::tuple{SimTime{0}, SimTime{1500ms}, std::size_t{1500}},
                                             std::tuple{SimTime{2s}, SimTime{20ms}, std::size_t{200}}}) {
      const SimTime to = std::min(from + length, time_of(tick_at(timeline.end())));
      Curves curves(other, kNames, from, to, dots);
      timeline.play_again(other, from, to, to - from, [&] {
        curves.look();
        curves.watch();
      });
      curves.finish();
      const Probes probes(stepped);
      std::vector<std::map<std::size_t, std::pair<double, double>>> expected(kNames.size());
      std::vector<double> last(kNames.size());
      timeline.play_again(stepped, from, to, kTickLength, [&] {
        const double part =
            static_cast<double>((stepped.now() - from).count()) / static_cast<double>((to - from).count());
        const auto dot = std::min(dots - 1, static_cast<std::size_t>(part * static_cast<double>(dots)));
        for (std::size_t i = 0; i < kNames.size(); ++i) {
          const double value = probes.value(probes.resolve(kNames[i]).handle).real();
          // A value lasts until the next tick, also through the dots between.
          const bool is_first = stepped.now() == from;
          if (is_first) last[i] = value;
          auto [found, is_new] = expected[i].try_emplace(dot, std::minmax(last[i], value));
          found->second = {std::min(found->second.first, value), std::max(found->second.second, value)};
          last[i] = value;
        }
      });
      for (std::size_t i = 0; i < kNames.size(); ++i) {
        for (const auto& [dot, range] : expected[i]) {
          ASSERT_EQ(curves.min(i)[dot], range.first) << seed << " " << kNames[i] << " " << dot;
          ASSERT_EQ(curves.max(i)[dot], range.second) << seed << " " << kNames[i] << " " << dot;
        }
      }
    }
  }
}

TEST(Curves, RefuseWhatIsNoName) {
  World world = make_world();
  EXPECT_THROW(Curves(world, {"feeder.nonsense"}, 0s, 1s, 10), NameError);
  EXPECT_THROW(Curves(world, {"feeder.A.greatest_speed"}, 0s, 1s, 10), NameError);
}

TEST(History, HasEachFrameOnce) {
  std::size_t answered = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Played played(seed);
    std::size_t reported = 0;
    SimTime before{0};
    for (const Exchange& exchange : played.history.exchanges()) {
      reported += (exchange.request.empty() ? 0U : 1U) + (exchange.reply.empty() ? 0U : 1U);
      EXPECT_LE(before, exchange.begin);
      EXPECT_LE(exchange.begin, exchange.end);
      before = exchange.begin;
      if (exchange.request.empty() || exchange.reply.empty()) continue;
      ++answered;
      ASSERT_TRUE(exchange.latency);
      EXPECT_LE(exchange.begin + *exchange.latency, exchange.end);
    }
    EXPECT_EQ(reported, played.frames) << seed;
    EXPECT_EQ(played.history.dropped(), 0U);
  }
  EXPECT_GT(answered, 10U);
}

TEST(ProgramSpans, FollowAProgramLineByLine) {
  World world = make_world();
  world.load_program(0, "        Delay_mSec 20\n        Out DOUT_4 ON\n        Delay_mSec 30\n        END\n");
  ProgramSpans spans(world);
  spans.watch();
  world.receive(0, framed({0x01, 0x06, 0x30, 0x00, 0x00, 0x00}));
  world.advance_to(100ms);
  const std::vector<ProgramSpans::Span> all = spans.finish();
  std::map<int, SimTime> waited;
  SimTime before{0};
  for (const ProgramSpans::Span& span : all) {
    EXPECT_EQ(span.device, "feeder");
    EXPECT_LE(before, span.begin);
    before = span.end;
    if (!span.waits_for.empty()) waited[span.line] += span.end - span.begin;
  }
  ASSERT_EQ(waited.size(), 2U);
  EXPECT_NEAR(static_cast<double>(waited[1].count()), 20e6, 2e6);
  EXPECT_NEAR(static_cast<double>(waited[3].count()), 30e6, 2e6);
  EXPECT_TRUE(spans.finish().empty());
}

}  // namespace curves_test
}  // namespace understudy::emulator::world
