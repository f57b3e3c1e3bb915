#include "benchmarks/busy_bench.h"

#include <string>
#include <vector>

#include "benchmarks/process.h"
#include "emulator/device/axes.h"
#include "emulator/device/register_map/access.h"
#include "emulator/models/models.h"
#include "interpreter/simple2/listing.h"

namespace understudy::benchmarks {

namespace {

using namespace understudy::emulator;

constexpr std::size_t kStationsALine = 15;
constexpr std::uint16_t kFirstCell = 0x4000;
constexpr std::size_t kWordsARequest = 120;

// The part of the program that does not move axes: it counts, calculates, reads STATUS and inputs, and
// switches an output.
constexpr std::string_view kWork =
    "work:   Counter_Increase 1\n"
    "        VAR_Add VAR32 Cord_A\n"
    "        Load_CalcREG VAR40\n"
    "        Out DOUT_4 ON\n"
    "        VAR_DirectGT VAR40 0\n"
    "        Out DOUT_4 OFF\n"
    "        Jump_STATUS_ON done 0\n"
    "        Jump_IN_ON done DIN_10\n";
constexpr std::string_view kEnd = "done:   END\n";

std::string program_of(Activity activity) {
  const auto program = [](std::string_view before, std::string_view after) {
    return std::string(before) + std::string(kWork) + std::string(after) + std::string(kEnd);
  };
  switch (activity) {
    case Activity::positions:
      return program(
          "        SVON_ALL\n"
          "        Move_Speed_ALL MEM0 MEM0\n"
          "        Move_AccDec_ALL MEM1 MEM1\n"
          "again:  VAR_INV VAR33\n"
          "        VAR_INV VAR34\n"
          "        Move_INC_ALL VAR33 VAR34\n",
          "        Wait_Move_ALL work\n"
          "        Jump again\n");
    case Activity::velocity:
      return program(
          "        SVON_ALL\n"
          "again:  VAR_INV VAR35\n"
          "        VelmRPM_A VAR35\n"
          "        VelmRPM_B VAR35\n"
          "        Timer_Reset 1\n"
          "        Timer_Start 1\n",
          "        Jump_Timer1_GE again MEM2\n"
          "        Jump work\n");
    case Activity::sync:
      return program(
          "        SVON_ALL\n"
          "        SyncMode_A\n"
          "        SyncMode_B\n",
          "        Jump work\n");
    case Activity::homing:
      return program(
          "        SVON_ALL\n"
          "        Move_Speed_ALL MEM0 MEM0\n"
          "        Move_AccDec_ALL MEM1 MEM1\n"
          "again:  Move_INC_ALL_Wait VAR33 VAR34\n"
          "        Move_Home_ALL\n",
          "        Wait_Move_ALL work\n"
          "        Jump again\n");
    case Activity::waiting: return "        Wait_IO DIN_10 ON\n        END\n";
    case Activity::idle: break;
  }
  return {};
}

emulator::world::DeviceSetup device_setup(std::size_t number) {
  emulator::world::DeviceSetup device;
  device.model = emulator::find_model(emulator::models::all_models(), "simple2-r3");
  device.settings.name = "d" + std::to_string(number);
  device.settings.address = static_cast<int>(number % kStationsALine) + 1;
  // Devices differ a little, so that their moves do not begin and end in the same ticks.
  const auto own = static_cast<emulator::Value>(number);
  device.settings.set = {
      {"PROG_VAR1", 80'000 + 37 * own},
      {"PROG_VAR2", 80'000 + 35 * own},
      {"PROG_VAR3", 90'000},      // mrpm
      {"PROG_MEM0", 300},         // rpm: 16 pulses per tick
      {"PROG_MEM1", 50},          // units of 10 ms
      {"PROG_MEM2", 4000 + own},  // ms
      {"Axis_VelMode_ACC", 32'768},
      {"Baxis_VelMode_ACC", 32'768},
      {"Aaxis_Home_Speed", 40},
      {"Baxis_Home_Speed", 40},
      {"Aaxis_Home_AccTime", 10},
      {"Baxis_Home_AccTime", 10},
  };
  for (const char* assigned : {"DIN0_Aaxis_Alarm", "DIN2_Aaxis_UP_Limit", "DIN3_Aaxis_DN_Limit",
                               "DIN4_Aaxis_Home", "DIN5_Baxis_Alarm", "DIN7_Baxis_UP_Limit",
                               "DIN8_Baxis_DN_Limit", "DIN9_Baxis_Home", "DOUT0_Aaxis_SVON"}) {
    device.settings.set.emplace_back(assigned, 1);
  }
  return device;
}

emulator::world::Bench bench_of(std::size_t devices, Activity activity) {
  emulator::world::Bench bench;
  for (std::size_t d = 0; d < devices; ++d) {
    bench.devices.push_back(device_setup(d));
    if (d % kStationsALine == 0) {
      emulator::world::LineSetup line;
      line.name = "line" + std::to_string(bench.lines.size());
      bench.lines.push_back(line);
    }
    bench.lines.back().stations.push_back(d);
    for (int axis = 0; axis < 2; ++axis) {
      emulator::world::PlantSetup plant;
      plant.home = emulator::world::PulseSpan{.first = -500, .last = 0};
      plant.lower_limit = -1'000'000;
      plant.upper_limit = 1'000'000;
      if (activity != Activity::sync) {
        plant.encoder_counts_per_revolution = 4000;
        plant.pulses_per_revolution = 3200;
      }
      bench.machines.push_back({.device = d, .axis = axis, .plant = plant});
    }
  }
  return bench;
}

void set(emulator::Device& device, std::string_view name, emulator::Value value) {
  const auto found = device.register_bank()->find(name);
  if (!found || emulator::write_value(*device.register_bank(), *found, value) != emulator::Refusal::none) {
    throw CannotRun(std::string(name) + " does not accept " + std::to_string(value));
  }
}

void load(emulator::Device& device, const std::string& text) {
  const auto assembly = interpreter::simple2::assemble(text);
  if (!assembly.lines) throw CannotRun("program: " + to_string(assembly.errors.front()));
  std::vector<std::uint16_t> cells;
  for (const auto& line : *assembly.lines) {
    for (const std::uint8_t cell : {line.command, line.data1, line.data2, line.flag}) cells.push_back(cell);
  }
  for (std::size_t first = 0; first < cells.size(); first += kWordsARequest) {
    const std::size_t count = std::min(kWordsARequest, cells.size() - first);
    if (emulator::write_words(*device.register_bank(), emulator::Table::holding,
                              static_cast<std::uint16_t>(kFirstCell + first),
                              std::span(cells).subspan(first, count)) != emulator::Refusal::none) {
      throw CannotRun("the device does not accept its program");
    }
  }
  set(device, "PROG_MAIN_RunTime_START", 0);
}

}  // namespace

std::string_view name_of(Activity activity) {
  switch (activity) {
    case Activity::positions: return "position moves";
    case Activity::velocity: return "velocity mode";
    case Activity::sync: return "sync mode";
    case Activity::homing: return "homing";
    case Activity::waiting: return "a program that waits";
    case Activity::idle: return "idle";
  }
  return "";
}

std::unique_ptr<emulator::world::World> make_busy_world(std::size_t devices, Activity activity) {
  auto world = std::make_unique<emulator::world::World>(
      bench_of(devices, activity), emulator::world::WorldOptions{}, [](const std::string&) {});
  const std::string program = program_of(activity);
  for (std::size_t d = 0; d < devices; ++d) {
    if (!program.empty()) load(world->device(d), program);
  }
  return world;
}

void begin_hour_long_move(emulator::world::World& world) {
  emulator::Device& device = world.device(0);
  set(device, "ALL_SVON", 1);
  set(device, "Aaxis_Pulse", 960'000);
  set(device, "Aaxis_Speed", 5);
  set(device, "Aaxis_AccTime", 50);
  set(device, "Aaxis_DecTime", 50);
  set(device, "Aaxis_Move_INC", 1);
}

void turn_encoders(emulator::world::World& world, Tick tick) {
  // The encoders turn back and forth, so that the axes stay between their limits.
  constexpr Tick kThere = 10'000;
  const Tick phase = tick % (2 * kThere);
  const std::int64_t counts = 16 * (phase < kThere ? phase : 2 * kThere - phase);
  for (std::size_t d = 0; d < world.device_count(); ++d) {
    for (int axis = 0; axis < 2; ++axis) world.device(d).axes()->set_encoder(axis, counts);
  }
}

}  // namespace understudy::benchmarks
