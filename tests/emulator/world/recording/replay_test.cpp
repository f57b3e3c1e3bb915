// A replayed recording sends every byte again, or reports the first that differs.
#include "emulator/world/recording/replay.h"
#include "emulator/models/models.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "base/version.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/snapshot_file.h"
#include "tests/emulator/world/recording/busy_world.h"
#include "tests/emulator/world/same_world.h"
#include "tests/sanitized.h"

namespace understudy::emulator::world {
namespace replay_test {

using Verdict = ReplayResult::Verdict;

Replayed play(const std::string& text, std::optional<SimTime> until = {},
              const std::function<void(World&)>& done = {}) {
  std::istringstream file(text);
  return replay(models::all_models(), file, "a.jsonl", until, {}, done);
}

std::string refusal(const std::string& text) {
  try {
    play(text);
  } catch (const RecordingError& error) {
    return error.what();
  }
  return "";
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream file(text);
  for (std::string line; std::getline(file, line);) lines.push_back(line + "\n");
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line;
  return text;
}

TEST(Replay, SaysEveryByteOfABusyWorldAgainAndEndsInItsState) {
  std::uint64_t bytes = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    BusyWorld busy(seed, seed % 3 == 0 ? "instant" : "wire");
    busy.play(300);
    const std::string text = busy.finish();
    testing::AssertionResult same = testing::AssertionFailure() << "nothing was replayed";
    const Replayed again = play(text, {}, [&](World& world) { same = same_state(world, busy.world()); });
    EXPECT_EQ(again.result.verdict, Verdict::same) << again.result.difference;
    EXPECT_TRUE(again.result.has_end);
    EXPECT_TRUE(same);
    EXPECT_EQ(again.header.version, program_version());
    EXPECT_EQ(again.header.seed, seed);
    bytes += again.result.bytes_sent;
  }
  EXPECT_GT(bytes, 3000U) << "or little was compared";
}

TEST(Replay, ReportsTheFirstByteThatDiffers) {
  BusyWorld busy(4);
  busy.play(300);
  const std::vector<std::string> lines = lines_of(busy.finish());
  std::uint64_t before = 0;
  int changed = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::size_t at = lines[i].find("\"do\":\"out\"");
    if (at == std::string::npos) continue;
    const std::size_t bytes = lines[i].find("\"bytes\":\"") + 9;
    std::vector<std::string> other = lines;
    other[i][bytes + 3] = other[i][bytes + 3] == '0' ? '1' : '0';  // the second byte
    const ReplayResult result = play(joined(other)).result;
    EXPECT_EQ(result.verdict, Verdict::different);
    EXPECT_TRUE(result.difference.starts_with("byte " + std::to_string(before + 2) + ": expected "))
        << result.difference;
    before += (lines[i].find('"', bytes) - bytes) / 2;
    if (++changed == 20) break;
  }
  EXPECT_EQ(changed, 20);
}

// One byte of the final state of a recording is changed: the field is named.
TEST(Replay, NamesTheFieldInWhichItEndsInAnotherState) {
  BusyWorld busy(4);
  busy.play(300);
  const std::vector<std::string> lines = lines_of(busy.finish());
  ASSERT_NE(lines.back().find("\"state\":"), std::string::npos);
  EXPECT_EQ(play(joined(lines)).result.verdict, Verdict::same);
  const WorldState state = save(busy.world());
  const auto ended_with = [&](const WorldState& other, std::string_view version = program_version()) {
    std::vector<std::string> changed = lines;
    RecordedEvent end{.at = state.time, .text = to_text(other, kBenchOfRecording)};
    changed.back() = to_line(end, busy.world().known()) + "\n";
    RecordingHeader header = parse_header(changed.front());
    header.version = version;
    changed.front() = to_line(header) + "\n";
    return play(joined(changed)).result;
  };
  EXPECT_EQ(ended_with(state).verdict, Verdict::same);
  WorldState other = state;
  other.parts.back().bytes.back() ^= std::byte{1};  // at the edge
  EXPECT_EQ(ended_with(other).verdict, Verdict::same) << "data that a host has not read do not matter";
  // The complete difference of a world that got one more pulse from outside.
  busy.world().set_external_input(0, 0, busy.world().device(0).input(0) == 0 ? 1 : 0);
  const ReplayResult moved = ended_with(save(busy.world()));
  EXPECT_EQ(moved.verdict, Verdict::different);
  EXPECT_TRUE(moved.difference.starts_with("ends in a different state: ")) << moved.difference;
  EXPECT_NE(moved.difference.find("inputs[0]"), std::string::npos) << moved.difference;
  EXPECT_TRUE(moved.difference.ends_with("(recorded against replayed)")) << moved.difference;
  EXPECT_EQ(ended_with(save(busy.world()), "0.0.1").verdict, Verdict::same) << "from another version";
  WorldState short_of_one = state;
  short_of_one.parts.erase(short_of_one.parts.begin());
  EXPECT_THROW(ended_with(short_of_one), RecordingError);
}

