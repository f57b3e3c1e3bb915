// kill -9 at random moments (seeded) while controllers write their memories: the next daemon always finds an
// image, and always one that the memory contained at some moment.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <iostream>
#include <random>
#include <thread>

#include "emulator/device/memory/nv_file.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace memory_kill_test {

using emulator::NvImage;
using emulator::read_nv_file;

constexpr int kDaemons = 8;
constexpr int kKillsOfEach = 25;
constexpr int kRegisters = 8;
constexpr std::int64_t kFirst = 65'530;  // soon the high words change as well
constexpr std::uint64_t kSeed = 81'004;

/// Sets MEM1 to MEM7 to MEM0 one by one, increments MEM0, and starts again. Storing a pair takes 10 ms, so
/// each write is stored before the next one: at every moment, MEM0 and the registers up to some MEMn have the
/// new count, and the others the previous one.
std::string program() {
  std::string listing = "again:";
  for (int i = 1; i < kRegisters; ++i) {
    listing += " VAR_Copy MEM0 MEM" + std::to_string(i) + "\nDelay_mSec 12\n";
  }
  return listing + "VAR_Inc MEM0\nDelay_mSec 12\nJump again\n";
}

std::vector<std::int64_t> counts(const NvImage& image) {
  std::vector<std::int64_t> found(kRegisters, 0);
  for (const auto& [name, value] : image.registers) {
    for (int i = 0; i < kRegisters; ++i) {
      if (name == "PROG_MEM" + std::to_string(i)) found[static_cast<std::size_t>(i)] = value;
    }
  }
  return found;
}

/// Returns whether the state results from the first so many writes, and no others.
bool is_some_moment(const std::vector<std::int64_t>& counts) {
  for (std::size_t i = 1; i < counts.size(); ++i) {
    if (counts[i] > counts[i - 1]) return false;
  }
  return counts.back() >= counts.front() - 1;
}

class KilledDaemon {
 public:
  KilledDaemon() {
    NvImage begin{.model = "simple2-r3", .firmware = "1.52", .registers = {}};
    for (int i = 0; i < kRegisters; ++i) begin.registers.emplace_back("PROG_MEM" + std::to_string(i), kFirst);
    folder_.write("counter.json", emulator::to_json(begin));
    folder_.write("count.lst", program());
    folder_.write(
        "bench.yaml",
        "understudy: 1\n"
        "lines:\n"
        "  line:\n"
        "    link: ./port\n"
        "    stations:\n"
        "      - { name: counter, model: simple2-r3, program: count.lst, set: { AutoStart_MainProg: 1 } }\n");
  }

  void start() {
    process_ =
        std::make_unique<Process>(Words{UNDERSTUDY_BINARY, "serve", folder_ / "bench.yaml", "--nv",
                                        folder_.path(), "--speed", "5x", "--control", folder_ / "control"});
  }

  /// Checks the image that it left, and returns its count.
  std::int64_t kill_and_look(int number) {
    process_->send(SIGKILL);
    EXPECT_EQ(process_->wait(kPatience), 128 + SIGKILL) << process_->errors();
    EXPECT_EQ(process_->errors().find("counter.json"), std::string::npos) << process_->errors();
    process_.reset();
    const std::optional<NvImage> image = emulator::read_nv_file(folder_ / "counter.json");
    EXPECT_TRUE(image);
    if (!image) return last_;
    const std::vector<std::int64_t> found = counts(*image);
    EXPECT_TRUE(is_some_moment(found)) << testing::PrintToString(found) << " after kill " << number;
    EXPECT_GE(found.front(), last_) << "no stored value is lost, kill " << number;
    last_ = found.front();
    return last_;
  }

 private:
  PrivateFolder folder_;
  std::unique_ptr<Process> process_;
  std::int64_t last_ = kFirst;
};

TEST(MemoryKill, AtRandomMomentsLeavesAlwaysAnImageThatThereWas) {
  std::mt19937_64 random(kSeed);
  std::vector<KilledDaemon> daemons(kDaemons);
  for (int round = 0; round < kKillsOfEach; ++round) {
    // All of them at once, each for a different time.
    std::vector<std::pair<Wait, std::size_t>> ends;
    for (std::size_t i = 0; i < daemons.size(); ++i) {
      daemons[i].start();
      ends.emplace_back(std::uniform_int_distribution<int>(0, 450)(random), i);
    }
    std::sort(ends.begin(), ends.end());
    const auto begin = std::chrono::steady_clock::now();
    for (const auto& [end, i] : ends) {
      std::this_thread::sleep_until(begin + end);
      daemons[i].kill_and_look(round);
    }
    if (HasFailure()) FAIL() << "seed " << kSeed;
  }
  // The test is meaningful only if they counted.
  std::int64_t counted = 0;
  for (KilledDaemon& daemon : daemons) {
    daemon.start();
    counted += daemon.kill_and_look(kKillsOfEach) - kFirst;
  }
  std::cout << counted << " counts of " << kRegisters << " registers outlived " << kDaemons * kKillsOfEach
            << " kills\n";
  EXPECT_GT(counted, 100);
}

}  // namespace memory_kill_test
}  // namespace understudy::acceptance
