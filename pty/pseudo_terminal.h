// A pseudo-terminal that stands for a serial port: stable link, lossless reopening, and the measures
// that let a host ask for even parity again and again (docs/wire.md, "What a Linux pty does").
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "base/files/descriptor.h"
#include "pty/line_settings.h"
#include "pty/port_link.h"

namespace understudy::pty {

/// How to serve it: when data_descriptor() is readable, read(), then, before the bytes are used,
/// poll_presence() if has_presence_news(), and poll_host_settings(); when presence_descriptor() is readable,
/// poll_presence().
class PseudoTerminal {
 public:
  /// Creates the pty, raw, at the resting speed, and links `link_path` to it. A stale symbolic link
  /// (dangling, or to a /dev/pts entry) is replaced; anything else that is there is left alone.
  /// `link_path` may be empty. Throws PortError.
  explicit PseudoTerminal(const std::string& link_path);
  /// Removes the link if it is still ours.
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  int data_descriptor() const { return master_.get(); }        // readable when the host has written
  int presence_descriptor() const { return watch_.get(); }     // readable when a host has opened or closed
  const std::string& path() const { return path_; }            // /dev/pts/N
  const std::string& link_path() const { return link_path_; }  // as it was given

  /// At most bytes.size() bytes; 0 when there is none now. Never blocks.
  std::size_t read(std::span<std::uint8_t> bytes);
  /// How many the kernel took; less than offered when nobody reads. Never blocks. While no host has the line
  /// open everything is taken and lost: nobody must find it there later.
  std::size_t write(std::span<const std::uint8_t> bytes);

  /// What has happened since the last call. Both may be true; host_present() says which came last.
  struct Presence {
    bool opened = false;  // a host came (the line was free before)
    bool closed = false;  // the last host went: what it had not read is gone, what it wrote is not
  };
  Presence poll_presence();
  /// Whether read() has learnt something that poll_presence() will report. presence_descriptor() may then no
  /// longer be readable.
  bool has_presence_news() const { return news_.opened || news_.closed; }
  bool host_present() const { return is_present_; }
  /// A host seems to have gone, but the kernel has not let go of it yet: poll_presence() wants to be called
  /// again in a few milliseconds. Rare. Without that call the doubt lasts until the next host.
  bool is_in_doubt() const { return is_present_ && opens_ == 0; }

  /// Nobody has the line open, not even we: the kernel would not let us back in. data_descriptor() then
  /// reports a hang-up without end: do not watch it, but call recover() now and then.
  bool is_lost() const { return !slave_ && !is_present_; }
  /// We have our own slave open; if not, a host's keeps the line up. Without ours, call poll_presence() when
  /// data_descriptor() is readable, as the line may have hung up.
  bool holds_slave() const { return static_cast<bool>(slave_); }
  /// For a lost line: returns true if it can be used again. If a host's claim (TIOCEXCL) outlives the host,
  /// there is a new pseudo-terminal behind the link, and path() and both descriptors have changed. False:
  /// perhaps later.
  bool recover();

  /// What the host of the bytes just read has set; nothing if it left the resting speed alone. read()
  /// looks, remembers it and puts the resting speed back, so that the host's next tcsetattr changes
  /// something and succeeds. Remembered until the next host opens the free line.
  std::optional<HostSettings> poll_host_settings() const { return settings_; }

 private:
  void follow_presence(bool must_look);
  bool read_presence_events();
  bool count_event(std::uint32_t mask);
  void count_arrival();
  void count_departure();
  void forget_unread();
  bool is_somebody_there();

  std::string path_;
  std::string link_path_;
  Descriptor master_;
  Descriptor slave_;  // ours, so that the master never hangs up; rarely none (is_lost(), holds_slave())
  Descriptor watch_;  // inotify on the slave
  PortLink link_;

  bool is_present_ = false;
  int opens_ = 0;      // by hosts; at least this many, as inotify merges equal neighbours
  int own_opens_ = 0;  // events still to come that we cause ourselves
  int own_closes_ = 0;
  Presence news_;
  std::optional<HostSettings> settings_;
};

}  // namespace understudy::pty
