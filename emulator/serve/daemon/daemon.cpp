#include "emulator/serve/daemon/daemon.h"

#include <signal.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/growing_file.h"
#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/serve/daemon/nv_keeper.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/serve/loop/pacer.h"
#include "emulator/serve/ports/port.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench/bench_text.h"
#include "emulator/world/events/event_log.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/recording/recording_spool.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/snapshot_file.h"
#include "emulator/world/trace/trace_file.h"
#include "emulator/world/trace/world_capture.h"
#include "emulator/world/world.h"

namespace understudy::emulator::serve {

namespace {

// Free running and long advances pause after this much wall time, so that ports and the control socket are
// served.
constexpr WallTime kWorkSlice = std::chrono::milliseconds(5);
// Bytes get the world's time, so the daemon may take longer to catch up before they are received.
constexpr WallTime kWorkForBytes = std::chrono::milliseconds(100);
// A host that reads more slowly than time passes is checked again after this time.
constexpr WallTime kReadingTime = std::chrono::milliseconds(1);
// A trace samples every tick, so a long quiet span takes a long time. It is handled in pieces of this length.
constexpr SimTime kTracedSpan = std::chrono::milliseconds(100);
// The first step of simulated time between two checks of the wall clock.
constexpr SimTime kSimSlice = std::chrono::milliseconds(100);

// The log keeps some seconds of a busy line for observers.
constexpr std::size_t kFramesKept = 1024;

// Returns the patience in simulated time, which may pass faster than the host's time.
SimTime patience_at(const Speed& speed) {
  const double factor = std::max(1.0, speed.rate());
  return SimTime{static_cast<std::int64_t>(static_cast<double>(world::kFramePatience.count()) * factor)};
}

world::WorldOptions world_options(const DaemonOptions& options) {
  return {.strict_framing = options.strict_framing,
          .patience = options.patience.value_or(patience_at(options.speed)),
          .enforce_settings = options.enforce_settings};
}

}  // namespace

Daemon::Daemon(const world::Bench& bench, const DaemonOptions& options,
               std::function<void(const std::string&)> log)
    : log_(std::move(log)),
      world_(bench, world_options(options), log_),
      frames_(world_, kFramesKept),
      missing_stations_(world_, log_),
      observers_(world_, frames_),
      bench_path_(options.bench_path),
      bench_hash_(world::bench_hash(bench)),
      files_(options.files),
      pacer_(options.speed, wall_now()) {
  frames_.set_observer([this](const pty::CapturedPacket& packet) { missing_stations_.check(packet); });
  if (options.watch_signals) watch_signals();
  watch_posts();
  make_ports(bench);
  watch_presence();
  make_doors(bench, options.is_host_simulated ? TcpDoor::Service::on_demand : TcpDoor::Service::at_once);
  if (options.door) door_ = options.door(*this, log_);
  memories_ = std::make_unique<NvKeeper>(bench, world_, log_);
  // This must be last: a run that cannot start must not change the files of an earlier run.
  open_files(bench, options);
}

Daemon::~Daemon() {
  helper_.reset();
  door_.reset();
  doors_.clear();
  ports_.clear();
  memories_.reset();
  trace_.reset();
  if (recording_) recording_->finish();
  recording_.reset();
  capture_.reset();
  if (signals_ >= 0) close(signals_);
  if (posted_signal_ >= 0) close(posted_signal_);
}

const std::string& Daemon::control_path() const {
  static const std::string none;
  return door_ ? door_->path() : none;
}

void Daemon::watch_signals() {
  sigset_t stop;
  sigemptyset(&stop);
  for (const int signal_number : {SIGTERM, SIGINT, SIGHUP}) sigaddset(&stop, signal_number);
  sigprocmask(SIG_BLOCK, &stop, nullptr);
  signals_ = signalfd(-1, &stop, SFD_NONBLOCK | SFD_CLOEXEC);
  loop_.watch(signals_, EventLoop::readable, [this](std::uint32_t) { stopping_ = true; });
}

void Daemon::record_wait(std::size_t thread, SimTime since, const std::string& text) {
  using What = world::RecordedEvent::What;
  observers_.waits.keep({.thread = thread, .begin = since, .end = world_.now(), .text = text});
  if (recording_) recording_->note({.what = What::wait, .since = since, .where = thread, .text = text});
}

FileClaims Daemon::files() const {
  FileClaims files = files_;
  for (const auto& port : ports_) {
    if (port->terminal() == nullptr) continue;
    const std::string line = "of line " + understudy::quoted(world_.line(port->line_number()).line.name());
    files.add_place({port->terminal()->link_path(), "the link " + line});
    files.add_place({port->terminal()->path(), "the port " + line});
  }
  files.add_place({control_path(), "the control socket"});
  return files;
}

/// Opens all files before any of them is emptied.
void Daemon::open_files(const world::Bench& bench, const DaemonOptions& options) {
  if (!options.capture_path.empty()) {
    capture_ = std::make_unique<world::WorldCapture>(world_, options.capture_path, log_);
  }
  std::unique_ptr<GrowingFile> recording;
  if (!options.record_path.empty()) {
    recording = std::make_unique<GrowingFile>(options.record_path, ContentKind::recording, log_);
  }
  if (!options.trace_path.empty()) {
    trace_ = std::make_unique<world::TraceFile>(world_, options.trace_path, options.trace_also, log_);
  }
  if (capture_) capture_->begin();
  if (recording) {
    const world::RecordingHeader header{.version = options.version,
                                        .bench = world::to_text(bench),
                                        .options = world_options(options),
                                        .seed = bench.seed,
                                        .snapshot = {}};
    recording_ = std::make_unique<world::RecordingSpool>(world_, header, std::move(recording),
                                                         options.record_cap_bytes, log_);
  }
  if (trace_) trace_->begin();
}

void Daemon::catch_up() { catch_up(kWorkSlice); }

void Daemon::catch_up_for_bytes() { catch_up(kWorkForBytes); }

void Daemon::catch_up(WallTime longest) {
  const WallTime now = wall_now();
  judge_stall(now);
  const bool is_free = pacer_.speed().kind == Speed::Kind::free;
  const SimTime target = std::max(world_.now(), pacer_.target(now));
  if (work_towards(target, now + (is_free ? kWorkSlice : longest))) return;
  if (world_.now() >= target) {
    behind_since_.reset();
  } else if (is_free) {
    pacer_.moved_to(world_.now(), wall_now());  // as fast as possible: lost time is not made up for
  } else if (!behind_since_) {
    behind_since_ = now;
  }
}

/// Checks for a stall. Must run before anything catches up with the elapsed time.
void Daemon::judge_stall(WallTime now) {
  if (!planned_) return;
  const WallTime planned = *std::exchange(planned_, std::nullopt);
  const WallTime left_out = pacer_.woke(planned, now);
  if (behind_since_) *behind_since_ += left_out;
  // Every long stall is logged. Repeated short slips of a slow machine are logged less and less often.
  const bool worth_a_line = left_out >= Pacer::kLongestStall || (pacer_.slips() & (pacer_.slips() - 1)) == 0;
  if (left_out > WallTime{0} && worth_a_line) {
    log_("stalled: " + format_duration(left_out) + " of simulated time was skipped (stall number " +
         std::to_string(pacer_.slips()) + ")");
  }
}

/// Stops the clock if the debugger has stopped the world. Returns true in that case.
bool Daemon::is_held() {
  if (!observers_.debugger.take_stop()) return false;
  if (advance_done_) advance_target_ = world_.now();
  // At manual speed the clock is stopped anyway, unless the waits of a host move it.
  if (!pacer_.standing() || is_host_timed()) pacer_.pause(wall_now());
  pacer_.moved_to(world_.now(), wall_now());
  behind_since_.reset();
  return true;
}

/// Advances the world to `target`, or until the wall clock reaches `until`. Steps become longer, so that
/// quiet spans pass quickly. Returns true if the debugger has stopped the world.
bool Daemon::work_towards(SimTime target, WallTime until) {
  for (SimTime step = kSimSlice; world_.now() < target; step *= 2) {
    if (is_held()) return true;
    step = std::min(step, longest_step());
    world_.advance_to(target - world_.now() > step ? world_.now() + step : target);
    if (is_held()) return true;
    if (world_.now() >= target || wall_now() >= until || waits_for_hosts()) return false;
  }
  return false;
}

void Daemon::pause() {
  if (advance_done_) advance_target_ = world_.now();  // ends the advance here, with a reply
  judge_stall(wall_now());
  pacer_.pause(wall_now());
  catch_up();                                 // to the moment at which the clock was stopped
  pacer_.moved_to(world_.now(), wall_now());  // the world may not have reached that moment
  behind_since_.reset();
}

bool Daemon::set_speed(const Speed& speed) {
  if (advance_done_) return false;
  judge_stall(wall_now());
  catch_up();
  pacer_.set_speed(speed, wall_now());
  pacer_.moved_to(world_.now(), wall_now());  // time lost at the earlier speed is not made up for
  behind_since_.reset();
  return true;
}

bool Daemon::resume() {
  if (advance_done_) return false;
  pacer_.resume(wall_now());
  return true;
}

bool Daemon::advance(SimTime duration, std::function<void()> done, std::function<bool()> is_met) {
  if (!pacer_.standing() || advance_done_ || duration > kHorizon - world_.now()) return false;
  advance_target_ = world_.now() + duration;
  advance_is_met_ = std::move(is_met);
  advance_done_ = std::move(done);
  return true;
}

/// Advances tick by tick, for a slice of wall time at most. When the condition becomes true, the target moves
/// to the present.
void Daemon::work_towards_condition(SimTime limit) {
  const WallTime until = wall_now() + kWorkSlice;
  while (world_.now() < std::min(limit, advance_target_) && wall_now() < until && !is_held()) {
    if (advance_is_met_()) {
      advance_target_ = world_.now();
      return;
    }
    world_.advance_to(std::min({limit, advance_target_, time_of(tick_at(world_.now()) + 1)}));
    if (is_held()) return;
    if (waits_for_hosts()) return;
  }
}

/// Returns true if time passes as fast as possible. A host may then not be able to read in time.
bool Daemon::makes_time_go() const {
  return advance_done_ != nullptr || pacer_.speed().kind == Speed::Kind::free;
}

/// Returns the longest step in which no line sends more bytes than it can buffer.
SimTime Daemon::longest_step() const {
  SimTime longest = kHorizon / 4;
  if (!makes_time_go()) return longest;
  for (const auto& port : ports_) longest = std::min(longest, port->time_until_full().value_or(longest));
  return longest;
}

/// Returns true if a host must read or write before time continues.
bool Daemon::waits_for_hosts() {
  if (!makes_time_go()) return false;
  bool waits = false;
  for (const auto& port : ports_) waits = port->is_waited_for() || waits;
  return waits;
}

void Daemon::work_on_advance(SimTime limit) {
  if (advance_is_met_) {
    work_towards_condition(limit);
  } else {
    work_towards(std::min(limit, advance_target_), wall_now() + kWorkSlice);
  }
  pacer_.moved_to(world_.now(), wall_now());
}

void Daemon::go_on_with_advance() {
  if (world_.now() < advance_target_) advance_driver_ ? advance_driver_() : work_on_advance(advance_target_);
  if (world_.now() < advance_target_) return;
  // The line's output is sent before the caller learns that the advance is over.
  for (const auto& port : ports_) port->flush();
  const std::function<void()> done = std::move(advance_done_);
  advance_done_ = nullptr;
  advance_is_met_ = nullptr;
  done();
}

std::string_view Daemon::why_no_restore() const {
  if (advance_done_) return "time is being advanced; expected `restore` after that";
  if (recording_) return "a recording is in progress and cannot go back in time; expected no recording";
  if (trace_) return "a trace is in progress and cannot go back in time; expected no trace";
  return {};
}

void Daemon::restart_logs(std::vector<world::FrameLog::Frame> frames, std::vector<world::Event> events) {
  frames_.restart_after(std::move(frames));
  observers_.events.restored_after(std::move(events));
}

void Daemon::restore(const world::WorldState& state) {
  world::restore(world_, state);
  frames_.restart();
  observers_.events.restored();
  ++observers_.restores;
  if (observers_.scope) observers_.scope->restart();
  observers_.debugger.restart();
  observers_.course.reset();
  planned_.reset();
  behind_since_.reset();
  pacer_.moved_to(world_.now(), wall_now());
  for (const auto& port : ports_) port->world_restored();
  memories_->world_restored();
}

std::optional<WallTime> Daemon::next_wake() const {
  const auto due = world_.next_due();
  if (!trace_ && !observers_.debugger.is_watching()) return due ? pacer_.wall_time_of(*due) : std::nullopt;
  return pacer_.wall_time_of(std::min(due.value_or(kHorizon), world_.now() + kTracedSpan));
}

void Daemon::wait() {
  // An advance is work in progress, not a planned wake-up. The same applies to catching up: its lateness
  // counts from its beginning, not from the remaining simulated time, which may include a long sleep.
  planned_ = advance_done_ ? std::nullopt : behind_since_ ? behind_since_ : next_wake();
  std::optional<WallTime> wake = advance_done_ && !advance_driver_ ? WallTime{0} : planned_;
  if (waits_for_hosts()) wake = wall_now() + kReadingTime;
  for (const auto& port : ports_) {
    const auto next = port->next_poll(pacer_.standing());
    if (next && (!wake || *next < *wake)) wake = next;
  }
  if (const auto next = memories_->next_poll(); next && (!wake || *next < *wake)) wake = next;
  const bool can_be_late = !makes_time_go() && !behind_since_;
  loop_.wait(wake, can_be_late ? EventLoop::kLaterSlice : EventLoop::kLongSlice);
}

void Daemon::run() {
  struct Leaving {
    ~Leaving() { daemon.end_posts(); }
    Daemon& daemon;
  } const leaving{*this};
  pacer_.moved_to(world_.now(), wall_now());  // opening the ports took no simulated time
  while (!stopping_) {
    wait();
    if (stopping_) break;
    if (advance_done_) {
      go_on_with_advance();
    } else if (planned_) {
      catch_up();
    }
    const WallTime now = wall_now();
    for (const auto& port : ports_) {
      port->poll(now, pacer_.standing());
      port->flush();
    }
    memories_->poll(now);
    if (recording_) recording_->poll();
  }
  // The recording or trace of an idle bench must end now, not at its last event.
  if (!advance_done_) catch_up();
}

}  // namespace understudy::emulator::serve
