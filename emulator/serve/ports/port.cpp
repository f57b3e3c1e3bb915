#include "emulator/serve/ports/port.h"

#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/world/protocol/line_protocol.h"
#include "emulator/world/view/world_view.h"
#include "emulator/world/world.h"
#include "pty/line.h"
#include "pty/line_observer.h"
#include "pty/line_settings.h"
#include "pty/port_link.h"
#include "pty/presence_watch.h"
#include "pty/station.h"

namespace understudy::emulator::serve {

namespace {

// The kernel reports that a host closes the terminal shortly before this takes effect. After this time, it
// has taken effect.
constexpr WallTime kSecondPoll = std::chrono::milliseconds(5);

// The interval of checks if the kernel does not report opening and closing of a terminal.
constexpr WallTime kUnwatchedPoll = std::chrono::milliseconds(50);

// A host that has not read anything for this long is considered as not reading.
constexpr WallTime kStillReads = std::chrono::milliseconds(200);

// The capacity of the kernel's buffer (20,480 bytes) plus one read, so a host that leaves loses nothing. If
// hosts write and leave faster than the line transmits their bytes, the excess is lost.
constexpr std::size_t kLeftoverCapacity = 20'480 + pty::Line::kInputCapacity;

}  // namespace

/// Takes the output of a world that runs fast and sends more bytes at once than its line can buffer. Passes
/// faults on to guests, which apply them themselves.
class Port::Overflow final : public pty::LineObserver {
 public:
  explicit Overflow(Port& port) : port_(port) { port_.world_.add_observer(port_.line_number_, *this); }
  ~Overflow() override { port_.world_.remove_observer(port_.line_number_, *this); }
  Overflow(const Overflow&) = delete;
  Overflow& operator=(const Overflow&) = delete;

  void on_output_full() override { port_.hand_over(); }
  void on_strike(const pty::StruckMessage& message) override {
    if (port_.guest_ == nullptr || !message.is_reply) return;
    for (const pty::Strike& strike : message.strikes) {
      const auto found = port_.world_.faults().find(strike.fault);
      if (found != port_.world_.faults().end()) port_.guest_->spoil(found->second.fault);
    }
  }
  void on_start_bit(SimTime) override {}
  void on_character(const pty::TimedByte&, bool) override {}
  void on_nothing_more() override {}
  void on_transmission(const pty::Transmission&) override {}
  std::optional<SimTime> due() const override { return std::nullopt; }
  void run(SimTime) override {}
  std::size_t quiet_characters() const override { return pty::Line::kInputCapacity; }

