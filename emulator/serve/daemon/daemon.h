// Connects a world to the outside: ports, control socket, pacing, signals. A daemon has one thread and one
// event loop, which wakes up for readable descriptors and for due events, not for every tick.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "base/files/file_claims.h"
#include "base/files/helper_thread.h"
#include "emulator/serve/daemon/door.h"
#include "emulator/serve/daemon/missing_stations.h"
#include "emulator/serve/daemon/nv_keeper.h"
#include "emulator/serve/daemon/observers.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/serve/loop/pacer.h"
#include "emulator/serve/ports/port.h"
#include "emulator/serve/ports/private_folder.h"
#include "emulator/serve/ports/tcp_door.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/frames/frame_log.h"
#include "emulator/world/recording/recording_spool.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/trace/trace_file.h"
#include "emulator/world/trace/world_capture.h"
#include "emulator/world/world.h"
#include "pty/presence_watch.h"

namespace understudy::emulator::serve {

struct DaemonOptions {
  Speed speed;
  bool is_host_simulated = false;  // the host runs in simulated time: doors are served on demand
  bool strict_framing = false;
  std::optional<SimTime> patience{};  // the longest wait for the rest of a frame; empty: depends on the speed
  bool enforce_settings = true;
  DoorMaker door{};        // empty: the daemon accepts no control messages
  std::string bench_path;  // the path of the bench's file; empty if there is no file
  bool watch_signals = true;
  std::string capture_path;  // empty: no capture
  std::string record_path;   // empty: no recording
  std::size_t record_cap_bytes = world::kRecordingCapBytes;
  std::string trace_path;  // .csv or .vcd; empty: no trace
  std::vector<std::string> trace_also;
  std::string version;  // the program's version, for the recording
  FileClaims files{};   // files that no snapshot may replace; the daemon adds the files that it opens itself
};

class Daemon {
 public:
  /// Opens everything. Throws SettingError, PortError, ControlError, CaptureError or GrowingFileError.
  Daemon(const world::Bench& bench, const DaemonOptions& options,
         std::function<void(const std::string&)> log);
  ~Daemon();
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

  /// Runs until SIGTERM, SIGINT or SIGHUP (if the daemon watches signals), or until stop().
  void run();
  /// Ends run() soon. Call this only on the thread that executes run().
  void stop() { stopping_ = true; }
  /// Calls `act` on the daemon's thread, outside World::advance_to(). May be called on any thread. `act` may
  /// put the world into another state; simulated time then continues from there. After run() has ended,
  /// pending calls are dropped, and this function returns false.
  bool post(std::function<void()> act);
  /// Runs `work` on a helper thread and posts its result. Use this for work that would delay the devices.
  void do_aside(std::function<std::function<void()>()> work);
  /// Returns true if run() has ended.
  bool is_over();
  /// Returns the event loop, which other parts can also use.
  EventLoop& loop() { return loop_; }

  world::World& world() { return world_; }
  const world::World& world() const { return world_; }
  const Pacer& pacer() const { return pacer_; }
  const std::vector<std::unique_ptr<Port>>& ports() const { return ports_; }
  const std::vector<std::unique_ptr<TcpDoor>>& doors() const { return doors_; }
  /// Returns the path of the daemon's door, or an empty text if there is no door.
  const std::string& control_path() const;
  const std::string& bench_path() const { return bench_path_; }
  /// Returns the most recent frames on the lines.
  const world::FrameLog& frames() const { return frames_; }
  /// Returns the data for observers.
  Observers& observers() { return observers_; }
  const Observers& observers() const { return observers_; }

