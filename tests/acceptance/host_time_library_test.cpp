// The library that exec --host-time preloads: without the right one the host would run in real time, so the
// command is not started.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "tests/acceptance/host_time_rig.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace host_time_test {

class HostTimeLibrary : public testing::Test {
 protected:
  /// The program runs from a copy that has this library, or none if it is empty.
  Finished exec_with(const std::string& library) {
    std::filesystem::remove_all(library_);
    if (!library.empty()) folder_.write("lib/understudy/host_time.so", library);
    return exec();
  }
  Finished exec() {
    return run({program_, "exec", bench_, "--host-time", "--", "touch", folder_ / "started"});
  }
  bool has_started() const { return std::filesystem::exists(folder_ / "started"); }
  std::string right_library() const {
    return text_of(std::string(BUILD_FOLDER) + "/lib/understudy/host_time.so");
  }
  std::string message(const std::string& why) const {
    return "understudy: --host-time: " + library_ + " " + why + "\n";
  }

  PrivateFolder folder_;
  std::string program_ = folder_ / "understudy";
  std::string library_ = folder_ / "lib/understudy/host_time.so";
  std::string bench_ = folder_.write("bench.yaml", kBench);

 private:
  void SetUp() override {
    std::filesystem::copy_file(UNDERSTUDY_BINARY, program_);
    std::filesystem::create_directories(folder_ / "lib/understudy");
  }
};

TEST_F(HostTimeLibrary, IsRefusedUnlessItIsOfThisVersion) {
  const Finished accepted = exec_with(right_library());
  ASSERT_EQ(accepted.exit_code, 0) << accepted.errors;
  ASSERT_TRUE(has_started());
  std::filesystem::remove(folder_ / "started");
  std::string older = right_library();
  const std::size_t at = older.find("understudy host time, version ");
  ASSERT_NE(at, std::string::npos);
  older.replace(at, 10, "understood");
  const std::string foreign = text_of(std::string(BUILD_FOLDER) + "/lib/understudy/tty_shim.so");
  for (const std::string& library : {older, foreign, std::string("#!/bin/sh\n"), std::string("\0", 1)}) {
    const Finished refused = exec_with(library);
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_EQ(refused.errors,
              message("is not the library of this version; expected the one that comes with this program"));
  }
  EXPECT_FALSE(has_started());
}

TEST_F(HostTimeLibrary, IsRefusedIfItIsMissing) {
  const Finished refused = exec_with("");
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_EQ(refused.errors,
            "understudy: " + folder_.path() +
                ": host_time.so is missing; expected it in lib/understudy or ../lib/understudy\n");
  EXPECT_FALSE(has_started());
}

TEST_F(HostTimeLibrary, IsRefusedIfItIsNoFile) {
  std::filesystem::create_directories(library_);
  const Finished refused = exec();
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_EQ(refused.errors,
            message("is not the library of this version; expected the one that comes with this program"));
}

TEST_F(HostTimeLibrary, IsRefusedIfItCannotBeRead) {
  if (geteuid() == 0) GTEST_SKIP() << "root may read any file";
  folder_.write("lib/understudy/host_time.so", right_library());
  chmod(library_.c_str(), 0);
  const Finished refused = exec();
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_EQ(refused.errors,
            message("cannot be read: Permission denied; expected a file that hosts may read"));
}

TEST_F(HostTimeLibrary, IsRefusedInACampaignBeforeItsFirstCase) {
  folder_.write("lib/understudy/host_time.so", "#!/bin/sh\n");
  const std::string scenario =
      folder_.write("campaign.yaml",
                    "understudy: 1\nname: three\nbench: bench.yaml\nvary: { n: [ 1, 2, 3 ] }\n"
                    "steps: [ { host: { within: 5s } } ]\n");
  const Finished refused =
      run({program_, "exec", scenario, "--host-time", "--", "touch", folder_ / "started"});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_EQ(refused.errors,
            message("is not the library of this version; expected the one that comes with this program"));
  EXPECT_FALSE(has_started());
}

}  // namespace host_time_test
}  // namespace understudy::acceptance
