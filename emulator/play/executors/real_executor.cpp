#include "emulator/play/executors/real_executor.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/modbus/modbus_ascii.h"
#include "emulator/device/register_map/row.h"
#include "emulator/play/executors/executor.h"
#include "emulator/play/executors/free_executor.h"
#include "emulator/play/executors/libmodbus_host.h"
#include "emulator/play/executors/modbus_host.h"
#include "emulator/play/executors/write_clock.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/daemon/daemon_thread.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/protocol/line_protocol.h"
#include "emulator/world/protocol/received_lines.h"
#include "emulator/world/view/world_view.h"
#include "emulator/world/world.h"
#include "pty/ascii_frame.h"
#include "pty/line.h"

namespace understudy::emulator::play {

namespace {

// The daemon sleeps until something is due. If a watcher needs every tick, it wakes up at this interval.
constexpr serve::WallTime kCheckInterval = std::chrono::milliseconds(1);
// During a wait, this is the interval for checking whether the scenario was given up.
constexpr serve::WallTime kLongestSleep = std::chrono::milliseconds(50);

}  // namespace

/// On the daemon's thread, watches for a condition for which another thread is waiting.
class RealExecutor::DeadlineWatch final : public world::TickWatcher {
 public:
  DeadlineWatch(const std::function<bool(world::World&)>& is_met, SimTime deadline)
      : is_met_(is_met), deadline_(deadline) {}

  void begin(world::World& world) {
    world_ = &world;
    if (!check(world.now())) world.add_watcher(*this);
  }
  void end(world::World& world) { world.remove_watcher(*this); }
  void on_tick(Tick tick) override {
    if (time_of(tick) <= deadline_) check(time_of(tick));
  }

  /// Waits for at most `patience`. Rethrows an exception from the condition.
  std::optional<SimTime> wait(serve::WallTime patience) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, patience, [this] { return found_at_ || error_; });
    if (error_) std::rethrow_exception(error_);
    return found_at_;
  }

 private:
  bool check(SimTime now) {
    const std::lock_guard lock(mutex_);
    if (found_at_ || error_) return true;
    try {
      if (!is_met_(*world_)) return false;
      found_at_ = now;
    } catch (...) {
      error_ = std::current_exception();
    }
    changed_.notify_all();
    return true;
  }

  const std::function<bool(world::World&)>& is_met_;
  SimTime deadline_;
  world::World* world_ = nullptr;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<SimTime> found_at_;
  std::exception_ptr error_;
};

RealExecutor::RealExecutor(serve::Daemon& daemon, RealExecutorOptions options)
    : daemon_(daemon), options_(options) {
  std::vector<bool> has_silences;
  with_world([&](world::World& world) {
    for (std::size_t i = 0; i < world.line_count(); ++i) {
      lines_.push_back(world.line(i).line.options());
      const world::LineProtocol& protocol = world.line(i).protocol;
      has_silences.push_back(protocol.is_framed_by_silence());
      are_ascii_.push_back(&protocol.protocol() == &kModbusAscii);
    }
  });
  for (std::size_t i = 0; options_.has_hosts && i < lines_.size(); ++i) {
    const SimTime silence = has_silences[i] ? silence_between_frames(lines_[i].settings) : SimTime{0};
    hosts_.push_back(std::make_unique<LibmodbusHost>(daemon_.ports()[i]->terminal()->path(),
                                                     lines_[i].settings, options_.timeout,
                                                     silence + options_.gap));
  }
  with_world([this](world::World& world) { writes_ = std::make_unique<WriteClock>(world); });
}

RealExecutor::RealExecutor(std::unique_ptr<serve::DaemonThread> thread, RealExecutorOptions options)
    : RealExecutor(thread->daemon(), options) {
  own_ = std::move(thread);
}

RealExecutor::~RealExecutor() {
  with_world([this](world::World&) { writes_.reset(); });
}

