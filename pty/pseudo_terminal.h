// A pseudo-terminal that acts as a serial port. It has a stable link, loses no bytes when hosts come and go,
// and lets a host ask for even parity again and again (docs/wire.md, "What a Linux pty does").
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "base/files/descriptor.h"
#include "pty/line_settings.h"
#include "pty/port_link.h"
#include "pty/presence_watch.h"

namespace understudy::pty {

/// To serve the terminal: when data_descriptor() is readable, call read(); before using the bytes, call
/// poll_presence() if has_presence_news(), and poll_host_settings(). When the watch has collected something,
/// call poll_presence() if has_presence_news().
class PseudoTerminal {
 public:
  /// Creates the pty, raw and at the resting speed, and links `link_path` to it. It replaces a stale
  /// symbolic link (dangling, or to a /dev/pts entry) and leaves anything else alone. `link_path` may be
  /// empty. Terminals that are served together share a watch. Throws PortError.
  explicit PseudoTerminal(const std::string& link_path,
                          std::shared_ptr<PresenceWatch> watch = std::make_shared<PresenceWatch>());
  /// Removes the link if it still leads to this terminal.
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  int data_descriptor() const { return master_.get(); }        // readable when the host has written
  const std::string& path() const { return path_; }            // /dev/pts/N
  const std::string& link_path() const { return link_path_; }  // as it was given

  /// Reads at most bytes.size() bytes. Returns 0 if there are none now. Never blocks.
  std::size_t read(std::span<std::uint8_t> bytes);
  /// Returns how many bytes the kernel took, which is less than offered if the host does not read. Never
  /// blocks. While no host has the line open, all bytes are taken and dropped, so that a later host does not
  /// find them.
  std::size_t write(std::span<const std::uint8_t> bytes);

  /// From now on write() returns when the host can read what was written. The kernel passes bytes on in a
  /// thread of its own, and a host in simulated time must not wake up before it has them.
  void settle_writes() { settles_writes_ = true; }

  /// The changes since the last call. Both may be true; host_present() shows which came last.
  struct Presence {
    bool opened = false;  // a host came (the line was free before)
    // The last host closed it: bytes that it had not read are dropped, bytes that it wrote are not.
    bool closed = false;
  };
  Presence poll_presence();
  /// Returns true if the watch has collected something, or read() has noticed something, that
  /// poll_presence() may report.
  bool has_presence_news() const { return news_.opened || news_.closed || place_.has_events(); }
  /// Returns false if the kernel does not report who opens and closes the line (it has no inotify instance or
  /// watch left). Then call poll_presence() from time to time. It finds out who is there at that moment.
  bool is_watched() const { return static_cast<bool>(place_); }
  bool host_present() const { return is_present_; }
  /// Returns true if a host seems to have left, but the kernel has not released the line yet. Call
  /// poll_presence() again in a few milliseconds. This is rare. Without that call, the doubt lasts until the
  /// next host comes.
  bool is_in_doubt() const { return is_present_ && opens_ == 0; }

  /// Returns true if neither a host nor this process has the line open, because the kernel did not let us
  /// reopen it. data_descriptor() then reports a hang-up without end: do not watch it, but call recover()
  /// from time to time.
  bool is_lost() const { return !slave_ && !is_present_; }
  /// Returns true if this process has the slave open. If not, a host's descriptor keeps the line up: then
  /// call poll_presence() when data_descriptor() is readable, because the line may have hung up.
  bool holds_slave() const { return static_cast<bool>(slave_); }
  /// Tries to reopen a lost line. Returns true if it can be used again. If a host's claim (TIOCEXCL) outlives
  /// the host, the link leads to a new pseudo-terminal, and path() and both descriptors have changed. If it
  /// returns false, try again later.
  bool recover();

  /// Returns the settings of the host that wrote the bytes just read, or nothing if it left the resting
  /// speed alone. read() remembers the settings and restores the resting speed, so that the host's next
  /// tcsetattr changes something and succeeds. They are kept until the next host opens the free line.
  std::optional<HostSettings> poll_host_settings() const { return settings_; }

 private:
  void follow_presence(bool must_poll);
  bool read_presence_events();
  bool count_event(std::uint32_t mask);
  void count_arrival();
  void count_departure();
  void forget_unread();
  bool is_somebody_there();
  void settle(std::size_t expected) const;

  std::string path_;
  std::string link_path_;
  Descriptor master_;
  Descriptor slave_;  // our own descriptor, so that the master never hangs up; rarely none (is_lost(),
                      // holds_slave())
  std::shared_ptr<PresenceWatch> watch_;
  PresenceWatch::Place place_;  // the events of the slave
  PortLink link_;

  bool settles_writes_ = false;
  bool is_present_ = false;
  int opens_ = 0;      // by hosts; at least this many, as inotify merges equal neighbouring events
  int own_opens_ = 0;  // events still to come that this process causes
  int own_closes_ = 0;
  Presence news_;
  std::optional<HostSettings> settings_;
};

}  // namespace understudy::pty
