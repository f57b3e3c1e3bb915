// A controller on a pseudo-terminal, implemented by the test itself. It accepts every request, and counts the
// requested functions and the writes to each address. A test can choose the values of its registers.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/files/descriptor.h"
#include "pty/rtu_crc.h"

namespace understudy::acceptance {

class CountingBox {
 public:
  using Frame = std::vector<std::uint8_t>;

  /// Returns what a register holds when it is read again after `times` reads.
  using Tell = std::function<int(int address, int times)>;

  /// `is_dead` is asked before each reply; if it returns true, there is none.
  explicit CountingBox(Tell tell = {}, std::function<bool()> is_dead = {})
      : tell_(std::move(tell)), is_dead_(std::move(is_dead)), master_(::posix_openpt(O_RDWR | O_NOCTTY)) {
    ::grantpt(master_.get());
    ::unlockpt(master_.get());
    path_ = ::ptsname(master_.get());
    slave_ = Descriptor(::open(path_.c_str(), O_RDWR | O_NOCTTY));  // stays open, so that nothing hangs up
    termios raw{};
    ::tcgetattr(slave_.get(), &raw);
    ::cfmakeraw(&raw);
    ::tcsetattr(slave_.get(), TCSANOW, &raw);
    thread_ = std::thread([this] { run(); });
  }
  ~CountingBox() {
    is_over_ = true;
    thread_.join();
  }
  CountingBox(const CountingBox&) = delete;
  CountingBox& operator=(const CountingBox&) = delete;

  const std::string& path() const { return path_; }
  int reads() const {
    return count([](const Frame& frame) { return frame[1] <= 4; });
  }
  int writes() const {
    return count([](const Frame& frame) { return frame[1] > 4; });
  }
  /// Returns the number of writes to an address.
  int writes_to(int address) const {
    return count([&](const Frame& frame) { return frame[1] > 4 && (frame[2] << 8 | frame[3]) == address; });
  }

 private:
  template <typename Is>
  int count(Is is) const {
    const std::lock_guard lock(mutex_);
    int sum = 0;
    for (const Frame& frame : heard_) sum += is(frame) ? 1 : 0;
    return sum;
  }

  static std::size_t size_of(const Frame& frame) {
    if (frame.size() < 7 || (frame[1] != 0x0F && frame[1] != 0x10)) return 8;
    return 9U + frame[6];
  }

  Frame answer(const Frame& request) {
    if (request[1] > 4) {
      for (std::size_t i = 4; request[1] < 0x0F && i < 6; ++i)
        values_[(request[2] << 8 | request[3])] = request[4] << 8 | request[5];
      Frame reply(request.begin(), request.begin() + 6);
      pty::append_rtu_crc(reply);
      return reply;
    }
    const int first = request[2] << 8 | request[3];
    const int words = request[4] << 8 | request[5];
    Frame reply{request[0], request[1], static_cast<std::uint8_t>(2 * words)};
    for (int i = 0; i < words; ++i) {
      const int value = tell_ ? tell_(first + i, times_read_[first + i]++) : values_[first + i];
      reply.push_back(static_cast<std::uint8_t>(value >> 8));
      reply.push_back(static_cast<std::uint8_t>(value));
    }
    pty::append_rtu_crc(reply);
    return reply;
  }

  void run() {
    Frame received;
    while (!is_over_) {
      pollfd ready{.fd = master_.get(), .events = POLLIN, .revents = 0};
      if (::poll(&ready, 1, 20) <= 0) continue;
      std::uint8_t byte = 0;
      if (::read(master_.get(), &byte, 1) != 1) return;
      received.push_back(byte);
      if (received.size() < size_of(received)) continue;
      const bool is_dead = is_dead_ && is_dead_();
      const Frame reply = is_dead ? Frame() : answer(received);
      {
        const std::lock_guard lock(mutex_);
        heard_.push_back(received);
      }
      received.clear();
      if (::write(master_.get(), reply.data(), reply.size()) < 0) return;
    }
  }

  Tell tell_;
  std::function<bool()> is_dead_;
  std::map<int, int> times_read_;
  Descriptor master_;
  Descriptor slave_;
  std::string path_;
  mutable std::mutex mutex_;
  std::vector<Frame> heard_;
  std::map<int, int> values_;
  std::atomic<bool> is_over_ = false;
  std::thread thread_;
};

}  // namespace understudy::acceptance
