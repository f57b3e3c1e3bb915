// Random courses of described controllers: many ticks in one step, snapshots, and memories.
#include <gtest/gtest.h>

#include <random>

#include "emulator/device/memory/persistent_memory.h"
#include "emulator/world/snapshot.h"
#include "tests/emulator/models/imported/one_described.h"
#include "tests/emulator/world/same_world.h"
#include "tests/sanitized.h"

namespace understudy::emulator::models::imported {
namespace course_test {

class Course {
 public:
  explicit Course(std::uint64_t seed) : random_(seed) {}
  std::int64_t between(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
  }
  bool one_in(std::int64_t many) { return between(1, many) == 1; }

  std::string machine() {
    std::string what = "position: " + std::to_string(between(-500, 500));
    if (!one_in(3)) what += ", home: { at: -100, width: 60, hysteresis: 3 }";
    if (!one_in(3)) what += ", limits: { lower: -3000, upper: 4000 }";
    if (one_in(2)) what += ", travel: [ -3500, 4500 ]";
    if (one_in(2)) what += ", encoder: { per_revolution: 400 }";
    return what;
  }
  std::string model() {
    std::string more = ", pulses_per_revolution: 200";
    if (one_in(2)) more += ", enable: CONTROL.ENABLE";
    if (one_in(2)) more += ", pulses_per_count: 7/3, pps_per_count: 1.5";
    if (one_in(3)) more += ", while_busy: ignore";
    if (one_in(3)) more += ", start_speed: 50";
    return axis_model(more);
  }

