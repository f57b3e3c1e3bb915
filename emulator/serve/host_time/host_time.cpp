#include "emulator/serve/host_time/host_time.h"

#include <poll.h>
#include <sys/socket.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <ranges>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/files/descriptor.h"
#include "base/simulated_time.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/host_time/host_library.h"
#include "emulator/serve/host_time/host_message.h"
#include "emulator/serve/host_time/host_waits.h"
#include "emulator/serve/host_time/simulated_task.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/serve/loop/listener.h"
#include "emulator/serve/ports/port.h"
#include "emulator/serve/ports/tty_shim.h"
#include "emulator/world/world.h"
#include "pty/host_time/protocol.h"

namespace understudy::emulator::serve {

namespace {

// A host with several threads that is not asleep is checked again after this time, then less and less often.
constexpr WallTime kFirstPoll = std::chrono::microseconds(20);
constexpr WallTime kSlowestPoll = std::chrono::milliseconds(1);
// Time advances for this long before the control socket and signals are served.
constexpr WallTime kSlice = std::chrono::milliseconds(5);
constexpr WallTime kWatch = std::chrono::milliseconds(500);
// A thread that has not waited during this many checks by watch_over() is reported.
constexpr int kPollsBeforeReport = 4;

Descriptor make_timer() {
  Descriptor timer(timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC));
  if (!timer) throw std::system_error(errno, std::generic_category(), "timerfd_create");
  return timer;
}

void set_timer(const Descriptor& timer, WallTime after, WallTime interval = WallTime{0}) {
  const auto spec_of = [](WallTime time) {
    return timespec{time.count() / 1'000'000'000, time.count() % 1'000'000'000};
  };
  const itimerspec setting{spec_of(interval), spec_of(after)};
  timerfd_settime(timer.get(), 0, &setting, nullptr);
}

/// Returns the number of the port's pseudo-terminal, or -1 if it has none.
int terminal_of(const Port& port) {
  if (port.terminal() == nullptr) return -1;
  const std::string& path = port.terminal()->path();  // /dev/pts/N
  return std::atoi(path.c_str() + path.rfind('/') + 1);
}

}  // namespace

HostTime::HostTime(Daemon& daemon, const std::string& place, std::function<void(const std::string&)> report)
    : daemon_(daemon),
      place_(place),
      report_(std::move(report)),
      page_(place + host_time::kPageEnding),
      doors_(daemon, place, page_),
      waits_([this](int number, HostAnswer what, const HostWaits::Thread& thread) {
        answer(number, what, thread);
      }),
      tasks_(daemon.loop(),
             [this](int process) {
               must_poll_ = true;  // the end of the process may have sent a signal
               receive_all();      // the process may have greeted the bench, or executed another program
               judge_end_of(process);
               waits_.process_ended(process);
               timers_.process_ended(process);
               watches_.process_ended(process);
               consider();
             }),
      log_([this](int terminal) { return line_of(terminal); },
           [this](const HostWait& wait) { daemon_.record_wait(wait.thread, wait.begin, wait.text); }),
      lines_(daemon.ports().size()),
      next_poll_(make_timer()),
      watch_(make_timer()) {
  page_.set_now(daemon_.world().now());
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    daemon_.ports()[i]->serve_on_demand();
    lines_[i].terminal = terminal_of(*daemon_.ports()[i]);
    page_.set_line(i, lines_[i].terminal);
  }
  Descriptor socket = listen_locally(place_, SOCK_SEQPACKET);
  listening_ = socket.get();
  listener_ = std::make_unique<Listener>(daemon_.loop(), std::move(socket),
                                         [this](Descriptor client) { admit(std::move(client)); });
  const auto on_timer = [&](const Descriptor& timer, std::function<void()> act) {
    daemon_.loop().watch(timer.get(), EventLoop::readable, [&timer, act = std::move(act)](std::uint32_t) {
      std::uint64_t ignored = 0;
      if (read(timer.get(), &ignored, sizeof ignored) > 0) act();
    });
  };
  daemon_.observers().waits.add_source([this] { return log_.under_way(waits_, line_counts()); });
  daemon_.set_advance_driver([this] { consider(); });
  on_timer(next_poll_, [this] { consider(); });
  on_timer(watch_, [this] { watch_over(); });
  set_timer(watch_, kWatch, kWatch);
}

HostTime::~HostTime() {
  daemon_.set_advance_driver({});
  daemon_.observers().waits.add_source({});
  for (const auto& [number, descriptor] : connections_) daemon_.loop().unwatch(number);
  daemon_.loop().unwatch(next_poll_.get());
  daemon_.loop().unwatch(watch_.get());
  listener_.reset();
  unlink(place_.c_str());
}

