// The events of hosts' requests: what a device has executed, and nothing else, once, whatever its number is.
#include "emulator/world/events/event_log.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "emulator/world/events/history.h"
#include "emulator/world/frames/frame_log.h"
#include "tests/emulator/model_file/described.h"
#include "tests/emulator/world/faults/faulty_line.h"
#include "tests/emulator/world/two_devices.h"

namespace understudy::emulator::world {
namespace event_log_test {

using namespace std::chrono_literals;
using Texts = std::vector<std::string>;

/// A world on whose first line a host sends requests.
struct Watched {
  explicit Watched(const Bench& bench) : world(bench, {}, {}), frames(world, 1'000), events(world, frames) {
    world.host_opened(0);
    world.advance_to(5s);
  }
  explicit Watched(const std::string& stations)
      : Watched(parse_bench(models::all_models(),
                            "understudy: 1\nlines: { a: { stations: [ " + stations + " ] } }\n", "b.yaml",
                            ".")) {}

  void send(const Bytes& frame, SimTime wait = 200ms) {
    world.receive(0, frame);
    world.advance_to(world.now() + wait);
    take_output(world);
  }
  /// Writes a register by name, as a host that sends to that station.
  void write(int station, const std::string& name, Value value) {
    const RegisterName found = find_register(world.known(), name);
    PreparedWrite write;
    ASSERT_EQ(prepare_value(*world.device(found.device).register_bank(), found.place, value, write),
              Refusal::none);
    Bytes frame{static_cast<std::uint8_t>(station),        16, static_cast<std::uint8_t>(write.first >> 8),
                static_cast<std::uint8_t>(write.first),    0,  static_cast<std::uint8_t>(write.count),
                static_cast<std::uint8_t>(2 * write.count)};
    for (std::size_t i = 0; i < write.count; ++i) {
      frame.push_back(static_cast<std::uint8_t>(write.words[i] >> 8));
      frame.push_back(static_cast<std::uint8_t>(write.words[i]));
    }
    send(framed(frame));
  }
  /// Returns "feeder.Aaxis_Speed = 7" for each write of a host.
  Texts writes() {
    Texts texts;
    for (const Event& event : events.since(1, SIZE_MAX))
      if (event.what == "write" && event.by == "host") texts.push_back(event.name + " = " + event.value);
    return texts;
  }
  Texts exceptions() {
    Texts texts;
    for (const Event& event : events.since(1, SIZE_MAX))
      if (event.what == "exception") texts.push_back(event.text);
    return texts;
  }
  Texts frame_texts() const {
    Texts texts;
    for (const FrameLog::Decoded& frame : frames.since(1, SIZE_MAX)) texts.push_back(frame.text);
    return texts;
  }