  struct Act {
    enum class What { write, input, power } what;
    std::string name;
    Value value;
  };
  Act act() {
    switch (between(0, 9)) {
      case 0: return {Act::What::write, "TARGET", between(-5000, 5000)};
      case 1: return {Act::What::write, "DISTANCE", between(-3000, 3000)};
      case 2: return {Act::What::write, "SPEED", one_in(4) ? between(-100, 100) : between(0, 40'000)};
      case 3: return {Act::What::write, "RAMP", between(0, 900)};
      case 4: return {Act::What::write, "CONTROL", between(0, 7)};
      case 5:
      case 6: return {Act::What::write, "COMMAND", between(0, 5)};
      case 7: return {Act::What::write, one_in(2) ? "SETPOINT" : "POSITION", between(-1000, 1000)};
      case 8: return {Act::What::input, "", between(0, 7)};
      default: return {one_in(6) ? Act::What::power : Act::What::write, "COMMAND", between(0, 2)};
    }
  }

 private:
  std::mt19937_64 random_;
};

void act_on(OneDescribed& one, const Course::Act& act) {
  switch (act.what) {
    case Course::Act::What::write: one.write(act.name, act.value); break;
    case Course::Act::What::input:
      one.world.set_external_input(0, static_cast<int>(act.value / 2), static_cast<int>(act.value % 2));
      break;
    case Course::Act::What::power: one.world.switch_power(0, act.value % 2 != 0); break;
  }
}

TEST(DescribedCourses, AreTheSameBySingleTicksAndAfterARestore) {
  std::uint64_t skipped = 0;
  for (std::uint64_t seed = 0; seed < fewer_if_sanitized(60U, 4U); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Course course(seed);
    const std::string model = course.model();
    const std::string machine = course.machine();
    OneDescribed plain(model, machine);
    OneDescribed twin(model, machine);
    twin.world.set_bulk_ticks(false);
    for (int i = 0; i < 30; ++i) {
      const auto act = course.act();
      const Tick ticks = course.one_in(3) ? course.between(0, 20) : course.between(0, 6000);
      for (OneDescribed* one : {&plain, &twin}) {
        act_on(*one, act);
        one->advance(ticks);
      }
      ASSERT_TRUE(world::same_state(plain.world, twin.world)) << "after act " << i;
      if (course.one_in(5)) {
        OneDescribed other(model, machine);
        world::restore(other.world, world::save(plain.world));
        ASSERT_TRUE(world::same_state(plain.world, other.world)) << "restored after act " << i;
        other.advance(100);
        OneDescribed same(model, machine);
        world::restore(same.world, world::save(plain.world));
        same.world.set_bulk_ticks(false);
        same.advance(100);
        ASSERT_TRUE(world::same_state(other.world, same.world)) << "after act " << i;
      }
    }
    skipped += plain.world.ticks_skipped();
    EXPECT_EQ(twin.world.ticks_skipped(), 0U);
  }
  EXPECT_GT(skipped, fewer_if_sanitized(500'000U, 4U));
}

TEST(DescribedMemory, KeepsWhatTheListCallsPersistent) {
  OneDescribed one;
  one.write("RAMP", 77);
  one.write("SETPOINT", -5);
  one.write("SPARE", value_of_real(1.5F));
  one.write("TARGET", 9);
  const NvImage image = one.device().memory()->nv_image();
  EXPECT_EQ(image.model, "one");
  EXPECT_EQ(image.registers, (std::vector<std::pair<std::string, Value>>{{"RAMP", 77}, {"SETPOINT", -5}}));
  ASSERT_EQ(image.reals.size(), 1U);
  one.world.switch_power(0, false);
  one.world.switch_power(0, true);
  EXPECT_EQ(one.read("RAMP"), 77);
  EXPECT_EQ(one.read("SETPOINT"), -5);
  EXPECT_EQ(one.read("TARGET"), 0);
  DeviceSettings settings;
  settings.name = "it";
  settings.nv = image;
  const auto device = make_device(one.device().model(), settings);
  EXPECT_EQ(read_value(*device->register_bank(), *device->register_bank()->find("SETPOINT")), -5);
}

/// If values are stored unchecked, a memory contains them, and is read back.
TEST(DescribedMemory, KeepsWhatIsBeyondItsRange) {
  OneDescribed one(axis_model() + "map: { out_of_range: stored }\n");
  one.write("SETPOINT", 5000);
  DeviceSettings settings;
  settings.name = "it";
  settings.nv = one.device().memory()->nv_image();
  const auto device = make_device(one.device().model(), settings);
  EXPECT_EQ(read_value(*device->register_bank(), *device->register_bank()->find("SETPOINT")), 5000);
}

TEST(DescribedTerminals, AreWhatTheirRegistersSay) {
  OneDescribed one;
  EXPECT_FALSE(one.device().terminals()->output(4));
  one.write("CONTROL.15", 1);
  EXPECT_TRUE(one.device().terminals()->output(4));
  one.world.set_external_input(0, 2, 1);
  one.advance(1);
  EXPECT_EQ(one.read("SWITCHES"), 1);
  one.world.switch_power(0, false);
  EXPECT_FALSE(one.device().terminals()->output(4));
}

/// A register that shows an input has its default until the input gets a level.
TEST(DescribedTerminals, BeginAsTheirRegistersDo) {
  const std::string list =
      "address,name,access,type,default\n0,LEVEL,R,s16,-250\n1,STATES,R,u16,4\n2,SPARE,R/W,u16,0\n";
  OneDescribed one(model_file::model_with(list, "inputs: { SENSOR: LEVEL, A: STATES.1, B: STATES.2 }\n"));
  EXPECT_EQ(one.read("LEVEL"), -250);
  EXPECT_EQ(one.read("STATES"), 4);
  one.world.switch_power(0, false);
  one.world.switch_power(0, true);
  one.advance(1);
  EXPECT_EQ(one.read("LEVEL"), -250);
  one.world.set_external_input(0, 0, 7);
  one.world.set_external_input(0, 2, 0);
  one.advance(1);
  EXPECT_EQ(one.read("LEVEL"), 7);
  EXPECT_EQ(one.read("STATES"), 0);
}

TEST(DescribedTerminals, TheFirstIsShownLikeAnyOther) {
  OneDescribed one(
      model_file::model_with("address,name,access\n0,STATE,R\n",
                             "inputs: { ALARM: nowhere }\n"
                             "axes: { A: { alarm: STATE.0, ready: STATE.1, inputs: { alarm: ALARM } } }\n"));
  EXPECT_EQ(one.read("STATE"), 2);
  one.world.set_external_input(0, 0, 1);
  one.advance(1);
  EXPECT_EQ(one.read("STATE"), 1);
}

/// Any write is accepted or refused, without other effects.
TEST(DescribedCourses, OutliveAnyNumbers) {
  std::mt19937_64 random(7);
  OneDescribed one(axis_model(", pulses_per_count: 2147483647, pps_per_count: 1e9, rated_speed: 2147483647"));
  for (int i = 0; i < 3000; ++i) {
    const char* kNames[] = {"CONTROL", "COMMAND", "TARGET",   "DISTANCE",
                            "SPEED",   "RAMP",    "POSITION", "SETPOINT"};
    const Value values[] = {0, 1, 2, 3, 4, 5, 32767, 65535, INT32_MAX, INT32_MIN, -1};
    one.write(kNames[random() % std::size(kNames)], values[random() % std::size(values)]);
    one.advance(static_cast<Tick>(random() % 3));
  }
  EXPECT_TRUE(one.device().powered());
}

}  // namespace course_test
}  // namespace understudy::emulator::models::imported
