// Edges of EXP+ and EXP- in quick succession (3.17): none is lost that the axis could have obeyed.
#include <gtest/gtest.h>

#include <string>

#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace external_edges_test {

/// An axis without ramps: a drive takes the time of its pulses.
struct QuickRsm : OneRsm {
  explicit QuickRsm(std::int64_t pps, const std::map<std::string, std::string>& choices = {})
      : OneRsm({.choices = choices}) {
    send("RSM_SET_MAX_V X 4000000");
    send("RSM_SET_V X " + std::to_string(pps));
    send("RSM_SET_SV X " + std::to_string(pps));
    run(2);
  }
  void turn(Pin pin, std::int64_t edges, Tick ticks) {
    world().inject({.kind = world::Fault::Kind::turn,
                    .device = 0,
                    .place = terminal(0, pin),
                    .amount = edges,
                    .over_ticks = ticks,
                    .of_input = true});
  }
};

/// Falling edges for which such a drive is ready, evenly spaced by `apart_us`.
std::int64_t obeyed(std::int64_t falls, double apart_us, double takes_us) {
  std::int64_t count = 0;
  double free_us = -1;
  for (std::int64_t i = 0; i < falls; ++i) {
    const double at_us = static_cast<double>(i) * apart_us;
    if (at_us < free_us - 1e-6) continue;
    ++count;
    free_us = at_us + takes_us;
  }
  return count;
}

TEST(RsM8194hExternalEdges, EachThatComesWhenThePulsesAreOutCounts) {
  struct Case {
    std::int64_t pps, pulses;
    std::int64_t edges;
    Tick ticks;
  };
  // There are half as many edges as falls. A drive is shorter than the time between two of them.
  const Case cases[] = {{4'000'000, 1, 200, 400},   {4'000'000, 1, 200, 200},  {4'000'000, 1, 200, 150},
                        {4'000'000, 1, 200, 100},   {4'000'000, 1, 200, 67},   {4'000'000, 1, 200, 40},
                        {4'000'000, 100, 200, 150}, {4'000'000, 400, 300, 70}, {100'000, 20, 200, 150},
                        {100'000, 100, 200, 150},   {10'000, 2, 200, 150},     {1'000, 1, 200, 300}};
  for (const Case& each : cases) {
    SCOPED_TRACE(std::to_string(each.pps) + ", " + std::to_string(each.pulses) + " pulses, " +
                 std::to_string(each.edges) + " edges in " + std::to_string(each.ticks) + " ms");
    for (const bool is_plus : {true, false}) {
      QuickRsm rsm(each.pps);
      rsm.send("RSM_EXD_FP X " + std::to_string(each.pulses));
      rsm.turn(is_plus ? Pin::external_plus : Pin::external_minus, each.edges, each.ticks);
      rsm.run(1000);
      EXPECT_EQ(rsm.get("LP_X"), (is_plus ? 1 : -1) * each.edges / 2 * each.pulses);
    }
  }
}

TEST(RsM8194hExternalEdges, ThoseInThePulsesOfTheLastOneAreVoid) {
  // Falls are 4 ms apart; the drive is longer than that.
  for (const std::int64_t takes_ms : {5, 7, 10, 13}) {
    QuickRsm rsm(10'000);
    rsm.send("RSM_EXD_FP X " + std::to_string(takes_ms * 10));
    rsm.turn(Pin::external_plus, 200, 400);
    rsm.run(1000);
    const std::int64_t wanted = obeyed(100, 4000, static_cast<double>(takes_ms) * 1000);
    EXPECT_NEAR(static_cast<double>(rsm.get("LP_X")), static_cast<double>(wanted * takes_ms * 10),
                static_cast<double>(takes_ms * 10))
        << takes_ms;
  }
}

TEST(RsM8194hExternalEdges, OfAHandWheelAllCount) {
  // A quadrature wheel: EXP- is low at the rises of EXP+, or at its falls.
  for (const Tick ticks : {1000, 400, 200, 100}) {
    for (const int pulses : {1, 5, 100}) {
      QuickRsm rsm(4'000'000);
      rsm.send("RSM_EXD_MP X " + std::to_string(pulses));
      rsm.pin(0, Pin::external_minus, true);
      rsm.run(3);
      rsm.turn(Pin::external_plus, 201, ticks);
      rsm.run(ticks + 50);
      // Falls and rises alternate, back and forth: the last one, a fall, is left over.
      EXPECT_EQ(rsm.get("LP_X"), -pulses) << ticks;
      EXPECT_TRUE(rsm.rests());
    }
  }
}

TEST(RsM8194hExternalEdges, BothInputsCount) {
  for (const Tick ticks : {400, 150, 100, 70}) {
    QuickRsm rsm(4'000'000);
    rsm.send("RSM_EXD_FP X 3");
    rsm.turn(Pin::external_plus, 200, ticks);
    rsm.turn(Pin::external_minus, 100, ticks);
    rsm.run(1000);
    EXPECT_EQ(rsm.get("LP_X"), 3 * (100 - 50)) << ticks;
  }
}

TEST(RsM8194hExternalEdges, CountTurnedBackOrTooFarToo) {
  QuickRsm rsm(4'000'000);
  rsm.send("RSM_EXD_FP X 1");
  rsm.turn(Pin::external_plus, -200, 100);
  rsm.run(150);
  EXPECT_EQ(rsm.get("LP_X"), 100);
  // Edges that no input could see are not handled one by one.
  rsm.turn(Pin::external_plus, 2'000'000'000, 1);
  rsm.run(20);
  EXPECT_GT(rsm.get("LP_X"), 100);
  EXPECT_LE(rsm.get("LP_X"), 100 + 4'000);
}

TEST(RsM8194hExternalEdges, NothingOfThemIsLeftBehindAStop) {
  for (const std::string_view stop : {"RSM_STOP_SUDDENLY X", "RSM_STOP_SLOWLY X", "RSM_EMERGENCY_STOP 0",
                                      "RSM_EXD_DISABLE X", "RSM_RESET_CARD"}) {
    QuickRsm rsm(1'000);
    rsm.send("RSM_EXD_FP X 1");
    rsm.turn(Pin::external_plus, 20, 20);
    rsm.run(11);
    rsm.send(stop);
    rsm.run(2);
    const Value at = rsm.get("LP_X");
    rsm.send({"RSM_EXD_DISABLE X", "RSM_CLEAR_STOP X", "RSM_CLEAR_EMERGENCY_STOP"});
    rsm.run(100);
    EXPECT_EQ(rsm.get("LP_X"), at) << stop;
  }
}

}  // namespace external_edges_test
}  // namespace understudy::emulator::models::rs_m8194h
