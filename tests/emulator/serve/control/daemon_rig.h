// A daemon of two controllers with a stopped clock, in its own folder.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "emulator/models/models.h"
#include "emulator/serve/control/control_door.h"
#include "emulator/serve/control/messages.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/bench_file/bench_file.h"

namespace understudy::emulator::serve {

using Json = nlohmann::json;

/// A new folder below /tmp that is removed with its owner.
struct TestFolder {
  TestFolder() { EXPECT_NE(mkdtemp(path.data()), nullptr); }
  ~TestFolder() { std::filesystem::remove_all(path); }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;
  std::string path = "/tmp/understudy-test-XXXXXX";
};

struct DaemonRig {
  /// `more` is added at the end of the bench.
  explicit DaemonRig(Speed speed = {.kind = Speed::Kind::manual}, const std::string& more = "")
      : bench(world::parse_bench(models::all_models(),
                                 "understudy: 1\n"
                                 "lines:\n"
                                 "  rs485:\n"
                                 "    link: ./feeder.port\n"
                                 "    stations:\n"
                                 "      - { name: feeder, model: simple2-r3 }\n"
                                 "      - { name: turner, model: simple2-r3, address: 2, firmware: 1.40 }\n"
                                 "wires: [ feeder.DOUT_4 -> turner.DIN_10 ]\n" +
                                     more,
                                 "bench.yaml", folder.path)),
        daemon(bench, options(speed), [this](const std::string& line) { log.push_back(line); }) {}

  DaemonOptions options(Speed speed) const {
    DaemonOptions made;
    made.speed = speed;
    made.door = control_door(folder.path + "/control");
    return made;
  }

  /// Returns the reply as it arrives; empty if none has arrived yet.
  std::string reply_to(const std::string& message) {
    std::string reply;
    handle_message(daemon, message, [&](const std::string& line) {
      EXPECT_EQ(reply, "") << "two replies to " << message;
      reply = line;
    });
    EXPECT_EQ(reply.find('\n'), std::string::npos) << "a reply is one line: " << reply;
    return reply;
  }

  Json ask(const std::string& message) { return Json::parse(reply_to(message)); }

  std::int64_t value(const std::string& name) {
    return ask(Json{{"do", "get"}, {"names", {name}}}.dump())["values"][name].get<std::int64_t>();
  }

  /// Returns true if both devices are in their initial state.
  bool is_untouched() {
    for (std::size_t i = 0; i < 2; ++i) {
      const auto fresh = make_device(*bench.devices[i].model, bench.devices[i].settings);
      if (!daemon.world().device(i).same_state(*fresh)) return false;
      for (int terminal = 0; terminal < 11; ++terminal) {
        if (daemon.world().device(i).input(terminal)) return false;
      }
    }
    return daemon.world().now() == SimTime{0};
  }

  TestFolder folder;
  std::vector<std::string> log;
  world::Bench bench;
  Daemon daemon;
};

}  // namespace understudy::emulator::serve
