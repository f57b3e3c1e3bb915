// A port: one line of the world joined to one pseudo-terminal. Only bytes cross here; what happens at this
// edge (a slow host, a full buffer) never reaches into the model.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "emulator/serve/loop/event_loop.h"
#include "emulator/world/world.h"
#include "pty/pseudo_terminal.h"

namespace understudy::emulator::serve {

class Port {
 public:
  /// `catch_up` brings the world to the present moment; `log` gets what the user should know. Throws
  /// pty::PortError.
  Port(EventLoop& loop, world::World& world, std::size_t line_number, const std::string& link_path,
       std::function<void()> catch_up, std::function<void(const std::string&)> log);
  ~Port();
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;

  /// Hands over what the wire has brought, and takes more bytes if the line has room.
  void flush();
  /// Hands over what there is, and returns whether there is more for a host that was reading a moment ago:
  /// where time goes by as fast as it can, such a host is waited for.
  bool keeps_host_reading();
  /// When look() should be called even if nothing is readable: a host may have gone, a frame is incomplete
  /// while the clock stands, or the pseudo-terminal was lost and could not be opened again yet.
  std::optional<WallTime> next_look(bool clock_stands);
  void look(WallTime now, bool clock_stands);
  /// The world has another state: its line gets the host that is there now, and what the old line was saying
  /// is dropped.
  void world_restored();

  const pty::PseudoTerminal& terminal() const { return terminal_; }
  std::size_t line_number() const { return line_number_; }
  bool host_present() const { return terminal_.host_present(); }
  std::optional<pty::HostSettings> host_settings() const { return terminal_.poll_host_settings(); }

 private:
  class Overflow;
  const pty::Line& line() const { return world_.line(line_number_).line; }
  void hand_over();
  void on_data(std::uint32_t ready);
  void watch();
  void keep_watch();
  void on_presence(std::span<const std::uint8_t> bytes);
  void keep_what_was_left_behind();
  void leave_behind(std::span<const std::uint8_t> bytes);
  void pass_on_what_was_left_behind();
  void receive(std::span<const std::uint8_t> bytes);

  EventLoop& loop_;
  world::World& world_;
  std::size_t line_number_;
  std::function<void()> catch_up_;
  std::function<void(const std::string&)> log_;
  pty::PseudoTerminal terminal_;
  std::vector<std::uint8_t> left_behind_;  // by hosts that have closed; at most kLeftBehindCapacity
  WallTime second_look_{0};                // when to check again whether the host has gone; 0: no need
  bool is_watching_ = false;               // the terminal's descriptors
  WallTime next_recovery_{0};              // when to try to open a lost terminal again; 0: it is not lost
  WallTime last_taken_{0};                 // when the host's side took something last
  std::unique_ptr<Overflow> overflow_;
  WallTime last_bytes_{0};  // when the host's last bytes came; 0: nothing is waited for
};

}  // namespace understudy::emulator::serve