TEST(Replay, ReportsWhatIsMissingOrExtraOrAtAnotherTime) {
  const std::string bench =
      to_text(parse_bench(models::all_models(), two_devices("wire", 19200), "two.yaml", "."));
  const std::string header =
      to_line(RecordingHeader{.version = "1", .bench = bench, .options = {}, .snapshot = {}}) + "\n";
  // Aaxis_SVON = 1: eight characters of 11 bits at 19200 baud are 4583333 ns, the END time 750000 ns.
  const std::string request = R"({"t":0,"do":"in","line":0,"bytes":"0106101400010cce"})"
                              "\n";
  const auto reply = [](const std::string& t) {
    return R"({"t":)" + t +
           R"(,"do":"out","line":0,"bytes":"0106101400010cce"})"
           "\n";
  };
  const std::string end = R"({"t":20000000,"do":"end"})"
                          "\n";
  EXPECT_EQ(play(header + request + reply("5333333") + end).result.verdict, Verdict::same);
  const std::string text = "01 06 10 14 00 01 0C CE on rs485 at ";
  EXPECT_EQ(play(header + request + end).result.difference, "got " + text + "5.333333ms; expected nothing");
  EXPECT_EQ(play(header + request + reply("5333333") + reply("6000000") + end).result.difference,
            "expected " + text + "6ms; nothing was sent");
  EXPECT_EQ(play(header + request + reply("5333334") + end).result.difference,
            "expected " + text + "5.333334ms; got " + text + "5.333333ms");
}

TEST(Replay, ARecordingMayBeginInTheMiddleWithASnapshot) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    BusyWorld busy(seed, seed % 3 == 0 ? "instant" : "wire");
    busy.play(100);
    busy.begin_again();
    busy.play(100);
    const std::string text = busy.finish();
    EXPECT_NE(text.find("\"snapshot\""), std::string::npos);
    std::uint64_t end = 0;
    const Replayed again = play(text, {}, [&](const World& world) { end = hash(world); });
    EXPECT_EQ(again.result.verdict, Verdict::same) << again.result.difference;
    EXPECT_TRUE(again.result.has_end);
    EXPECT_EQ(end, hash(busy.world()));
  }
}

TEST(Replay, ASnapshotThatDoesNotBelongToTheBenchIsRefused) {
  BusyWorld busy(1);
  busy.play(20);
  busy.begin_again();
  busy.play(20);
  std::string text = busy.finish();
  const std::size_t at = text.find("rs485");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 5, "rs486");
  const std::string why = refusal(text);
  EXPECT_TRUE(why.starts_with("a.jsonl:1: snapshot: bench: ")) << why;
}

TEST(Replay, StopsWhereRequested) {
  BusyWorld busy(5);
  busy.play(100);
  const std::string text = busy.finish();
  const SimTime middle = busy.world().now() / 2;
  SimTime reached{0};
  const Replayed half = play(text, middle, [&](World& world) { reached = world.now(); });
  EXPECT_EQ(half.result.verdict, Verdict::stopped);
  EXPECT_EQ(half.result.reached, middle);
  EXPECT_EQ(reached, middle);
}

TEST(Replay, WhatHappensAtThatMomentBelongsToIt) {
  BusyWorld busy(5);
  busy.play(100);
  const std::string text = busy.finish();
  std::vector<std::int64_t> times;
  for (const std::string& line : lines_of(text)) {
    if (line.starts_with("{\"t\":")) times.push_back(std::stoll(line.substr(5)));
  }
  ASSERT_GT(times.size(), 100U);
  for (std::size_t i = 0; i < times.size(); i += 7) {
    for (const std::int64_t until : {times[i] - 1, times[i]}) {
      const auto events = std::count_if(times.begin(), times.end(), [&](auto t) { return t <= until; });
      EXPECT_EQ(play(text, SimTime{until}).result.events, static_cast<std::uint64_t>(events)) << until;
    }
  }
}

TEST(Replay, ATruncatedRecordingIsPlayedAsFarAsItGoes) {
  BusyWorld busy(6);
  busy.play(40);
  const std::string text = busy.finish();
  const std::size_t header = text.find('\n') + 1;
  const std::size_t step = is_sanitized() ? 71 : 7;
  for (std::size_t size = header; size < text.size(); size += step) {
    const Replayed again = play(text.substr(0, size));
    EXPECT_EQ(again.result.verdict, Verdict::same) << size << ": " << again.result.difference;
    EXPECT_FALSE(again.result.has_end) << size;
  }
}

