// Tracks which threads of a host in simulated time are waiting, and for what. Pure: no sockets.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "base/simulated_time.h"
#include "pty/host_time/protocol.h"

namespace understudy::emulator::serve {

/// The state of a thread. It is `unknown` until the thread greets the bench. A thread that waits without a
/// message is `running` here; HostTasks detects that the kernel does not run it.
enum class HostState : std::uint8_t { unknown, running, waiting, gone };
enum class HostEvent : std::uint8_t {
  hello,   // the thread greets the bench
  wait,    // the thread waits
  cancel,  // something else has ended the thread's wait
  time,    // the wait has expired
  line,    // a line for which the thread waits has news
  left,    // the thread's connection is closed
};
enum class HostAnswer : std::uint8_t {
  nothing,
  go,         // the wait is over
  cancelled,  // no further message about its wait will arrive
  refuse,     // the thread violates the protocol, so its connection is closed
};

struct HostStep {
  HostState next;
  HostAnswer answer;
};

inline constexpr std::size_t kHostStates = 4;
inline constexpr std::size_t kHostEvents = 6;

/// The effect of each event in each state (also listed in docs/host-time.md). A wait that arrives during
/// another wait comes from a signal handler; the thread sends the first wait again afterwards. The bench may
/// have ended a wait while the thread was giving it up. `cancelled` is then the last message.
inline constexpr std::array<std::array<HostStep, kHostEvents>, kHostStates> kHostSteps = [] {
  using enum HostState;
  using enum HostAnswer;
  return std::array<std::array<HostStep, kHostEvents>, kHostStates>{{
      // hello, wait, cancel, time, line, left
      {{{running, nothing},
        {gone, refuse},
        {gone, refuse},
        {unknown, nothing},
        {unknown, nothing},
        {gone, nothing}}},
      {{{gone, refuse},
        {waiting, nothing},
        {running, cancelled},
        {running, nothing},
        {running, nothing},
        {gone, nothing}}},
      {{{gone, refuse},
        {waiting, nothing},
        {running, cancelled},
        {running, go},
        {running, go},
        {gone, nothing}}},
      {{{gone, nothing},
        {gone, nothing},
        {gone, nothing},
        {gone, nothing},
        {gone, nothing},
        {gone, nothing}}},
  }};
}();

constexpr HostStep host_step(HostState state, HostEvent event) {
  return kHostSteps[static_cast<std::size_t>(state)][static_cast<std::size_t>(event)];
}

class HostWaits {
 public:
  /// A thread; the number of its connection identifies it.
  struct Thread {
    HostState state = HostState::unknown;
    int process = -1;
    int thread = -1;        // the kernel's number
    std::size_t order = 0;  // counted from 1, in the order of connection
    bool is_outside = false;
    host_time::Message wait{};  // valid while the thread waits
  };
  using Report = std::function<void(int number, HostAnswer answer, const Thread& thread)>;

  /// `report` is called with each answer other than `nothing`.
  explicit HostWaits(Report report) : report_(std::move(report)) {}

  void add(int number) { threads_[number].order = ++last_order_; }
  void remove(int number) { threads_.erase(number); }
  /// Handles a message of a thread. Ignores messages that are not events of the table.
  void on_message(int number, const host_time::Message& message);
  /// Ends the waits that have expired at simulated time `now`. Returns true if there were such waits.
  bool time_is(SimTime now);
  /// Call this when data have arrived on the line whose pseudo-terminal has this number. Returns true if a
  /// thread was waiting for them.
  bool line_has_news(int terminal);
  /// Call this when all bytes written to the line have been transmitted.
  bool line_is_drained(int terminal);
  void process_ended(int process);

  /// Returns true if a thread waits.
  bool is_any_waiting() const;
  /// Returns true if a thread waits for a time or for a line.
  bool is_any_for_bench() const;
  /// Returns true if a thread waits for something outside the bench.
  bool is_any_outside() const;
  /// Returns when the first wait ends, or nothing.
  std::optional<SimTime> next_end() const;
  /// Returns true if a thread waits for data on the line, or for the line to be drained.
  bool is_line_waited_for(int terminal) const;
  const std::map<int, Thread>& threads() const { return threads_; }

 private:
  void happen(int number, Thread& thread, HostEvent event);
  bool happen_on_line(int terminal, bool is_drained);

  Report report_;
  std::map<int, Thread> threads_;
  std::size_t last_order_ = 0;
};

}  // namespace understudy::emulator::serve
