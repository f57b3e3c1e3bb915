// A running daemon, used through its socket.
#pragma once

#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <string>
#include <thread>

#include "emulator/serve/control/server.h"
#include "tests/emulator/serve/control/daemon_rig.h"

namespace understudy::emulator::serve {

/// The daemon's loop in a separate thread, until the end of the test.
struct Running {
  explicit Running(Speed speed = {.kind = Speed::Kind::manual})
      : rig(speed), thread([this] { rig.daemon.run(); }) {}
  ~Running() {
    // The daemon reads its signals from a descriptor; they are blocked in every thread.
    kill(getpid(), SIGTERM);
    thread.join();
    sigset_t term;
    sigemptyset(&term);
    sigaddset(&term, SIGTERM);
    const timespec now{};
    sigtimedwait(&term, nullptr, &now);  // the signal may still be pending
  }
  Json ask(const std::string& message) {
    return Json::parse(ask_control(rig.folder.path + "/control", message));
  }
  std::int64_t get(const std::string& name) {
    return ask(Json{{"do", "get"}, {"names", {name}}}.dump())["values"][name].get<std::int64_t>();
  }

  DaemonRig rig;
  std::thread thread;
};

}  // namespace understudy::emulator::serve
