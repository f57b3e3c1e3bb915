// Random acts in a world of two Simple2-R3: those of random_events.h, and programs with arbitrary lines,
// homing, velocity mode, power cuts and faults.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "interpreter/simple2/instructions.h"
#include "tests/emulator/world/random_events.h"

namespace understudy::emulator::world {

struct Act {
  SimTime at{0};
  std::function<void(World&)> carry_out;
};

class BusyActs {
 public:
  explicit BusyActs(std::uint64_t seed) : events_(seed), random_(seed + 1) {}

  std::int64_t between(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
  }

  std::vector<Act> make(int count) {
    std::vector<Act> acts;
    for (const RandomEvent& event : events_.make(count)) {
      acts.push_back({event.at, [event](World& world) { apply(world, event); }});
      if (between(0, 2) == 0) acts.push_back({event.at, something_more()});
    }
    return acts;
  }

 private:
  using Doing = std::function<void(World&)>;

  Doing something_more() {
    const std::string device = between(0, 1) == 0 ? "feeder" : "turner";
    const std::string axis = between(0, 1) == 0 ? "Aaxis_" : "Baxis_";
    const auto write = [&](const std::string& name, std::int64_t value) -> Doing {
      return [name = device + "." + name, value](World& world) {
        if (world.device(name[0] == 'f' ? 0 : 1).powered()) set(world, name, value);
      };
    };
    switch (between(0, 11)) {
      case 0: return some_program(device == "feeder" ? 0 : 1);
      case 1: return write("PROG_MAIN_RunTime_START", between(0, 20));
      case 2: return write(axis + "GoHome", 1);
      case 3: return write(axis + "Home_Speed", between(0, 40));
      case 4: return write(axis + "DirectmRPM", between(-200'000, 200'000));
      case 5: return write(axis + "SyncMode", 1);
      case 6: return write(axis + "DirectPWM", between(0, 100));
      case 7: return some_power_cut(device == "feeder" ? 0 : 1);
      case 8: return some_fault();
      case 9: return write("PROG_MEM" + std::to_string(between(0, 31)), between(-1000, 1000));
      case 10: return write(between(0, 9) == 0 ? "PROG_MAIN_Erase_ALL" : "AutoStart_MainProg", 1);
      default: return write("ALL_SVON", between(0, 5) != 0);
    }
  }

  /// Loads twenty lines of arbitrary commands; the last line jumps to the first.
  Doing some_program(std::size_t device) {
    std::vector<std::uint16_t> words;
    for (int line = 0; line < 20; ++line) {
      const auto& instruction = interpreter::simple2::kInstructions[static_cast<std::size_t>(
          between(0, std::size(interpreter::simple2::kInstructions) - 1))];
      words.push_back(instruction.opcode);
      words.push_back(operand(instruction.data1));
      words.push_back(operand(instruction.data2));
      words.push_back(static_cast<std::uint16_t>(line + 1));
    }
    for (const std::uint16_t word : {0x03, 1, 0, 0}) words.push_back(word);
    return [device, words](World& world) {
      if (!world.device(device).powered()) return;
      write_words(*world.device(device).register_bank(), Table::holding, 0x4000, words);
      set(world, world.device(device).name() + ".PROG_MAIN_RunTime_START", 0);
    };
  }

  std::uint16_t operand(interpreter::simple2::Operand kind) {
    using interpreter::simple2::Operand;
    switch (kind) {
      case Operand::none: return 0;
      case Operand::flag: return static_cast<std::uint16_t>(between(1, 20));
      case Operand::parameter: return static_cast<std::uint16_t>(between(0, 182));
      case Operand::amount_high: return 0;
      default: return static_cast<std::uint16_t>(between(0, between(0, 3) == 0 ? 200 : 6));
    }
  }

  Doing some_power_cut(std::size_t device) {
    const bool comes_back = between(0, 3) != 0;
    return [device, comes_back](World& world) {
      const bool had_power = world.device(device).powered();
      world.switch_power(device, false);
      if (comes_back || !had_power) world.switch_power(device, true);
    };
  }

  Doing some_fault() {
    const std::int64_t pulses = between(-20, 20);
    static const FaultText kFaults[] = {
        {"stall", "feeder.A", {}},
        {"lost_steps", "feeder.A", {{"one_in", "7"}}},
        {"alarm", "turner.B", {}},
        {"stuck", "feeder.DIN_2", {{"level", "1"}}},
        {"encoder_noise", "turner.B", {{"counts", "3"}, {"period", "4ms"}}},
        {"power_cut", "turner", {{"chance", "2%"}, {"for", "3ms"}}},
        {"delay", "rs485", {{"by", "15ms"}, {"of", "both"}, {"every", "2"}}},
        {"duplicate", "feeder", {{"after", "9ms"}, {"chance", "40%"}}},
        {"noise", "turner", {{"before", "FF"}, {"when", "feeder.A.pulses > 5"}}},
        {"slow", "turner", {{"by", "30ms"}, {"nth", "2.."}}},
        {"stall", "turner.B", {{"function", "6"}, {"for", "12ms"}}},
        {"early_reply", "feeder", {}}};
    const FaultText lasting = kFaults[between(0, std::size(kFaults) - 1)];
    const bool slips = between(0, 1) == 0;
    return [=](World& world) {
      if (world.faults().size() > 2) world.clear_fault(world.faults().begin()->first);
      const FaultText slip{"slip", "feeder.A", {{"pulses", std::to_string(pulses)}}};
      world.inject(find_fault(world.known(), slips ? slip : lasting));
    };
  }

  RandomEvents events_;
  std::mt19937_64 random_;
};

}  // namespace understudy::emulator::world
