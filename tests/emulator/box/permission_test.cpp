// What may be sent to a real controller: the marks of requests, and the limits of an envelope. A request that
// the limits cannot judge is refused.
#include "emulator/box/stage/permission.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "emulator/device/command_window.h"
#include "emulator/play/executors/modbus_host.h"
#include "emulator/play/executors/real_box.h"
#include "emulator/world/expression/tolerance.h"
#include "emulator/world/world.h"
#include "tests/emulator/box/fake_box.h"

namespace understudy::emulator::box {
namespace permission_test {

using Bytes = std::vector<std::uint8_t>;

Envelope envelope_of(const std::vector<std::pair<std::string, std::string>>& limits) {
  Envelope envelope;
  for (const auto& [pattern, range] : limits)
    envelope.limits.push_back(
        {.pattern = pattern, .range = world::parse_tolerance(range), .place = "limits.yaml:3"});
  return envelope;
}

/// Returns why a request is not sent, or an empty text.
std::string objection(const SentRequest& request, const Envelope& envelope, Hazards allowed = Hazards::all) {
  try {
    require_allowed(request, allowed, envelope);
    return "";
  } catch (const play::BeyondEnvelope& error) {
    return error.what();
  } catch (const play::NotAllowed& error) {
    return error.what();
  }
}

Bytes joined(const std::vector<Bytes>& parts) {
  Bytes all;
  for (const Bytes& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

const Bytes kRead = frame({1, 3, 0, 1, 0, 1});
const Bytes kMove = frame({1, 6, 0x10, 0x05, 0, 1});

TEST(Permission, RefusesFramesThatTheEnvelopeCannotJudge) {
  const Envelope envelope = envelope_of({{"Aaxis_Pulse", "-3200..3200"}, {"*_Speed", "0..60"}});
  struct Case {
    Bytes request;
    const char* why;  // empty: it is sent
  };
  const std::vector<Case> cases{
      {kRead, ""},
      {frame({1, 6, 0x10, 0x02, 0, 60}), ""},
      {frame({1, 6, 0x10, 0x02, 0, 61}), "Aaxis_Speed = 61 is beyond limits.yaml:3; expected 0..60"},
      {frame({1, 6, 0x10, 0x14, 0, 1}), ""},  // no limit is about Aaxis_SVON
      {frame({1, 16, 0x10, 0, 0, 2, 4, 0x0C, 0x80, 0, 0}), ""},
      {frame({1, 16, 0x10, 0, 0, 2, 4, 0x0C, 0x81, 0, 0}), "Aaxis_Pulse = 3201 is beyond"},
      {frame({1, 16, 0x10, 0, 0, 2, 4, 0, 100, 0, 1}), "Aaxis_Pulse = 65636 is beyond"},
      {frame({1, 6, 0x10, 0x00, 0, 100}), "Aaxis_Pulse is written by half"},
      {frame({1, 6, 0x10, 0x01, 0, 0}), "Aaxis_Pulse is written by half"},
      {frame({1, 16, 0x10, 0x01, 0, 2, 4, 0, 0, 0, 60}), "Aaxis_Pulse is written by half"},
      {frame({0, 6, 0x10, 0x00, 0x19, 0}), "it is a broadcast"},
      {frame({7, 6, 0x10, 0x02, 0, 10}), "the bench has no station 7 on this line"},
      {frame({1, 6, 0x70, 0x00, 0, 1}), "it writes to an address that no table names"},
      {frame({1, 0x17, 0x10, 0x02, 0, 1}), "it is not a write of a known form"},
      {joined({{0xFF}, kMove}), "it is not a frame with a right checksum"},
      // Its checksum is right: a byte 0 after a frame makes the high byte of the checksum, and 0, one as
      // well.
      {joined({kMove, {0}}), "it is not a write of a known form"},
      {joined({kMove, {1}}), "it is not a frame with a right checksum"},
      {joined({kRead, kMove}), "it is not a frame with a right checksum"},
      {frame(joined({kRead, kMove})), "it is not a write of a known form"},
      {{1, 6, 0x10}, "it is not a frame with a right checksum"},
  };
  const world::World world(bench_of("simple2-r3"), {}, {});
  for (const Case& one : cases) {
    const SentRequest sent = judge_frame(world, 0, one.request);
    const std::string came = objection(sent, envelope);
    if (*one.why == '\0') {
      EXPECT_EQ(came, "") << sent.what;
    } else {
      EXPECT_NE(came.find(std::string("not sent, because ") + one.why), std::string::npos)
          << sent.what << " " << came;
    }
    EXPECT_EQ(objection(sent, {}), "") << sent.what;  // without an envelope, the permission is enough
  }
}

/// A checksum over both makes them one long frame, but a controller may end a frame by its length.
TEST(Permission, CountsARequestBehindARead) {
  const world::World world(bench_of("simple2-r3"), {}, {});
  EXPECT_EQ(judge_frame(world, 0, kRead).hazards, Hazards::reads);
  EXPECT_EQ(judge_frame(world, 0, frame({1, 3, 0, 1, 0})).hazards, Hazards::reads);
  EXPECT_EQ(judge_frame(world, 0, frame({1, 0x2B, 0x0E, 1, 0})).hazards, Hazards::reads);
  EXPECT_EQ(judge_frame(world, 0, frame(joined({kRead, kMove}))).hazards, Hazards::all);
  const world::World text(bench_of("slim"), {}, {});
  EXPECT_EQ(judge_frame(text, 0, kRead).hazards, Hazards::all);  // bytes of a line of text
}

TEST(Permission, JudgesLinesOfTextAsTheControllerReadsThem) {
  struct Case {
    const char* text;
    const char* why;
  };
  const std::vector<Case> cases{
      {"MA 100", ""},
      {"?PE", ""},
      {"?MA 200", ""},
      {"R0=500", ""},
      {"HON", ""},
      {"MR 500", ""},
      {"MA 200", "MA = 200 is beyond limits.yaml:3; expected 0..100"},
      {"ma 200", "MA = 200 is beyond"},
      {"Ma\t200", "MA = 200 is beyond"},
      {"MA 1e3", "MA = 1000 is beyond"},
      {"$LOOP ma 200", "MA = 200 is beyond"},
      {"t1ma 200", "T1MA = 200 is beyond"},
      {"T0MA 200", "MA = 200 is beyond"},
      {"2MA 50,200", "2MA = 200 is beyond"},
      {"XMA 200", "XMA = 200 is beyond"},
      {"MA R0", "MA takes a number that only the controller knows, and limits.yaml:3 limits it"},
      {"ma r0", "MA takes a number that only the controller knows"},
      {"2MA R0,R1", "2MA takes a number that only the controller knows"},
      {"MA 50;MA 200", "it is not a command"},
      {"move it", "it is not a command"},
      {"500", "it is not a command"},
      {"?PE\x08", "it has control characters"},
      {"MA 50\x1B", "it has control characters"},
  };
  world::World world(bench_of("slim"), {}, {});
  for (const Case& one : cases) {
    const std::string came = objection(judge_text(world, 0, one.text), envelope_of({{"*MA", "0..100"}}));
    if (*one.why == '\0') {
      EXPECT_EQ(came, "") << one.text;
    } else {
      EXPECT_NE(came.find(std::string("not sent, because ") + one.why), std::string::npos)
          << one.text << ": " << came;
    }
  }
  // The module of the host has two names.
  for (const char* const pattern : {"MA", "T0MA", "t0ma"}) {
    for (const char* const text : {"MA 200", "T0MA 200"})
      EXPECT_NE(objection(judge_text(world, 0, text), envelope_of({{pattern, "0..100"}})), "")
          << pattern << " " << text;
    EXPECT_EQ(objection(judge_text(world, 0, "T1MA 200"), envelope_of({{pattern, "0..100"}})), "");
  }
  EXPECT_NE(objection(judge_text(world, 0, "r0=500"), envelope_of({{"R0", "0..100"}})), "");
  EXPECT_NE(objection(judge_text(world, 0, "VM=500"), envelope_of({{"VM", "0..100"}})), "");
  EXPECT_NE(judge_text(world, 0, "?PE\rMA 9").hazards, Hazards::reads);
}

TEST(Permission, JudgesCommandsOfAWindow) {
  struct Case {
    const char* text;
    const char* why;
  };
  const std::vector<Case> cases{
      {"RSM_FIXED_MOVE X 1000", ""},
      {"RSM_SET_V X 5000", ""},
      {"RSM_FIXED_MOVE X -1001", "RSM_FIXED_MOVE = -1001 is beyond"},
      {"RSM_MACRO_FIXED_MOVE XY 1001", "RSM_MACRO_FIXED_MOVE = 1001 is beyond"},
      {"RSM_MACRO_FIXED_MOVE X VAR0", "RSM_MACRO_FIXED_MOVE takes a number that only the controller knows"},
  };
  const Envelope envelope = envelope_of({{"RSM_FIXED_MOVE", "-1000..1000"}});
  world::World world(bench_of("rs-m8194h"), {}, {});
  for (const Case& one : cases) {
    const WindowMessage message = window_message(world.device(0), one.text);
    const Bytes request = play::message_request(1, message.first, message.words);
    const std::string came = objection(judge_frame(world, 0, request), envelope);
    if (*one.why == '\0') {
      EXPECT_EQ(came, "") << one.text;
    } else {
      EXPECT_NE(came.find(std::string("not sent, because ") + one.why), std::string::npos)
          << one.text << ": " << came;
    }
  }
  const Bytes no_command = frame({1, 16, 0x1F, 0x40, 0, 1, 2, 0x0A, 0xFF});
  EXPECT_NE(objection(judge_frame(world, 0, no_command), envelope).find("is not a command"),
            std::string::npos);
}

}  // namespace permission_test
}  // namespace understudy::emulator::box
