#include "emulator/world/recording/replay.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <istream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "base/state/state_error.h"
#include "base/version.h"
#include "emulator/device/model.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/snapshot_file.h"
#include "emulator/world/world.h"
#include "pty/line_observer.h"
#include "pty/station.h"

namespace understudy::emulator::world {

namespace {

using What = RecordedEvent::What;

/// Collects what stations send during the replay until the bytes are compared.
class SentBytes {
 public:
  struct Sent {
    std::size_t line = 0;
    SimTime at{0};
    std::vector<std::uint8_t> bytes;
  };

  explicit SentBytes(World& world) : world_(world) {
    for (std::size_t i = 0; i < world.line_count(); ++i) {
      line_collectors_.push_back(std::make_unique<LineCollector>(*this, i));
      world.add_observer(i, *line_collectors_.back());
    }
  }
  ~SentBytes() {
    for (std::size_t i = 0; i < line_collectors_.size(); ++i) world_.remove_observer(i, *line_collectors_[i]);
  }
  SentBytes(const SentBytes&) = delete;
  SentBytes& operator=(const SentBytes&) = delete;

  std::deque<Sent>& waiting() { return waiting_; }

 private:
  class LineCollector final : public pty::LineObserver {
   public:
    LineCollector(SentBytes& all, std::size_t line) : all_(all), line_(line) {}
    void on_start_bit(SimTime) override {}
    void on_character(const pty::TimedByte&, bool) override {}
    void on_nothing_more() override {}
    void on_transmission(const pty::Transmission& transmission) override {
      all_.waiting_.push_back({.line = line_,
                               .at = all_.world_.now(),
                               .bytes = {transmission.bytes.begin(), transmission.bytes.end()}});
    }
    std::optional<SimTime> due() const override { return std::nullopt; }
    void run(SimTime) override {}

   private:
    SentBytes& all_;
    std::size_t line_;
  };

