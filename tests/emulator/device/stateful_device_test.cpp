// A device whose state is one value: it is compared, saved, distinguished and restored as a whole, as if no
// tick had been skipped.
#include "emulator/device/stateful_device.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "base/state/fields.h"
#include "base/state/state_error.h"
#include "emulator/device/stateful_device_bytes.h"
#include "tests/emulator/device/register_map/toy_device.h"

namespace understudy::emulator::stateful_device_test {

constexpr std::int32_t kOpenings = 3;

struct GateState {
  std::int32_t opened = 0;
  Tick seen = 0;                  // the last tick, also if it was skipped
  std::int32_t left = kOpenings;  // is not part of the bytes

  bool operator==(const GateState&) const = default;
};

/// Opens at most three times. It records a tick only when it is run.
class Gate final : public StatefulDevice<Gate, GateState> {
 public:
  using StatefulDevice::StatefulDevice;

  GateState settled() const { return {.opened = state_.opened, .seen = now(), .left = state_.left}; }
  void open() {
    ++state_.opened;
    --state_.left;
  }
  void run(Tick tick) {
    state_.seen = tick;
    set_now(tick);
  }
  int restorations = 0;

 protected:
  void check_restored(GateState& restored) const override {
    require_state(restored.opened <= kOpenings, "it opens three times");
    restored.left = kOpenings - restored.opened;
  }
  void take_over(const GateState& restored) override {
    StatefulDevice::take_over(restored);
    ++restorations;
  }
};

}  // namespace understudy::emulator::stateful_device_test

template <>
struct understudy::StateOf<understudy::emulator::stateful_device_test::GateState> {
  using Value = understudy::emulator::stateful_device_test::GateState;
  static constexpr auto fields = FieldList{field<&Value::opened>(), field<&Value::seen>()};
  static constexpr std::size_t apart = 1;
};

template class understudy::emulator::StatefulDevice<understudy::emulator::stateful_device_test::Gate,
                                                    understudy::emulator::stateful_device_test::GateState>;

namespace understudy::emulator {
namespace stateful_device_test {

const Model& gate_model(std::size_t number) {
  static constexpr int kBauds[] = {9600};
  static constexpr PortRow kPorts[] = {{.name = "GATE", .bauds = kBauds, .settings = {}}};
  static const auto named = [](std::string_view name) {
    return Model{.name = name,
                 .title = "",
                 .firmwares = kToyFirmwares,
                 .choices = {},
                 .terminals = {},
                 .axes = {},
                 .state_registers = {},
                 .known_limitations = {},
                 .line = {.protocol = {"knocks"}, .ports = kPorts},
                 .make = nullptr};
  };
  static const Model models[] = {named("gate"), named("door")};
  return models[number];
}

TEST(StatefulDevice, IsTheSameByModelTimeAndState) {
  Gate gate(gate_model(0), {});
  Gate twin(gate_model(0), {});
  EXPECT_TRUE(gate.same_state(twin));
  EXPECT_FALSE(gate.same_state(Gate(gate_model(1), {})));
  gate.open();
  EXPECT_FALSE(gate.same_state(twin));
  twin.open();
  EXPECT_TRUE(gate.same_state(twin));
  gate.run(5);
  EXPECT_FALSE(gate.same_state(twin));
  twin.set_now(5);  // has skipped the tick
  EXPECT_NE(gate.state(), twin.state());
  EXPECT_TRUE(gate.same_state(twin));
}

TEST(StatefulDevice, IsSavedAsIfTicksHadBeenRun) {
  Gate gate(gate_model(0), {});
  gate.set_now(7);
  const std::vector<std::byte> saved = gate.save_state();
  Gate twin(gate_model(0), {});
  twin.restore_state(saved);
  EXPECT_EQ(twin.state().seen, 7);
  EXPECT_EQ(twin.save_state(), saved);
  gate.run(7);
  EXPECT_EQ(gate.save_state(), saved);
}

TEST(StatefulDevice, CompletesWhatItsBytesLeaveOut) {
  Gate gate(gate_model(0), {});
  gate.open();
  Gate twin(gate_model(0), {});
  const auto put = twin.read_state(gate.save_state());
  EXPECT_EQ(twin.state(), GateState{}) << "it is read only";
  EXPECT_EQ(twin.restorations, 0);
  put();
  EXPECT_EQ(twin.state(), gate.state());
  EXPECT_EQ(twin.state().left, 2);
  EXPECT_EQ(twin.restorations, 1);
  EXPECT_TRUE(twin.same_state(gate));
}

TEST(StatefulDevice, TellsItsFieldsApart) {
  Gate gate(gate_model(0), {});
  const std::vector<std::byte> before = gate.save_state();
  gate.open();
  EXPECT_EQ(gate.state_difference(before, gate.save_state()), "opened: 0 against 1");
}

TEST(StatefulDevice, RefusesAStateThatItCannotBeIn) {
  Gate gate(gate_model(0), {});
  for (int i = 0; i <= kOpenings; ++i) gate.open();
  const std::vector<std::byte> impossible = gate.save_state();
  Gate twin(gate_model(0), {});
  EXPECT_THROW(twin.restore_state(impossible), StateError);
  EXPECT_EQ(twin.state(), GateState{});
}

}  // namespace stateful_device_test
}  // namespace understudy::emulator
