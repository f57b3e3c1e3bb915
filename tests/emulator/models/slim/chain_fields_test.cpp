// The state of a chain as bytes, and back.
#include <gtest/gtest.h>

#include <algorithm>

#include "emulator/models/slim/chain/chain_fields.h"
#include "tests/emulator/models/slim/one_chain.h"

namespace understudy::emulator::models::slim {
namespace chain_fields_test {

std::vector<std::byte> saved(const Chain& chain) {
  StateWriter writer;
  writer.write(chain);
  return writer.take();
}
Chain restored(std::span<const std::byte> bytes, const ChainOptions& options = {}) {
  Chain chain(options);
  StateReader reader(bytes);
  reader.read(chain);
  reader.require_end();
  return chain;
}

ChainOptions shorter_buffers() {
  ChainOptions options;
  options.choose(option("buffer_length", "16"));
  return options;
}

OneChain busy(const ChainOptions& options = shorter_buffers()) {
  OneChain bench(options);
  bench.scale_all(100);
  bench.map({0, 1});
  bench.chain.set_continuous_path(1);
  for (int i = 0; i < 5; ++i) bench.line({10, 5});
  bench.map({2, 3});
  bench.chain.arc({.centre_x_units = 20, .sweep_deg = 360});
  bench.chain.move(5, true, 100);
  bench.chain.move(5, true, 0);
  bench.chain.jog(6, +1);
  bench.chain.move(6, false, 10);
  bench.chain.home(7);
  bench.chain.arm(1, 1, 1, true, 20);
  bench.chain.pwm(4, 1, 7, 30);
  bench.chain.pulse_output(4, 2, 50);
  return bench;
}

TEST(SlimChainFields, RestoredItIsTheSameAndContinuesTheSame) {
  for (const Tick when : {0, 1, 77, 250, 600}) {
    for (const bool paused : {false, true}) {
      OneChain bench = busy();
      bench.steps(when);
      if (paused) bench.chain.pause();
      OneChain copy = bench;
      copy.chain = restored(saved(bench.chain), shorter_buffers());
      ASSERT_EQ(copy.chain, bench.chain);
      if (paused) {
        bench.steps(100);
        copy.steps(100);
        bench.chain.resume();
        copy.chain.resume();
      }
      bench.steps(500);
      copy.steps(500);
      EXPECT_EQ(copy.chain, bench.chain);
      EXPECT_EQ(copy.sent, bench.sent);
      EXPECT_EQ(saved(copy.chain), saved(bench.chain));
    }
  }
}

TEST(SlimChainFields, OptionsAreNotAPartOfIt) {
  ChainOptions others;
  for (std::size_t row = 0; row < others.numbers.size(); ++row) {
    others.numbers[row] = static_cast<std::uint8_t>(std::ranges::count(kChoices[row].options, '|'));
  }
  OneChain bench = busy();
  bench.steps(77);
  const std::vector<std::byte> bytes = saved(bench.chain);
  bench.chain.set_options(others);
  EXPECT_EQ(saved(bench.chain), bytes);
}

TEST(SlimChainFields, AnIdleChainIsSmall) { EXPECT_LT(saved(Chain{}).size(), 30'000U); }

TEST(SlimChainFields, BytesThatAreNoChainAreRefusedOrCanBeStepped) {
  OneChain bench = busy();
  bench.steps(100);
  const std::vector<std::byte> good = saved(bench.chain);
  for (std::size_t kept = 0; kept < good.size(); kept += 997) {
    EXPECT_THROW(restored(std::span(good).first(kept)), StateError) << kept;
  }
  int refused = 0;
  for (std::size_t at = 0; at < good.size(); at += 13) {
    std::vector<std::byte> bad = good;
    bad[at] ^= std::byte{0xff};
    try {
      Chain chain = restored(bad);
      for (Tick tick = 101; tick < 110; ++tick) chain.step(tick);
      chain.emergency_stop();
    } catch (const StateError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 100);
}

TEST(SlimChainFields, TicksLeftOutWhereNothingHappensMakeNoDifference) {
  OneChain bench = busy();
  bench.chain.jog(6, 0);
  OneChain sparse = bench;
  bench.chain.set_horg(7, true);
  sparse.chain.set_horg(7, true);
  for (bench.tick = 0; bench.tick < 20'000;) bench.step();
  Tick steps = 0;
  for (Tick next = 0; (next = sparse.chain.next_active_tick(sparse.tick)) <= 20'000; ++steps) {
    sparse.chain.skip_to(next - 1);
    sparse.tick = next - 1;
    sparse.step();
  }
  sparse.chain.step(20'000);
  EXPECT_EQ(sparse.sent, bench.sent);
  EXPECT_EQ(sparse.chain, bench.chain);
  EXPECT_LT(steps, 19'000);
}

}  // namespace chain_fields_test
}  // namespace understudy::emulator::models::slim
