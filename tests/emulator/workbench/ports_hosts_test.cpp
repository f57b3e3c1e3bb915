// Two hosts at once on the two ports of one device: every reply is correct, on the right line, and no value
// is torn. The run is recorded, replayed, saved and restored.
#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <sstream>

#include "emulator/world/bench/bench_text.h"
#include "emulator/world/outcome_hash.h"
#include "emulator/world/recording/recorder.h"
#include "emulator/world/recording/replay.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/snapshot_file.h"
#include "tests/emulator/workbench/two_lines.h"
#include "tests/emulator/world/same_world.h"

namespace understudy::emulator::workbench {
namespace ports_hosts_test {

using namespace std::chrono_literals;
using world::Bytes;

constexpr std::uint16_t kFirst = 0x64;  // D0
constexpr std::size_t kWords = 24;

void put_word(Bytes& bytes, std::size_t word) {
  bytes.push_back(static_cast<std::uint8_t>(word >> 8));
  bytes.push_back(static_cast<std::uint8_t>(word));
}

/// The expected replies of the device, as a manual would describe them, without its code.
class Oracle {
 public:
  /// Executes it. Empty: no reply.
  Bytes answer(const Bytes& request) {
    if (request[0] != 1) return {};
    const std::size_t first = word_at(request, 2);
    Bytes reply{1, request[1]};
    if (request[1] == 0x03) {
      reply.push_back(static_cast<std::uint8_t>(2 * word_at(request, 4)));
      for (std::size_t i = 0; i < word_at(request, 4); ++i) put_word(reply, words_[first - kFirst + i]);
    } else if (request[1] == 0x05) {
      is_absent_ = request[4] == 0xFF;
      reply.assign(request.begin(), request.begin() + 6);
    } else if (first < kFirst && is_absent_) {
      reply = {1, 0x90, 4};
    } else {
      for (std::size_t i = 0; first >= kFirst && i < word_at(request, 4); ++i) {
        words_[first - kFirst + i] = static_cast<std::uint16_t>(word_at(request, 7 + 2 * i));
      }
      reply.assign(request.begin(), request.begin() + 6);
    }
    pty::append_rtu_crc(reply);
    return reply;
  }

 private:
  static std::size_t word_at(const Bytes& bytes, std::size_t at) {
    return static_cast<std::size_t>(bytes[at] << 8 | bytes[at + 1]);
  }
  std::array<std::uint16_t, kWords> words_{};
  bool is_absent_ = false;
};

class Requests {
 public:
  explicit Requests(std::uint64_t seed) : random_(seed) {}
  std::size_t below(std::size_t count) { return random_() % count; }

  Bytes next() {
    const std::size_t count = 1 + below(kWords / 2);
    const std::size_t first = kFirst + below(kWords - count + 1);
    Bytes request{static_cast<std::uint8_t>(below(20) == 0 ? 2 : 1)};
    switch (below(8)) {
      case 0:
        request.insert(request.end(), {0x05, 0x00, 111, static_cast<std::uint8_t>(below(2) * 0xFF), 0x00});
        break;
      case 1:
        request.insert(request.end(), {0x10, 0x00, 0x10, 0x00, 0x02, 0x04, 0x00, 0x00, 0x00, 0x00});
        break;
      case 2:
      case 3:
      case 4:
        request.push_back(0x10);
        put_word(request, first);
        put_word(request, count);
        request.push_back(static_cast<std::uint8_t>(2 * count));
        for (std::size_t i = 0; i < count; ++i) put_word(request, random_() & 0xFFFF);
        break;
      default:
        request.push_back(0x03);
        put_word(request, first);
        put_word(request, count);
        break;
    }
    pty::append_rtu_crc(request);
    return request;
  }

 private:
  std::mt19937_64 random_;
};

TEST(TwoHosts, GetTheRightAnswers100000Times) {
  constexpr int kRounds = 50'000;
  TwoLines two;
  Oracle oracle;
  Requests requests(16);
  int refused = 0;
  for (int round = 0; round < kRounds; ++round) {
    const std::array<Bytes, 2> asked{requests.next(), requests.next()};
    std::array<SimTime, 2> over{};
    std::array<std::size_t, 2> parts{};
    for (const std::size_t line : {std::size_t{0}, std::size_t{1}}) {
      over[line] = std::chrono::microseconds(requests.below(3));
      parts[line] = over[line] == 0us ? asked[line].size() : requests.below(asked[line].size());
    }
    const SimTime begin = two.world.now();
    const std::size_t fed_first = requests.below(2);
    for (const std::size_t line : {fed_first, 1 - fed_first}) {
      two.world.receive(line, std::span(asked[line]).first(parts[line]));
    }
    for (const SimTime step : {SimTime(1us), SimTime(2us)}) {
      two.world.advance_to(begin + step);
      for (const std::size_t line : {std::size_t{1}, std::size_t{0}}) {
        if (over[line] == step) two.world.receive(line, std::span(asked[line]).subspan(parts[line]));
      }
    }
    two.world.advance_to(begin + 3us);
    const std::size_t sooner = over[1] < over[0] ? 1 : 0;  // at the same moment, in the order of the bench
    for (const std::size_t line : {sooner, 1 - sooner}) {
      const Bytes wanted = oracle.answer(asked[line]);
      const auto came = two.world.line(line).line.output();
      ASSERT_EQ(world::text(came), world::text(wanted))
          << "round " << round << ", line " << line << ", asked " << world::text(asked[line]);
      two.world.take_output(line, came.size());
      refused += wanted.size() == 5 ? 1 : 0;
    }
    if (requests.below(64) == 0) two.pass(std::chrono::microseconds(requests.below(3000)));
  }
  EXPECT_GT(refused, kRounds / 50);
  EXPECT_EQ(two.mill().state.receive_errors, (std::array<std::uint32_t, 2>{}));
}

/// Both send all the time, at the speed of the wire, disconnect, meet faults and lose the power.
class BusyHosts {
 public:
  explicit BusyHosts(std::uint64_t seed)
      : two(two_lines_text(
            "", "faults: [ { drop: hmi, every: 7 }, { corrupt_checksum: pc, of: request, every: 5 } ]\n")),
        requests_(seed) {}

