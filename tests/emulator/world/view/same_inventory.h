// Compares the description of a bench with the world that is made from it.
#pragma once

#include <gtest/gtest.h>

#include "emulator/device/axes.h"
#include "emulator/device/named_values.h"
#include "emulator/world/view/bench_inventory.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

inline void expect_same_machine(const PlantSetup& here, const PlantSetup& there) {
  EXPECT_EQ(here.position_pulses, there.position_pulses);
  EXPECT_EQ(here.travel.has_value(), there.travel.has_value());
  EXPECT_EQ(here.lower_limit, there.lower_limit);
  EXPECT_EQ(here.upper_limit, there.upper_limit);
  EXPECT_EQ(here.encoder_counts_per_revolution, there.encoder_counts_per_revolution);
  EXPECT_EQ(here.pulses_per_revolution, there.pulses_per_revolution);
  EXPECT_EQ(here.has_wheel, there.has_wheel);
  EXPECT_EQ(here.drive.has_value(), there.drive.has_value());
}

/// Compares the properties of a device that names can refer to.
inline void expect_same_device(const Device& here, const Device& there) {
  EXPECT_EQ(here.name(), there.name());
  EXPECT_EQ(&here.model(), &there.model());
  EXPECT_EQ(here.firmware(), there.firmware());
  EXPECT_EQ(here.register_bank() == nullptr, there.register_bank() == nullptr);
  EXPECT_EQ(here.named_values() == nullptr, there.named_values() == nullptr);
  ASSERT_EQ(here.axes() == nullptr, there.axes() == nullptr);
  if (there.axes() == nullptr) return;
  EXPECT_EQ(here.axes()->pulse_formats().size(), there.axes()->pulse_formats().size());
  for (std::size_t a = 0; a < there.model().axes.size(); ++a) {
    const int axis = static_cast<int>(a);
    EXPECT_EQ(here.axes()->duty_percent(axis).has_value(), there.axes()->duty_percent(axis).has_value());
  }
}

inline void expect_same_inventory(const Bench& bench) {
  const BenchInventory inventory(bench);
  const World world(bench, WorldOptions{}, {});
  ASSERT_EQ(inventory.line_count(), world.line_count());
  for (std::size_t i = 0; i < world.line_count(); ++i) {
    EXPECT_EQ(inventory.line_name(i), world.line(i).line.name());
  }
  ASSERT_EQ(inventory.known().size(), world.device_count());
  ASSERT_EQ(world.known().size(), world.device_count());
  for (std::size_t d = 0; d < world.device_count(); ++d) {
    const KnownDevice& here = inventory.known()[d];
    SCOPED_TRACE(here.name);
    EXPECT_EQ(here.name, world.known()[d].name);
    EXPECT_EQ(here.lines, world.known()[d].lines);
    EXPECT_EQ(here.name, world.device(d).name());
    EXPECT_EQ(here.model, &world.device(d).model());
    EXPECT_EQ(here.firmware, world.device(d).firmware());
    expect_same_device(inventory.device(d), world.device(d));
    for (std::size_t a = 0; a < here.model->axes.size(); ++a) {
      const int axis = static_cast<int>(a);
      expect_same_machine(inventory.machine(d, axis), world.plant(d, axis).setup());
    }
  }
}

}  // namespace understudy::emulator::world
