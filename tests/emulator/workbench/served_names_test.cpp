// Names with their table, bits and reals where people give and read them: benches, the control socket, frames
// in words.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "emulator/serve/control/messages.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/speech/modbus_words.h"
#include "pty/rtu_crc.h"
#include "tests/emulator/workbench/workbench.h"
#include "tests/emulator/world/stations/pdus.h"

namespace understudy::emulator::workbench {
namespace served_names_test {

using Json = nlohmann::json;

const Model* const kModels[] = {&model()};

world::Bench bench_with(const std::string& set) {
  return world::parse_bench(kModels,
                            "understudy: 1\nlines:\n  rs485:\n    stations:\n"
                            "      - { name: it, model: workbench, set: { " +
                                set + " } }\n",
                            "bench.yaml", "/tmp");
}

struct Served {
  Served()
      : daemon(bench_with("Gain_X: 2.5, Gain_Y: 3, holding.Position_Z: -9, Mode.PROGRAM: 6"), options(),
               [](const std::string&) {}) {}
  static serve::DaemonOptions options() {
    serve::DaemonOptions made;
    made.speed.kind = serve::Speed::Kind::manual;
    made.watch_signals = false;
    return made;
  }
  Json ask(const Json& message) {
    Json reply;
    serve::handle_message(daemon, message.dump(),
                          [&](const std::string& line) { reply = Json::parse(line); });
    return reply;
  }
  Json get(const std::string& name) {
    const Json reply = ask({{"do", "get"}, {"names", {name}}});
    return reply.contains("values") ? reply["values"][name] : reply;
  }
  std::string complaint_of_setting(const std::string& name, const Json& value) {
    const Json reply = ask({{"do", "set"}, {"values", {{name, value}}}});
    return reply.value("error", std::string());
  }
  serve::Daemon daemon;
};

TEST(ServedNames, ABenchAndTheControlSocketKnowTablesAndReals) {
  Served served;
  EXPECT_EQ(served.get("Gain_X"), 2.5);
  EXPECT_EQ(served.get("it.Gain_Y"), 3);
  EXPECT_EQ(served.get("it.input.Position_Z"), -9);
  EXPECT_EQ(served.get("Mode"), 0x60);
  EXPECT_EQ(served.get("Temperature"), 21.5);
  EXPECT_EQ(served.get("input.STATE.WAITING"), 0);
  EXPECT_EQ(served.complaint_of_setting("Gain_Z", 0.25), "");
  EXPECT_EQ(served.get("Gain_Z"), 0.25);
  EXPECT_EQ(served.complaint_of_setting("Gain_Z", 4), "");
  EXPECT_EQ(served.get("Gain_Z"), 4);
  EXPECT_EQ(served.complaint_of_setting("coil.Output_9", 1), "");
  EXPECT_EQ(served.get("Output_9"), 1);
  EXPECT_EQ(served.complaint_of_setting("Mode.PROGRAM", 15), "");
  EXPECT_EQ(served.get("Mode.PROGRAM"), 15);
}

TEST(ServedNames, WhatCannotBeSetIsToldInALine) {
  Served served;
  const std::tuple<const char*, Json, const char*> cases[] = {
      {"Gain_Z", 10.5, "Gain_Z: 10.5 is out of range; expected 0 to 10"},
      {"Gain_Z", 1e300, "Gain_Z: 1e+300 is more than a single can hold"},
      {"Speed_X", 2.5, "Speed_X: expected a whole number"},
      {"Output_9", 2, "Output_9: 2 is out of range; expected 0 or 1"},
      {"Command0", kStop, "Command0 takes whole messages; expected a request from the line"},
      {"Servo_X", 1, "Servo_X cannot be written; it is read-only"},
      {"Position_X", 1,
       "it: 'Position_X' is in several tables; expected one of holding.Position_X, input.Position_X"},
  };
  for (const auto& [name, value, wanted] : cases) EXPECT_EQ(served.complaint_of_setting(name, value), wanted);
  try {
    bench_with("Gain_X: 11");
    ADD_FAILURE() << "a gain of 11 is taken";
  } catch (const std::exception& error) {
    EXPECT_STREQ(error.what(),
                 "bench.yaml:5:54: lines.rs485.stations[0].set.Gain_X: 11 is out of range; expected 0 to 10");
  }
}

TEST(ServedNames, FramesTellInputRegistersByTheirNames) {
  Served served;
  const auto frame = [](std::string_view bytes) {
    world::Bytes made = world::hex(bytes);
    pty::append_rtu_crc(made);
    return made;
  };
  const world::LineStations& stations = served.daemon.world().line(0).stations;
  const world::Bytes request = frame("01 04 00 08 00 02");
  EXPECT_EQ(world::modbus_request_text(stations, request), "read 0x0008 it.Temperature");
  EXPECT_EQ(world::modbus_reply_text(stations, request, frame("01 04 04 41 AC 00 00")),
            "it.Temperature = 21.5");
  EXPECT_EQ(world::modbus_request_text(stations, frame("01 03 00 08 00 01")), "read 0x0008 it.Offset");
}

}  // namespace served_names_test
}  // namespace understudy::emulator::workbench