void RealExecutor::with_world(const std::function<void(world::World&)>& act) {
  const auto act_now = [&] {
    world::World& world = daemon_.world();
    const SimTime before = world.now();
    act(world);
    if (world.now() < before) writes_->restart();
  };
  // If the function is dropped, its promise is broken.
  auto done = std::make_shared<std::promise<void>>();
  std::future<void> is_done = done->get_future();
  bool was_dropped = !daemon_.post([&act_now, done = std::move(done)] {
    try {
      act_now();
      done->set_value();
    } catch (...) {
      done->set_exception(std::current_exception());
    }
  });
  if (!was_dropped) {
    try {
      is_done.get();
    } catch (const std::future_error&) {
      was_dropped = true;
    }
  }
  // The world no longer runs, but its observers must still be removed.
  if (was_dropped) act_now();
}

void RealExecutor::throw_if_given_up() const {
  const bool is_given_up = options_.given_up != nullptr && *options_.given_up;
  if (is_given_up || daemon_.is_over()) throw ExecutionAborted();
}

std::optional<serve::WallTime> RealExecutor::wall_time_until(SimTime time) {
  std::optional<serve::WallTime> there;
  with_world([&](world::World& world) {
    there = world.now() >= time ? serve::WallTime{0} : daemon_.pacer().wall_time_of(time);
  });
  if (!there || *there == serve::WallTime{0}) return there;
  return std::max(*there - serve::wall_now(), serve::WallTime{1});
}

bool RealExecutor::run_until(const Awaited& awaited, SimTime deadline) {
  throw_if_given_up();
  found_at_.reset();
  DeadlineWatch watch(awaited.is_met, deadline);
  struct Watching {
    Watching(RealExecutor& of, DeadlineWatch& watcher) : executor(of), watch(watcher) {
      executor.with_world([&](world::World& world) { watch.begin(world); });
    }
    ~Watching() {
      executor.with_world([&](world::World& world) { watch.end(world); });
    }
    Watching(const Watching&) = delete;
    Watching& operator=(const Watching&) = delete;
    RealExecutor& executor;
    DeadlineWatch& watch;
  };
  const Watching watching(*this, watch);
  while (true) {
    found_at_ = watch.wait(kCheckInterval);
    if (found_at_) return true;
    throw_if_given_up();
    // Requesting the time brings the world up to date and notifies the watchers of every tick up to now.
    const auto rest = wall_time_until(deadline);
    if (rest == serve::WallTime{0}) {
      found_at_ = watch.wait(serve::WallTime{0});
      return found_at_.has_value();
    }
  }
}

void RealExecutor::advance(SimTime by) {
  const SimTime target = now() + by;
  found_at_.reset();
  while (true) {
    throw_if_given_up();
    const auto rest = wall_time_until(target);
    if (rest == serve::WallTime{0}) return;
    std::this_thread::sleep_for(std::min(rest.value_or(kCheckInterval), kLongestSleep));
  }
}

SimTime RealExecutor::now() {
  if (found_at_) return *found_at_;
  SimTime present{0};
  with_world([&](world::World& world) { present = world.now(); });
  return present;
}

Tick RealExecutor::tick_of_last_write() {
  Tick tick = 0;
  with_world([&](world::World&) { tick = writes_->tick_of_last_write(); });
  return tick;
}

LibmodbusHost& RealExecutor::host(std::size_t line) {
  throw_if_given_up();
  if (!options_.has_hosts) {
    throw std::logic_error("a host program uses the lines; expected only steps that do not use a line");
  }
  found_at_.reset();
  return *hosts_[line];
}

HostReply RealExecutor::with_bytes(std::size_t line, HostReply reply) {
  if (reply.kind == HostReply::Kind::garbled)
    with_world([&](world::World&) { reply.bytes = writes_->answer_on(line); });
  return reply;
}

HostReply RealExecutor::read(std::size_t line, int station, Table table, std::uint16_t first, int count) {
  if (are_ascii_[line]) return ask_ascii(line, read_request(station, table, first, count));
  return with_bytes(line, host(line).read(station, table, first, count));
}

