// What observers see of faults that act on messages: each kind, on replies and on requests, as in a capture.
#include "emulator/models/models.h"
#include "emulator/world/faults/kinds.h"
#include "pty/capture_frames.h"
#include "pty/capture_text.h"
#include "tests/emulator/world/faults/faulty_line.h"

namespace understudy::emulator::world {
namespace reported_faults_test {

using Lines = std::vector<std::string>;

/// Returns the capture of the one line, without times.
class Captured {
 public:
  explicit Captured(FaultyLine& line)
      : world_(line.world()), frames_(0, world_.line(0).framing, [this](const pty::CapturedPacket& packet) {
          std::string text;
          pty::append_text_packet(text, std::vector<pty::CapturedLine>{{"L", 19200}}, packet, 0);
          lines_.push_back(text.substr(text.find(' ') + 1, text.size() - text.find(' ') - 2));
        }) {
    world_.add_observer(0, frames_);
  }
  ~Captured() { world_.remove_observer(0, frames_); }
  Captured(const Captured&) = delete;
  Captured& operator=(const Captured&) = delete;

  Lines lines() {
    frames_.finish();
    return std::exchange(lines_, {});
  }

 private:
  World& world_;
  Lines lines_;
  pty::CaptureFrames frames_;
};

const std::string kAsked = "in  L 01 03 00 01 00 01 D5 CA";
const std::string kSaid = "out L 01 03 02 C0 01 29 84";

struct Told {
  std::string fault;
  Lines lines;
};

const std::vector<Told>& cells() {
  static const std::vector<Told> all{
      // On the reply.
      {"drop feeder", {kAsked, "out L  # fault 1 drop: not sent"}},
      {"delay feeder by=20ms", {kAsked, "out L  # fault 1 delay: sent late", kSaid}},
      {"corrupt_checksum feeder",
       {kAsked, "out L 01 03 02 C0 01 29 7B  # fault 1 corrupt_checksum: last byte inverted"}},
      {"truncate feeder keep=3", {kAsked, "out L 01 03 02  # fault 1 truncate: cut"}},
      {"truncate feeder keep=0", {kAsked, "out L  # fault 1 truncate: cut"}},
      {"duplicate feeder", {kAsked, kSaid + "  # fault 1 duplicate: sent twice", kSaid}},
      {"duplicate feeder after=20ms", {kAsked, kSaid + "  # fault 1 duplicate: sent twice", kSaid}},
      {"noise feeder before=FF",
       {kAsked, "out L FF 01 03 02 C0 01 29 84  # fault 1 noise: surrounded by noise"}},
      {"collision feeder with=00",
       {kAsked, "out L 00 03 02 C0 01 29 84  # fault 1 collision: another sender collided"}},
      {"drop rs485", {kAsked, "out L  # fault 1 drop: not sent"}},
      {"split feeder keep=3 by=20ms",
       {kAsked, "out L 01 03 02  # fault 1 split: sent in two pieces", "out L C0 01 29 84"}},
      {"split feeder keep=0 by=20ms", {kAsked, "out L  # fault 1 split: sent in two pieces", kSaid}},
      {"split feeder keep=7 by=20ms", {kAsked, kSaid + "  # fault 1 split: sent in two pieces"}},
      // On the connection from a gateway; on the wire it is unchanged.
      {"wrong_transaction feeder",
       {kAsked, kSaid + "  # fault 1 wrong_transaction: wrong transaction over TCP"}},
      {"wrong_unit rs485", {kAsked, kSaid + "  # fault 1 wrong_unit: wrong unit over TCP"}},
      {"hang_up feeder keep=3", {kAsked, kSaid + "  # fault 1 hang_up: connection closed"}},
      // On the adapter, triggered by a request.
      {"echo rs485 nth=1", {kAsked, "in  L  # fault 1 echo: begins", kSaid}},
      {"lumps rs485 by=16ms nth=1", {kAsked, "in  L  # fault 1 lumps: begins", kSaid}},
      {"unplug rs485 nth=1", {kAsked, "in  L  # fault 1 unplug: begins", kSaid}},
      // On the request. The host's own bytes are unchanged.
      {"drop feeder of=request", {kAsked, "in  L  # fault 1 drop: not received"}},
      {"drop rs485 of=request", {kAsked, "in  L  # fault 1 drop: not received"}},
      {"delay feeder by=20ms of=request", {kAsked, "in  L  # fault 1 delay: received late", kSaid}},
      {"corrupt_checksum rs485 of=request",
       {kAsked, "in  L  # fault 1 corrupt_checksum: last byte inverted"}},
      {"truncate feeder keep=3 of=request", {kAsked, "in  L  # fault 1 truncate: cut"}},
      {"duplicate feeder of=request", {kAsked, "in  L  # fault 1 duplicate: received twice", kSaid, kSaid}},
      {"noise feeder before=FF of=request", {kAsked, "in  L  # fault 1 noise: surrounded by noise", kSaid}},
      {"collision feeder with=00 of=request",
       {kAsked, "in  L  # fault 1 collision: another sender collided"}},
      {"drop feeder of=both", {kAsked, "in  L  # fault 1 drop: not received"}},
      // On the device's reply to it.
      {"slow feeder by=20ms", {kAsked, "in  L  # fault 1 slow: executed late", kSaid}},
      {"busy feeder", {kAsked, "in  L  # fault 1 busy: refused", "out L 01 83 06 C1 32"}},
      {"exception rs485 code=4", {kAsked, "in  L  # fault 1 exception: refused", "out L 01 83 04 40 F3"}},
      {"early_reply feeder", {"in  L  # fault 1 early_reply: treated as complete at once", kSaid, kAsked}},
      {"power_cut feeder nth=1", {kAsked, "in  L  # fault 1 power_cut: begins"}},
      // On the machine, triggered by a request.
      {"stall feeder.A nth=1", {kAsked, "in  L  # fault 1 stall: begins", kSaid}},
      {"lost_steps feeder.A one_in=5 nth=1", {kAsked, "in  L  # fault 1 lost_steps: begins", kSaid}},
      {"slip feeder.A pulses=5 nth=1", {kAsked, "in  L  # fault 1 slip: pushed", kSaid}},
      {"alarm feeder.A nth=1", {kAsked, "in  L  # fault 1 alarm: begins", kSaid}},
      {"stuck feeder.DIN_2 level=1 nth=1", {kAsked, "in  L  # fault 1 stuck: begins", kSaid}},
      {"encoder_noise feeder.A counts=5 nth=1", {kAsked, "in  L  # fault 1 encoder_noise: begins", kSaid}},
      {"turn feeder.B counts=400 nth=1", {kAsked, "in  L  # fault 1 turn: turned", kSaid}},
  };
  return all;
}

TEST(ReportedFaults, EachKindIsReportedWhereItActs) {
  for (const Told& cell : cells()) {
    FaultyLine line(
        "plant: { feeder.A: { encoder: { per_revolution: 4000 } }, feeder.B: { encoder: { on: wheel, "
        "per_revolution: 4000 } } }\n");
    Captured captured(line);
    line.inject(cell.fault);
    line.ask(kAskFeeder);
    EXPECT_EQ(captured.lines(), cell.lines) << cell.fault;
  }
}

TEST(ReportedFaults, NoKindIsForgottenHere) {
  for (const FaultKindRow& row : fault_kinds()) {
    const auto is_of_kind = [&](const Told& cell) {
      return cell.fault.starts_with(std::string(row.name) + " ");
    };
    EXPECT_TRUE(std::any_of(cells().begin(), cells().end(), is_of_kind)) << row.name;
  }
}

TEST(ReportedFaults, SeveralOnOneMessageAreReportedTogether) {
  FaultyLine line;
  Captured captured(line);
  line.inject("corrupt_checksum feeder");
  line.inject("truncate feeder keep=3");
  line.ask(kAskFeeder);
  EXPECT_EQ(captured.lines(),
            (Lines{kAsked,
                   "out L 01 03 02  # fault 1 corrupt_checksum: last byte inverted; fault 2 truncate: cut"}));
  line.inject("drop feeder");
  line.inject("delay feeder by=20ms");  // never sees it
  line.ask(kAskFeeder);
  EXPECT_EQ(captured.lines(), (Lines{kAsked,
                                     "out L  # fault 1 corrupt_checksum: last byte inverted; "
                                     "fault 2 truncate: cut; fault 3 drop: not sent"}));
}

TEST(ReportedFaults, OnlyWhatIsHitIsReported) {
  FaultyLine line;
  Captured captured(line);
  line.inject("drop feeder function=6");
  line.inject("drop feeder nth=2");
  line.ask_all({kAskFeeder, kAskTurner, kAskFeeder});
  EXPECT_EQ(captured.lines(),
            (Lines{kAsked, kSaid, "in  L 02 03 00 01 00 01 D5 F9", "out L 02 03 02 C0 01 6D 84", kAsked,
                   "out L  # fault 2 drop: not sent"}));
}

TEST(ReportedFaults, AReplyToNobodySaysBoth) {
  FaultyLine line;
  Captured captured(line);
  line.inject("corrupt_checksum feeder");
  line.world().receive(0, kAskFeeder);
  line.world().host_closed(0);
  line.world().advance_to(std::chrono::milliseconds(50));
  EXPECT_EQ(captured.lines().back(),
            "out L 01 03 02 C0 01 29 7B  # discarded: no host has the line open; "
            "fault 1 corrupt_checksum: last byte inverted");
}

TEST(ReportedFaults, ALineOfTextIsReportedNextToIt) {
  World world(parse_bench(models::all_models(),
                          "understudy: 1\nlines: { t: { stations: [ { name: chain, model: slim } ] } }\n",
                          "t.yaml", "."),
              {}, {});
  Lines lines;
  pty::CaptureFrames frames(
      0, world.line(0).framing,
      [&](const pty::CapturedPacket& packet) {
        lines.push_back((packet.direction == pty::Direction::from_host ? "in " : "out ") +
                        std::string(packet.bytes.begin(), packet.bytes.end()) + pty::comment_of(packet));
      },
      pty::Packets::lines);
  world.add_observer(0, frames);
  world.inject(find_fault(world.known(), fault_words("drop chain nth=1")));
  world.inject(find_fault(world.known(), fault_words("delay chain of=request by=20ms nth=2")));
  for (const int ms : {100, 200}) {
    world.advance_to(std::chrono::milliseconds(ms));
    world.receive(0, Bytes{'?', 'P', 'E', '\r'});
  }
  world.advance_to(std::chrono::milliseconds(300));
  world.remove_observer(0, frames);
  ASSERT_GE(lines.size(), 4u);
  EXPECT_EQ(lines[0], "in ?PE\r");
  EXPECT_EQ(lines[1], "out fault 1 drop: not sent");
  EXPECT_EQ(lines[2], "in ?PE\r");
  EXPECT_EQ(lines[3], "in fault 2 delay: received late");
  EXPECT_GT(lines.size(), 4u) << "the second reply arrives";
}

}  // namespace reported_faults_test
}  // namespace understudy::emulator::world