std::vector<std::pair<std::string, std::string>> HostTime::environment() const {
  require_host_library(library_path(kHostTimeLibrary));
  return {{"LD_PRELOAD", preload_with(kHostTimeLibrary)}, {host_time::kVariable, place_}};
}

// --- messages ------------------------------------------------------------------------------------

void HostTime::admit(Descriptor client) {
  const int number = client.get();
  daemon_.loop().watch(number, EventLoop::readable, [this, number](std::uint32_t) { on_message(number); });
  connections_.emplace(number, std::move(client));
  waits_.add(number);
}

void HostTime::drop(int number) {
  must_poll_ = true;
  waits_.remove(number);
  daemon_.loop().unwatch(number);
  connections_.erase(number);
}

/// Reads all pending messages. The end of a short-lived program may be noticed before its greeting.
void HostTime::receive_all() {
  listener_->accept_all();
  std::vector<int> numbers;
  for (const auto& [number, connection] : connections_) numbers.push_back(number);
  for (const int number : numbers) {
    while (connections_.contains(number) && on_message(number)) {
    }
  }
}

/// Reports a process whose last program did not load the library.
void HostTime::judge_end_of(int process) {
  if (!greetings_.is_silent(process) || is_host_to_end_ || !greetings_.silent_one_ended(process)) return;
  report_("process " + std::to_string(process) +
          " of the host did not load our library, so it ran in real time; expected programs that keep "
          "LD_PRELOAD");
}

void HostTime::note_process(const host_time::Message& message) {
  using host_time::MessageKind;
  greetings_.on_message(message);
  if (message.what == MessageKind::hello || message.what == MessageKind::child) tasks_.add(message.process);
  const bool is_leaving = message.what == MessageKind::child || message.what == MessageKind::leaves;
  if (!is_leaving || tasks_.knows(message.process) || !greetings_.is_silent(message.process)) return;
  receive_all();  // the thread has already ended
  judge_end_of(message.process);
}

/// Handles a message. Returns false if there was none.
bool HostTime::on_message(int number) {
  host_time::Message message{};
  Descriptor passed;
  const ssize_t size = receive_message(number, message, passed);
  if (size < 0 && (errno == EAGAIN || errno == EINTR)) return false;
  using host_time::MessageKind;
  has_moved_ = true;
  if (std::exchange(was_asleep_, false)) speakers_.clear();
  speakers_.insert(number);
  is_last_message_wait_ = message.what == MessageKind::wait;
  const bool is_good = size == static_cast<ssize_t>(sizeof message) &&
                       (message.what != MessageKind::hello || message.sequence == host_time::kVersion);
  if (!is_good) {
    drop(number);
    consider();
    return true;
  }
  note_process(message);
  if (message.what == MessageKind::timer) timers_.set(message, std::move(passed));
  if (message.what == MessageKind::watch) watches_.set(message);
  waits_.on_message(number, message);
  if (!connections_.contains(number)) return true;
  if (waits_.threads().at(number).state == HostState::gone) {
    drop(number);
  } else if (message.what == MessageKind::wait || message.what == MessageKind::inside ||
             message.what == MessageKind::timer || message.what == MessageKind::watch) {
    consider();
  }
  return true;
}

void HostTime::answer(int number, HostAnswer what, const HostWaits::Thread& thread) {
  if (what == HostAnswer::refuse) return;  // on_message() drops the connection
  host_time::Message message = thread.wait;
  message.what = what == HostAnswer::go ? host_time::MessageKind::go : host_time::MessageKind::cancelled;
  // This cannot block, because a thread has at most a few unread answers.
  [[maybe_unused]] const ssize_t sent = send(number, &message, sizeof message, MSG_DONTWAIT | MSG_NOSIGNAL);
  if (thread.wait.is_on_word != 0 && what == HostAnswer::go) page_.wake(thread.thread);
  tasks_.continues(thread.thread);
}

// --- time ----------------------------------------------------------------------------------------

/// Checks again soon, because no message reports that a thread has gone to sleep.
void HostTime::poll_again() {
  patience_ = std::clamp(patience_ * 2, kFirstPoll, kSlowestPoll);
  set_timer(next_poll_, patience_);
}

