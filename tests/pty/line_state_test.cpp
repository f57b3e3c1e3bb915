// The state of a line, and of a framer, as values: a restored one continues as before, at any moment of an
// exchange.
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "pty/rtu_crc.h"
#include "tests/pty/fake_station.h"

namespace understudy::pty {
namespace line_state_test {

using namespace std::chrono_literals;

/// A slave that replies to every frame for it with as many bytes as the frame has, and whose state is a
/// value.
class Echo final : public Station {
 public:
  explicit Echo(std::uint8_t address, bool strict)
      : framer({.strict = strict, .silence = 750us, .patience = 10ms}), address_(address) {}

  LineSettings settings() const override { return {}; }
  void on_start_bit(SimTime at) override { framer.start_bit(at); }
  void receive(const TimedByte& byte) override { framer.push(byte); }
  void on_other_station() override { framer.reset(); }
  void on_idle() override { framer.give_up_waiting(); }
  std::optional<SimTime> due() const override { return framer.due(); }
  void run(SimTime now, Transmitter& out) override {
    const auto frame = framer.take(now);
    // Address 0 makes all of them send at once.
    if (!frame || (frame->bytes[0] != address_ && frame->bytes[0] != 0)) return;
    out.answer(std::span(frame->bytes).first(frame->size), frame->last_character);
  }

  RtuFramer framer;

 private:
  std::uint8_t address_;
};

struct State {
  Line::State line;
  RtuFramer::State first, second;
};

/// Two slaves, and their output.
struct Rig {
  Rig(Timing timing, bool strict)
      : first(1, strict), second(2, strict), wire({.settings = {}, .timing = timing}) {
    wire.line.attach(first);
    wire.line.attach(second);
  }
  State save() const {
    return {.line = wire.line.save(), .first = first.framer.save(), .second = second.framer.save()};
  }
  void restore(const State& state) {
    wire.line.restore(state.line);
    first.framer.restore(state.first);
    second.framer.restore(state.second);
  }