  void play(int events) {
    for (int i = 0; i < events; ++i) {
      two.pass(std::chrono::microseconds(requests_.below(8000)));
      const std::size_t line = requests_.below(2);
      Bytes bytes = requests_.next();
      if (requests_.below(10) == 0) bytes.resize(1 + requests_.below(bytes.size()));
      if (requests_.below(40) == 0) bytes = Bytes(300, 0x55);
      bytes.resize(std::min(bytes.size(), two.world.line(line).line.room()));
      two.world.receive(line, bytes);
      if (requests_.below(50) == 0) two.world.switch_power(0, requests_.below(2) == 0);
      if (requests_.below(3) == 0) take_all();
    }
    two.world.switch_power(0, true);
    two.pass(1s);
    take_all();
  }
  void take_all() {
    for (const std::size_t line : {TwoLines::kPc, TwoLines::kHmi}) {
      two.world.take_output(line, two.world.line(line).line.output().size());
    }
  }

  TwoLines two;

 private:
  Requests requests_;
};

TEST(TwoHosts, AreRecordedAndPlayedAgain) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    BusyHosts busy(seed);
    std::string text;
    world::Recorder recorder(
        busy.two.world,
        {.version = "1", .bench = world::to_text(busy.two.bench), .options = {}, .seed = 0, .snapshot = {}},
        [&](std::string_view line) { text += line; });
    busy.play(300);
    recorder.finish();
    std::istringstream file(text);
    std::uint64_t hash = 0;
    const auto again = world::replay(kWorkbenchModels, file, "a.jsonl", {}, {},
                                     [&](world::World& played) { hash = world::hash(played); });
    EXPECT_EQ(again.result.verdict, world::ReplayResult::Verdict::same) << again.result.difference;
    EXPECT_EQ(hash, world::hash(busy.two.world)) << "seed " << seed;
    EXPECT_GT(again.result.bytes_sent, 500U);
    EXPECT_GT(busy.two.mill().state.receive_errors[0], 3U);
    EXPECT_GT(busy.two.mill().state.receive_errors[1], 3U);
  }
}

TEST(TwoHosts, ContinueFromASnapshotInAnotherWorld) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    BusyHosts busy(seed);
    busy.play(100);
    busy.two.send(TwoLines::kPc, "01 03 00 64 00 10");
    busy.two.send(TwoLines::kHmi, "01 03 00 64 00 10");
    busy.two.pass(2ms);  // both are in the middle of something
    TwoLines other(two_lines_text("",
                                  "faults: [ { drop: hmi, every: 7 }, { corrupt_checksum: pc, of: request, "
                                  "every: 5 } ]\n"));
    const std::string file = world::to_text(world::save(busy.two.world), world::bench_hash(busy.two.bench));
    world::restore(other.world, world::parse_snapshot(file, world::bench_hash(other.bench)));
    ASSERT_TRUE(world::same_state(other.world, busy.two.world));
    world::OutcomeHash of_one(busy.two.world);
    world::OutcomeHash of_other(other.world);
    Requests requests(seed);
    for (int i = 0; i < 100; ++i) {
      const Bytes bytes = requests.next();
      const std::size_t line = requests.below(2);
      const SimTime time = std::chrono::microseconds(requests.below(20'000));
      for (world::World* world : {&busy.two.world, &other.world}) {
        world->receive(line, std::span(bytes).first(std::min(bytes.size(), world->line(line).line.room())));
        world->advance_to(world->now() + time);
      }
    }
    EXPECT_EQ(of_other.value(), of_one.value());
    EXPECT_TRUE(world::same_state(other.world, busy.two.world));
  }
}

TEST(TwoHosts, NeverSeeATornValueInTheWiresTime) {
  TwoLines two(two_lines_text());
  constexpr std::size_t kCount = 20;
  std::uint16_t written = 0;
  int read = 0;
  while (read < 500) {
    if (two.world.line(TwoLines::kPc).line.room() == pty::Line::kInputCapacity) {
      Bytes request{1, 0x10, 0x00, kFirst, 0x00, kCount, 2 * kCount};
      for (std::size_t i = 0; i < kCount; ++i) put_word(request, written);
      ++written;
      pty::append_rtu_crc(request);
      if (two.world.line(TwoLines::kPc).line.output().size() == 8 || written == 1) {
        two.came(TwoLines::kPc);
        two.world.receive(TwoLines::kPc, request);
      } else {
        --written;
      }
    }
    const auto output = two.world.line(TwoLines::kHmi).line.output();
    if (read == 0 || output.size() == 5 + 2 * kCount) {
      for (std::size_t i = 5; i + 2 < output.size(); i += 2) {
        ASSERT_EQ(output[i] << 8 | output[i + 1], output[3] << 8 | output[4]) << "reply " << read;
      }
      ++read;
      two.came(TwoLines::kHmi);
      two.send(TwoLines::kHmi, "01 03 00 64 00 14");
    }
    two.pass(97us);
  }
  EXPECT_GT(written, 500);
}

}  // namespace ports_hosts_test
}  // namespace understudy::emulator::workbench
