// The traffic on the lines, requested over the control socket.
#include "pty/rtu_crc.h"
#include "tests/emulator/serve/control/daemon_rig.h"

namespace understudy::emulator::serve {
namespace frames_message_test {

using Bytes = std::vector<std::uint8_t>;

struct FramesRig : DaemonRig {
  /// A host sends this, and the line is silent afterwards.
  void say(Bytes bytes, bool with_checksum = true) {
    if (with_checksum) pty::append_rtu_crc(bytes);
    world::World& world = daemon.world();
    world.host_opened(0);
    world.receive(0, bytes);
    world.advance_to(world.now() + std::chrono::milliseconds(100));
  }
  /// Returns "1 -> write ...", and the next number.
  std::vector<std::string> frames(const std::string& more = "") {
    const Json reply = ask(R"({"do":"frames")" + more + "}");
    std::vector<std::string> texts;
    for (const Json& frame : reply["frames"]) {
      EXPECT_EQ(frame["line"], "rs485");
      texts.push_back(std::to_string(frame["number"].get<int>()) + (frame["way"] == "in" ? " -> " : " <- ") +
                      frame["text"].get<std::string>() +
                      (frame.contains("remark") ? "  " + frame["remark"].get<std::string>() : ""));
    }
    texts.push_back("next " + reply["next"].dump());
    return texts;
  }
};

using Texts = std::vector<std::string>;

TEST(FramesMessage, TellsFramesInWordsAndThoseThatWereDropped) {
  FramesRig rig;
  EXPECT_EQ(rig.frames(), Texts{"next 1"});
  rig.say({1, 6, 0x10, 0x14, 0, 1});
  rig.say({2, 3, 0x0E, 0x04, 0, 2});
  rig.say({1, 3, 0, 0, 0, 1, 0xBA, 0xD0}, false);
  EXPECT_EQ(rig.frames(),
            (Texts{"1 -> write 0x1014 feeder.Aaxis_SVON = 1", "2 <- done", "3 -> read 0x0E04 turner.Cord_A",
                   "4 <- turner.Cord_A = 0", "5 -> 01 03 00 00 00 01 BA D0  dropped: bad CRC", "next 6"}));
}

TEST(FramesMessage, GoesOnWhereTheReplyBeforeEnded) {
  FramesRig rig;
  rig.say({1, 6, 0x10, 0x14, 0, 1});
  EXPECT_EQ(rig.frames(R"(,"since":2)"), (Texts{"2 <- done", "next 3"}));
  EXPECT_EQ(rig.frames(R"(,"since":3)"), Texts{"next 3"});
  rig.say({1, 6, 0x10, 0x14, 0, 0});
  EXPECT_EQ(rig.frames(R"(,"since":3)"),
            (Texts{"3 -> write 0x1014 feeder.Aaxis_SVON = 0", "4 <- done", "next 5"}));
  EXPECT_EQ(rig.frames(R"(,"last":1)"), (Texts{"4 <- done", "next 5"}));
  EXPECT_EQ(rig.frames(R"(,"last":0)"), Texts{"next 5"});
  EXPECT_EQ(rig.frames(R"(,"since":99999)"), Texts{"next 5"});
}

TEST(FramesMessage, KeepsABoundedNumberAndTellsSoManyAtATime) {
  FramesRig rig;
  for (int i = 0; i < 1000; ++i) rig.say({1, 6, 0x10, 0x14, 0, 1});
  const Json all = rig.ask(R"({"do":"frames","since":1})");
  EXPECT_EQ(all["frames"].size(), 200U);
  EXPECT_EQ(all["frames"][0]["number"], 2000 - 1024 + 1);
  EXPECT_EQ(all["next"], 2000 - 1024 + 1 + 200);
  EXPECT_EQ(rig.ask(R"({"do":"frames"})")["frames"][0]["number"], 1801);
}

}  // namespace frames_message_test
}  // namespace understudy::emulator::serve
