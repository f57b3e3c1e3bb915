// Benches with more lines than a user has inotify instances, and users who have none left.
#include <gtest/gtest.h>
#include <sys/inotify.h>

#include <filesystem>

#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/running_understudy.h"
#include "tests/ordinary_user.h"

namespace understudy::acceptance {
namespace many_ports_test {

std::string lines(int count) {
  std::string bench = "understudy: 1\nlines:\n";
  for (int i = 0; i < count; ++i) {
    const std::string name = "l" + std::to_string(i);
    bench += "  " + name + ": { timing: instant, link: " + name + ".port, stations: [ { name: d" +
             std::to_string(i) + ", model: simple2-r3 } ] }\n";
  }
  return bench;
}

int inotify_instances_of(const Process& process) {
  int count = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator("/proc/" + std::to_string(process.pid()) + "/fd"))
    count += std::filesystem::read_symlink(entry.path()) == "anon_inode:inotify" ? 1 : 0;
  return count;
}

TEST(BenchOfManyLines, TakesOneInotifyInstance) {
  constexpr int kLines = 200;  // Linux gives a user 128 instances
  const auto daemon = RunningUnderstudy::of_bench(lines(kLines));
  ASSERT_EQ(daemon->ports().size(), static_cast<std::size_t>(kLines));
  EXPECT_EQ(inotify_instances_of(daemon->process()), 1);
  for (const int line : {0, 57, kLines - 1}) {
    for (int opening = 0; opening < 2; ++opening) {
      ModbusHost host(daemon->ports().at(static_cast<std::size_t>(line)).link);
      EXPECT_EQ(host.read(kHardwareCode), Registers{0xC001}) << line;
    }
  }
  EXPECT_TRUE(
      eventually([&] { return daemon->ctl({"status"}).output.find("host open") == std::string::npos; }));
}

TEST(BenchOfManyLines, LearnsHowManyFilesItMayOpen) {
  const PrivateFolder folder;
  const std::string bench = folder.write("bench.yaml", lines(30));
  const Finished refused =
      run({"sh", "-c", "ulimit -n 64; exec \"$@\"", "sh", UNDERSTUDY_BINARY, "serve", bench});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.errors.find("`ulimit -n` is 64, and each port needs 3"), std::string::npos)
      << refused.errors;
  EXPECT_EQ(lines_of(refused.errors).size(), 1U) << refused.errors;
}

TEST(UserWithoutInotifyInstances, IsServedAsWell) {
  const PrivateFolder folder;
  const OrdinaryUser user(folder.path());
  std::vector<Descriptor> instances;
  constexpr std::size_t kLimit = 900;  // below the usual limit of descriptors
  while (instances.size() < kLimit) {
    Descriptor instance(::inotify_init1(IN_CLOEXEC));
    if (!instance) break;
    instances.push_back(std::move(instance));
  }
  if (instances.size() == kLimit) GTEST_SKIP() << "this machine has no such limit";
  const auto daemon = RunningUnderstudy::of_bench(lines(2));
  EXPECT_NE(daemon->errors().find("2 ports are checked for hosts every 50 ms"), std::string::npos)
      << daemon->errors();
  for (int opening = 0; opening < 3; ++opening) {
    {
      ModbusHost host(daemon->port());
      EXPECT_EQ(host.read(kHardwareCode), Registers{0xC001});
      EXPECT_NE(daemon->ctl({"status"}).output.find("host open"), std::string::npos);
    }
    EXPECT_TRUE(
        eventually([&] { return daemon->ctl({"status"}).output.find("host open") == std::string::npos; }));
  }
}

}  // namespace many_ports_test
}  // namespace understudy::acceptance
