// Names with their table, bits and reals wherever people write and read them: benches, the control socket,
// decoded frames.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "emulator/serve/control/messages.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/protocol/modbus_words.h"
#include "pty/rtu_crc.h"
#include "tests/emulator/workbench/workbench.h"
#include "tests/emulator/world/stations/pdus.h"

namespace understudy::emulator::workbench {
namespace served_names_test {

using Json = nlohmann::json;

const ListedModel kModels[] = {&model()};

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
  std::string diagnostic_of_setting(const std::string& name, const Json& value) {
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
  EXPECT_EQ(served.diagnostic_of_setting("Gain_Z", 0.25), "");
  EXPECT_EQ(served.get("Gain_Z"), 0.25);
  EXPECT_EQ(served.diagnostic_of_setting("Gain_Z", 4), "");
  EXPECT_EQ(served.get("Gain_Z"), 4);
  EXPECT_EQ(served.diagnostic_of_setting("coil.Output_9", 1), "");
  EXPECT_EQ(served.get("Output_9"), 1);
  EXPECT_EQ(served.get("coil.9"), 1);
  EXPECT_EQ(served.get("it.input.20"), 0x44);
  EXPECT_EQ(served.diagnostic_of_setting("Mode.PROGRAM", 15), "");
  EXPECT_EQ(served.get("Mode.PROGRAM"), 15);
}

TEST(ServedNames, ExpressionsAndStatusKnowThem) {
  Served served;
  const std::pair<const char*, Json> cases[] = {
      {"Gain_X * 2", 5},
      {"Gain_X == 2.5 and coil.Output_9 == 0", 1},
      {"input.Position_Z + holding.Position_Z", -18},
      {"Mode.PROGRAM + Always_On_Y + Input_3", 7},
      {"Temperature - 0.25", 21.25},
  };
  for (const auto& [expression, wanted] : cases) {
    EXPECT_EQ(served.ask({{"do", "eval"}, {"expression", expression}})["value"], wanted) << expression;
  }
  EXPECT_EQ(served.diagnostic_of_setting("Gain_X", 0.1), "");
  EXPECT_EQ(served.ask({{"do", "eval"}, {"expression", "Gain_X"}})["value"].dump(), "0.1");
  EXPECT_EQ(served.ask({{"do", "eval"}, {"expression", "Gain_X == 0.1"}})["value"], 1);
  const Json registers = served.ask({{"do", "status"}})["status"]["devices"][0]["registers"];
  EXPECT_EQ(registers["Temperature"], 21.5) << registers;
  EXPECT_EQ(registers["Mode.PROGRAM"], 6);
}

TEST(ServedNames, ADeviceThatFailsMeanwhileTakesNoMore) {
  Served served;
  const Json reply = served.ask({{"do", "set"}, {"values", {{"Absent", 1}, {"holding.Position_X", 5}}}});
  EXPECT_EQ(reply.value("error", ""),
            "holding.Position_X was not written: after the earlier writes the device does not accept it now");
  EXPECT_EQ(served.get("Absent"), 1);
  EXPECT_EQ(served.get("holding.Position_X"), 0);
  EXPECT_EQ(served.diagnostic_of_setting("holding.Position_X", 5),
            "holding.Position_X cannot be written now; the device refuses it (exception 4)");
}

TEST(ServedNames, WhatCannotBeSetIsReportedInALine) {
  Served served;
  const std::tuple<const char*, Json, const char*> cases[] = {
      {"Gain_Z", 10.5, "Gain_Z: 10.5 is out of range; expected 0 to 10"},
      {"Gain_Z", 1e300, "Gain_Z: 1e+300 is too large for a 32-bit real"},
      {"Speed_X", 2.5, "Speed_X: 2.5 is not a whole number; expected 1 to 4000"},
      {"Output_9", 2, "Output_9: 2 is out of range; expected 0 or 1"},
      {"Mode.PROGRAM", 16, "Mode.PROGRAM: 16 is out of range; expected 0 to 15"},
      {"Mode.3", -1, "Mode.3: -1 is out of range; expected 0 or 1"},
      {"Offset.15", 1, "Offset.15: 1 is out of range; expected Offset within -500 to 500"},
      {"holding.Position_X_L", 1,
       "holding.Position_X_L cannot be written alone; expected the whole Position_X"},
      {"Command0", kStop, "Command0 accepts only complete messages; expected a Modbus request"},
      {"Servo_X", 1, "Servo_X cannot be written; it is read-only"},
      {"Position_X", 1,
       "it: 'Position_X' is in several tables; expected one of holding.Position_X, input.Position_X"},
  };
  for (const auto& [name, value, wanted] : cases)
    EXPECT_EQ(served.diagnostic_of_setting(name, value), wanted);
  const std::pair<const char*, const char*> of_benches[] = {
      {"Gain_X: 11", "54: lines.rs485.stations[0].set.Gain_X: 11 is out of range; expected 0 to 10"},
      {"Mode.PROGRAM: 16",
       "60: lines.rs485.stations[0].set.Mode.PROGRAM: 16 is out of range; expected 0 to 15"},
      {"Command0: 5",
       "56: lines.rs485.stations[0].set.Command0: accepts only complete messages; expected a Modbus request"},
      {"input.20: 5", "56: lines.rs485.stations[0].set.input.20: cannot be written; it is read-only"},
  };
  for (const auto& [set, diagnostic] : of_benches) {
    try {
      bench_with(set);
      ADD_FAILURE() << set << " is taken";
    } catch (const std::exception& error) {
      EXPECT_EQ(error.what(), std::string("bench.yaml:5:") + diagnostic);
    }
  }
}

TEST(ServedNames, ACommandIsGivenByItsName) {
  Served served;
  const auto command = [&](const Json& device, const std::string& text) {
    Json message{{"do", "command"}, {"text", text}};
    if (!device.is_null()) message["device"] = device;
    const Json reply = served.ask(message);
    return reply["ok"] == true ? std::string() : reply["error"].get<std::string>();
  };
  EXPECT_EQ(command("it", "MOVE X -70000"), "");
  EXPECT_EQ(command({}, "STOP"), "") << "the only device";
  // In the present word order.
  EXPECT_EQ(served.diagnostic_of_setting("Word_Order", 1), "");
  EXPECT_EQ(command({}, "MOVE Z 65537"), "");
  EXPECT_EQ(served.get("STATE.WAITING"), 3);
  EXPECT_EQ(command({}, "STOP"), "it refuses it: it is busy (reason 193)") << "the FIFO holds three";
  served.ask({{"do", "set"}, {"values", {{"Absent", 1}}}});
  EXPECT_EQ(command({}, "STOP"), "it refuses it: it has failed (reason 194)");
  served.ask({{"do", "set"}, {"values", {{"Absent", 0}, {"Run", 1}}}});
  served.daemon.world().advance_to(std::chrono::seconds(30));
  EXPECT_EQ(served.get("input.Position_X"), -70000);
  EXPECT_EQ(served.get("input.Position_Z"), 65537);
  const std::pair<std::string, std::string> wrong[] = {
      {"MOVE W 5", "column 6: 'W' is not an axis; expected X, Y or Z"},
      {"", "column 1: '' is not a command; expected MOVE or STOP"},
  };
  for (const auto& [text, why] : wrong) EXPECT_EQ(command({}, text), why) << text;
  EXPECT_NE(command("mil", "STOP").find("'mil'"), std::string::npos);
  EXPECT_EQ(served.ask({{"do", "command"}})["error"], "'text' is missing");
  served.ask({{"do", "power"}, {"to", "off"}});
  EXPECT_EQ(command({}, "STOP"), "it has no power; expected it to be on");
}

TEST(ServedNames, ATurnsDiagnosticIsNotToldTwice) {
  Served served;
  const auto diagnostic = [&](const Json& in) {
    return served.ask({{"do", "turn"}, {"values", {{"it.MPG", 30}}}, {"in", in}})["error"].get<std::string>();
  };
  for (const char* in : {"2", "soon", "-1s"}) {
    EXPECT_EQ(diagnostic(in).find("turn"), std::string::npos) << diagnostic(in);
    EXPECT_EQ(diagnostic(in).substr(0, 4), "in: ") << diagnostic(in);
  }
}

TEST(ServedNames, FramesTellInputRegistersByTheirNames) {
  Served served;
  const auto frame = [](std::string_view bytes) {
    world::Bytes made = world::hex(bytes);
    pty::append_rtu_crc(made);
    return made;
  };
  const Device* const it = &served.daemon.world().line(0).stations[0]->device();
  const world::Bytes request = frame("01 04 00 08 00 02");
  EXPECT_EQ(world::modbus_request_text(it, request), "read input registers 0x0008 it.Temperature");
  EXPECT_EQ(world::modbus_reply_text(it, request, frame("01 04 04 41 AC 00 00")), "it.Temperature = 21.5");
  EXPECT_EQ(world::modbus_request_text(it, frame("01 03 00 08 00 01")), "read 0x0008 it.Offset");
}

TEST(ServedNames, FramesOfAllFunctionsAreDescribedInWords) {
  Served served;
  const auto frame = [](std::string_view bytes) {
    world::Bytes made = world::hex(bytes);
    pty::append_rtu_crc(made);
    return made;
  };
  const Device* const it = &served.daemon.world().line(0).stations[0]->device();
  struct Case {
    const char* request;
    const char* reported;
    const char* reply;
    const char* decoded_reply;
  };
  const Case cases[] = {
      {"01 01 00 02 00 03", "read coils 0x0002 it.Output_2, Output_3, Output_4", "01 01 01 05",
       "it.Output_2 = 1, Output_3 = 0, Output_4 = 1"},
      {"01 01 10 00 07 D0",
       "read coils 0x1000 it.Relay_0, Relay_1, Relay_2, Relay_3, Relay_4, Relay_5, Relay_6, Relay_7, and "
       "1992 more bits",
       "01 01 01 05", "01 in bytes"},
      {"01 02 00 10 00 02", "read discrete inputs 0x0010 it.DRIVING_X, Always_On_X", "01 02 01 02",
       "it.DRIVING_X = 0, Always_On_X = 1"},
      {"01 02 00 03 00 01", "read discrete input 0x0003 it.Input_3", "01 82 02",
       "exception 2 (illegal data address)"},
      {"01 04 00 14 00 01", "read input register 0x0014 it.Module_ID", "01 04 02 00 44", "it.Module_ID = 68"},
      {"01 05 00 6E FF 00", "write coil 0x006E it.Run = 1", "01 05 00 6E FF 00", "done"},
      {"01 05 00 6E 00 00", "write coil 0x006E it.Run = 0", "01 85 06", "exception 6 (device busy)"},
      {"01 05 00 6E 12 34", "01 in bytes", "01 85 03",
       "exception 3 (illegal data value): a single bit can be set to 0x0000 or 0xFF00, not 0x1234"},
      {"01 0F 00 4F 00 02 01 03", "write coils 0x004F it.Output_79 = 1, 0x0050 = 1", "01 0F 00 4F 00 02",
       "done"},
      {"01 0F 00 00 00 02 02 03 00", "01 in bytes", "01 8F 03",
       "exception 3 (illegal data value): its byte count does not fit 2 values"},
      {"01 10 00 22 00 02 04 40 20 00 00", "write 0x0022 it.Gain_Y = 2.5", "01 10 00 22 00 02", "done"},
  };
  for (const Case& c : cases) {
    const world::Bytes request = frame(c.request);
    const std::string reported = world::modbus_request_text(it, request);
    const bool is_bytes = std::string_view(c.reported).starts_with("01 ");
    EXPECT_EQ(is_bytes ? reported.substr(0, std::string_view(c.request).size()) : reported,
              is_bytes ? c.request : c.reported);
    const std::string reply = world::modbus_reply_text(it, request, frame(c.reply));
    const bool reply_is_bytes = std::string_view(c.decoded_reply).starts_with("01 ");
    const std::string_view expected = reply_is_bytes ? c.reply : c.decoded_reply;
    const bool is_begin =
        reply_is_bytes || expected.starts_with("exception");  // the nearest registers may follow
    EXPECT_EQ(is_begin ? reply.substr(0, expected.size()) : reply, expected) << c.request;
  }
}

}  // namespace served_names_test
}  // namespace understudy::emulator::workbench