TEST(Replay, WhatIsNoRecordingIsRefusedWithItsLine) {
  const std::string bench =
      to_text(parse_bench(models::all_models(), two_devices("wire", 19200), "two.yaml", "."));
  const std::string header =
      to_line(RecordingHeader{.version = "1", .bench = bench, .options = {}, .snapshot = {}}) + "\n";
  const auto event = [&](const std::string& line) { return refusal(header + line + "\n"); };
  EXPECT_EQ(refusal(""), "a.jsonl:1: recording: is empty or cannot be read; expected a header");
  EXPECT_EQ(refusal("{\n"), "a.jsonl:1: line: is damaged or not JSON; expected one object");
  EXPECT_EQ(refusal("[]\n"), "a.jsonl:1: line: is not an object; expected an object");
  EXPECT_EQ(refusal("{\"understudy\":1,\"kind\":\"nv-image\"}\n"),
            "a.jsonl:1: kind: is missing or different; expected a recording");
  EXPECT_EQ(refusal(to_line(RecordingHeader{
                        .version = "1", .bench = "understudy: 1", .options = {}, .snapshot = {}}) +
                    "\n"),
            "a.jsonl:1: bench: bench:1:1: bench: 'lines' is missing; expected it here");
  EXPECT_EQ(event(R"({"t":1,"do":"end","t":2})"), "a.jsonl:2: 't': appears twice; expected it only once");
  EXPECT_EQ(refusal(header + "{\"t\":5,\"do\":\"end\"}\n{\"t\":6,\"do\":\"open\",\"line\":0}\n"),
            "a.jsonl:3: line: follows the end; expected no further lines");
  EXPECT_EQ(event("{}"), "a.jsonl:2: do: is missing; expected a value");
  EXPECT_EQ(event(R"({"t":1,"do":"dance"})"),
            "a.jsonl:2: do: 'dance' is not an event; expected a recorded event");
  EXPECT_EQ(event(R"({"t":-1,"do":"end"})"),
            "a.jsonl:2: t: is not a valid number; expected 0 to 3153600000000000000");
  EXPECT_EQ(event(R"({"t":1,"do":"in","line":1,"bytes":"00"})"),
            "a.jsonl:2: line: is not a valid number; expected 0 to 0");
  EXPECT_EQ(event(R"({"t":1,"do":"in","line":0,"bytes":"0"})"),
            "a.jsonl:2: bytes: ends in half a byte; expected two digits");
  EXPECT_EQ(event(R"({"t":1,"do":"in","line":0,"bytes":"0G"})"),
            "a.jsonl:2: bytes: is not a sequence of bytes; expected two digits per byte");
  EXPECT_EQ(event(R"({"t":1,"do":"input","device":0,"terminal":99,"level":0})").substr(0, 22),
            "a.jsonl:2: terminal: i");
  EXPECT_EQ(event(R"({"t":1,"do":"power","device":0,"on":1})"),
            "a.jsonl:2: on: is neither true nor false; expected true or false");
  EXPECT_EQ(event(R"({"t":1,"do":"program","device":0,"text":"Fly"})").substr(0, 20), "a.jsonl:2: mnemonic:");
  EXPECT_EQ(refusal(header + "{\"t\":5,\"do\":\"open\",\"line\":0}\n{\"t\":4,\"do\":\"end\"}\n"),
            "a.jsonl:3: t: goes back in time; expected the events in chronological order");
}

TEST(Replay, ARecordingNamesNoPaths) {
  // It may come from anyone: anything that it could read or write is refused first.
  for (const auto& [key, path] : {std::pair<std::string, std::string>{"nv", "/tmp/precious"},
                                  {"nv", "feeder.json"},
                                  {"program", "/etc/passwd"}}) {
    const std::string bench = R"({"understudy":1,"lines":{"l":{"stations":[{"name":"d","model":"simple2-r3",)"
                              R"("address":1,")" +
                              key + R"(":")" + path + R"("}]}}})";
    EXPECT_EQ(
        refusal(to_line(RecordingHeader{.version = "1", .bench = bench, .options = {}, .snapshot = {}}) +
                "\n"),
        "a.jsonl:1: bench: bench:1:" + std::to_string(bench.find("\"" + path) + 1) +
            ": lines.l.stations[0]." + key +
            ": is a path; expected no path, because a recording contains everything");
  }
  const std::string linked =
      R"({"understudy":1,"lines":{"l":{"link":"/tmp/p","stations":[{"name":"d","model":"simple2-r3"}]}}})";
  EXPECT_NE(
      refusal(to_line(RecordingHeader{.version = "1", .bench = linked, .options = {}, .snapshot = {}}) + "\n")
          .find("lines.l.link: is a path"),
      std::string::npos);
}

}  // namespace replay_test
}  // namespace understudy::emulator::world
