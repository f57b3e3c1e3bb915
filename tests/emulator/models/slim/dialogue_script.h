// A whole dialogue with a SLIM as a script, compared line by line:
//   > ?PE          is typed
//   < 100          is the next reply
//   @ 250          this many milliseconds pass
//   IN3 = 1        a terminal gets a level
//   off, on        the power
// At the end, no further reply may be left. Lines that begin with # are remarks.
#pragma once

#include <gtest/gtest.h>

#include <deque>
#include <map>
#include <memory>
#include <sstream>
#include <string>

#include "emulator/models/slim/device.h"
#include "emulator/models/slim/model.h"
#include "emulator/world/world.h"

namespace understudy::emulator::models::slim {

inline world::Bench slim_bench(int modules, const std::map<std::string, std::string>& choices = {}) {
  world::Bench bench;
  world::DeviceSetup device;
  device.model = &model();
  device.settings.name = "robot";
  device.settings.modules = modules;
  device.settings.choices = choices;
  bench.devices.push_back(device);
  world::LineSetup line;
  line.name = "rs232";
  line.stations.push_back(0);
  line.timing = pty::Timing::instant;
  bench.lines.push_back(line);
  return bench;
}

class DialogueScript {
 public:
  explicit DialogueScript(int modules = 1, const std::map<std::string, std::string>& choices = {})
      : world_(slim_bench(modules, choices), world::WorldOptions{}, [](const std::string&) {}) {}

  world::World& world() { return world_; }
  Slim& device() { return dynamic_cast<Slim&>(world_.device(0)); }

  void pass(Tick ticks) {
    tick_ += ticks;
    world_.advance_to(time_of(tick_));
    listen();
  }

  void type(const std::string& line) { send(line + "\r"); }
  void send(const std::string& bytes) {
    world_.receive(0, std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
    world_.advance_to(world_.now());
    listen();
  }

  /// Returns the next line that was received; "(nothing)" if there is none.
  std::string next() {
    if (lines_.empty()) return "(nothing)";
    const std::string line = lines_.front();
    lines_.pop_front();
    return line;
  }

  std::string ask(const std::string& query) {
    type(query);
    return next();
  }

  void play(const std::string& script) {
    std::istringstream lines(script);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
      SCOPED_TRACE("line " + std::to_string(number) + " of the script: " + line);
      if (line.empty() || line[0] == '#') continue;
      const std::string rest = line.size() > 2 ? line.substr(2) : "";
      if (line[0] == '>') {
        EXPECT_EQ(next(), "(nothing)") << "before this was typed";
        type(rest);
      } else if (line[0] == '<') {
        EXPECT_EQ(next(), rest);
      } else if (line[0] == '@') {
        pass(std::stoll(rest));
      } else if (line == "off" || line == "on") {
        world_.switch_power(0, line == "on");
      } else {
        const std::size_t equals = line.find(" = ");
        world_.set_external_input(0, terminal_named(line.substr(0, equals)),
                                  std::stoi(line.substr(equals + 3)));
      }
    }
    EXPECT_EQ(next(), "(nothing)") << "after the script";
  }

 private:
  int terminal_named(const std::string& name) {
    const auto terminals = model().terminals;
    for (std::size_t i = 0; i < terminals.size(); ++i) {
      if (terminals[i].name == name) return static_cast<int>(i);
    }
    ADD_FAILURE() << "no terminal " << name;
    return 0;
  }

  void listen() {
    const auto output = world_.line(0).line.output();
    rest_.append(output.begin(), output.end());
    world_.take_output(0, output.size());
    for (std::size_t end = rest_.find("\r\n"); end != std::string::npos; end = rest_.find("\r\n")) {
      lines_.push_back(rest_.substr(0, end));
      rest_.erase(0, end + 2);
    }
  }

  world::World world_;
  Tick tick_ = 0;
  std::string rest_;
  std::deque<std::string> lines_;
};

using Choices = std::map<std::string, std::string>;

/// Plays a script with the given options.
inline void play(const Choices& choices, const std::string& script) {
  SCOPED_TRACE(choices.empty() ? "ours" : choices.begin()->first + ": " + choices.begin()->second);
  DialogueScript(1, choices).play(script);
}

}  // namespace understudy::emulator::models::slim
