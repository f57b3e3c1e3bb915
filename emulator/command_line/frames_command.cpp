// Implements `understudy ctl frames`: describes the frames on the lines as they are transmitted.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/command_line/choose_daemon.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/interruption.h"
#include "emulator/serve/control/server.h"

namespace understudy::emulator::command_line {

namespace {

constexpr int kMaxAtOnce = 200;  // frames in one reply

using Json = nlohmann::ordered_json;

/// Returns a line such as "12.345s rs485 -> write 0x1014 feeder.Aaxis_SVON = 1".
std::string text_of(const Json& frame) {
  std::string text = format_duration(SimTime{frame.at("time_ns").get<std::int64_t>()}) + " " +
                     frame.at("line").get<std::string>() + (frame.at("way") == "in" ? " -> " : " <- ") +
                     frame.at("text").get<std::string>();
  if (frame.contains("remark")) text += "  (" + frame.at("remark").get<std::string>() + ")";
  return one_line(text);
}

/// Prints the frames starting at number `since`. Returns the number at which the next request must start.
std::uint64_t print_new(const Json& reply, std::uint64_t since, bool json) {
  const std::uint64_t next = reply.at("next").get<std::uint64_t>();
  const Json& frames = reply.at("frames");
  const std::uint64_t first = frames.empty() ? next : frames.at(0).at("number").get<std::uint64_t>();
  if (since != 0 && first > since && !json) {
    std::printf("... %llu more frames, which are no longer stored\n",
                static_cast<unsigned long long>(first - since));
  }
  for (const Json& frame : frames) {
    std::printf("%s\n", json ? frame.dump().c_str() : text_of(frame).c_str());
  }
  return next;
}

}  // namespace

int follow_frames(const FramesArguments& arguments) {
  const auto every = parse_duration(arguments.every);
  if (!every || *every < std::chrono::milliseconds(10)) {
    throw UsageError("ctl frames: --every: " + understudy::quoted(arguments.every) +
                     " is not a valid interval; expected 10ms or more");
  }
  if (arguments.last < 0 || arguments.last > kMaxAtOnce) {
    throw UsageError("ctl frames: --last: expected 0 to " + std::to_string(kMaxAtOnce));
  }
  if (arguments.times < 0) throw UsageError("ctl frames: --times: expected 0 (no limit) or more");
  const int times = arguments.once ? 1 : arguments.times;
  const std::string path = choose_daemon(arguments.which);
  Json message{{"do", "frames"}, {"last", arguments.last}};
  std::uint64_t since = 0;
  try {
    Json reply = Json::parse(serve::ask_control(path, message.dump()));
    watch_for_interruption();
    for (int look = 1;; ++look) {
      since = print_new(reply, since, arguments.json);
      std::fflush(stdout);
      if (look == times) break;
      const bool may_be_more = reply.at("frames").size() == kMaxAtOnce;
      if (!may_be_more) wait_or_be_interrupted(*every);
      if (is_interrupted()) break;
      reply = Json::parse(serve::ask_control(path, Json{{"do", "frames"}, {"since", since}}.dump()));
    }
  } catch (const Json::exception&) {
    throw serve::ControlError(
        path + ": this is not an Understudy socket; expected the control socket of `understudy serve`");
  }
  return kExitWell;
}

}  // namespace understudy::emulator::command_line
