// Looks after the faults of a world that wait for something: stations ask it about frames, the world asks it
// about time. There is none if nothing waits.
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

  /// All must outlive it. The faults must be possible in this world (check_fault); when faults come or go,
  /// make a new one.
  FaultWatch(World& world, Faults& faults, std::uint64_t seed);

  // --- time ------------------------------------------------------------------------------------
  /// When look() wants to be called next by the clock, as is_tick = false; kForever if it does not.
  SimTime next_moment() const;
  /// The first tick after `done` at whose end it wants to be called.
  Tick next_tick(Tick done) const;
  /// Notes in its course what has begun or ended by now.
  void look(SimTime now, bool is_tick);
  bool has_news() const;

  // --- frames ----------------------------------------------------------------------------------
  bool is_early(const HeardFrame& frame) override;
  std::vector<pty::WireFault> on_request(const HeardFrame& frame) override;
  Treatment on_serving(const HeardFrame& frame) override;
  std::vector<pty::WireFault> on_reply(const HeardFrame& frame) override;

 private:
  bool holds(const std::string& expression) override;
  bool is_at(const Fault& fault, const HeardFrame& frame) const;
  bool is_hit(std::size_t number, ArmedFault& armed, const HeardFrame& frame);
  bool is_request_hit(std::size_t number, ArmedFault& armed, const HeardFrame& frame);
  void tell(const HeardFrame& frame, bool is_reply, bool is_said, std::span<const pty::Strike> strikes);
  std::uint64_t stream(std::size_t number) const;

  World& world_;
  Faults& faults_;
  std::uint64_t seed_;
  std::vector<std::vector<std::size_t>> lines_;  // of the devices, by their ports
  Probes probes_;
  std::map<std::string, Expression> conditions_;
};

/// What is wrong with a machine's encoder at the end of `tick`, in counts.
std::int64_t encoder_noise_counts(const Fault& fault, Tick tick);

}  // namespace understudy::emulator::world
