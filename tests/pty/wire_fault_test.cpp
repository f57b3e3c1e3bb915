// The effect of each stage on a message, byte by byte, and of several stages in a row.
#include "pty/wire_fault.h"

#include <gtest/gtest.h>

#include "tests/pty/wire_examples.h"

namespace understudy::pty {
namespace wire_fault_test {

using namespace std::chrono_literals;
using Kind = WireFault::Kind;
using Pieces = std::vector<WirePiece>;

const Bytes kMessage{0x01, 0x03, 0x02, 0xC0, 0x01, 0x29, 0x84};

Pieces through(std::vector<WireFault> stages, const Bytes& message = kMessage) {
  return through_faults(message, stages);
}

TEST(WireFault, EachStageDoesItsOwn) {
  struct Case {
    WireFault stage;
    Pieces pieces;
  };
  for (const auto& [stage, pieces] : std::vector<Case>{
           {{.kind = Kind::drop}, {}},
           {{.kind = Kind::delay, .time = 20ms}, {{20ms, kMessage}}},
           {{.kind = Kind::corrupt_checksum}, {{0ms, {0x01, 0x03, 0x02, 0xC0, 0x01, 0x29, 0x7B}}}},
           {{.kind = Kind::truncate, .size = 3}, {{0ms, {0x01, 0x03, 0x02}}}},
           {{.kind = Kind::truncate, .size = 7}, {{0ms, kMessage}}},
           {{.kind = Kind::truncate, .size = 9}, {{0ms, kMessage}}},
           {{.kind = Kind::truncate, .size = 0}, {}},
           {{.kind = Kind::duplicate}, {{0ms, kMessage}, {0ms, kMessage}}},
           {{.kind = Kind::duplicate, .time = 5ms}, {{0ms, kMessage}, {5ms, kMessage}}},
           {{.kind = Kind::noise, .before = {0xFF, 0x00}, .after = {0x55}},
            {{0ms, {0xFF, 0x00, 0x01, 0x03, 0x02, 0xC0, 0x01, 0x29, 0x84, 0x55}}}},
           // 0x55 is 01010101: its effect on 01 03 02 C0 01 29 84.
           {{.kind = Kind::collision}, {{0ms, {0x01, 0x01, 0x00, 0x40, 0x01, 0x01, 0x04}}}},
           {{.kind = Kind::collision, .before = {0x02, 0x0F}},
            {{0ms, {0x00, 0x03, 0x02, 0xC0, 0x01, 0x29, 0x84}}}},
           {{.kind = Kind::collision, .before = {1, 3, 2, 0xC0, 1, 0x29, 0x84, 0x66}},
            {{0ms, {0x01, 0x03, 0x02, 0xC0, 0x01, 0x29, 0x84, 0x66}}}},
       }) {
    EXPECT_EQ(through({stage}), pieces) << static_cast<int>(stage.kind);
  }
}

TEST(WireFault, StagesActInTheirOrder) {
  const WireFault cut{.kind = Kind::truncate, .size = 2};
  const WireFault garble{.kind = Kind::corrupt_checksum};
  const WireFault noise{.kind = Kind::noise, .after = {0xAA}};
  EXPECT_EQ(through({cut, garble}), (Pieces{{0ms, {0x01, 0xFC}}}));
  EXPECT_EQ(through({garble, cut}), (Pieces{{0ms, {0x01, 0x03}}}));
  EXPECT_EQ(through({cut, noise, garble}), (Pieces{{0ms, {0x01, 0x03, 0x55}}}));
  EXPECT_EQ(through({garble, {.kind = Kind::drop}, noise}), Pieces{});
}

TEST(WireFault, DelaysAddUpAndPiecesComeInTheOrderOfTime) {
  const WireFault twice{.kind = Kind::duplicate, .time = 10ms};
  const WireFault late{.kind = Kind::delay, .time = 3ms};
  EXPECT_EQ(through({twice, late}, {7}), (Pieces{{3ms, {7}}, {13ms, {7}}}));
  EXPECT_EQ(through({late, late, twice}, {7}), (Pieces{{6ms, {7}}, {16ms, {7}}}));
  // 0, 10 and then 4 later than each.
  const WireFault again{.kind = Kind::duplicate, .time = 4ms};
  EXPECT_EQ(through({twice, again}, {7}), (Pieces{{0ms, {7}}, {4ms, {7}}, {10ms, {7}}, {14ms, {7}}}));
}

TEST(WireFault, HoweverOftenItIsDoubledThereAreNoMoreThanSixteen) {
  for (const std::size_t stages : {4u, 5u, 40u}) {
    const auto pieces = through(std::vector<WireFault>(stages, {.kind = Kind::duplicate}), {7});
    EXPECT_EQ(pieces.size(), kMaxWirePieces) << stages;
  }
  EXPECT_EQ(through(std::vector<WireFault>(3, {.kind = Kind::duplicate}), {7}).size(), 8u);
}

TEST(WireFault, OfNoBytesMakesNone) {
  for (const Kind kind : {Kind::delay, Kind::corrupt_checksum, Kind::truncate, Kind::duplicate}) {
    EXPECT_EQ(through({{.kind = kind}}, {}), Pieces{});
  }
}

}  // namespace wire_fault_test
}  // namespace understudy::pty
