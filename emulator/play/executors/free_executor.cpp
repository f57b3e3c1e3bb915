#include "emulator/play/executors/free_executor.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/modbus/modbus_ascii.h"
#include "emulator/device/register_map/row.h"
#include "emulator/play/executors/condition_watch.h"
#include "emulator/play/executors/executor.h"
#include "emulator/play/executors/modbus_host.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/protocol/modbus_words.h"
#include "emulator/world/protocol/received_lines.h"
#include "emulator/world/view/world_view.h"
#include "emulator/world/world.h"
#include "pty/ascii_frame.h"
#include "pty/ascii_framer.h"
#include "pty/line.h"
#include "pty/line_observer.h"
#include "pty/line_settings.h"
#include "pty/station.h"

namespace understudy::emulator::play {

SimTime silence_between_frames(const pty::LineSettings& settings) {
  if (settings.baud > 19200) return std::chrono::microseconds(1750);
  const std::int64_t seven_halves = std::int64_t{7} * settings.bits_per_character() * 1'000'000'000;
  return SimTime{(seven_halves + 2 * settings.baud - 1) / (2 * settings.baud)};
}

/// The master on a line. It keeps track of when the line was last busy, and receives the line's output.
class FreeExecutor::Host final : public pty::LineObserver {
 public:
  Host(world::World& world, std::size_t number)
      : world_(world),
        number_(number),
        settings_(line().options().settings),
        is_ascii_(&world.line(number).protocol.protocol() == &kModbusAscii) {
    world_.host_settings(number_,
                         pty::HostSettings{.baud = settings_.baud, .stop_bits = settings_.stop_bits});
    world_.add_observer(number_, *this);
  }
  ~Host() override { world_.remove_observer(number_, *this); }
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  const pty::Line& line() const { return world_.line(number_).line; }
  void send_text(std::span<const std::uint8_t> bytes) { world_.receive(number_, bytes); }
  bool is_ascii() const { return is_ascii_; }
  /// Returns the silence before a frame.
  SimTime silence() const { return is_ascii_ ? SimTime{0} : silence_between_frames(settings_); }
  /// Returns the maximum time between two bytes of a reply: the next byte may begin just before t3.5 is over.
  SimTime longest_pause() const { return is_ascii_ ? pty::kAsciiPatience : silence() + duration_of(1); }
  SimTime duration_of(std::size_t count) const {
    if (line().options().timing == pty::Timing::instant) return SimTime{0};
    return settings_.duration_of(static_cast<std::int64_t>(count));
  }

  /// Returns the end of the last byte on the line.
  SimTime quiet_since() const { return quiet_since_; }
  void keep_busy(SimTime until) { quiet_since_ = std::max(quiet_since_, until); }
  void set_quiet_since(SimTime since) { quiet_since_ = since; }
  /// Forgets everything after `now`, because simulated time was set back.
  void forget_after(SimTime now) { quiet_since_ = now == SimTime{0} ? kEver : std::min(quiet_since_, now); }

  /// Moves the bytes that have arrived since the last call to `bytes`.
  void take(std::vector<std::uint8_t>& bytes) {
    const auto came = line().output();
    bytes.insert(bytes.end(), came.begin(), came.end());
    take_output(came.size());
  }
  /// Returns the bytes that have arrived as lines of text, but does not remove them.
  world::ReceivedLines lines() const {
    const auto came = line().output();
    return world::lines_in({reinterpret_cast<const char*>(came.data()), came.size()});
  }
  void discard() { take_output(line().output().size()); }
  void take_output(std::size_t count) { world_.take_output(number_, count); }

  /// Returns how many frames have been executed so far.
  std::uint64_t requests() const {
    std::uint64_t sum = 0;
    for (const auto& station : world_.line(number_).stations) sum += station->counters().requests;
    return sum;
  }

  // --- LineObserver ----------------------------------------------------------------------------
  void on_start_bit(SimTime) override {}
  void on_character(const pty::TimedByte&, bool) override {}
  void on_nothing_more() override {}
  void on_transmission(const pty::Transmission& transmission) override {
    keep_busy(transmission.start + duration_of(transmission.bytes.size()));
  }
  std::optional<SimTime> due() const override { return std::nullopt; }
  void run(SimTime) override {}