HostReply RealExecutor::write(std::size_t line, int station, Table table, std::uint16_t first,
                              std::span<const std::uint16_t> words) {
  if (are_ascii_[line]) return ask_ascii(line, write_request(station, table, first, words));
  return with_bytes(line, host(line).write(station, table, first, words));
}

HostReply RealExecutor::write_message(std::size_t line, int station, std::uint16_t first,
                                      std::span<const std::uint16_t> words) {
  if (are_ascii_[line]) return ask_ascii(line, message_request(station, first, words));
  return with_bytes(line, host(line).write_message(station, first, words));
}

/// Exchanges Modbus ASCII frames, which libmodbus does not support. `request` is the corresponding RTU frame.
HostReply RealExecutor::ask_ascii(std::size_t line, const std::vector<std::uint8_t>& request) {
  const std::vector<std::uint8_t> frame = pty::ascii_of_rtu(request);
  constexpr std::size_t kShortestReply = 11;
  std::vector<std::uint8_t> reply = exchange(line, frame, kShortestReply, options_.timeout);
  // The rest arrives without a request. Every reply ends with LF.
  while (!reply.empty() && reply.back() != '\n') {
    const std::vector<std::uint8_t> more = host(line).receive(options_.timeout);
    if (more.empty()) break;
    reply.insert(reply.end(), more.begin(), more.end());
  }
  return judge_ascii_reply(request, reply);
}

std::vector<std::uint8_t> RealExecutor::exchange(std::size_t line, std::span<const std::uint8_t> bytes,
                                                 std::size_t wanted, SimTime within) {
  LibmodbusHost& on_line = host(line);
  const pty::LineOptions& options = lines_[line];
  const SimTime sending = options.timing == pty::Timing::instant
                              ? SimTime{0}
                              : options.settings.duration_of(static_cast<std::int64_t>(bytes.size()));
  return on_line.exchange(bytes, wanted, sending, within);
}

void RealExecutor::send_text(std::size_t line, const std::string& text) {
  LibmodbusHost& on_line = host(line);
  const auto requests = [&] {
    std::uint64_t sum = 0;
    with_world([&](world::World& world) {
      for (const auto& station : world.line(line).stations) sum += station->counters().requests;
    });
    return sum;
  };
  const std::uint64_t before = requests();
  const SimTime sending = time_to_send(line, text);
  on_line.send_text(text);
  // A line that is too long, or that a fault drops, is never executed.
  const serve::WallTime limit = serve::wall_now() + sending + options_.timeout;
  while (requests() == before && serve::wall_now() < limit) {
    throw_if_given_up();
    std::this_thread::sleep_for(kCheckInterval);
  }
}

std::vector<std::string> RealExecutor::exchange_text(std::size_t line, const std::optional<std::string>& text,
                                                     const world::LinesWanted& wanted, SimTime within) {
  return host(line).exchange_text(text, wanted, text ? time_to_send(line, *text) : SimTime{0}, within);
}

SimTime RealExecutor::time_to_send(std::size_t line, const std::string& text) const {
  const pty::LineOptions& options = lines_[line];
  if (options.timing == pty::Timing::instant) return SimTime{0};
  return options.settings.duration_of(static_cast<std::int64_t>(text.size()) + 1);
}

std::unique_ptr<Executor> make_real_executor(const Scenario& scenario) {
  world::Bench bench = scenario.bench;
  for (world::LineSetup& line : bench.lines) {
    line.link.clear();  // because other runs may use the same link
    line.tcp.clear();
    line.has_pty = true;
  }
  for (world::DeviceSetup& device : bench.devices) device.nv_path.clear();
  serve::DaemonOptions options;
  options.watch_signals = false;
  auto thread = std::make_unique<serve::DaemonThread>(bench, options, [](const std::string&) {});
  thread->start();
  return std::make_unique<RealExecutor>(std::move(thread), RealExecutorOptions{.gap = scenario.gap});
}

}  // namespace understudy::emulator::play
