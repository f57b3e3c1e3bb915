#include "emulator/command_line/dialogue.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "emulator/command_line/interruption.h"
#include "emulator/device/model.h"
#include "emulator/play/executors/real_executor.h"
#include "emulator/play/performing/performance.h"
#include "emulator/play/reading/parameters.h"
#include "emulator/play/reading/shared_reading.h"
#include "emulator/play/reading/steps_reader.h"
#include "emulator/play/reading/trial.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/bench_file/yaml_fields.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/names/names.h"
#include "pty/port_link.h"

namespace understudy::emulator::command_line {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kLongestMessage = std::size_t{4} << 20;
constexpr const char* kMessagePlace = "standard input";

/// Reads lines from standard input. Ctrl-C ends the wait for a line.
class MessageReader {
 public:
  std::optional<std::string> next() {
    while (true) {
      if (const std::size_t end = text_.find('\n'); end != std::string::npos) {
        std::string line = text_.substr(0, end);
        text_.erase(0, end + 1);
        return line;
      }
      if (!read_more()) return std::nullopt;
    }
  }

 private:
  bool read_more() {
    constexpr int kPatienceMs = 100;
    pollfd waited{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
    while (::poll(&waited, 1, kPatienceMs) <= 0)
      if (is_interrupted()) return false;
    std::array<char, 4096> part{};
    const ssize_t size = ::read(STDIN_FILENO, part.data(), part.size());
    if (size <= 0 || text_.size() > kLongestMessage) return false;
    text_.append(part.data(), static_cast<std::size_t>(size));
    return true;
  }
  std::string text_;
};

Json error_reply(const char* kind, const std::string& why) {
  return {{"ok", false}, {"kind", kind}, {"error", one_line(why)}};
}

class Dialogue {
 public:
  Dialogue(ModelList models, const play::Scenario& scenario, play::Performance& performance)
      : performance_(performance),
        shared_{.models = models, .benches = {}, .included = {}},
        reading_{.shared = shared_},
        trial_(scenario.bench),
        reader_(trial_, reading_, kMessagePlace) {}

  Json answer(const std::string& line) {
    const Json message = Json::parse(line, nullptr, false);
    const bool has_step = message.is_object() && message.contains("step") && message["step"].is_object();
    const bool has_values = message.is_object() && message.contains("values") && message["values"].is_array();
    if (has_step) return play(message["step"]);
    if (has_values) return values_of(message["values"]);
    return error_reply("refused",
                       "a message is not valid; expected {\"step\": {...}} or {\"values\": [...]}");
  }

 private:
  Json play(const Json& step) {
    reading_.steps = 0;  // their number is unlimited
    reading_.bytes = 0;
    play::Steps steps;
    try {
      steps = reader_.read_apart(world::YamlFields::parse(step.dump(), kMessagePlace, "step",
                                                          "expected a step such as {\"write\": {...}}"));
    } catch (const FileError& error) {
      return error_reply("refused", error.diagnostics().front().text);
    }
    performance_.begin_step_now();
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const auto failure = performance_.play(std::span(steps).subspan(i));
      if (failure) return error_reply("failed", failure->what);
      if (!performance_.skipped().empty()) return error_reply("skipped", performance_.skipped());
    }
    return good();
  }

  Json values_of(const Json& names) {
    Json reply = good();
    reply["values"] = Json::object();
    for (const Json& name : names) {
      if (!name.is_string())
        return error_reply("refused", "a value is not a string; expected names in quotes");
      try {
        const world::Number value = performance_.present_value(name.get<std::string>());
        if (value.is_whole()) {
          reply["values"][name.get<std::string>()] = value.whole();
        } else {
          reply["values"][name.get<std::string>()] = value.real();
        }
      } catch (const world::NameError& error) {
        return error_reply("refused", error.what());
      } catch (const world::ExpressionError& error) {
        return error_reply("refused", error.what());
      } catch (const world::ArithmeticError& error) {
        return error_reply("refused", error.what());
      } catch (const play::StepError& error) {
        return error_reply("failed", error.what());
      } catch (const play::ExecutionAborted&) {
        throw;
      } catch (const pty::PortError&) {
        throw;
      } catch (const std::runtime_error& error) {
        return error_reply("skipped", error.what());
      }
    }
    reply["now_ns"] = performance_.now().count();
    return reply;
  }

  Json good() { return {{"ok", true}, {"now_ns", performance_.now().count()}}; }

  play::Performance& performance_;
  play::SharedReading shared_;
  play::FileReading reading_;
  play::Trial trial_;
  play::StepsReader reader_;
};

}  // namespace

void hold_dialogue(ModelList models, const play::Scenario& scenario, play::Performance& performance) {
  Dialogue dialogue(models, scenario, performance);
  MessageReader messages;
  while (const auto line = messages.next()) {
    std::printf("%s\n", dialogue.answer(*line).dump(-1, ' ', false, Json::error_handler_t::replace).c_str());
    std::fflush(stdout);
  }
}

}  // namespace understudy::emulator::command_line
