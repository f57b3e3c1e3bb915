// Folders below /tmp that are removed with their owner, and what failures have left in some.
#include "emulator/serve/ports/private_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace understudy::emulator::serve {
namespace private_folder_test {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

class LeftOvers : public testing::Test {
 protected:
  LeftOvers() { EXPECT_NE(mkdtemp(home_.data()), nullptr); }
  ~LeftOvers() override { fs::remove_all(home_); }

  /// A folder with a recording in it, both of that age.
  std::string make(const std::string& name, std::chrono::hours age, mode_t mode = 0700) const {
    const std::string folder = home_ + "/" + name;
    fs::create_directory(folder);
    std::ofstream(folder + "/recording") << "{}";
    chmod(folder.c_str(), mode);
    set_age(folder + "/recording", age);
    set_age(folder, age);
    return folder;
  }
  static void set_age(const std::string& path, std::chrono::hours age) {
    fs::last_write_time(path, fs::file_time_type::clock::now() - age);
  }
  void remove() const { remove_left_overs(home_ + "/kept-"); }

  std::string home_ = "/tmp/left-overs-XXXXXX";
};

TEST_F(LeftOvers, GoAfterAWeek) {
  const std::string old = make("kept-Ab3dEf", kLeftOversKept + 1h);
  const std::string young = make("kept-Ab3dEg", kLeftOversKept - 1h);
  const std::string touched = make("kept-Ab3dEh", kLeftOversKept + 1h);
  set_age(touched + "/recording", 1h);
  remove();
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(young));
  EXPECT_TRUE(fs::exists(touched)) << "its contents count as well";
}

TEST_F(LeftOvers, OfOthersAndOfOtherNamesStay) {
  const auto age = kLeftOversKept * 100;
  for (const std::string& path :
       {make("kept-Ab3dE", age), make("kept-Ab3dEfg", age), make("kept-Ab.dEf", age), make("Ab3dEf", age),
        make("kept-Ab3dE2", age, 0755), make("kept-" + std::to_string(geteuid()), age)}) {
    remove();
    EXPECT_TRUE(fs::exists(path)) << path;
  }
  // A link is not one of our folders, and its target even less.
  const std::string target = make("precious", age);
  fs::create_directory_symlink(target, home_ + "/kept-Linked");
  remove();
  EXPECT_TRUE(fs::exists(target + "/recording"));
}

TEST_F(LeftOvers, OfALivingOwnerStay) {
  PrivateFolder owner;
  const std::string path = owner.path();
  std::ofstream(path + "/recording") << "{}";
  set_age(path + "/recording", kLeftOversKept * 2);
  set_age(path, kLeftOversKept * 2);
  remove_left_overs();
  EXPECT_TRUE(fs::exists(path + "/recording"));
  fs::remove(path + "/recording");
}

}  // namespace private_folder_test
}  // namespace understudy::emulator::serve
