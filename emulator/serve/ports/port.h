// A port: one line of the world joined to its host, which has opened a pseudo-terminal or is a guest from
// elsewhere. Only bytes cross here; what happens at this edge (a slow host, a full buffer) never reaches into
// the model.
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
  /// The link to its pseudo-terminal; nothing: it has none, and guests only.
  using Link = std::optional<std::string>;
  /// `catch_up` brings the world to the present moment; `log` gets what the user should know. Throws
  /// pty::PortError.
  Port(EventLoop& loop, world::World& world, std::size_t line_number, const Link& link,
       std::function<void()> catch_up, std::function<void(const std::string&)> log);
  ~Port();
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;

  /// Hands over what the wire has brought, and takes more bytes if the line has room.
  void flush();
  /// Hands over what there is. Returns whether there is more for a host that was reading a moment ago, or
  /// room again for what a host has written: where time goes by as fast as it can, it has to wait for such a
  /// host.
  bool is_waited_for();
  /// How long the line can talk to its host until it has said more than it keeps; nothing: it will not talk.
  std::optional<SimTime> time_until_full() const;
  /// When look() should be called even if nothing is readable: a host may have gone, a frame is incomplete
  /// while the clock stands, or the pseudo-terminal was lost or pulled out and could not be opened again yet.
  std::optional<WallTime> next_look(bool clock_stands);
  void look(WallTime now, bool clock_stands);
  /// The world has another state: its line gets the host that is there now, and what the old line was saying
  /// is dropped.
  void world_restored();

  /// A host that comes by another way than the pseudo-terminal. What it sends is hear()d.
  class Guest {
   public:
    virtual ~Guest() = default;
    /// What the line says next. Returns how much of it was taken.
    virtual std::size_t take(std::span<const std::uint8_t> bytes) = 0;
    /// The line may have room again.
    virtual void follow() = 0;
    /// What a fault does to the reply that the line says next.
    virtual void spoil(const world::Fault& fault) = 0;
    /// The port is pulled out: the guest leaves.
    virtual void hang_up() = 0;
  };
  /// False: the line has a host. Who opens the pseudo-terminal later is not heard until the guest leaves.
  bool admit(Guest& guest);
  /// Its last bytes are still served.
  void leave(std::span<const std::uint8_t> last);
  /// At most room() bytes.
  void hear(std::span<const std::uint8_t> bytes, const pty::HostSettings& settings);
  /// It takes back what is not on the wire yet.
  void take_back();
  /// It does not want what it has not taken yet.
  void throw_away();
  std::size_t room() const { return left_behind_.empty() ? line().room() : 0; }
  bool is_unplugged() const { return line().is_unplugged(); }
  /// Nothing is on its way, and nobody has anything to say.
  bool is_quiet() const { return left_behind_.empty() && !line().due() && line().output().empty(); }
  const pty::Line& line() const { return world_line().line; }
  const world::WorldLine& world_line() const { return world_.line(line_number_); }

  /// Null: it has none, or it is pulled out.
  const pty::PseudoTerminal* terminal() const { return terminal_ ? &*terminal_ : nullptr; }
  /// What a host opens: the link's path, or where it is reached by TCP if there is no pseudo-terminal.
  std::string place() const;
  std::size_t line_number() const { return line_number_; }
  bool host_present() const { return guest_ != nullptr || (terminal_ && terminal_->host_present()); }
  std::optional<pty::HostSettings> host_settings() const;
  /// Where it is reached by TCP, as a user writes it.
  const std::vector<std::string>& tcp_places() const { return tcp_places_; }
  void add_tcp_place(const std::string& place) { tcp_places_.push_back(place); }

 private:
  class Overflow;
  void hand_over();
  void on_data(std::uint32_t ready);
  void watch();
  void keep_watch();
  void on_presence(std::span<const std::uint8_t> bytes);
  void keep_what_was_left_behind();
  void leave_behind(std::span<const std::uint8_t> bytes);
  void pass_on_what_was_left_behind();
  void receive(std::span<const std::uint8_t> bytes);
  WallTime patience() const;
  void take_in(std::span<const std::uint8_t> bytes, const std::optional<pty::HostSettings>& settings);
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
  std::optional<pty::PseudoTerminal> terminal_;  // none as well while it is pulled out
  Guest* guest_ = nullptr;                       // has the line instead
  std::optional<pty::HostSettings> guest_settings_;
  std::vector<std::string> tcp_places_;
  std::vector<std::uint8_t> left_behind_;  // by hosts that have closed; at most kLeftBehindCapacity
  WallTime second_look_{0};                // when to check again whether the host has gone; 0: no need
  bool is_watching_ = false;               // the terminal's descriptors
  bool is_pulled_out_ = false;             // by a fault
  bool has_told_ = false;                  // why it cannot be plugged in again
  struct stat access_ {};                  // of the terminal that was
  WallTime next_recovery_{0};              // when to try to open a lost terminal again; 0: it is not lost
  bool is_listening_ = true;               // the line had room when last something was handed over
  WallTime last_taken_{0};                 // when the host's side took something last
  std::unique_ptr<Overflow> overflow_;
  WallTime last_bytes_{0};   // when the host's last bytes came; 0: nothing is waited for
  bool has_paused_ = false;  // where the clock stands: since then a frame's usual patience is over
};

}  // namespace understudy::emulator::serve
