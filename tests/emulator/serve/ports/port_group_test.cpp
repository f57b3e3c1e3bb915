#include "emulator/serve/ports/port_group.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "pty/pseudo_terminal.h"

namespace understudy::emulator::serve {
namespace port_group_test {

TEST(FindGroup, KnowsNamesAndNumbers) {
  EXPECT_EQ(find_group("root"), 0U);
  EXPECT_EQ(find_group("0"), 0U);
  EXPECT_EQ(find_group("4711"), 4711U) << "a number needs no name";
}

TEST(FindGroup, RefusesEverythingElse) {
  for (const char* name : {"", "no-such-group", "-1", "4294967295", "4294967296", "20 "})
    EXPECT_FALSE(find_group(name)) << name;
}

TEST(SharePort, LetsTheGroupReadAndWriteAndNobodyElse) {
  const pty::PseudoTerminal terminal("");
  share_port(terminal.path(), getegid());
  struct stat status {};
  ASSERT_EQ(stat(terminal.path().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0660U);
  EXPECT_EQ(status.st_gid, getegid());
}

TEST(SharePort, SaysWhichPortCouldNotBeShared) {
  try {
    share_port("/missing/port", getegid());
    FAIL();
  } catch (const pty::PortError& error) {
    EXPECT_NE(std::string(error.what()).find("/missing/port"), std::string::npos) << error.what();
  }
}

}  // namespace port_group_test
}  // namespace understudy::emulator::serve
