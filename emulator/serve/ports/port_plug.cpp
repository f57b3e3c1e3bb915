// Faults that unplug a port and plug it in again.
#include <sys/stat.h>
#include <unistd.h>

#include <string>
#include <utility>

#include "emulator/serve/loop/event_loop.h"
#include "emulator/serve/ports/port.h"
#include "pty/port_link.h"

namespace understudy::emulator::serve {

void Port::follow_plug() {
  if (is_unplugged() && !is_pulled_out_) {
    pull_out();
  } else if (!is_unplugged() && is_pulled_out_) {
    plug_in();
  }
}

/// Behaves like an unplugged adapter: the link disappears, and hosts get a hang-up.
void Port::pull_out() {
  is_pulled_out_ = true;
  next_recovery_ = next_presence_ = WallTime{0};
  leftover_.clear();
  if (guest_ != nullptr) guest_->hang_up();
  if (!terminal_) return;
  if (stat(terminal_->path().c_str(), &access_) != 0) access_ = {};
  unwatch();
  if (terminal_->host_present() && !hosts_are_ignored_) world_.host_closed(line_number_);
  terminal_.reset();
}

/// Creates a new pseudo-terminal for the same link, with the permissions of the old one.
void Port::plug_in() {
  is_pulled_out_ = false;
  next_recovery_ = WallTime{0};
  if (!link_) return;
  try {
    terminal_.emplace(*link_, presence_);
  } catch (const pty::PortError& error) {
    if (!std::exchange(has_reported_, true)) log_("line " + line().name() + ": " + error.what());
    is_pulled_out_ = true;
    next_recovery_ = wall_now() + kRecovery;
    return;
  }
  has_reported_ = false;
  const char* const path = terminal_->path().c_str();
  // The group must be set first, because the old group must not gain access.
  if (access_.st_mode != 0 && chown(path, static_cast<uid_t>(-1), access_.st_gid) == 0)
    chmod(path, access_.st_mode & (S_IRWXU | S_IRWXG | S_IRWXO));
  watch();
  log_("line " + line().name() + " is plugged in again; the port is now " + terminal_->path());
}

}  // namespace understudy::emulator::serve
