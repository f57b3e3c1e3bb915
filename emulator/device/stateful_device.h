// The base of a device whose whole state is one value. It defines how the state is saved, compared and
// restored. `State` must have a field list (base/state/fields.h).
//
// stateful_device_bytes.h defines the members that are declared here. Only the source file that lists the
// fields includes it, and instantiates this class for its device:
//
//   template class understudy::emulator::StatefulDevice<Gate, GateState>;
#pragma once

#include <functional>
#include <string>

#include "emulator/device/device.h"
#include "emulator/device/device_of.h"

namespace understudy::emulator {

template <typename Itself, typename State>
class StatefulDevice : public DeviceOf<Itself> {
 public:
  using DeviceOf<Itself>::DeviceOf;

  const State& state() const { return state_; }
  /// Returns the state as if all ticks up to now had been run one by one. A device that postpones part of its
  /// skipped ticks hides this function with its own.
  const State& settled() const { return state_; }

 protected:
  /// Throws StateError for a state that is impossible for a device with these settings. Fills in members that
  /// the bytes do not contain.
  virtual void check_restored(State& restored) const = 0;
  /// Puts a checked state into effect. A device with data outside its state adjusts that data here.
  virtual void take_over(const State& restored) { state_ = restored; }

  void write_own_state(StateWriter& writer) const final;
  std::function<void()> read_own_state(StateReader& reader) final;
  std::string own_difference(StateReader& a, StateReader& b) const final;

  State state_{};
};

}  // namespace understudy::emulator
