// The two ends of a pseudo-terminal for tests: a host that opens it as real programs do, and a server.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <filesystem>
#include <string>
#include <thread>

#include "pty/pseudo_terminal.h"
#include "tests/pty/wire_examples.h"

namespace understudy::pty {

inline constexpr int kTimeoutMs = 10000;  // for a failing test; a passing one only waits for events

inline bool is_readable(int descriptor, int timeout_ms) {
  pollfd entry{.fd = descriptor, .events = POLLIN, .revents = 0};
  return ::poll(&entry, 1, timeout_ms) > 0;
}

class Host {
 public:
  explicit Host(const std::string& path) : descriptor_(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    EXPECT_TRUE(descriptor_) << path;
  }

  /// Sets the terminal to raw with even parity, as nearly every Modbus host does. Returns false if libc
  /// refused them.
  bool set_even_parity(speed_t speed, int stop_bits = 1) {
    termios settings = {};
    if (::tcgetattr(descriptor_.get(), &settings) != 0) return false;
    ::cfmakeraw(&settings);
    settings.c_cflag |= PARENB | CLOCAL | CREAD;
    settings.c_cflag &= ~static_cast<tcflag_t>(PARODD | CSTOPB);
    if (stop_bits == 2) settings.c_cflag |= CSTOPB;
    ::cfsetspeed(&settings, speed);
    return ::tcsetattr(descriptor_.get(), TCSANOW, &settings) == 0;
  }
  void write(const Bytes& bytes) {
    EXPECT_EQ(::write(descriptor_.get(), bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  /// Returns exactly `count` bytes, or fewer if they do not arrive in time.
  Bytes read(std::size_t count, int timeout_ms = kTimeoutMs) {
    Bytes bytes;
    std::array<std::uint8_t, 4096> buffer{};
    while (bytes.size() < count && is_readable(descriptor_.get(), timeout_ms)) {
      const ssize_t size =
          ::read(descriptor_.get(), buffer.data(), std::min(buffer.size(), count - bytes.size()));
      if (size <= 0) break;
      bytes.insert(bytes.end(), buffer.begin(), buffer.begin() + size);
    }
    return bytes;
  }
  void close() { descriptor_.close(); }
  int descriptor() const { return descriptor_.get(); }

 private:
  Descriptor descriptor_;
};

/// A directory that is removed with the test.
class ScratchDirectory {
 public:
  ScratchDirectory() {
    std::string name = (std::filesystem::temp_directory_path() / "pty_test_XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~ScratchDirectory() { std::filesystem::remove_all(path_); }
  ScratchDirectory(const ScratchDirectory&) = delete;
  ScratchDirectory& operator=(const ScratchDirectory&) = delete;
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

/// A terminal with its own watch.
struct WatchedTerminal {
  bool has_news(int timeout_ms = 0) {
    if (is_readable(watch->descriptor(), timeout_ms)) watch->collect();
    return port.has_presence_news();
  }
  bool is_quiet() { return !is_readable(port.data_descriptor(), 0) && !has_news(); }

  std::shared_ptr<PresenceWatch> watch = std::make_shared<PresenceWatch>();
  PseudoTerminal port{"", watch};
};

/// Reads what arrives within the time-out, at least one byte.
inline Bytes read_some(PseudoTerminal& port) {
  if (!is_readable(port.data_descriptor(), kTimeoutMs)) return {};
  std::array<std::uint8_t, 4096> buffer{};
  const std::size_t size = port.read(buffer);
  return {buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(size)};
}

/// A thread that answers every byte with its complement.
class ComplementServer {
 public:
  explicit ComplementServer(WatchedTerminal& terminal)
      : port_(terminal.port), watch_(*terminal.watch), thread_([this] { serve(); }) {}
  ~ComplementServer() {
    is_stopping_ = true;
    thread_.join();
  }
  ComplementServer(const ComplementServer&) = delete;
  ComplementServer& operator=(const ComplementServer&) = delete;

  std::atomic<int> opened{0};
  std::atomic<int> closed{0};
  std::atomic<int> wrong_settings{0};  // reads for which the host's speed was not 19200 baud

 private:
  void serve() {
    std::array<pollfd, 2> entries = {pollfd{port_.data_descriptor(), POLLIN, 0},
                                     pollfd{watch_.descriptor(), POLLIN, 0}};
    std::array<std::uint8_t, 256> buffer{};
    while (!is_stopping_) {
      ::poll(entries.data(), entries.size(), 20);
      const std::size_t size = port_.read(buffer);
      const auto presence = port_.poll_presence();
      opened += presence.opened ? 1 : 0;
      closed += presence.closed ? 1 : 0;
      if (size == 0) continue;
      if (port_.poll_host_settings() != HostSettings{.baud = 19200}) ++wrong_settings;
      for (std::size_t i = 0; i < size; ++i) buffer[i] = static_cast<std::uint8_t>(~buffer[i]);
      port_.write(std::span(buffer).first(size));
    }
  }

  PseudoTerminal& port_;
  PresenceWatch& watch_;
  std::atomic<bool> is_stopping_{false};
  std::thread thread_;
};

}  // namespace understudy::pty
