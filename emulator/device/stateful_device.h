// The base of a device whose whole state is one value: how the state is compared, saved, told apart and
// restored, said once. `State` has operator== and its fields (base/state/fields.h). A device that prepares
// the state before it is read (RS-M8194H), or does more once it is in force (SUPER-40NC), writes these
// functions itself.
//
// What is declared here is defined in stateful_device_bytes.h. Only the source that lists the fields includes
// that, and instantiates it for its device:
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
  /// Returns the state as if all ticks up to now had been run one by one. A device that leaves something of
  /// skipped ticks for later hides this with a function of its own.
  const State& settled() const { return state_; }
  bool same_state(const Device& other) const final;

 protected:
  /// Throws StateError for a state that no device made like this one can be in, and completes one with what
  /// does not stand in its bytes.
  virtual void check_restored(State& restored) const = 0;

  void write_own_state(StateWriter& writer) const final;
  std::function<void()> read_own_state(StateReader& reader) final;
  std::string own_difference(StateReader& a, StateReader& b) const final;

  State state_{};

 private:
  const Itself& itself() const { return static_cast<const Itself&>(*this); }
};

}  // namespace understudy::emulator
