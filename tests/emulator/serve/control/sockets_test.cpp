// Where the control sockets of several daemons are, side by side.
#include "emulator/serve/control/sockets.h"
#include "emulator/serve/control/server.h"

#include <sys/stat.h>
#include <sys/wait.h>

#include <fstream>

#include "tests/emulator/serve/control/daemon_rig.h"

namespace understudy::emulator::serve {
namespace sockets_test {

/// While this object exists, XDG_RUNTIME_DIR is the test's own folder.
struct RuntimeFolder {
  RuntimeFolder() {
    const char* const before = std::getenv("XDG_RUNTIME_DIR");
    if (before != nullptr) kept = before;
    setenv("XDG_RUNTIME_DIR", folder.path.c_str(), 1);
  }
  ~RuntimeFolder() {
    kept.empty() ? unsetenv("XDG_RUNTIME_DIR") : setenv("XDG_RUNTIME_DIR", kept.c_str(), 1);
  }
  RuntimeFolder(const RuntimeFolder&) = delete;
  RuntimeFolder& operator=(const RuntimeFolder&) = delete;
  std::string control(const std::string& name) const { return folder.path + "/understudy/" + name; }
  TestFolder folder;
  std::string kept;
};

ControlServer::Handler nobody() {
  return [](const std::string&, const ControlServer::Reply&) {};
}

TEST(ControlSockets, AreNamedByTheirProcessInAPrivateFolder) {
  const RuntimeFolder runtime;
  const std::string pid = std::to_string(getpid());
  EXPECT_EQ(own_control_path(), runtime.control(pid + ".control"));
  struct stat status {};
  ASSERT_EQ(stat((runtime.folder.path + "/understudy").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0700U);
  setenv("XDG_RUNTIME_DIR", "", 1);
  EXPECT_EQ(own_control_path(), "/tmp/understudy-" + std::to_string(getuid()) + "/" + pid + ".control");
}

TEST(ControlSockets, EachDaemonOfAProcessHasItsOwn) {
  const RuntimeFolder runtime;
  EventLoop loop;
  EXPECT_TRUE(live_control_sockets().empty());
  const ControlServer first(loop, own_control_path(), nobody());
  auto second = std::make_unique<ControlServer>(loop, own_control_path(), nobody());
  EXPECT_NE(first.path(), second->path());
  EXPECT_EQ(live_control_sockets().size(), 2U);
  second.reset();
  EXPECT_EQ(live_control_sockets(), std::vector<std::string>{first.path()});
}

TEST(ControlSockets, WhatTheDeadHaveLeftIsRemovedAndNothingElse) {
  const RuntimeFolder runtime;
  control_folder();
  // A process that ends without removing its socket.
  const pid_t dead = fork();
  if (dead == 0) {
    EventLoop loop;
    new ControlServer(loop, own_control_path(), nobody());
    _exit(0);
  }
  waitpid(dead, nullptr, 0);
  const std::string left = runtime.control(std::to_string(dead) + ".control");
  ASSERT_TRUE(std::filesystem::exists(left));
  std::ofstream(runtime.control("notes.control")) << "mine";
  std::ofstream(runtime.control("4711.control")) << "no socket";
  EXPECT_TRUE(live_control_sockets().empty());
  EXPECT_FALSE(std::filesystem::exists(left));
  EXPECT_TRUE(std::filesystem::exists(runtime.control("notes.control")));
  EXPECT_TRUE(std::filesystem::exists(runtime.control("4711.control")));
}

TEST(ControlSockets, AFolderThatOthersMayOpenIsRefused) {
  const RuntimeFolder runtime;
  std::filesystem::create_directory(runtime.folder.path + "/understudy");
  chmod((runtime.folder.path + "/understudy").c_str(), 0755);
  EXPECT_THROW(own_control_path(), ControlError);
  EXPECT_THROW(live_control_sockets(), ControlError);
}

}  // namespace sockets_test
}  // namespace understudy::emulator::serve
