#include "emulator/edge/daemon.h"

#include <signal.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "emulator/control/messages.h"

namespace understudy::emulator {

namespace {

// Free running and long advances look up from their work this often (wall time), so that ports and the
// control socket are served meanwhile.
constexpr WallTime kWorkSlice = std::chrono::milliseconds(5);
// The kernel tells that a host closes a moment before it has; so much later it has.
constexpr WallTime kSecondLook = std::chrono::milliseconds(5);
// What they do before they look at the clock again.
constexpr SimTime kSimSlice = std::chrono::milliseconds(100);

// An incomplete frame waits 10 ms of the host's time, however fast simulated time runs beside it.
SimTime patience_at(const Speed& speed) {
  constexpr SimTime kPatience = std::chrono::milliseconds(10);
  constexpr double kFreeFactor = 10'000;
  const double factor = speed.kind == Speed::Kind::free ? kFreeFactor : speed.factor;
  return factor <= 1 ? kPatience
                     : SimTime{static_cast<std::int64_t>(static_cast<double>(kPatience.count()) * factor)};
}

WorldOptions world_options(const DaemonOptions& options) {
  return {.strict_framing = options.strict_framing,
          .patience = patience_at(options.speed),
          .enforce_settings = options.enforce_settings};
}

}  // namespace

Daemon::Daemon(const Bench& bench, const DaemonOptions& options, std::function<void(const std::string&)> log)
    : log_(std::move(log)), world_(bench, world_options(options), log_), pacer_(options.speed, wall_now()) {
  watch_signals();
  make_ports(bench);
  const bool asked_for = !options.control_path.empty();
  try {
    const std::string path = asked_for ? options.control_path : default_control_path();
    control_ = std::make_unique<ControlServer>(
        loop_, path, [this](const std::string& line, const ControlServer::Reply& reply) {
          handle_message(*this, line, reply);
        });
  } catch (const ControlError& error) {
    if (asked_for) throw;
    log_(std::string("no control socket: ") + error.what() + " (--control SOCKET gives this one its own)");
  }
}

Daemon::~Daemon() {
  control_.reset();
  ports_.clear();
  if (!private_folder_.empty()) {
    std::error_code ignored;
    std::filesystem::remove(private_folder_, ignored);
  }
  if (signals_ >= 0) close(signals_);
}

const std::string& Daemon::control_path() const {
  static const std::string none;
  return control_ ? control_->path() : none;
}

void Daemon::watch_signals() {
  sigset_t stop;
  sigemptyset(&stop);
  for (const int signal_number : {SIGTERM, SIGINT, SIGHUP}) sigaddset(&stop, signal_number);
  sigprocmask(SIG_BLOCK, &stop, nullptr);
  signals_ = signalfd(-1, &stop, SFD_NONBLOCK | SFD_CLOEXEC);
  loop_.watch(signals_, EventLoop::readable, [this](std::uint32_t) { stopping_ = true; });
}

void Daemon::make_ports(const Bench& bench) {
  for (std::size_t i = 0; i < bench.lines.size(); ++i) {
    std::string link = bench.lines[i].link;
    if (link.empty()) {
      if (private_folder_.empty()) {
        std::string folder = "/tmp/understudy-XXXXXX";
        if (mkdtemp(folder.data()) == nullptr)
          throw pty::PortError(folder + ": cannot be made; expected a writable /tmp");
        private_folder_ = folder;
      }
      link = private_folder_ + "/" + bench.lines[i].name + ".port";
    }
    ports_.push_back(std::make_unique<Port>(
        loop_, world_, i, link, [this] { catch_up(); }, log_));
  }
}

void Daemon::catch_up() { world_.advance_to(std::max(world_.now(), pacer_.target(wall_now()))); }

void Daemon::pause() {
  pacer_.pause(wall_now());
  catch_up();  // to the moment at which the clock stopped
}

void Daemon::resume() { pacer_.resume(wall_now()); }

bool Daemon::advance(SimTime duration, std::function<void()> done) {
  if (!pacer_.standing() || advance_done_) return false;
  advance_target_ = world_.now() + duration;
  advance_done_ = std::move(done);
  return true;
}

void Daemon::work_on_advance() {
  const WallTime until = wall_now() + kWorkSlice;
  while (world_.now() < advance_target_ && wall_now() < until) {
    world_.advance_to(std::min(world_.now() + kSimSlice, advance_target_));
  }
  pacer_.moved_to(world_.now(), wall_now());
  if (world_.now() < advance_target_) return;
  // What the advance has put on the line is on its way before the caller hears that it is over.
  for (const auto& port : ports_) port->flush();
  const std::function<void()> done = std::move(advance_done_);
  advance_done_ = nullptr;
  done();
}

std::optional<WallTime> Daemon::next_wake() const {
  if (advance_done_ || (pacer_.speed().kind == Speed::Kind::free && !pacer_.paused())) return WallTime{0};
  const auto due = world_.next_due();
  return due ? pacer_.wall_time_of(*due) : std::nullopt;
}

void Daemon::wait_until(std::optional<WallTime> planned) {
  const auto in_doubt = [](const std::unique_ptr<Port>& port) { return port->wants_another_look(); };
  if (std::none_of(ports_.begin(), ports_.end(), in_doubt)) return loop_.wait(planned);
  const WallTime look = wall_now() + kSecondLook;
  loop_.wait(planned ? std::min(*planned, look) : look);
  for (const auto& port : ports_) {
    if (in_doubt(port)) port->look_again();
  }
}

void Daemon::run() {
  pacer_.moved_to(world_.now(), wall_now());  // opening the ports took no simulated time
  while (!stopping_) {
    const std::optional<WallTime> planned = next_wake();
    wait_until(planned);
    if (stopping_) break;
    if (advance_done_) {
      work_on_advance();
    } else if (pacer_.speed().kind == Speed::Kind::free && !pacer_.paused()) {
      const WallTime until = wall_now() + kWorkSlice;
      while (wall_now() < until) world_.advance_to(world_.now() + kSimSlice);
      pacer_.moved_to(world_.now(), wall_now());
    } else if (planned) {
      if (const WallTime left_out = pacer_.woke(*planned, wall_now()); left_out > WallTime{0}) {
        log_("stalled: " + format_duration(left_out) + " of simulated time were left out");
      }
      catch_up();
    }
    for (const auto& port : ports_) port->flush();
  }
}

}  // namespace understudy::emulator