/// Returns the kernel's number of the only thread that has sent messages since the host was asleep, if that
/// thread waits only for the bench and signals, and no signal can have arrived.
std::optional<int> HostTime::lone_speaker() const {
  if (speakers_.size() != 1 || !is_last_message_wait_ || must_poll_) return std::nullopt;
  const auto found = waits_.threads().find(*speakers_.begin());
  if (found == waits_.threads().end()) return std::nullopt;
  const HostWaits::Thread& thread = found->second;
  if (thread.state != HostState::waiting || thread.wait.has_others != 0) return std::nullopt;
  return thread.thread;
}

void HostTime::look_at_command() {
  if (is_host_to_end_ || !tasks_.has_command_ended()) return;
  receive_all();
  tasks_.note_ends();
  judge_end_of(greetings_.first_process());
  host_is_to_end();
}

bool HostTime::is_host_asleep() {
  if (is_host_over_) return true;
  if (must_poll_) tasks_.any_may_continue();
  const std::optional<int> speaker = lone_speaker();
  // A thread that has just ended may have woken another thread. Its end is read first, because only threads
  // that exist when time advances are numbered. A thread that has sent a message sleeps until it is answered,
  // so unread messages are checked last.
  const bool is_alone = speaker && tasks_.is_one_thread();
  if ((!is_alone && !tasks_.are_all_asleep(speaker)) || has_unread_messages()) return false;
  // From the end of the command on, time no longer passes, although what it has left behind may still wait.
  if (tasks_.has_command_ended()) return false;
  must_poll_ = false;
  was_asleep_ = true;
  return true;
}

bool HostTime::has_unread_messages() const {
  std::vector<pollfd> entries{{.fd = listening_, .events = POLLIN, .revents = 0}};
  for (const auto& [number, connection] : connections_)
    entries.push_back({.fd = number, .events = POLLIN, .revents = 0});
  return poll(entries.data(), entries.size(), 0) != 0;
}

/// Takes the bytes that the host has written, and notices which ports it has opened and closed.
void HostTime::take_from_host() {
  for (const auto& port : daemon_.ports()) port->attend();
  doors_.attend();
}

/// Passes the lines' output to the host, and ends the waits for it. Returns true if a wait has ended.
bool HostTime::give_to_host() {
  bool has_ended = false;
  doors_.attend();
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    Port& port = *daemon_.ports()[i];
    Seen& seen = lines_[i];
    port.attend();
    const int terminal = terminal_of(port);
    const std::uint64_t bytes_out = port.line().counters().bytes_out;
    const bool has_room = port.room() > 0;
    const bool has_bytes = bytes_out != seen.bytes_out;
    const bool has_news = terminal != seen.terminal || has_bytes || (has_room && !seen.had_room);
    const int before = std::exchange(seen, {terminal, bytes_out, has_room}).terminal;
    if (terminal != before) page_.set_line(i, terminal);
    if (has_news) has_ended = waits_.line_has_news(before) || has_ended;
    if (has_bytes && watches_.line_has_news(before)) must_poll_ = has_ended = true;
    if (port.line().save().input.empty()) has_ended = waits_.line_is_drained(terminal) || has_ended;
  }
  has_ended = doors_.report_news(waits_) || has_ended;
  return waits_.time_is(daemon_.world().now()) || has_ended;
}

/// Sends the signals of expired timers. The threads that they wake give up their waits. Returns true if there
/// were any expired timers.
bool HostTime::expire_timers() {
  const auto expired = timers_.expire(daemon_.world().now());
  for (const HostTimers::Expired& each : expired) send_signal(each);
  must_poll_ = must_poll_ || !expired.empty();
  return !expired.empty();
}

/// Returns the time until which the host and the task need not act, or nothing if time must not advance.
std::optional<SimTime> HostTime::next_stop() const {
  const world::World& world = daemon_.world();
  const SimTime now = world.now();
  std::optional<SimTime> stop = waits_.next_end();
  const auto not_beyond = [&](SimTime time) {
    stop = std::min(stop.value_or(time), std::max(time, now + SimTime{1}));
  };
  if (const auto next = timers_.next()) not_beyond(*next);
  if (const auto next = doors_.due()) not_beyond(*next);
  if (const auto next = task_ != nullptr ? task_->next_act() : std::nullopt) not_beyond(*next);
  for (const auto& port : daemon_.ports()) {
    if (const auto full = port->time_until_full()) not_beyond(now + *full);
    const int terminal = terminal_of(*port);
    if (!waits_.is_line_waited_for(terminal) && !watches_.is_watched(terminal) &&
        !doors_.is_waited_for(*port, waits_))
      continue;
    if (const auto due = port->line().due()) not_beyond(*due);
    const bool may_change = port->world_line().protocol.may_be_unasked() || !world.faults().empty();
    if (may_change && stop) not_beyond(time_of(tick_at(now) + 1));
  }
  if (stop) return stop;
  return world.next_due();  // all threads wait indefinitely, and only a device could wake one
}

