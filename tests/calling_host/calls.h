// Calls that exec --host-time handles, with random arguments: valid, unusual and invalid ones.
#pragma once

#include <poll.h>
#include <signal.h>
#include <sys/time.h>
#include <time.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <random>
#include <string>
#include <vector>

namespace calling_host {

/// Draws arguments. Equal seeds give the same arguments on any machine.
class Drawer {
 public:
  explicit Drawer(std::uint32_t seed) : numbers_(seed) {}

  int below(int end) { return static_cast<int>(numbers_() % static_cast<unsigned>(end)); }
  bool one_in(int times) { return below(times) == 0; }
  template <class Value>
  Value one_of(std::initializer_list<Value> values) {
    return values.begin()[below(static_cast<int>(values.size()))];
  }

  clockid_t clock();
  /// Returns a short time, zero, or an invalid time. Waits in real time must not take long.
  timespec length();
  timeval short_length();
  /// Returns a time of the clock that is in the past, is soon, or is invalid.
  timespec end_by(clockid_t clock);

 private:
  std::mt19937 numbers_;
};

/// Descriptors of every kind that a wait may be given. They have the same numbers in each run.
class Descriptors {
 public:
  Descriptors();
  ~Descriptors();
  Descriptors(const Descriptors&) = delete;
  Descriptors& operator=(const Descriptors&) = delete;

  int any(Drawer& draw) const {
    return all_[static_cast<std::size_t>(draw.below(static_cast<int>(all_.size())))];
  }
  int ready() const { return ready_; }  // a pipe with bytes
  int line() const { return line_; }    // UNDERSTUDY_PORT, at rest
  int ready_epoll() const { return ready_epoll_; }

 private:
  int opened(int descriptor);
  std::vector<int> all_;
  std::vector<int> opened_;
  int ready_ = -1;
  int line_ = -1;
  int ready_epoll_ = -1;
};

/// Prints the call.
void tell(const std::string& text);
/// Prints the call and its result, with errno if the result is -1.
void tell(const std::string& call, long result);
/// Prints a call that returns its error, and the error.
void tell_error(const std::string& call, int error);
/// Runs a call with errno set to 0, which no call sets. The caller passes the result to tell().
template <class Call>
long result_of(Call call) {
  errno = 0;
  return static_cast<long>(call());
}
std::string text_of(const timespec& time);

using Call = void (*)(Drawer&, const Descriptors&);

void poll_or_select(Drawer& draw, const Descriptors& descriptors);
void wait_for_epoll(Drawer& draw, const Descriptors& descriptors);
void read_or_write(Drawer& draw, const Descriptors& descriptors);
void use_a_socket(Drawer& draw, const Descriptors& descriptors);
void read_a_clock(Drawer& draw, const Descriptors& descriptors);
void sleep_a_little(Drawer& draw, const Descriptors& descriptors);
void use_a_timerfd(Drawer& draw, const Descriptors& descriptors);
void use_a_timer(Drawer& draw, const Descriptors& descriptors);
void use_the_alarm(Drawer& draw, const Descriptors& descriptors);
void wait_for_a_signal(Drawer& draw, const Descriptors& descriptors);
void wait_for_a_condition(Drawer& draw, const Descriptors& descriptors);
void wait_for_a_semaphore(Drawer& draw, const Descriptors& descriptors);
void wait_for_a_lock(Drawer& draw, const Descriptors& descriptors);
void wait_for_a_thread(Drawer& draw, const Descriptors& descriptors);
void use_a_futex(Drawer& draw, const Descriptors& descriptors);

}  // namespace calling_host
