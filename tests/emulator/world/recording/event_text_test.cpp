// Events of a world in words, for the pages about recordings.
#include "emulator/world/recording/event_text.h"
#include "emulator/models/models.h"

#include <gtest/gtest.h>

#include "emulator/world/bench_file/bench_file.h"

namespace understudy::emulator::world {
namespace event_text_test {

constexpr const char* kBench =
    "understudy: 1\nlines:\n"
    "  rs485: { stations: [ { name: feeder, model: simple2-r3 } ] }\n"
    "  rs232: { stations: [ { name: robot, model: slim, modules: 2 } ] }\n";

TEST(EventText, SaysWhatCameFromOutsideBesideBytes) {
  const World world(parse_bench(models::all_models(), kBench, "bench.yaml", ""), WorldOptions{}, {});
  const std::pair<const char*, const char*> kCases[] = {
      {R"("do":"open","line":0)", "a host opens rs485"},
      {R"("do":"close","line":1)", "the host closes rs232"},
      {R"("do":"settings","line":0,"baud":9600,"stop_bits":2)",
       "the host sets rs485: 9600 baud, 2 stop bits"},
      {R"("do":"settings","line":0,"baud":19200,"stop_bits":1)",
       "the host sets rs485: 19200 baud, 1 stop bit"},
      {R"("do":"settings","line":0,"baud":9600,"stop_bits":1,"data_bits":7,"parity":"odd")",
       "the host sets rs485: 9600 7O1"},
      {R"("do":"purge","line":0)", "the host discards unsent bytes on rs485"},
      {R"("do":"settings","line":0)", "the host sets rs485: as the line has it"},
      {R"("do":"power","device":1,"on":false)", "power robot off"},
      {R"("do":"power","device":0,"on":true)", "power feeder on"},
      {R"("do":"inject","fault":{"stall":"feeder.A"})", "inject stall feeder.A"},
      {R"("do":"clear","number":3)", "clear 3"},
      // A word; both words of a 32-bit register, the low one first; one of them; one that does not exist.
      {R"("do":"write","device":0,"table":0,"first":4098,"words":"00c8")", "set feeder.Aaxis_Speed=200"},
      {R"("do":"write","device":0,"table":0,"first":4096,"words":"ee90fffe")",
       "set feeder.Aaxis_Pulse=-70000"},
      {R"("do":"write","device":0,"table":0,"first":4097,"words":"0001")", "set feeder.0x1001=1"},
      {R"("do":"write","device":0,"table":0,"first":12287,"words":"0002")", "set feeder.0x2FFF=2"},
      {R"("do":"assign","device":1,"name":"T1PE","value":-1.5)", "set robot.T1PE=-1.5"},
      {R"("do":"program","device":1,"text":"MA 5\n")", "program robot"},
      {R"("do":"in","line":0,"bytes":"01")", ""},
      {R"("do":"left","line":0,"bytes":"01")", ""},
      {R"("do":"out","line":0,"bytes":"01")", ""},
      {R"("do":"pause","line":0)", ""},
      {R"("do":"end")", ""},
  };
  for (const auto& [event, text] : kCases) {
    const std::string line = std::string("{\"t\":0,") + event + "}";
    EXPECT_EQ(text_of(parse_event(line, world.known(), world.line_count()), world), text) << line;
  }
}

}  // namespace event_text_test
}  // namespace understudy::emulator::world