  World& world_;
  std::vector<std::unique_ptr<LineCollector>> line_collectors_;
  std::deque<Sent> waiting_;
};

std::string hex_words_of(const std::vector<std::uint8_t>& bytes) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string text;
  for (const std::uint8_t byte : bytes) {
    if (!text.empty()) text += ' ';
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

std::string text_of(const World& world, std::size_t line, SimTime at,
                    const std::vector<std::uint8_t>& bytes) {
  return hex_words_of(bytes) + " on " + world.line(line).line.name() + " at " + format_duration(at);
}

/// Returns the first difference, or an empty text if the output matches the recording.
std::string compare(const World& world, SentBytes& sent_bytes, const RecordedEvent& recorded,
                    std::uint64_t bytes_before) {
  const std::string expected = text_of(world, recorded.where, recorded.at, recorded.bytes);
  if (sent_bytes.waiting().empty()) return "expected " + expected + "; nothing was sent";
  const SentBytes::Sent sent = sent_bytes.waiting().front();
  sent_bytes.waiting().pop_front();
  const std::string came = text_of(world, sent.line, sent.at, sent.bytes);
  std::size_t same = 0;
  while (same < sent.bytes.size() && same < recorded.bytes.size() &&
         sent.bytes[same] == recorded.bytes[same]) {
    ++same;
  }
  if (sent.bytes != recorded.bytes) {
    return "byte " + std::to_string(bytes_before + same + 1) + ": expected " + expected + "; got " + came;
  }
  if (sent.line != recorded.where || sent.at != recorded.at) {
    return "expected " + expected + "; got " + came;
  }
  return {};
}

/// Compares the world with the state at the end of the recording. Returns an empty text if they agree in
/// everything that affects the model (bytes that a host has not read yet do not). A state from another
/// version cannot be compared.
std::string compare_state(const World& world, const RecordingHeader& header, const std::string& text) {
  if (text.empty() || header.version != program_version()) return {};
  WorldState recorded = parse_snapshot(text, kBenchOfRecording);
  const WorldState replayed = save(world);
  for (WorldState::Part& part : recorded.parts) {
    if (part.name == kEdgePart) part = replayed.parts.back();
  }
  const std::string found = difference(world, recorded, replayed);
  return found.empty() ? found : "ends in a different state: " + found + " (recorded against replayed)";
}

/// The lines of a recording. Error messages contain the line number.
class RecordedLines {
 public:
  RecordedLines(std::istream& recording, std::string name) : recording_(recording), name_(std::move(name)) {}

  bool next() {
    if (!std::getline(recording_, line_)) return false;
    ++number_;
    return true;
  }
  const std::string& line() const { return line_; }
  std::size_t number() const { return number_; }
  /// Returns true if the line has no line ending, because the writer was killed while writing it.
  bool is_torn() const { return recording_.eof(); }
  RecordingError error(const std::string& what) const {
    return RecordingError(name_ + ":" + std::to_string(std::max<std::size_t>(number_, 1)) + ": " + what);
  }

 private:
  std::istream& recording_;
  std::string name_;
  std::string line_;
  std::size_t number_ = 0;
};

void read_header(ModelList models, RecordedLines& lines, Replayed& replayed) {
  if (!lines.next()) throw lines.error("recording: is empty or cannot be read; expected a header");
  try {
    replayed.header = parse_header(lines.line());
    replayed.bench = parse_recorded_bench(models, replayed.header.bench);
  } catch (const RecordingError& error) {
    throw lines.error(error.what());
  } catch (const BenchError& error) {
    throw lines.error("bench: " + error.diagnostics().front().text);
  }
}

/// Restores the state in which the recording begins, unless it begins at power-up.
void restore_beginning(World& world, const RecordedLines& lines, const Replayed& replayed) {
  if (replayed.header.snapshot.empty()) return;
  try {
    restore(world, parse_snapshot(replayed.header.snapshot, bench_hash(replayed.bench)));
  } catch (const SnapshotError& error) {
    throw lines.error(std::string("snapshot: ") + error.what());
  } catch (const StateError& error) {
    throw lines.error(std::string("snapshot: ") + error.what());
  }
}

RecordedEvent event_of(const RecordedLines& lines, const World& world) {
  RecordedEvent event;
  try {
    event = parse_event(lines.line(), world.known(), world.line_count());
  } catch (const RecordingError& error) {
    throw lines.error(error.what());
  }
  if (event.at < world.now())
    throw lines.error("t: goes back in time; expected the events in chronological order");
  return event;
}

}  // namespace

Replayed replay(ModelList models, std::istream& recording, const std::string& name,
                std::optional<SimTime> until, const ReplayWatcherMaker& watch,
                const std::function<void(World&)>& done) {
  RecordedLines lines(recording, name);
  Replayed replayed;
  ReplayResult& result = replayed.result;
  read_header(models, lines, replayed);
  World world(replayed.bench, replayed.header.options, {});
  restore_beginning(world, lines, replayed);
  const std::unique_ptr<ReplayWatcher> watcher = watch ? watch(world) : nullptr;
  SentBytes sent_bytes(world);
  const auto expect_silence = [&] {
    if (sent_bytes.waiting().empty()) return;
    const SentBytes::Sent& sent = sent_bytes.waiting().front();
    result.difference = "got " + text_of(world, sent.line, sent.at, sent.bytes) + "; expected nothing";
  };
  while (result.difference.empty() && !result.has_end && lines.next()) {
    if (lines.is_torn()) break;
    const RecordedEvent event = event_of(lines, world);
    if (until && event.at > *until) break;
    world.advance_to(event.at);
    ++result.events;
    if (event.what == What::sent) {
      result.difference = compare(world, sent_bytes, event, result.bytes_sent);
      result.bytes_sent += event.bytes.size();
      continue;
    }
    // Everything that is due must be sent before the next outside input.
    expect_silence();
    result.has_end = event.what == What::end;
    if (watcher && result.difference.empty()) watcher->happened(event, lines.number());
    try {
      if (result.has_end && result.difference.empty()) {
        result.difference = compare_state(world, replayed.header, event.text);
      }
      if (result.difference.empty()) apply(world, event);
    } catch (const std::runtime_error& error) {
      throw lines.error(error.what());
    }
  }
  if (result.has_end && lines.next()) {
    throw lines.error("line: follows the end; expected no further lines");
  }
  const bool is_stopped = until && result.difference.empty();
  if (is_stopped && !result.has_end) world.advance_to(*until);
  result.reached = world.now();
  if (!result.difference.empty()) {
    result.verdict = ReplayResult::Verdict::different;
  } else if (is_stopped) {
    result.verdict = ReplayResult::Verdict::stopped;
  }
  if (watcher) watcher->ended();
  if (done) done(world);
  return replayed;
}

}  // namespace understudy::emulator::world
