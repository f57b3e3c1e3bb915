#include "pty/pseudo_terminal.h"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <stdlib.h>
#include <sys/inotify.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "base/files/descriptor.h"
#include "pty/port_link.h"
#include "pty/presence_watch.h"
#include "pty/terminal_settings.h"

namespace understudy::pty {
namespace {

PortError cannot_have(const std::string& link_path, const std::string& what, int error) {
  return PortError((link_path.empty() ? std::string("/dev/ptmx") : link_path) + ": " + what + ": " +
                   port_trouble(error));
}

/// Our descriptor is read-only, so that closing it (IN_CLOSE_NOWRITE) can be told apart from an ordinary
/// host's close.
Descriptor open_slave(const std::string& path) {
  for (;;) {
    Descriptor slave(::open(path.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (slave || errno != EINTR) return slave;
  }
}

/// Returns true if no slave is open.
bool is_hung_up(int master) {
  pollfd entry{.fd = master, .events = 0, .revents = 0};
  while (::poll(&entry, 1, 0) < 0 && errno == EINTR) {
  }
  return (entry.revents & POLLHUP) != 0;
}

/// Returns true if bytes are waiting to be read. The check also makes the kernel deliver bytes that it still
/// holds.
bool is_readable(int descriptor) {
  pollfd entry{.fd = descriptor, .events = POLLIN, .revents = 0};
  while (::poll(&entry, 1, 0) < 0 && errno == EINTR) {
  }
  return (entry.revents & POLLIN) != 0;
}

/// Returns how many bytes the kernel has for the reader.
std::size_t unread_in(int descriptor) {
  int count = 0;
  return ::ioctl(descriptor, FIONREAD, &count) == 0 && count > 0 ? static_cast<std::size_t>(count) : 0;
}

/// Returns how long to wait for the terminal to count what was written to it. A terminal that reads whole
/// lines counts no bytes, and one that removes some characters (such as STOP) never counts those.
std::chrono::milliseconds longest_count(int descriptor) {
  termios settings = {};
  if (::tcgetattr(descriptor, &settings) != 0 || (settings.c_lflag & ICANON) != 0) return {};
  const bool takes_some = (settings.c_lflag & ISIG) != 0 || (settings.c_iflag & (IGNCR | IXON)) != 0;
  return std::chrono::milliseconds(takes_some ? 100 : 5'000);
}

/// Returns true if a host has claimed the line (TIOCEXCL); then only root can open it again.
bool is_claimed(int slave) {
  int claimed = 0;
  return ::ioctl(slave, TIOCGEXCL, &claimed) == 0 && claimed != 0;
}

struct Pair {
  Descriptor master;
  Descriptor slave;
  std::string path;  // the slave's path
};

/// Opens a pair that is raw and at the resting speed.
Pair open_pair(const std::string& link_path) {
  Pair pair;
  pair.master = Descriptor(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!pair.master) {
    throw cannot_have(link_path, "no pseudo-terminal is available; expected a free one", errno);
  }
  const int master = pair.master.get();
  std::array<char, 64> name{};
  if (::grantpt(master) != 0 || ::unlockpt(master) != 0 ||
      ::ptsname_r(master, name.data(), name.size()) != 0) {
    throw cannot_have(link_path, "the pseudo-terminal cannot be unlocked", errno);
  }
  pair.path = name.data();
  pair.slave = open_slave(pair.path);
  if (!pair.slave) throw cannot_have(link_path, pair.path + " cannot be opened", errno);
  if (!rest(pair.slave.get()))
    throw cannot_have(link_path, pair.path + " cannot be put into raw mode", errno);
  return pair;
}

/// Gives the new file the owner and permissions of the old one.
void give_same_access(const std::string& from, const std::string& to) {
  struct stat access = {};
  if (::stat(from.c_str(), &access) != 0) return;
  // The group is changed first, so that the old group never gains a permission.
  if (::chown(to.c_str(), static_cast<uid_t>(-1), access.st_gid) != 0) return;
  ::chmod(to.c_str(), access.st_mode & (S_IRWXU | S_IRWXG | S_IRWXO));
}

}  // namespace

PseudoTerminal::PseudoTerminal(const std::string& link_path, std::shared_ptr<PresenceWatch> watch)
    : link_path_(link_path), watch_(std::move(watch)) {
  Pair pair = open_pair(link_path);
  master_ = std::move(pair.master);
  slave_ = std::move(pair.slave);
  path_ = std::move(pair.path);
  place_ = PresenceWatch::Place(*watch_, path_);
  if (!link_path.empty()) link_ = PortLink(link_path, path_);
}

PseudoTerminal::~PseudoTerminal() = default;

// --- bytes -------------------------------------------------------------------------------------

std::size_t PseudoTerminal::read(std::span<std::uint8_t> bytes) {
  ssize_t size = 0;
  do {
    size = ::read(master_.get(), bytes.data(), bytes.size());
  } while (size < 0 && errno == EINTR);
  if (size <= 0) return 0;
  // Closes and opens up to now are processed before these bytes are answered. Otherwise the answer to a new
  // host could be dropped as one that the old host did not read.
  follow_presence(false);
  if (!is_present_) follow_presence(true);  // its opening was missed, or it has already closed
  // A host that writes has done its tcsetattr, so the line can be prepared for its next one without
  // disturbing it.
  if (const auto taken = take_host_settings(master_.get())) settings_ = taken;
  return static_cast<std::size_t>(size);
}

std::size_t PseudoTerminal::write(std::span<const std::uint8_t> bytes) {
  if (is_in_doubt()) follow_presence(false);
  if (!is_present_) return bytes.size();
  const std::size_t unread = settles_writes_ ? unread_in(slave_.get()) : 0;
  ssize_t size = 0;
  do {
    size = ::write(master_.get(), bytes.data(), bytes.size());
  } while (size < 0 && errno == EINTR);
  if (size > 0 && settles_writes_) settle(unread + static_cast<std::size_t>(size));
  return size < 0 ? 0 : static_cast<std::size_t>(size);
}

/// Waits until the host has this many bytes to read. A kernel thread carries them; on a busy machine it may
/// be delayed.
void PseudoTerminal::settle(std::size_t expected) const {
  if (!slave_) return;
  const auto end = std::chrono::steady_clock::now() + longest_count(slave_.get());
  while (unread_in(slave_.get()) < expected) {
    is_readable(slave_.get());  // this alone is enough if nothing was unread
    if (std::chrono::steady_clock::now() >= end) return;
    if (unread_in(slave_.get()) < expected) sched_yield();
  }
}

// --- who is there ------------------------------------------------------------------------------
//
// inotify reports every opening and closing in order, but merges equal neighbours (two hosts that open at
// once are one event), so its count is only a hint. The kernel's own state decides: when something has
// closed, we close our slave for a moment and see whether the master hangs up. Without inotify, each
// poll_presence() does so.
//
// inotify is also early: a host's closing is reported a moment before the kernel releases the terminal. So if
// the count says that no host is left but the kernel shows one, that host is believed only at the second
// check; until then it is in doubt.

PseudoTerminal::Presence PseudoTerminal::poll_presence() {
  follow_presence(!is_watched());
  return std::exchange(news_, {});
}

void PseudoTerminal::follow_presence(bool must_poll) {
  const bool was_in_doubt = is_in_doubt();
  const bool has_closed = read_presence_events();
  bool is_second_poll = was_in_doubt && !has_closed && is_in_doubt();
  const bool is_abandoned = !slave_ && is_hung_up(master_.get());
  must_poll = must_poll || has_closed || is_second_poll || is_abandoned;
  // Hosts may open and close during this check. If they keep doing so, the watch stays readable for the next
  // call.
  constexpr int kMaxPolls = 8;
  for (int poll = 0; must_poll && poll < kMaxPolls; ++poll) {
    if (!is_somebody_there()) {
      opens_ = 0;
      if (is_present_) count_departure();
    } else if (!is_present_ || is_second_poll) {
      if (!is_present_) count_arrival();
      opens_ = 1;  // merged openings
    }
    is_second_poll = false;
    must_poll = read_presence_events();
  }
}

/// Returns true if a descriptor has been closed.
bool PseudoTerminal::read_presence_events() {
  watch_->collect();
  bool has_closed = false;
  for (const std::uint32_t mask : place_.take_events()) has_closed = count_event(mask) || has_closed;
  own_opens_ = own_closes_ = 0;  // any left were merged with a host's
  return has_closed;
}

/// Returns true if the event reports that a host has closed, or that events were lost.
bool PseudoTerminal::count_event(std::uint32_t mask) {
  if ((mask & IN_OPEN) != 0) {
    if (own_opens_ > 0) {
      --own_opens_;
      return false;
    }
    if (opens_ == 0 && is_present_) {
      // The host closed and opened again since the last check. The settings stay, as on a serial port.
      count_departure();
      is_present_ = news_.opened = true;
    } else if (!is_present_) {
      count_arrival();
    }
    ++opens_;
    return false;
  }
  if ((mask & IN_CLOSE_NOWRITE) != 0 && own_closes_ > 0) {
    --own_closes_;
    return false;
  }
  if ((mask & IN_CLOSE) != 0 && opens_ > 0) --opens_;
  return (mask & (IN_CLOSE | IN_Q_OVERFLOW)) != 0;
}

void PseudoTerminal::count_arrival() {
  is_present_ = true;
  news_.opened = true;
  settings_.reset();
}

/// Drops bytes that a host has not read, so that the next host does not find them. Bytes that the host wrote
/// stay. It flushes only if there are such bytes: while the kernel flushes, a poll() of the next host may
/// find the line readable but empty (n_tty empties its buffer in several steps), and libmodbus takes that
/// for a lost line.
void PseudoTerminal::forget_unread() {
  if (is_readable(slave_.get())) ::tcflush(slave_.get(), TCIFLUSH);
}

void PseudoTerminal::count_departure() {
  is_present_ = false;
  news_.closed = true;
  forget_unread();
  // Bytes of this host may still be unread here, and they need its settings.
  if (const auto last = host_settings_of(master_.get())) settings_ = last;
}

// A claim (TIOCEXCL) would lock us out as well, unless we are root; and on a pseudo-terminal, unlike on a
// real port, it outlives the host that made it. So it is removed before we close, and restored if a host is
// still there. One case is left: a host that opens and claims the line at exactly that moment. Then we have
// no slave until it closes; this works, because the host's own keeps the master from hanging up. If that host
// closes without releasing its claim, the kernel never lets anyone in again: recover().

/// Returns true if a host has the line open. If not, the line is then at rest and unclaimed.
bool PseudoTerminal::is_somebody_there() {
  const bool was_claimed = slave_ && is_claimed(slave_.get());
  if (was_claimed) ::ioctl(slave_.get(), TIOCNXCL);
  own_closes_ = own_opens_ = 1;
  slave_.close();
  const bool is_free = is_hung_up(master_.get());
  if (is_free) {
    if (const auto last = host_settings_of(master_.get())) settings_ = last;
    // A line at rest needs nothing. If it is not at rest, a host may have opened it since.
    if (!is_at_rest(master_.get()) && is_hung_up(master_.get())) rest(master_.get());
  }
  slave_ = open_slave(path_);
  if (!is_free && was_claimed && slave_) ::ioctl(slave_.get(), TIOCEXCL);
  return !is_free;
}

bool PseudoTerminal::recover() {
  if (!is_lost()) return true;
  slave_ = open_slave(path_);
  if (slave_) {
    forget_unread();  // count_departure() could not
    return true;
  }
  if (errno != EBUSY) return false;  // no descriptor is available just now
  try {
    Pair fresh = open_pair(link_path_);
    give_same_access(path_, fresh.path);
    link_.point_to(fresh.path);
    place_ = PresenceWatch::Place(*watch_, fresh.path);
    path_ = std::move(fresh.path);
    master_ = std::move(fresh.master);
    slave_ = std::move(fresh.slave);
    opens_ = own_opens_ = own_closes_ = 0;
    return true;
  } catch (const PortError&) {
    return false;
  }
}

}  // namespace understudy::pty
