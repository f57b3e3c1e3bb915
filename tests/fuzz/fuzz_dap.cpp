// Any bytes on the Debug Adapter Protocol: frames come out the same however the bytes are cut, and each line
// of the input, as a message, gets its reply and leaves a session that goes on. The bench is a daemon in this
// process. Lines with a path are left out, because a search must not touch the machine that it runs on.
#include <cstdint>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/dap/bench_link.h"
#include "emulator/dap/framing.h"
#include "emulator/dap/session.h"
#include "emulator/models/models.h"
#include "emulator/serve/control/debug_messages.h"
#include "emulator/serve/control/messages.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/snapshot.h"
#include "tests/fuzz/fuzzing.h"

namespace {

using namespace understudy;
using emulator::dap::Json;
using fuzzing::require;

constexpr std::size_t kLongest = 4096;
constexpr SimTime kGoneOn = std::chrono::milliseconds(20);

struct Rig {
  Rig()
      : daemon(emulator::world::parse_bench(emulator::models::all_models(),
                                            "understudy: 1\n"
                                            "lines:\n"
                                            "  rs485: { stations: [ { name: a, model: simple2-r3 } ] }\n"
                                            "  serial: { stations: [ { name: b, model: slim } ] }\n",
                                            "bench.yaml", "/nonexistent"),
               options(), [](const std::string&) {}) {
    daemon.world().load_program(0, "again: VAR_Inc VAR32\nDelay_mSec 5\nJump again\nEND\n");
    as_made = save(daemon.world());
  }
  static emulator::serve::DaemonOptions options() {
    emulator::serve::DaemonOptions made;
    made.speed = {.kind = emulator::serve::Speed::Kind::manual};
    made.watch_signals = false;
    return made;
  }
  emulator::serve::Daemon daemon;
  emulator::world::WorldState as_made;
};

/// A daemon without a socket. What would take time takes 20 ms of simulated time, or less to a breakpoint.
class Beside final : public emulator::dap::BenchLink {
 public:
  explicit Beside(emulator::serve::Daemon& daemon) : daemon_(daemon) {}

  Json ask(const Json& message) const override {
    if (message["do"] == "speed" || message["do"] == "resume") throw emulator::dap::RequestError("refused");
    std::string reply;
    handle_message(daemon_, message.dump(), [&](const std::string& line) { reply = line; });
    require(!reply.empty(), "what does not go on is answered at once");
    return emulator::dap::judged_reply(reply);
  }
  void begin(const Json&) override { is_awaiting_ = true; }
  bool is_awaiting() const override { return is_awaiting_; }
  int awaited() const override { return -1; }
  std::optional<Json> take_reply() override {
    pause();
    daemon_.advance_at_once(daemon_.world().now() + kGoneOn);
    return Json::parse(time_and_stop(daemon_).dump());
  }
  void pause() override { is_awaiting_ = false; }

 private:
  emulator::serve::Daemon& daemon_;
  bool is_awaiting_ = false;
};

void cut_into_frames(std::string_view bytes, std::size_t piece, std::vector<std::string>& messages,
                     std::string& error) {
  emulator::dap::Unframer unframer;
  try {
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      unframer.push(bytes.substr(at, piece));
      while (auto message = unframer.take()) messages.push_back(std::move(*message));
    }
  } catch (const emulator::dap::FramingError& why) {
    error = why.what();
  }
}

void look_at_frames(std::string_view bytes) {
  std::vector<std::string> whole;
  std::vector<std::string> cut;
  std::string why_whole;
  std::string why_cut;
  cut_into_frames(bytes, bytes.size() + 1, whole, why_whole);
  cut_into_frames(bytes, 3, cut, why_cut);
  require(whole == cut && why_whole == why_cut, "frames do not depend on how the bytes are cut");
  require(why_whole.find('\n') == std::string::npos, "an error is one line");
}

bool touches_the_machine(const std::string& line) {
  return line.find("path") != std::string::npos || line.find("sources") != std::string::npos ||
         line.find("\\u") != std::string::npos;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Rig rig;
  if (size > kLongest) return 0;
  look_at_frames(fuzzing::text_of(data, size));
  std::int64_t last = 0;
  int replies = 0;
  bool is_launched = false;
  emulator::dap::Session session(
      [&](std::string_view request, const Json&) {
        emulator::dap::Launched launched{.link = std::make_unique<Beside>(rig.daemon)};
        is_launched = request == "launch";
        if (is_launched) launched.end = [] {};
        return launched;
      },
      [&](const Json& message) {
        require(message["seq"] == ++last, "messages are numbered");
        require(message["type"] == "event" || message["type"] == "response", "and of a kind");
        replies += message["type"] == "response" ? 1 : 0;
        if (!message.value("success", true))
          require(message.value("message", std::string("\n")).find('\n') == std::string::npos,
                  "a refusal is one line");
        require(!message.dump(-1, ' ', false, Json::error_handler_t::replace).empty(), "and can be sent");
      });
  std::istringstream text{std::string(fuzzing::text_of(data, size))};
  for (std::string line; !session.is_over() && std::getline(text, line);) {
    if (touches_the_machine(line)) continue;
    replies = 0;
    session.handle(line);
    require(replies <= 1, "a request gets one reply");
    if (session.has_bench()) session.poll();
  }
  session.handle(R"({"seq":1,"type":"request","command":"disconnect"})");
  require(session.is_over(), "and a session can always be ended");
  require(is_launched || rig.daemon.observers().debugger.breakpoints().empty(), "no breakpoint of it stays");
  rig.daemon.observers().debugger.remove_all();
  rig.daemon.observers().snapshots.clear();
  if (rig.daemon.world().now() != SimTime{0} || last > 1) rig.daemon.restore(rig.as_made);
  return 0;
}
