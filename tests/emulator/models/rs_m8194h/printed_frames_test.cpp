// The frames that the manual prints, each sent to a new device.
#include <gtest/gtest.h>

#include "interpreter/rs_m8194h/commands.h"
#include "tests/emulator/models/rs_m8194h/one_rsm.h"
#include "tests/interpreter/facts.h"

namespace understudy::emulator::models::rs_m8194h {
namespace printed_frames_test {

/// Without station and CRC.
std::string pdu(const std::string& frame) {
  return frame.size() < 9 ? "" : frame.substr(3, frame.size() - 9);
}

void open_block_before(OneRsm& rsm, lang::Verb verb) {
  using lang::Verb;
  if (verb == Verb::else_ || verb == Verb::end_if) rsm.send("RSM_MACRO_IF 1 == 1");
  if (verb == Verb::next || verb == Verb::exit_for) rsm.send("RSM_MACRO_FOR 3");
}

TEST(RsM8194hFrames, EachPrintedFrameIsAnsweredAsItShould) {
  int requests = 0;
  for (const Fact& fact : read_facts(TEST_FACTS "/models/rs_m8194h/rs_m8194h_frames.csv")) {
    const std::string frame = pdu(fact.at("frame"));
    if (fact.at("direction") != "request" || frame.empty()) continue;
    SCOPED_TRACE(fact.at("section") + " " + fact.at("function") + " " + frame);
    ++requests;
    const std::string& variant = fact.at("variant");
    const world::Bytes bytes = world::hex(frame);
    if (variant == "macro (Cxx)") {
      OneRsm outside;
      EXPECT_EQ(outside.ask(bytes), "90 03");
      EXPECT_EQ(outside.get("IllegalFuncErr"), 7);
      const lang::CommandRow* row = lang::find_code(static_cast<std::uint16_t>(bytes[6] << 8 | bytes[7]));
      ASSERT_NE(row, nullptr);
      for (const bool is_isr : {false, true}) {
        OneRsm inside;
        inside.send(is_isr ? "RSM_MP_ISR_CREATE 19" : "RSM_MP_CREATE 157");
        const bool is_taken = is_isr ? row->use.in_isr : row->use.in_mp;
        const bool opens = is_isr && (row->verb == lang::Verb::next || row->verb == lang::Verb::exit_for);
        if (opens) continue;  // an ISR cannot contain FOR
        open_block_before(inside, row->verb);
        // A GOTO can name a label that comes later.
        EXPECT_EQ(inside.ask(bytes), is_taken ? pdu(fact.at("answer")) : "90 03") << is_isr;
        if (is_taken) continue;
        EXPECT_EQ(inside.get("IllegalFuncErr"), is_isr ? 4 : 5);
      }
      continue;
    }
    OneRsm rsm;
    const std::string reply = rsm.ask(bytes);
    if (!fact.at("answer").empty()) {
      EXPECT_EQ(reply, pdu(fact.at("answer")));
    } else {
      // A read: as many bytes as the registers need.
      const std::size_t words = static_cast<std::size_t>(bytes[3] << 8 | bytes[4]);
      EXPECT_EQ(world::hex(reply).size(), 2 + 2 * words) << reply;
      EXPECT_EQ(world::hex(reply)[0], bytes[0]);
    }
  }
  EXPECT_GT(requests, 250);
}

}  // namespace printed_frames_test
}  // namespace understudy::emulator::models::rs_m8194h
