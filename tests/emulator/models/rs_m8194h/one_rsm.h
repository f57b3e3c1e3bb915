// A world of one RS-M8194H, driven by commands as text and by frames.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/device/register_map/access.h"
#include "emulator/models/rs_m8194h/device.h"
#include "emulator/models/rs_m8194h/model.h"
#include "emulator/world/names/names.h"
#include "emulator/world/stations/server.h"
#include "emulator/world/world.h"
#include "interpreter/rs_m8194h/text.h"
#include "interpreter/rs_m8194h/window.h"
#include "tests/emulator/world/stations/pdus.h"

namespace understudy::emulator::models::rs_m8194h {

struct GivenRsm {
  Firmware firmware = 300;
  std::map<std::string, bool> dip{};
  std::map<int, world::PlantSetup> plant{};  // by axis
  std::string program{};
  std::map<std::string, std::string> choices{};
};

/// Returns the PDU of a command: FC16 to 8000.
inline world::Bytes pdu_of(std::string_view command, bool low_word_first = false) {
  const lang::ParsedCommand parsed = lang::parse_command(command);
  EXPECT_TRUE(parsed.command) << command << ": " << (parsed.error ? parsed.error->message : "");
  if (!parsed.command) return {};
  const auto order = low_word_first ? lang::WordOrder::low_first : lang::WordOrder::high_first;
  return world::write_request(kWindow, lang::encode(*parsed.command, order));
}

class OneRsm {
 public:
  explicit OneRsm(const GivenRsm& given = {}) : world_(bench(given), {}, {}) {}

  world::World& world() { return world_; }
  Device& device() { return world_.device(0); }
  const RsM8194h& rsm() const { return static_cast<const RsM8194h&>(world_.device(0)); }
  const State& state() const { return rsm().state(); }
  const Ports& ports() const { return *rsm().terminals(); }

  /// Serves a request through its station, and returns the reply's PDU as text.
  std::string ask(const world::Bytes& pdu) {
    const world::ModbusReply reply = world::serve(device(), pdu);
    if (reply.refused.objection) device().register_bank()->exception_answered(reply.refused);
    return world::text(
        world::Bytes(reply.pdu.begin(), reply.pdu.begin() + static_cast<std::ptrdiff_t>(reply.size)));
  }
  std::string ask(std::string_view pdu) { return ask(world::hex(pdu)); }
  /// Returns the exception code that a command gets, or 0.
  int exception(std::string_view command) {
    const std::string reply = ask(pdu_of(command));
    return reply.starts_with("90") ? std::stoi(reply.substr(3), nullptr, 16) : 0;
  }
  void send(std::string_view command) { EXPECT_EQ(exception(command), 0) << command; }
  void send(std::initializer_list<std::string_view> commands) {
    for (const std::string_view command : commands) send(command);
  }

  Value get(std::string_view name) const {
    return read_value(*world_.device(0).register_bank(),
                      world::find_register(world_.known(), "rsm." + std::string(name)).place);
  }
  Refusal try_set(std::string_view name, Value value) {
    return write_value(*device().register_bank(),
                       world::find_register(world_.known(), "rsm." + std::string(name)).place, value);
  }
  void set(std::string_view name, Value value) { EXPECT_EQ(try_set(name, value), Refusal::none) << name; }
  Value input_word(std::uint16_t address) {
    std::uint16_t word = 0;
    EXPECT_EQ(read_words(*device().register_bank(), Table::input, address, std::span(&word, 1)),
              Refusal::none);
    return word;
  }
  /// Returns LP of the four axes.
  std::vector<Value> positions() const { return {get("LP_X"), get("LP_Y"), get("LP_Z"), get("LP_U")}; }

  Tick now() const { return tick_at(world_.now()); }
  void run(Tick ticks) { world_.advance_to(time_of(now() + ticks)); }
  bool rests() const {
    return get("DRIVING_AXIS") == 0 && get("FREE_BUFFER_SIZE") == 30 && get("I8094H_STATE") == 0;
  }
  /// Runs until nothing moves or waits. Returns the number of ticks.
  Tick run_to_rest(Tick max = 200'000) {
    const Tick begin = now();
    do {
      run(1);
    } while (!rests() && now() - begin < max);
    EXPECT_TRUE(rests());
    return now() - begin;
  }
  void pin(std::size_t axis, Pin pin, bool on) { world_.set_external_input(0, terminal(axis, pin), on); }
  void input(int number, bool on) { world_.set_external_input(0, number, on); }

 private:
  static world::Bench bench(const GivenRsm& given) {
    world::Bench bench;
    world::DeviceSetup device{.model = &rs_m8194h::model(), .settings = {}};
    device.settings.name = "rsm";
    device.settings.firmware = given.firmware;
    device.settings.address = 1;
    device.settings.dip = given.dip;
    device.settings.program = given.program;
    device.settings.choices = given.choices;
    bench.devices.push_back(device);
    bench.lines.push_back({.name = "com", .link = {}, .timing = pty::Timing::instant, .stations = {0}});
    for (const auto& [axis, plant] : given.plant) {
      bench.machines.push_back({.device = 0, .axis = axis, .plant = plant});
    }
    return bench;
  }

  world::World world_;
};

}  // namespace understudy::emulator::models::rs_m8194h