 private:
  world::World& world_;
  std::size_t number_;
  pty::LineSettings settings_;  // of the line at the beginning, because a host does not follow a DIP switch
  bool is_ascii_;
  static constexpr SimTime kEver = SimTime::min() / 2;
  SimTime quiet_since_ = kEver;
};

FreeExecutor::FreeExecutor(const world::Bench& bench, FreeExecutorOptions options)
    : world_(bench, world::WorldOptions{.strict_framing = true}, options.log), options_(std::move(options)) {
  for (std::size_t i = 0; i < world_.line_count(); ++i) {
    hosts_.push_back(std::make_unique<Host>(world_, i));
  }
}

FreeExecutor::~FreeExecutor() = default;

void FreeExecutor::with_world(const std::function<void(world::World&)>& act) {
  const SimTime before = world_.now();
  act(world_);
  if (world_.now() == before) return;
  // The world is in a different state now, so later frames and writes are not part of its past.
  for (const auto& host : hosts_) host->forget_after(world_.now());
  tick_of_last_write_ = 0;
}

std::vector<SimTime> FreeExecutor::quiet_since() {
  std::vector<SimTime> since;
  for (const auto& host : hosts_) since.push_back(host->quiet_since());
  return since;
}

void FreeExecutor::set_quiet_since(const std::vector<SimTime>& since) {
  for (std::size_t i = 0; i < hosts_.size() && i < since.size(); ++i) hosts_[i]->set_quiet_since(since[i]);
}

bool FreeExecutor::run_until(const Awaited& awaited, SimTime deadline) {
  if (awaited.is_met(world_)) return true;
  const ConditionWatch watch(world_, awaited);
  world_.advance_to(deadline);
  return watch.is_met();
}

HostReply FreeExecutor::read(std::size_t line, int station, Table table, std::uint16_t first, int count) {
  return ask(*hosts_[line], read_request(station, table, first, count));
}

HostReply FreeExecutor::write(std::size_t line, int station, Table table, std::uint16_t first,
                              std::span<const std::uint16_t> words) {
  return ask(*hosts_[line], write_request(station, table, first, words));
}

HostReply FreeExecutor::write_message(std::size_t line, int station, std::uint16_t first,
                                      std::span<const std::uint16_t> words) {
  return ask(*hosts_[line], message_request(station, first, words));
}

HostReply FreeExecutor::ask(Host& host, const std::vector<std::uint8_t>& request) {
  const Tick written_before = tick_of_last_write_;
  send(host, host.is_ascii() ? pty::ascii_of_rtu(request) : request);
  std::vector<std::uint8_t> reply;
  SimTime limit = host.quiet_since() + options_.timeout;
  while (true) {
    const std::size_t before = reply.size();
    host.take(reply);
    const bool is_over = host.is_ascii() ? !reply.empty() && reply.back() == '\n'
                                         : reply.size() >= wanted_size(request, reply);
    if (is_over) break;
    if (reply.size() > before) limit = world_.now() + host.longest_pause();
    if (world_.now() >= limit) break;
    advance_to_next(limit);
  }
  HostReply judged = host.is_ascii() ? judge_ascii_reply(request, reply) : judge_reply(request, reply);
  // The write was refused.
  if (judged.kind == HostReply::Kind::exception) tick_of_last_write_ = written_before;
  return judged;
}

std::vector<std::uint8_t> FreeExecutor::exchange(std::size_t line, std::span<const std::uint8_t> bytes,
                                                 std::size_t wanted, SimTime within) {
  Host& host = *hosts_[line];
  const Tick written_before = tick_of_last_write_;
  send(host, bytes);
  const SimTime deadline = host.quiet_since() + within;
  std::vector<std::uint8_t> reply;
  host.take(reply);
  while (reply.size() < wanted && world_.now() < deadline) {
    advance_to_next(deadline);
    host.take(reply);
  }
  if (world_.now() < deadline) {  // a byte that follows immediately belongs to the reply in any case
    const SimTime rounding{1};    // a character ends at a whole nanosecond
    world_.advance_to(std::min(world_.now() + host.duration_of(1) + rounding, deadline));
    host.take(reply);
  }
  const bool is_refused = bytes.size() >= 2 && reply.size() >= 2 && reply[1] == (bytes[1] | 0x80);
  if (is_refused) tick_of_last_write_ = written_before;
  return reply;
}

void FreeExecutor::send_text(std::size_t line, const std::string& text) {
  Host& host = *hosts_[line];
  const std::uint64_t before = host.requests();
  put_text(host, text);
  // A line that is too long, or that a fault drops, is never executed.
  const SimTime limit = host.quiet_since() + options_.timeout;
  while (host.requests() == before && world_.now() < limit) advance_to_next(limit);
}

std::vector<std::string> FreeExecutor::exchange_text(std::size_t line, const std::optional<std::string>& text,
                                                     const world::LinesWanted& wanted, SimTime within) {
  Host& host = *hosts_[line];
  SimTime deadline = world_.now() + within;
  if (text) {
    put_text(host, *text);
    deadline = host.quiet_since() + within;
  }
  world::ReceivedLines received = host.lines();
  while (!world::has_come(wanted, received) && world_.now() < deadline) {
    advance_to_next(deadline);
    received = host.lines();
  }
  // Bytes that follow an answer immediately belong to it, even if they are not expected, but at most one more
  // line.
  while (text && world_.now() < deadline && received.finished <= wanted.lines.size()) {
    const std::size_t before = host.line().output().size();
    const SimTime rounding{1};  // a character ends at a whole nanosecond
    world_.advance_to(std::min(world_.now() + host.duration_of(1) + rounding, deadline));
    received = host.lines();
    if (host.line().output().size() == before) break;
  }
  const std::size_t wanted_lines = wanted.lines.size();
  if (!text && wanted_lines > 0 && received.finished >= wanted_lines) {
    host.take_output(received.ends[wanted_lines - 1]);
    received.lines.resize(wanted_lines);
  } else {
    host.discard();
  }
  return received.lines;
}

/// Sends text after the gap. On return, the whole text is on the line's queue, but may not have been sent
/// yet.
void FreeExecutor::put_text(Host& host, const std::string& text) {
  writing_ = nullptr;
  world_.advance_to(world_.now());  // output from an earlier action at this moment comes first
  if (options_.gap > SimTime{0} && host.quiet_since() + options_.gap > world_.now()) {
    world_.advance_to(host.quiet_since() + options_.gap);
  }
  host.discard();
  writing_ = &host;
  requests_before_ = host.requests();
  const std::string line = text + '\r';
  const std::vector<std::uint8_t> bytes(line.begin(), line.end());
  host.keep_busy(world_.now() + host.duration_of(bytes.size()));
  host.send_text(bytes);
}

/// Sends a frame after t3.5 and the gap. On return, the whole frame is on the line's queue, but may not have
/// been sent yet.
void FreeExecutor::send(Host& host, std::span<const std::uint8_t> bytes) {
  writing_ = nullptr;
  for (SimTime start{0}; start = host.quiet_since() + host.silence() + options_.gap, world_.now() < start;) {
    world_.advance_to(start);  // a station may still send something
  }
  host.discard();
  const auto carried = host.is_ascii() ? pty::rtu_of_ascii(bytes) : std::nullopt;
  if (world::is_write(carried ? std::span<const std::uint8_t>(*carried) : bytes)) {
    writing_ = &host;
    requests_before_ = host.requests();
  }
  host.keep_busy(world_.now() + host.duration_of(bytes.size()));
  while (true) {
    const auto part = bytes.first(std::min(bytes.size(), host.line().room()));
    host.send_text(part);
    bytes = bytes.subspan(part.size());
    if (bytes.empty()) break;
    advance_to_next(host.quiet_since());
  }
}

/// Advances to the next event, but not beyond `limit`. Writes are executed at such moments.
void FreeExecutor::advance_to_next(SimTime limit) {
  world_.advance_to(std::min(world_.next_due().value_or(limit), limit));
  if (writing_ == nullptr || writing_->requests() == requests_before_) return;
  requests_before_ = writing_->requests();
  tick_of_last_write_ = tick_at(world_.now()) + 1;
}

}  // namespace understudy::emulator::play
