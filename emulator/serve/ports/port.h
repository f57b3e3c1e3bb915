// Connects one line of the world to its host, which is either a program that has opened the pseudo-terminal,
// or a Guest such as a TCP client. Only bytes are exchanged here; effects at this boundary (a slow host, a
// full buffer) never reach the model.
#pragma once

#include <sys/stat.h>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "emulator/serve/loop/event_loop.h"
#include "emulator/world/world.h"
#include "pty/pseudo_terminal.h"

namespace understudy::emulator::serve {

class Port {
 public:
  /// The path of the link to the port's pseudo-terminal; nothing: the port has only guests.
  using Link = std::optional<std::string>;
  /// Ports that are served together share a `presence` watch. When it has collected something, call
  /// follow_hosts() for each port. `catch_up` brings the world to the present moment; `log` receives messages
  /// for the user. Throws pty::PortError.
  Port(EventLoop& loop, world::World& world, std::size_t line_number, const Link& link,
       std::shared_ptr<pty::PresenceWatch> presence, std::function<void()> catch_up,
       std::function<void(const std::string&)> log);
  ~Port();
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;

  /// From now on, only attend() reads the host's bytes and notices when the host opens or closes the port,
  /// because a host in simulated time is served when it waits.
  void serve_on_demand();
  /// Ignores hosts, or stops ignoring them. While hosts are ignored, nothing that they do affects the line,
  /// they get nothing from it, and nobody can become a guest.
  void ignore_hosts(bool ignored);
  /// Reads bytes from the host as far as there is room, and passes the line's output to the host.
  void attend();
  /// Returns true if a host seems to have left, but the kernel has not released the line yet.
  bool is_in_doubt() const { return terminal_ && terminal_->is_in_doubt(); }

  /// Passes on transmitted bytes, and reads more bytes if the line has room.
  void flush();
  /// Passes on available bytes. Returns true if there are more bytes for a host that was reading a moment
  /// ago, or if there is room again for bytes that a host has written. In virtual time, time must wait for
  /// such a host.
  bool is_waited_for();
  /// Returns how long the line can send to its host before its buffer is full, or nothing if the line will
  /// not send.
  std::optional<SimTime> time_until_full() const;
  /// Tells the line which hosts connected and disconnected, if the watch has collected such news.
  void follow_hosts();
  /// Returns when to call poll() even if nothing is readable: a host may have come or left, a frame is
  /// incomplete while the clock is stopped, or a lost or unplugged pseudo-terminal must be opened again.
  std::optional<WallTime> next_poll(bool clock_stands);
  void poll(WallTime now, bool clock_stands);
  /// Call this after a restore: the present host uses the new line, and unsent bytes of the old line are
  /// dropped.
  void world_restored();

  /// A host that does not use the pseudo-terminal. It passes its bytes to take_from_guest().
  class Guest {
   public:
    virtual ~Guest() = default;
    /// Receives the line's next bytes. Returns how many it took.
    virtual std::size_t take(std::span<const std::uint8_t> bytes) = 0;
    /// Called when the line may have room again.
    virtual void follow() = 0;
    /// Applies a fault to the next reply of the line.
    virtual void spoil(const world::Fault& fault) = 0;
    /// Called when the port is unplugged. The guest must leave.
    virtual void hang_up() = 0;
  };
  /// Makes the guest the line's host. Returns false if the line already has a host. While a guest is present,
  /// hosts that open the pseudo-terminal are ignored.
  bool admit(Guest& guest);
  /// Removes the guest. Its last bytes are still served.
  void leave(std::span<const std::uint8_t> last);
  /// Takes bytes from the guest, at most room().
  void take_from_guest(std::span<const std::uint8_t> bytes, const pty::HostSettings& settings);
  /// Call this when the guest flushes bytes that are not transmitted yet.
  void discard_input();
  /// Call this when the guest discards bytes that it has not received yet.
  void discard_output();
  std::size_t room() const { return leftover_.empty() ? line().room() : 0; }
  bool is_unplugged() const { return line().is_unplugged(); }
  /// Returns true if no bytes are in transit and nothing is due.
  bool is_quiet() const { return leftover_.empty() && !line().due() && line().output().empty(); }
  const pty::Line& line() const { return world_line().line; }
  const world::WorldLine& world_line() const { return world_.line(line_number_); }
  SimTime now() const { return world_.now(); }

  /// Returns the pseudo-terminal; null if the port has none or is unplugged.
  const pty::PseudoTerminal* terminal() const { return terminal_ ? &*terminal_ : nullptr; }
  /// Returns the place that a host opens: the link's path, or the TCP address if there is no pseudo-terminal.
  std::string place() const;
  std::size_t line_number() const { return line_number_; }
  bool host_present() const { return guest_ != nullptr || (terminal_ && terminal_->host_present()); }
  std::optional<pty::HostSettings> host_settings() const;
  /// Returns the port's TCP addresses in the user's notation.
  const std::vector<std::string>& tcp_places() const { return tcp_places_; }
  void add_tcp_place(const std::string& place) { tcp_places_.push_back(place); }

 private:
  static constexpr WallTime kRecovery = std::chrono::milliseconds(100);  // between attempts to reopen it
  class Overflow;
  void hand_over();
  void on_data(std::uint32_t ready);
  void watch();
  void unwatch();
  void keep_watch();
  void on_presence(std::span<const std::uint8_t> bytes);
  void keep_leftover();
  void add_leftover(std::span<const std::uint8_t> bytes);
  void pass_on_leftover();
  void receive(std::span<const std::uint8_t> bytes);
  WallTime patience() const;
  void take_in(std::span<const std::uint8_t> bytes, const std::optional<pty::HostSettings>& settings);
  bool is_terminal_ignored() const { return guest_ != nullptr || hosts_are_ignored_; }
  void ignore_terminal();
  void follow_plug();
  void pull_out();
  void plug_in();

  EventLoop& loop_;
  world::World& world_;
  std::size_t line_number_;
  std::function<void()> catch_up_;
  std::function<void(const std::string&)> log_;
  Link link_;
  std::shared_ptr<pty::PresenceWatch> presence_;
  std::optional<pty::PseudoTerminal> terminal_;  // also empty while the port is unplugged
  Guest* guest_ = nullptr;                       // if not null, the guest is the line's host
  std::optional<pty::HostSettings> guest_settings_;
  std::vector<std::string> tcp_places_;
  std::vector<std::uint8_t> leftover_;  // from hosts that have left; at most kLeftoverCapacity
  WallTime next_presence_{0};           // when to check again whether a host is present; 0: not needed
  bool is_watching_ = false;            // the terminal's descriptor is watched
  bool is_on_demand_ = false;           // the terminal's descriptor is not watched
  bool is_pulled_out_ = false;          // a fault has unplugged the port
  bool hosts_are_ignored_ = false;
  bool has_reported_ = false;  // the log contains the reason why the port cannot be plugged in again
  struct stat access_ {};      // the access rights of the previous terminal
  WallTime next_recovery_{0};  // when to try again to open a lost terminal; 0: it is not lost
  bool is_listening_ = true;   // the line had room when bytes were last passed on
  WallTime last_taken_{0};     // when the host's side last took bytes
  std::unique_ptr<Overflow> overflow_;
  WallTime last_bytes_{0};   // when the host's last bytes arrived; 0: no frame is incomplete
  bool has_paused_ = false;  // while the clock is stopped: the time for the rest of a frame is over
};

}  // namespace understudy::emulator::serve