  World world;
  FrameLog frames;
  EventLog events;
};

constexpr int kSpeed = 0x1002;
constexpr int kAccTime = 0x1003;

TEST(EventLog, HasEachWriteOnceWhateverTheNumbersAre) {
  struct Case {
    int address;
    int station;
    bool is_received;
  };
  for (const Case& c : {Case{1, 1, true}, Case{1, 0, true}, Case{1, 2, false}, Case{0, 0, true},
                        Case{0, 1, true}, Case{0, 15, true}}) {
    Watched it("{ name: f, model: simple2-r3, address: " + std::to_string(c.address) + " }");
    it.send(write_request(c.station, kSpeed, 7));
    EXPECT_EQ(it.writes(), c.is_received ? Texts{"f.Aaxis_Speed = 7"} : Texts{})
        << c.address << " " << c.station;
  }
}

TEST(EventLog, HasNoWriteThatADeviceRefuses) {
  for (const int address : {0, 1}) {
    for (const int station : {0, 1}) {
      Watched it("{ name: f, model: simple2-r3, address: " + std::to_string(address) + " }");
      it.send(write_request(station, kAccTime, 65'000));
      EXPECT_EQ(it.writes(), Texts{}) << address << " " << station;
    }
  }
}

TEST(EventLog, HasABroadcastOnceForEachDevice) {
  Watched it("{ name: f, model: simple2-r3, address: 1 }, { name: t, model: simple2-r3, address: 2 }");
  it.send(write_request(0, kSpeed, 7));
  EXPECT_EQ(it.writes(), (Texts{"f.Aaxis_Speed = 7", "t.Aaxis_Speed = 7"}));
}

/// A reply that is lost leaves the write executed.
TEST(EventLog, HasAWriteWithoutItsReply) {
  Watched it("{ name: f, model: simple2-r3, address: 1 }");
  it.world.inject(find_fault(it.world.known(), fault_words("drop f nth=1")));
  it.send(write_request(1, kSpeed, 7));
  EXPECT_EQ(it.writes(), Texts{"f.Aaxis_Speed = 7"});
}

TEST(EventLog, KnowsTheNamesOfFramesBeforeTheNumberChanged) {
  Watched it("{ name: mill, model: super-40nc }");
  const int before = it.world.device(0).station_number().value();
  it.write(before, "mill.D10", 3);
  it.write(before, "mill.D9000", 5);
  it.write(5, "mill.D10", 4);
  EXPECT_EQ(it.writes(), (Texts{"mill.D10 = 3", "mill.D9000 = 5", "mill.D10 = 4"}));
  const Texts texts = it.frame_texts();
  ASSERT_EQ(texts.size(), 6U);
  for (const std::size_t i : {0U, 2U, 4U}) EXPECT_NE(texts[i].find(" mill.D"), std::string::npos) << texts[i];
}

TEST(EventLog, GivesALateReplyToItsOwnRequest) {
  Watched it("{ name: f, model: simple2-r3, address: 1 }");
  it.world.inject(find_fault(it.world.known(), fault_words("delay f by=600ms nth=1")));
  it.world.inject(find_fault(it.world.known(), fault_words("drop f of=request nth=2")));
  it.send(write_request(1, kSpeed, 9), 100ms);
  it.send(write_request(1, kSpeed, 11), 1s);
  EXPECT_EQ(it.writes(), Texts{"f.Aaxis_Speed = 9"});
  History history;
  history.collect(it.world, it.frames, it.events);
  Texts replies;
  for (const Exchange& exchange : history.exchanges()) {
    if (!exchange.request.empty()) replies.push_back(exchange.request + ": " + exchange.reply);
  }
  EXPECT_EQ(replies, (Texts{"write 0x1002 f.Aaxis_Speed = 9: done", "write 0x1002 f.Aaxis_Speed = 11: "}));
}

const std::string kList =
    "address,name,access,type,min,max,default\n"
    "0,FLAGS,R/W,u16,,,0x0012\n"
    "1,LEVEL,R/W,u16,0,100,7\n";
const std::string kKeys = "line: { functions: [3, 6, 16, 22, 23] }\n";

TEST(EventLog, KnowsMasksAndReadsThatWrite) {
  Watched it(model_file::bench_with(model_file::model_with(kList, kKeys)));
  it.send(framed({1, 0x16, 0, 0, 0, 0xF2, 0, 0x25}));
  it.send(framed({1, 0x17, 0, 0, 0, 2, 0, 1, 0, 1, 2, 0, 9}));
  it.send(framed({1, 0x17, 0, 0, 0, 1, 0, 1, 0, 1, 2, 0, 101}));
  it.send(framed({1, 0x16, 0, 1, 0xFF, 0, 0, 0x65}));
  EXPECT_EQ(it.writes(), (Texts{"it.FLAGS = 23", "it.LEVEL = 9"}));
  const Texts texts = it.frame_texts();
  const Texts expected = {"mask 0x0000 it.FLAGS AND 0x00F2 OR 0x0025",
                          "done",
                          "write 0x0001 it.LEVEL = 9, then read 0x0000 it.FLAGS, LEVEL",
                          "it.FLAGS = 23, LEVEL = 9",
                          "write 0x0001 it.LEVEL = 101, then read 0x0000 it.FLAGS",
                          "exception 3 (illegal data value): it.LEVEL accepts 0 to 100, not 101",
                          "mask 0x0001 it.LEVEL AND 0xFF00 OR 0x0065",
                          "exception 3 (illegal data value): it.LEVEL accepts 0 to 100, not 101"};
  EXPECT_EQ(texts, expected);
  EXPECT_EQ(it.exceptions().size(), 2U);
}

}  // namespace event_log_test
}  // namespace understudy::emulator::world
