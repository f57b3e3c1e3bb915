// Records the run log of a scenario.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "emulator/play/performing/observer.h"
#include "emulator/play/report/envelope.h"
#include "emulator/play/report/run_log.h"
#include "emulator/world/probe/probes.h"
#include "pty/capture_frames.h"

namespace understudy::emulator::play {

class RunLogger final : public Observer, private world::TickWatcher {
 public:
  explicit RunLogger(world::World& world);
  ~RunLogger() override;
  RunLogger(const RunLogger&) = delete;
  RunLogger& operator=(const RunLogger&) = delete;

  void world_restored(std::size_t steps) override;
  /// Adds a wait of a host in simulated time.
  void add(SeenWait wait) { stretch_.waits.push_back(std::move(wait)); }
  /// Sets ScenarioResult::run_log.
  void finish(ScenarioResult& result) override;

 private:
  struct ObservedSignal {
    SeenSignal::Kind kind;
    std::string name;
    std::int32_t handle;
    Envelope values;
  };
  void add_signal(const std::string& name, SeenSignal::Kind kind);
  void watch_lines();
  void ignore_lines();
  void on_tick(Tick tick) override;
  Tick next_poll(Tick done) const override;
  void on_rest(Tick last) override;
  void add(const pty::CapturedPacket& packet);
  void end_stretch();

  world::World& world_;
  world::Probes probes_;
  std::vector<ObservedSignal> signals_;
  std::vector<std::unique_ptr<pty::CaptureFrames>> framers_;  // one per line
  /// The last requests without an answer; the newest request is last. They are needed to decode replies.
  struct Request {
    std::size_t line = 0;
    std::uint64_t last_character = 0;
    const Device* to = nullptr;  // the device that it addressed when it was sent
    std::vector<std::uint8_t> bytes{};
  };
  Request taken_request(const pty::CapturedPacket& reply);
  std::deque<Request> requests_;
  Stretch stretch_;
  RunLog run_log_;
};

}  // namespace understudy::emulator::play