  /// Pauses the clock, and ends an advance in progress.
  void pause();
  /// Resumes the clock. Returns false while an advance is in progress.
  bool resume();
  /// Sets the speed of simulated time from now on. Returns false while an advance is in progress. The
  /// patience with an incomplete frame still depends on the initial speed.
  bool set_speed(const Speed& speed);
  bool is_advancing() const { return advance_done_ != nullptr; }
  /// Advances simulated time by `duration`, or to the end of the first tick at which `is_met` is true (it is
  /// called at the end of every tick), then calls `done`. Returns false while the clock is running or another
  /// advance is in progress.
  bool advance(SimTime duration, std::function<void()> done, std::function<bool()> is_met = {});
  /// From now on `driver` is called until an advance is over, and calls work_on_advance() whenever time may
  /// pass. Without one, time may always pass.
  void set_advance_driver(std::function<void()> driver) { advance_driver_ = std::move(driver); }
  /// Returns true if the waits of a host in simulated time move the clock.
  bool is_host_timed() const { return advance_driver_ != nullptr; }
  /// Holds the clock if the debugger has stopped the world. Returns true if so.
  bool is_held();
  /// Works on the advance in progress, for a few milliseconds, and not beyond `limit`.
  void work_on_advance(SimTime limit);
  /// Advances simulated time to `time` before it returns. The clock must be stopped, and no advance in
  /// progress.
  void advance_at_once(SimTime time) {
    world_.advance_to(time);
    pacer_.moved_to(world_.now(), wall_now());
  }
  /// Stores and records that a thread of a host in simulated time has waited since `since`.
  void record_wait(std::size_t thread, SimTime since, const std::string& text);
  /// Brings the world to the present moment, or as far as it gets in a few milliseconds.
  void catch_up();
  /// Like catch_up(), but takes up to a tenth of a second. Used for bytes that get the time of this moment.
  void catch_up_for_bytes();

  /// Returns the hash of the world's bench, for snapshots.
  std::uint64_t bench_hash() const { return bench_hash_; }
  /// Returns all files that the daemon uses, including its ports and its control socket.
  FileClaims files() const;
  /// Returns the reason why the world cannot be put into another state now, or an empty text.
  std::string_view why_no_restore() const;
  /// Puts the world into another state. Simulated time continues from there, and connected hosts stay
  /// connected. If this throws StateError, nothing has changed.
  void restore(const world::WorldState& state);
  /// Replaces the earlier frames and events for observers.
  void restart_logs(std::vector<world::FrameLog::Frame> frames, std::vector<world::Event> events);

 private:
  void watch_signals();
  void watch_posts();
  void end_posts();
  void make_ports(const world::Bench& bench);
  void watch_presence();
  void make_doors(const world::Bench& bench, TcpDoor::Service service);
  void open_files(const world::Bench& bench, const DaemonOptions& options);
  void judge_stall(WallTime now);
  void catch_up(WallTime longest);
  bool work_towards(SimTime target, WallTime until);
  void go_on_with_advance();
  bool makes_time_go() const;
  bool waits_for_hosts();
  SimTime longest_step() const;
  void work_towards_condition(SimTime limit);
  std::optional<WallTime> next_wake() const;
  void wait();

  EventLoop loop_;
  std::function<void(const std::string&)> log_;
  world::World world_;
  world::FrameLog frames_;
  MissingStations missing_stations_;
  Observers observers_;
  std::string bench_path_;
  std::uint64_t bench_hash_;
  FileClaims files_;
  std::unique_ptr<world::WorldCapture> capture_;
  std::unique_ptr<NvKeeper> memories_;
  std::unique_ptr<world::RecordingSpool> recording_;
  std::unique_ptr<world::TraceFile> trace_;
  Pacer pacer_;
  PrivateFolder private_folder_;  // for links whose paths the user did not choose
  std::shared_ptr<pty::PresenceWatch> presence_ = std::make_shared<pty::PresenceWatch>();
  std::vector<std::unique_ptr<Port>> ports_;
  std::vector<std::unique_ptr<TcpDoor>> doors_;
  std::unique_ptr<Door> door_;
  int signals_ = -1;
  int posted_signal_ = -1;  // an eventfd
  std::mutex posted_mutex_;
  std::vector<std::function<void()>> posted_;
  bool is_over_ = false;  // guarded by the same mutex
  std::unique_ptr<HelperThread> helper_ = std::make_unique<HelperThread>();
  bool stopping_ = false;
  std::optional<WallTime> planned_;       // when the loop planned to wake up; used once
  std::optional<WallTime> behind_since_;  // when the daemon began to catch up; nothing: it is up to date

  SimTime advance_target_{0};
  std::function<bool()> advance_is_met_;  // may be empty
  std::function<void()> advance_driver_;
  std::function<void()> advance_done_;  // set while an advance is in progress
};

}  // namespace understudy::emulator::serve
