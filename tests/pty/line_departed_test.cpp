// A host that has disconnected: what it wrote is served, and replies to it never reach the next host.
#include <gtest/gtest.h>

#include "pty/line.h"
#include "tests/pty/fake_station.h"

namespace understudy::pty {
namespace line_departed_test {

using namespace std::chrono_literals;

const Bytes kRequest = hex("01 03 00 01 00 01 D5 CA");
const Bytes kReply = hex("01 03 02 C0 01 29 84");

class LineDeparted : public testing::TestWithParam<Timing> {
 protected:
  LineDeparted()
      : rig_({.settings = {}, .timing = GetParam()}),
        slave_(1, kReply,
               {.silence = GetParam() == Timing::wire ? SimTime{750us} : SimTime{0}, .patience = 10ms}) {
    rig_.line.attach(slave_);
  }

  void open(SimTime) {
    rig_.line.host_opened();
    rig_.line.host_settings(HostSettings{.baud = 19200});
  }

  LineRig rig_;
  FakeSlave slave_;
};

INSTANTIATE_TEST_SUITE_P(Timings, LineDeparted, testing::Values(Timing::wire, Timing::instant));

TEST_P(LineDeparted, ItsRequestIsServedButTheNextHostGetsNoReply) {
  open(0s);
  rig_.send(kRequest, 0s);
  rig_.line.host_closed();
  open(0s);
  rig_.run(1s);
  EXPECT_EQ(slave_.served_at.size(), 1U);
  EXPECT_TRUE(rig_.out.empty());
}

TEST_P(LineDeparted, WhatIsFoundAfterItClosedIsItsOwn) {
  open(0s);
  rig_.line.host_closed();
  rig_.send(kRequest, 0s);
  open(0s);
  rig_.run(1s);
  EXPECT_EQ(slave_.served_at.size(), 1U);
  EXPECT_TRUE(rig_.out.empty());
}

TEST_P(LineDeparted, TheNextHostGetsItsOwnReplyRightBehindIt) {
  open(0s);
  rig_.send(kRequest, 0s);
  rig_.line.host_closed();
  open(0s);
  rig_.send(kRequest, 0s);
  rig_.run(1s);
  EXPECT_EQ(slave_.served_at.size(), 2U);
  EXPECT_EQ(rig_.out.size(), kReply.size());
}

TEST_P(LineDeparted, ItsSpeedHoldsForWhatItLeftBehind) {
  rig_.line.host_opened();
  rig_.line.host_settings(HostSettings{.baud = 9600});
  rig_.send(kRequest, 0s);
  rig_.line.host_closed();
  open(0s);
  rig_.run(1s);
  // In wire timing the first character had started, and was judged, before it closed.
  EXPECT_TRUE(slave_.served_at.empty());
}

TEST_P(LineDeparted, AStationThatSpeaksUnaskedLaterIsReceived) {
  FakeTalker talker;
  rig_.line.attach(talker);
  open(0s);
  rig_.send(kRequest, 0s);
  rig_.line.host_closed();
  open(0s);
  talker.says[500ms].push_back(hex("41 42"));
  rig_.run(1s);
  EXPECT_EQ(rig_.out.size(), 2U);
}

TEST_P(LineDeparted, ARequestItDidNotFinishDoesNotSilenceTheNextHost) {
  open(0s);
  rig_.send(Bytes(kRequest.begin(), kRequest.begin() + 5), 0s);
  rig_.run(4ms);
  rig_.line.host_closed();
  open(4ms);
  rig_.run(30ms);  // the timeout has expired
  rig_.send(kRequest, 30ms);
  rig_.run(1s);
  EXPECT_EQ(rig_.out.size(), kReply.size());
}

TEST_P(LineDeparted, ARequestItDidNotFinishIsNoiseBeforeTheNextHosts) {
  open(0s);
  rig_.send(Bytes(kRequest.begin(), kRequest.begin() + 5), 0s);
  rig_.line.host_closed();
  open(0s);
  rig_.send(kRequest, 0s);
  rig_.run(1s);
  EXPECT_EQ(slave_.served_at.size(), 1U);
  EXPECT_EQ(rig_.out.size(), kReply.size());
}

TEST_P(LineDeparted, WhatItLeftInThePortIsItsOwnEvenWithANewHost) {
  open(0s);
  rig_.line.host_closed();
  open(0s);
  rig_.line.receive_departed(kRequest, 0s);
  rig_.send(kRequest, 0s);
  rig_.run(1s);
  EXPECT_EQ(slave_.served_at.size(), 2U);
  EXPECT_EQ(rig_.out.size(), kReply.size());
}

}  // namespace line_departed_test
}  // namespace understudy::pty
