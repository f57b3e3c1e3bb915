// A device without facets reports no registers, terminals, axes, memory, programs or motion.
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

#include "base/state/state_bytes.h"
#include "emulator/device/device.h"
#include "emulator/device/terminals.h"
#include "emulator/world/bench_file/bench_file.h"
#include "tests/emulator/device/register_map/toy_device.h"

namespace understudy::emulator {
namespace bare_device_test {

constexpr Protocol kSmokeSigns{"smoke signs"};
constexpr int kBauds[] = {300, 1200};
constexpr PortRow kPorts[] = {{.name = "HILL", .bauds = kBauds, .settings = {}}};
constexpr TerminalRow kLamp[] = {{TerminalRow::Kind::digital_out, "LAMP"}};
constexpr AxisRow kWheel[] = {{.name = "A"}};

/// Only its state, which is empty.
class BareDevice final : public Device {
 public:
  using Device::Device;

 protected:
  void write_own_state(StateWriter&) const override {}
  std::function<void()> read_own_state(StateReader&) override {
    return [] {};
  }
  std::string own_difference(StateReader&, StateReader&) const override { return ""; }
};

template <const Model& (*model_of)()>
std::unique_ptr<Device> make_bare(const DeviceSettings& settings) {
  return std::make_unique<BareDevice>(model_of(), settings);
}

Model bare_model() {
  return {.name = "bare",
          .title = "",
          .firmwares = kToyFirmwares,
          .choices = {},
          .terminals = {},
          .axes = {},
          .state_registers = {},
          .known_limitations = {},
          .line = {.protocol = kSmokeSigns, .ports = kPorts},
          .make = nullptr};
}

const Model& bare() {
  static const Model model = [] {
    Model made = bare_model();
    made.make = make_bare<bare>;
    return made;
  }();
  return model;
}

DeviceSettings settings_at(int address) {
  DeviceSettings settings;
  settings.name = "it";
  settings.address = address;
  return settings;
}

std::string diagnostic_of_making(const Model& model, const DeviceSettings& settings = settings_at(1)) {
  try {
    make_device(model, settings);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(BareDevice, LivesWithoutAnyFacet) {
  const auto device = make_device(bare(), settings_at(1));
  EXPECT_EQ(device->line_settings(0).baud, 300);
  device->sample_inputs(1);
  device->run_interpreters(1);
  device->step_motion(1);
  device->update_outputs(1);
  EXPECT_EQ(device->next_active_tick(1), kNever);
  const auto before = device->save_state();
  device->switch_power(false);
  device->switch_power(true);
  EXPECT_EQ(device->save_state(), before);
  EXPECT_EQ(device->terminals(), nullptr);
}

TEST(BareDevice, RefusesWhatItHasNoFacetFor) {
  EXPECT_FALSE(find_register(bare(), "Speed", 100));
  EXPECT_TRUE(register_rows(bare()).empty());
  EXPECT_EQ(diagnostic_of_making(bare(), settings_at(1000)), "");  // it has no station number
  DeviceSettings settings = settings_at(1);
  settings.set.emplace_back("Speed", 1);
  EXPECT_EQ(diagnostic_of_making(bare(), settings), "set: no register is called 'Speed'; there is none");
}

const Model& with_lamp() {
  static const Model model = [] {
    Model made = bare_model();
    made.terminals = kLamp;
    made.make = make_bare<with_lamp>;
    return made;
  }();
  return model;
}

const Model& with_wheel() {
  static const Model model = [] {
    Model made = bare_model();
    made.axes = kWheel;
    made.make = make_bare<with_wheel>;
    return made;
  }();
  return model;
}

const Model& with_frames() {
  static const Model model = [] {
    Model made = bare_model();
    made.rtu = RtuRules{.functions = kToyFunctions};
    made.make = make_bare<with_frames>;
    return made;
  }();
  return model;
}

const Model& without_port() {
  static const Model model = [] {
    Model made = bare_model();
    made.line.ports = {};
    made.make = make_bare<without_port>;
    return made;
  }();
  return model;
}

TEST(BareDevice, IsNotMadeOfAModelThatListsMore) {
  EXPECT_EQ(diagnostic_of_making(with_lamp()), "bare: lacks the facet Terminals, for its terminals");
  EXPECT_EQ(diagnostic_of_making(with_wheel()), "bare: lacks the facet Axes, for its axes");
  EXPECT_EQ(diagnostic_of_making(with_frames()), "bare: lacks the facet ModbusStation, for its `rtu`");
  EXPECT_EQ(diagnostic_of_making(without_port()), "bare: has no port on its line");
}

// A bench uses a model's ports before any device is made.
TEST(BareDevice, OfAModelWithoutAPortIsRefusedByABench) {
  const std::array<ListedModel, 1> models{&without_port()};
  try {
    world::parse_bench(models, "understudy: 1\nlines: { a: { stations: [ { name: x, model: bare } ] } }\n",
                       "b.yaml", ".");
    ADD_FAILURE() << "taken";
  } catch (const std::logic_error& error) {
    EXPECT_STREQ(error.what(), "bare: has no port on its line");
  }
}

}  // namespace bare_device_test
}  // namespace understudy::emulator
