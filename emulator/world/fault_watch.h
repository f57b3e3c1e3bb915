// Decides when the faults of a world take effect: stations ask it about each frame, and the world about time.
// It exists only while a fault is waiting for something or changes with time.
#pragma once

#include <map>
#include <span>
#include <string>

#include "emulator/world/expression/expression.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/probe/probes.h"
#include "emulator/world/stations/frame_faults.h"
#include "pty/line_observer.h"

namespace understudy::emulator::world {

class World;

class FaultWatch final : public FrameFaults, private ConditionSource {
 public:
  using Faults = std::map<std::size_t, ArmedFault>;  // by number

  /// `world` and `faults` must outlive this object. The faults must be possible in this world (check_fault).
  /// When a fault is added or removed, create a new watch.
  FaultWatch(World& world, Faults& faults, std::uint64_t seed);

  // --- time ------------------------------------------------------------------------------------
  /// Returns when check() must be called next between ticks (is_tick = false), or kForever.
  SimTime next_moment() const;
  /// Returns the first tick after `done` at whose end check() must be called.
  Tick next_tick(Tick done) const;
  /// Records which faults have begun or ended.
  void check(SimTime now, bool is_tick);
  bool has_news() const;

  // --- frames ----------------------------------------------------------------------------------
  bool is_early(const ReceivedFrame& frame) override;
  std::vector<pty::WireFault> on_request(const ReceivedFrame& frame) override;
  Treatment on_serving(const ReceivedFrame& frame) override;
  std::vector<pty::WireFault> on_reply(const ReceivedFrame& frame) override;

 private:
  bool holds(const std::string& expression) override;
  bool is_at(const Fault& fault, const ReceivedFrame& frame) const;
  bool is_hit(std::size_t number, ArmedFault& armed, const ReceivedFrame& frame);
  bool is_request_hit(std::size_t number, ArmedFault& armed, const ReceivedFrame& frame);
  void report(const ReceivedFrame& frame, bool is_reply, bool is_sent, std::span<const pty::Strike> strikes);
  std::uint64_t stream(std::size_t number) const;

  World& world_;
  Faults& faults_;
  std::uint64_t seed_;
  std::vector<std::vector<std::size_t>> lines_;  // [device][port]: the line's number
  Probes probes_;
  std::map<std::string, Expression> conditions_;
};

/// Returns the error of a machine's encoder at the end of `tick`, in counts.
std::int64_t encoder_noise_counts(const Fault& fault, Tick tick);

}  // namespace understudy::emulator::world