  Echo first;
  Echo second;
  LineRig wire;
};

struct Event {
  SimTime at{0};
  enum class What { bytes, departed, opened, closed, settings, purged, nothing_more } what = What::bytes;
  Bytes bytes;
  HostSettings host;
};

void apply(Line& line, const Event& event) {
  switch (event.what) {
    case Event::What::bytes: return line.receive(event.bytes, event.at);
    case Event::What::departed: return line.receive_departed(event.bytes, event.at);
    case Event::What::opened: return line.host_opened();
    case Event::What::closed: return line.host_closed();
    case Event::What::settings: return line.host_settings(event.host);
    case Event::What::purged: return line.host_purged();
    case Event::What::nothing_more: return line.nothing_more(event.at);
  }
}

Bytes random_bytes(std::mt19937_64& random) {
  Bytes bytes;
  switch (random() % 6) {
    case 0:  // noise
      for (auto n = random() % 20; n > 0; --n) bytes.push_back(static_cast<std::uint8_t>(random()));
      return bytes;
    case 1: {  // a function whose length is only known after silence
      bytes = {static_cast<std::uint8_t>(random() % 3), 0x41};
      for (auto n = random() % 40; n > 0; --n) bytes.push_back(static_cast<std::uint8_t>(random()));
      break;
    }
    default: {
      const auto count = static_cast<std::uint8_t>(random() % 30);
      bytes = {static_cast<std::uint8_t>(random() % 3), 0x10, 0, 0, 0, count,
               static_cast<std::uint8_t>(2 * count)};
      for (int i = 0; i < 2 * count; ++i) bytes.push_back(static_cast<std::uint8_t>(random()));
    }
  }
  append_rtu_crc(bytes);
  if (random() % 8 == 0) bytes.resize(bytes.size() - random() % bytes.size());  // truncated
  return bytes;
}

std::vector<Event> random_events(std::mt19937_64& random) {
  std::vector<Event> events;
  SimTime at{0};
  for (int i = 0; i < 60; ++i) {
    at += SimTime{static_cast<std::int64_t>(random() % (random() % 3 == 0 ? 60'000'000 : 2'000'000))};
    Event event{.at = at, .bytes = random_bytes(random), .host = {}};
    switch (random() % 16) {
      case 0: event.what = Event::What::departed; break;
      case 1: event.what = Event::What::opened; break;
      case 2: event.what = Event::What::closed; break;
      case 3:
        event.what = Event::What::settings;
        event.host = {.baud = random() % 3 == 0 ? 9600 : 19200};
        if (random() % 3 == 0) event.host.parity = random() % 2 == 0 ? Parity::none : Parity::even;
        break;
      case 4: event.what = Event::What::nothing_more; break;
      case 5: event.what = Event::What::purged; break;
      default: break;
    }
    events.push_back(event);
  }
  return events;
}

/// The output from here on, with times and warnings, and the counts.
struct Outcome {
  Bytes out;
  std::vector<SimTime> out_at;
  std::vector<std::string> warnings;
  std::vector<std::uint64_t> counted;
  bool operator==(const Outcome&) const = default;
};

Outcome live(Rig& rig, const std::vector<Event>& events, std::size_t first) {
  rig.wire.out.clear();
  rig.wire.out_at.clear();
  rig.wire.warnings.clear();
  for (std::size_t i = first; i < events.size(); ++i) {
    rig.wire.run(events[i].at);
    apply(rig.wire.line, events[i]);
  }
  rig.wire.run(events.back().at + 5s);
  const LineCounters& c = rig.wire.line.counters();
  return {.out = rig.wire.out,
          .out_at = rig.wire.out_at,
          .warnings = rig.wire.warnings,
          .counted = {c.bytes_in, c.bytes_out, c.bytes_unheard, c.bytes_discarded, c.collisions,
                      rig.first.framer.dropped_bytes(), rig.second.framer.dropped_bytes()}};
}

TEST(LineState, WhatIsRestoredContinuesAsItDid) {
  int in_request = 0;
  int in_reply = 0;
  int ready = 0;
  int collided = 0;
  std::size_t sent = 0;
  for (std::uint64_t seed = 1; seed <= 360; ++seed) {
    std::mt19937_64 random(seed);
    const Timing timing = seed % 3 == 0 ? Timing::instant : Timing::wire;
    const bool strict = seed % 4 == 0;
    const std::vector<Event> events = random_events(random);
    Rig rig(timing, strict);
    // Up to a moment after some event, in the middle of whatever is in progress.
    const std::size_t stop = 1 + random() % (events.size() - 1);
    for (std::size_t i = 0; i < stop; ++i) {
      rig.wire.run(events[i].at);
      apply(rig.wire.line, events[i]);
    }
    const SimTime span = events[stop].at - events[stop - 1].at;
    rig.wire.run(events[stop - 1].at + SimTime{static_cast<std::int64_t>(random()) % (span.count() + 1)});
    const State state = rig.save();
    in_request += state.line.input.empty() ? 0 : 1;
    in_reply += state.line.leaving.empty() ? 0 : 1;
    ready += state.first.ready.empty() && state.second.ready.empty() ? 0 : 1;

    const Outcome once = live(rig, events, stop);
    rig.restore(state);
    EXPECT_EQ(live(rig, events, stop), once) << "the same line, seed " << seed;
    Rig fresh(timing, strict);
    fresh.restore(state);
    EXPECT_EQ(live(fresh, events, stop), once) << "a new line, seed " << seed;
    collided += once.counted[4] > 0 ? 1 : 0;
    sent += once.out.size();
  }
  EXPECT_GT(in_request, 20);
  EXPECT_GT(in_reply, 6);
  EXPECT_GT(ready, 3);
  EXPECT_GT(collided, 10);
  EXPECT_GT(sent, 5000u);
}

TEST(LineState, WhatNoLineCanBeIsRefusedAndChangesNothing) {
  Rig rig(Timing::wire, false);
  rig.wire.send(hex("01 03 00 01 00 01 D5 CA"), 1s);
  rig.wire.run(1s + 2ms);
  const Line::State good = rig.wire.line.save();
  ASSERT_EQ(good.input.size(), 5u);  // 3.5 characters have passed at 573 us each; the fourth is in progress
  const auto refused = [&](const std::string& what, auto spoil) {
    Line::State bad = good;
    spoil(bad);
    try {
      rig.wire.line.restore(bad);
      ADD_FAILURE() << "was accepted, though " << what;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(), "line rs485: " + what);
    }
    EXPECT_EQ(rig.wire.line.save().input.size(), 5u);
  };
  refused("its stations are different", [](Line::State& s) { s.members.pop_back(); });
  refused("its settings are not valid for a line", [](Line::State& s) { s.settings.baud = 0; });
  refused("its settings are not valid for a line", [](Line::State& s) { s.settings.stop_bits = 3; });
  refused("its settings are not valid for a line", [](Line::State& s) { s.settings.data_bits = 9; });
  refused("more bytes are waiting than it can hold",
          [](Line::State& s) { s.input.resize(Line::kInputCapacity + 1); });
  refused("more bytes are waiting than it can hold",
          [](Line::State& s) { s.edge.output.resize(Line::kOutputCapacity + 1); });
  refused("its characters have impossible times", [](Line::State& s) { s.input[0].end = SimTime::max(); });
  refused("its characters have impossible times", [](Line::State& s) { s.arriving.count = 19'200; });
  refused("its characters have impossible times",
          [](Line::State& s) { s.members[1].transmission.count = -1; });
  refused("its characters have impossible times",
          [](Line::State& s) { s.members[0].noticed_at = SimTime::min(); });
  refused("its clock is after the end of simulated time",
          [](Line::State& s) { s.edge.clock = SimTime::max(); });
}

void lengthen(RtuFramer::State& state, std::size_t size) {
  while (state.characters.size() < size) state.characters.push_back({});
}

TEST(FramerState, WhatNoFramerCanHoldIsRefused) {
  RtuFramer framer({.strict = false, .silence = 750us, .patience = 10ms});
  std::uint64_t number = 0;
  SimTime at = 1s;
  for (const std::uint8_t value : hex("01 03 00 01 00 01 D5 CA 02 03 00")) {
    framer.push({at, at + 500us, value, ++number});
    at += 500us;
  }
  // One frame is ready, three characters are undecided.
  const RtuFramer::State good = framer.save();
  ASSERT_EQ(good.characters.size(), 11u);
  ASSERT_EQ(good.ready.size(), 1u);
  ASSERT_EQ(good.undecided, 8);
  const auto refused = [&](auto spoil) {
    RtuFramer::State bad = good;
    spoil(bad);
    EXPECT_THROW(framer.restore(bad), std::invalid_argument);
    EXPECT_EQ(framer.save().characters.size(), 11u);
  };
  refused([](RtuFramer::State& s) { lengthen(s, 3 * kRtuMaxFrame + 1); });
  refused([](RtuFramer::State& s) { s.characters.marks.push_back({}); });
  refused([](RtuFramer::State& s) { s.undecided = 12; });
  refused([](RtuFramer::State& s) { s.undecided = 7; });  // within the frame
  refused([](RtuFramer::State& s) { s.candidate = 7; });
  refused([](RtuFramer::State& s) { s.candidate = 12; });
  refused([](RtuFramer::State& s) { s.search_again_at = kRtuMaxFrame + 2; });
  refused([](RtuFramer::State& s) { s.ready[0].size = 3; });
  refused([](RtuFramer::State& s) { s.ready[0].first = 1; });
  refused([](RtuFramer::State& s) { s.ready.push_back(s.ready[0]); });
  refused([](RtuFramer::State& s) { s.characters.marks[3].end = SimTime::max(); });
  refused([](RtuFramer::State& s) { s.last_end = SimTime::min(); });
  // Under strict framing a lump is one frame at most.
  RtuFramer strict({.strict = true, .silence = 750us});
  RtuFramer::State long_lump;
  lengthen(long_lump, kRtuMaxFrame + 1);
  EXPECT_THROW(strict.restore(long_lump), std::invalid_argument);
  EXPECT_NO_THROW(framer.restore(long_lump));
}

/// 8E1 at 19200: a character is 572.9 us, at 38400 286.4 us.
TEST(LineState, AnotherSpeedBeginsAfterWhatIsOnItsWay) {
  LineRig rig({.settings = {.baud = 19200}, .timing = Timing::wire, .enforce_settings = false});
  FakeSlave slave(9, {});
  rig.line.attach(slave);
  rig.send(Bytes(10, 0x55), 0s);  // until 5729.1 us
  rig.run(1ms);
  rig.line.set_settings({.baud = 38400});
  rig.send(Bytes(2, 0x66), 1ms);  // of the same burst
  rig.run(1s);
  ASSERT_EQ(slave.received.size(), 12u);
  EXPECT_EQ(slave.received[9].end, 5'729'166ns);  // 10 * 11 / 19200 s
  EXPECT_EQ(slave.received[10].start, 5'729'166ns);
  EXPECT_EQ(slave.received[10].end, 5'729'166ns + 286'458ns);
  EXPECT_EQ(slave.received[11].end, 5'729'166ns + 572'916ns);
}

}  // namespace line_state_test
}  // namespace understudy::pty
