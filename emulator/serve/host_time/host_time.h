// Puts an unmodified host into simulated time (`exec --host-time`). A preloaded library intercepts its clock
// reads and waits, and forwards them to this class. Simulated time stops while any thread of the host can
// continue. When all threads wait, time advances to the first event: the end of a wait, or data on a line for
// which a thread waits. docs/host-time.md describes the order in which bytes and time advance.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/files/descriptor.h"
#include "base/simulated_time.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/host_time/host_doors.h"
#include "emulator/serve/host_time/host_greetings.h"
#include "emulator/serve/host_time/host_page.h"
#include "emulator/serve/host_time/host_tasks.h"
#include "emulator/serve/host_time/host_timers.h"
#include "emulator/serve/host_time/host_wait_log.h"
#include "emulator/serve/host_time/host_waits.h"
#include "emulator/serve/host_time/host_watches.h"
#include "emulator/serve/host_time/simulated_task.h"
#include "emulator/serve/loop/listener.h"

namespace understudy::emulator::serve {

class HostTime {
 public:
  /// Serves the daemon's ports only when the host waits, from now on. The clock must be stopped (`manual`).
  /// `place` is the path of the socket, which must be in a private folder. `report` receives messages for the
  /// user. Throws std::system_error.
  HostTime(Daemon& daemon, const std::string& place, std::function<void(const std::string&)> report);
  ~HostTime();
  HostTime(const HostTime&) = delete;
  HostTime& operator=(const HostTime&) = delete;

  /// Returns the environment variables that the host needs. Throws NoTtyShim.
  std::vector<std::pair<std::string, std::string>> environment() const;
  /// Lets time advance only while the task also waits, from now on. The task must outlive this object, or be
  /// removed by passing null.
  void run_beside(SimulatedTask* task);
  /// Must be called when the command has begun: time passes until this process ends.
  void command_began(int process) { tasks_.set_command(process); }
  /// Must be called when the command may have ended, before the processes that it leaves behind are ended
  /// too.
  void look_at_command();
  /// Call this when a signal is about to end the host: waiting threads may wake up, and processes may end
  /// before they have greeted the bench.
  void host_is_to_end() { must_poll_ = is_host_to_end_ = true; }
  /// Call this when the host has ended. Takes the last bytes that the host wrote. From now on, the task alone
  /// decides how far time advances.
  void host_ended();
  /// See HostGreetings::was_reached().
  bool was_reached() const { return greetings_.was_reached(); }

 private:
  void admit(Descriptor client);
  bool on_message(int number);
  void note_process(const host_time::Message& message);
  void drop(int number);
  void receive_all();
  void judge_end_of(int process);
  void answer(int number, HostAnswer answer, const HostWaits::Thread& thread);
  void consider();
  bool may_time_go() const;
  std::optional<int> lone_speaker() const;
  bool is_host_asleep();
  bool has_unread_messages() const;
  void poll_again();
  void take_from_host();
  bool give_to_host();
  bool expire_timers();
  void let_host_act();
  std::optional<SimTime> next_stop() const;
  void watch_over();
  HostWaitLog::Lines line_counts() const;
  std::size_t line_of(int terminal) const;

  /// The state of a line when the host was last notified.
  struct Seen {
    int terminal = -1;
    std::uint64_t bytes_out = 0;
    bool had_room = true;
  };

  Daemon& daemon_;
  SimulatedTask* task_ = nullptr;
  bool is_host_to_end_ = false;
  bool is_host_over_ = false;
  std::string place_;
  std::function<void(const std::string&)> report_;
  HostPage page_;
  HostDoors doors_;
  HostWaits waits_;
  HostTasks tasks_;
  HostGreetings greetings_;
  HostTimers timers_;
  HostWatches watches_;
  HostWaitLog log_;
  std::map<int, Descriptor> connections_;
  int listening_ = -1;  // the listener's socket
  std::unique_ptr<Listener> listener_;
  std::vector<Seen> lines_;
  Descriptor next_poll_;    // a timer
  Descriptor watch_;        // a timer
  WallTime patience_{0};    // the time until the next check of a host that is not asleep
  bool must_poll_ = false;  // a signal may have woken a thread that seems to be waiting
  std::set<int> speakers_;  // connections that have sent messages since the host was last asleep
  bool is_last_message_wait_ = false;
  bool was_asleep_ = false;  // the host was asleep, and has sent no message since
  bool has_moved_ = true;    // something has happened since the last call of watch_over()
  int idle_polls_ = 0;
  bool has_reported_spinning_ = false;
  bool has_reported_outside_ = false;
};

}  // namespace understudy::emulator::serve