bool HostTime::may_time_go() const {
  if (is_host_over_) return daemon_.is_advancing() || (task_ != nullptr && task_->next_act());
  return (waits_.is_any_waiting() || timers_.next() || watches_.is_any()) && !waits_.is_any_outside();
}

void HostTime::consider() {
  if (!may_time_go()) return;
  const bool is_advance = daemon_.is_advancing();
  if ((daemon_.pacer().paused() && !is_advance) || !is_host_asleep()) return poll_again();
  patience_ = WallTime{0};
  const WallTime until = wall_now() + kSlice;
  while (true) {
    page_.set_now(daemon_.world().now());
    if (task_ != nullptr) task_->act(daemon_.world().now());  // before the host, in every run
    // The task has sent a signal: the host reacts to it before time advances.
    if (must_poll_ && !is_host_over_) return poll_again();
    const bool continues = give_to_host();
    if (!may_time_go()) return;
    // A thread that continues may then wait for another thread that is already waiting, and no message would
    // report that.
    if (continues) return poll_again();
    if (expire_timers()) return poll_again();
    for (const auto& port : daemon_.ports()) {
      if (port->is_in_doubt()) return poll_again();
    }
    const auto stop = next_stop();
    if (!stop && !is_advance) return;
    has_moved_ = true;
    if (!is_host_over_) log_.begin(waits_, line_counts(), daemon_.world().now());
    if (is_advance) {
      daemon_.work_on_advance(stop.value_or(kHorizon));
    } else {
      daemon_.advance_at_once(*stop);
    }
    log_.end(line_counts(), daemon_.world().now());
    if (!is_advance && daemon_.is_held()) return poll_again();
    if (is_advance) let_host_act();
    if (is_advance || wall_now() >= until) {
      set_timer(next_poll_, WallTime{1});
      return;
    }
  }
}

/// Ends the waits that are over now. An advance may end here, and the clock stop: the host gets its turn
/// first.
void HostTime::let_host_act() {
  page_.set_now(daemon_.world().now());
  give_to_host();
  expire_timers();
}

void HostTime::run_beside(SimulatedTask* task) {
  task_ = task;
  if (task != nullptr) consider();
}

void HostTime::host_ended() {
  take_from_host();
  log_.finish(line_counts());
  is_host_over_ = true;
  receive_all();  // the end of a short-lived host may be noticed before its greeting
  judge_end_of(greetings_.first_process());
  if (const auto left = tasks_.left_one()) {
    report_(*left +
            " continues in the background although the command has ended, and simulated time ends with the "
            "command; expected a host that runs in the foreground");
  }
  if (task_ != nullptr && !task_->next_act()) task_->act(daemon_.world().now());  // it may wait for this
  consider();
}

HostWaitLog::Lines HostTime::line_counts() const {
  HostWaitLog::Lines counts;
  for (const auto& port : daemon_.ports()) {
    const auto& line = port->line();
    counts.push_back({line.name(), line.counters().bytes_in, line.counters().bytes_out});
  }
  return counts;
}

std::size_t HostTime::line_of(int terminal) const {
  if (terminal >= host_time::kFirstDoor) {
    const auto door = static_cast<std::size_t>(terminal - host_time::kFirstDoor);
    return door < daemon_.doors().size() ? daemon_.doors()[door]->port().line_number() : lines_.size();
  }
  const auto found = std::ranges::find(lines_, terminal, &Seen::terminal);
  return static_cast<std::size_t>(found - lines_.begin());
}

/// Reports once that a thread does not wait, and once that all threads wait for something outside the bench.
void HostTime::watch_over() {
  idle_polls_ = std::exchange(has_moved_, false) ? 0 : idle_polls_ + 1;
  if (idle_polls_ < kPollsBeforeReport || is_host_over_) return;
  const auto running = tasks_.running_one();
  const bool is_outside =
      waits_.is_any_outside() || (!waits_.is_any_for_bench() && !timers_.next() && !watches_.is_any());
  if (!running && is_outside && !std::exchange(has_reported_outside_, true)) {
    report_(
        "the host waits for something outside the bench, such as standard input or another machine, so the "
        "clock is stopped");
  }
  if (!running || std::exchange(has_reported_spinning_, true)) return;
  report_(*running +
          " does not wait, so the clock is stopped; expected a wait that the bench can end, such as poll or "
          "sleep");
}

}  // namespace understudy::emulator::serve