 private:
  Port& port_;
};

Port::Port(EventLoop& loop, world::World& world, std::size_t line_number, const Link& link,
           std::shared_ptr<pty::PresenceWatch> presence, std::function<void()> catch_up,
           std::function<void(const std::string&)> log)
    : loop_(loop),
      world_(world),
      line_number_(line_number),
      catch_up_(std::move(catch_up)),
      log_(std::move(log)),
      link_(link),
      presence_(std::move(presence)),
      overflow_(std::make_unique<Overflow>(*this)) {
  if (!link_) return;
  terminal_.emplace(*link_, presence_);
  watch();
}

void Port::watch() {
  if (is_on_demand_) return terminal_->settle_writes();
  loop_.watch(terminal_->data_descriptor(), EventLoop::readable, [this](std::uint32_t ready) {
    on_data(ready);
    keep_watch();
  });
  is_watching_ = true;
}

void Port::unwatch() {
  if (!is_watching_) return;
  loop_.unwatch(terminal_->data_descriptor());
  is_watching_ = false;
}

void Port::serve_on_demand() {
  is_on_demand_ = true;
  if (!terminal_) return;
  unwatch();
  terminal_->settle_writes();
}

void Port::attend() {
  if (terminal_ && is_terminal_ignored()) ignore_terminal();
  if (!terminal_ || is_terminal_ignored()) return flush();
  on_presence({});
  constexpr int kMaxReadings = 64;  // more than the kernel's buffer contains
  for (int i = 0; i < kMaxReadings && terminal_ && room() > 0; ++i) {
    const std::uint64_t before = line().counters().bytes_in;
    on_data(EventLoop::readable);
    if (line().counters().bytes_in == before) break;
  }
  keep_watch();
  flush();
}

/// Stops watching a lost terminal, which would report its hang-up endlessly, and tries to recover it.
void Port::keep_watch() {
  if (!terminal_) return;  // a fault has just unplugged the port
  if (!terminal_->is_lost()) {
    if (!is_watching_ && !is_on_demand_) watch();
    return;
  }
  unwatch();
  const std::string path_before = terminal_->path();
  if (!terminal_->recover()) {
    next_recovery_ = wall_now() + kRecovery;
    return;
  }
  next_recovery_ = WallTime{0};
  watch();
  if (terminal_->path() != path_before) {
    log_("line " + line().name() + ": a host exited and left " + path_before +
         " claimed (TIOCEXCL), so no other program can open it; the new port is " + terminal_->path());
  }
}

Port::~Port() { unwatch(); }

void Port::follow_hosts() {
  if (!terminal_ || !is_watching_ || !terminal_->has_presence_news()) return;
  on_presence({});
  keep_watch();
}

/// Tells the line which hosts connected and disconnected. `bytes` were read just before.
void Port::on_presence(std::span<const std::uint8_t> bytes) {
  if (is_terminal_ignored()) return ignore_terminal();
  const pty::PseudoTerminal::Presence presence = terminal_->poll_presence();
  if (!presence.opened && !presence.closed) return receive(bytes);
  catch_up_();
  // If both are reported, either one host left and another came, or one came and has already left.
  if (presence.closed && terminal_->host_present()) world_.host_closed(line_number_);
  if (presence.opened) world_.host_opened(line_number_);
  if (presence.closed && !terminal_->host_present()) {
    world_.host_settings(line_number_, terminal_->poll_host_settings());
    world_.host_closed(line_number_);
    add_leftover(bytes);
    keep_leftover();
  } else {
    receive(bytes);
  }
}

/// Keeps the bytes that a host wrote before it closed the terminal. They are still served, but must not count
/// as the next host's input.
void Port::keep_leftover() {
  std::array<std::uint8_t, pty::Line::kInputCapacity> bytes;
  while (!terminal_->host_present()) {
    const std::size_t count = terminal_->read(bytes);
    if (terminal_->host_present()) {
      // If the next host came during the read, these may be its bytes, and it must get its reply. If they
      // have to wait for leftover bytes, they are served in order, but without a reply.
      pass_on_leftover();
      const auto read = std::span(bytes).first(count);
      if (leftover_.empty() && count <= line().room()) return on_presence(read);
      add_leftover(read);
      return on_presence({});
    }
    if (count == 0) break;
    add_leftover(std::span(bytes).first(count));
  }
  pass_on_leftover();
}

void Port::add_leftover(std::span<const std::uint8_t> bytes) {
  const auto taken = bytes.first(std::min(bytes.size(), kLeftoverCapacity - leftover_.size()));
  leftover_.insert(leftover_.end(), taken.begin(), taken.end());
}

/// Passes on leftover bytes before the bytes of the next host, as on a real line. A loop is necessary because
/// with instant timing the line has room again immediately, and nothing would wake the event loop for the
/// rest.
void Port::pass_on_leftover() {
  while (const std::size_t count = std::min(leftover_.size(), line().room())) {
    catch_up_();
    world_.receive_departed(line_number_, std::span(leftover_).first(count));
    leftover_.erase(leftover_.begin(), leftover_.begin() + static_cast<std::ptrdiff_t>(count));
    world_.advance_to(world_.now());
  }
}

/// Discards bytes that others write to the pseudo-terminal while a guest uses the line, or while all hosts
/// are ignored.
void Port::ignore_terminal() {
  if (terminal_->poll_presence().opened)
    log_("line " + line().name() + ": a host has opened " + terminal_->path() +
         (hosts_are_ignored_
              ? ", but this is a recording; the host is ignored until `what-if`"
              : ", but a TCP client has the line; the host is ignored until the client disconnects"));
  std::array<std::uint8_t, pty::Line::kInputCapacity> ignored;
  constexpr int kMaxReadings = 32;  // enough for all bytes in the kernel's buffer
  for (int i = 0; i < kMaxReadings && terminal_->read(ignored) > 0; ++i) {
  }
}

void Port::on_data(std::uint32_t ready) {
  if (is_terminal_ignored()) return ignore_terminal();
  if (!terminal_->holds_slave()) on_presence({});  // the event may be a hang-up
  if ((ready & EventLoop::readable) != 0 && leftover_.empty()) {
    std::array<std::uint8_t, pty::Line::kInputCapacity> bytes;
    const std::size_t count = terminal_->read(std::span(bytes).first(line().room()));
    if (terminal_->has_presence_news()) {
      on_presence(std::span(bytes).first(count));
    } else {
      receive(std::span(bytes).first(count));
    }
  }
  flush();
}

void Port::receive(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return;
  catch_up_();
  take_in(bytes, terminal_->poll_host_settings());
}

void Port::take_in(std::span<const std::uint8_t> bytes, const std::optional<pty::HostSettings>& settings) {
  if (host_present()) world_.host_settings(line_number_, settings);
  world_.receive(line_number_, bytes);
  world_.advance_to(world_.now());
  last_bytes_ = wall_now();
  has_paused_ = false;
}

/// Returns how long to wait for the rest of a frame, by the host's clock.
WallTime Port::patience() const {
  const pty::RtuFraming& framing = world_line().framing;
  const bool waits_longer = has_paused_ && framing.patience > SimTime{0};
  if (!waits_longer) return world::kFramePatience;
  return world::kFramePatience * std::max<std::int64_t>(framing.rest_patience / framing.patience, 1);
}

std::optional<WallTime> Port::next_poll(bool clock_stands) {
  if (next_recovery_ > WallTime{0}) return next_recovery_;
  const bool is_in_doubt = terminal_ && terminal_->is_in_doubt();
  if (!is_in_doubt && (!terminal_ || terminal_->is_watched())) {
    next_presence_ = WallTime{0};
  } else if (next_presence_ == WallTime{0}) {
    next_presence_ = wall_now() + (is_in_doubt ? kSecondPoll : kUnwatchedPoll);
  }
  std::optional<WallTime> next;
  if (next_presence_ > WallTime{0}) next = next_presence_;
  if (is_on_demand_) return next;
  if (terminal_ && terminal_->has_presence_news()) next = WallTime{0};  // another port has collected the news
  // While the clock is stopped, the timeout of an incomplete frame would never expire.
  if (clock_stands && last_bytes_ > WallTime{0} && line().due())
    next = std::min(next.value_or(WallTime::max()), last_bytes_ + patience());
  return next;
}

void Port::poll(WallTime now, bool clock_stands) {
  if (next_recovery_ > WallTime{0} && now >= next_recovery_) terminal_ ? keep_watch() : follow_plug();
  follow_hosts();
  if (next_presence_ > WallTime{0} && now >= next_presence_) {
    next_presence_ = WallTime{0};
    on_presence({});
    keep_watch();
  }
  // The second call is necessary because an incomplete frame waits longer after the first pause.
  if (clock_stands && !is_on_demand_ && last_bytes_ > WallTime{0} && now >= last_bytes_ + patience()) {
    if (std::exchange(has_paused_, true)) last_bytes_ = WallTime{0};
    world_.nothing_more(line_number_);
  }
}

void Port::ignore_hosts(bool ignored) {
  if (std::exchange(hosts_are_ignored_, ignored) == ignored) return;
  if (!ignored) world_restored();
}

void Port::world_restored() {
  if (hosts_are_ignored_) return flush();
  if (line().is_host_open() != host_present()) {
    if (host_present()) {
      world_.host_opened(line_number_);
    } else {
      world_.host_closed(line_number_);
    }
  }
  world_.host_settings(line_number_, host_settings());
  last_bytes_ = wall_now();  // a frame may be incomplete
  has_paused_ = false;
  flush();
}

void Port::hand_over() {
  while (!line().output().empty()) {
    const std::span<const std::uint8_t> sent = line().output();
    const std::size_t taken = hosts_are_ignored_  ? sent.size()
                              : guest_ != nullptr ? guest_->take(sent)
                              : terminal_         ? terminal_->write(sent)
                                                  : sent.size();  // no host reads the bytes
    if (taken == 0) break;                                // the host does not read
    world_.take_output(line_number_, taken);
    last_taken_ = wall_now();
  }
}

bool Port::is_waited_for() {
  const bool was_listening = is_listening_;
  if (was_listening && line().output().empty()) return false;
  flush();
  if (!was_listening && is_listening_) return true;
  return host_present() && !line().output().empty() && wall_now() < last_taken_ + kStillReads;
}

std::optional<SimTime> Port::time_until_full() const {
  const world::WorldLine& line = world_.line(line_number_);
  if (!host_present() || (!line.protocol.may_be_unasked() && !line.line.due())) return std::nullopt;
  return line.line.options().settings.duration_of(pty::Line::kOutputCapacity);
}

void Port::flush() {
  follow_plug();
  if (!leftover_.empty()) pass_on_leftover();
  hand_over();
  is_listening_ = room() > 0;
  if (guest_ != nullptr) return guest_->follow();
  if (!terminal_) return;
  const std::uint32_t interest =
      (is_listening_ ? EventLoop::readable : 0U) | (line().output().empty() ? 0U : EventLoop::writable);
  loop_.change_interest(terminal_->data_descriptor(), interest);
}

// --- guests --------------------------------------------------------------------------------------

bool Port::admit(Guest& guest) {
  if (is_unplugged() || hosts_are_ignored_) return false;
  if (terminal_ && (is_watching_ || is_on_demand_)) on_presence({});  // it may have just been opened
  if (host_present()) return false;
  catch_up_();
  guest_ = &guest;
  guest_settings_.reset();
  if (terminal_ && is_watching_) loop_.change_interest(terminal_->data_descriptor(), EventLoop::readable);
  world_.host_opened(line_number_);
  return true;
}

void Port::leave(std::span<const std::uint8_t> last) {
  if (terminal_ && (is_watching_ || is_on_demand_)) ignore_terminal();
  catch_up_();
  guest_ = nullptr;
  if (hosts_are_ignored_) return flush();
  world_.host_closed(line_number_);
  add_leftover(last);
  if (terminal_ && terminal_->host_present()) world_.host_opened(line_number_);
  flush();
}

void Port::take_from_guest(std::span<const std::uint8_t> bytes, const pty::HostSettings& settings) {
  if (hosts_are_ignored_) return;
  catch_up_();
  guest_settings_ = settings;
  take_in(bytes, guest_settings_);
  flush();
}

void Port::discard_input() {
  if (hosts_are_ignored_) return;
  catch_up_();
  world_.host_purged(line_number_);
}

void Port::discard_output() {
  if (hosts_are_ignored_) return;
  catch_up_();
  world_.take_output(line_number_, line().output().size());
}

std::optional<pty::HostSettings> Port::host_settings() const {
  return guest_ != nullptr ? guest_settings_ : terminal_ ? terminal_->poll_host_settings() : std::nullopt;
}

std::string Port::place() const { return link_ ? *link_ : tcp_places_.empty() ? "" : tcp_places_.front(); }

}  // namespace understudy::emulator::serve
