#include "emulator/serve/control/timeline_door.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/serve/control/course_messages.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/messages.h"
#include "emulator/serve/control/recording_stops.h"
#include "emulator/serve/control/server.h"
#include "emulator/serve/control/sockets.h"
#include "emulator/serve/control/verbs.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/daemon/door.h"
#include "emulator/serve/loop/pacer.h"
#include "emulator/world/debug/debugger.h"
#include "emulator/world/events/event_log.h"
#include "emulator/world/events/history.h"
#include "emulator/world/events/story.h"
#include "emulator/world/frames/frame_log.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/recording/timeline.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/world.h"

namespace understudy::emulator::serve {

namespace {

constexpr std::size_t kMaxMarks = 2'000;
constexpr std::size_t kMarksAtOnce = 500;
constexpr std::size_t kMaxBefore = 200;  // the most frames, and the most events, kept from before a moment

/// Returns true for events that appear on the timeline.
bool is_mark(std::string_view what) {
  return what == "fault" || what == "inject" || what == "clear" || what == "exception" || what == "ignored" ||
         what == "dropped" || what == "power" || what == "program";
}

/// The commands that do not change the bench. A recording refuses all others, because it shows what happened.
constexpr std::array<std::string_view, 19> kLooks{"status", "identify", "bench",     "registers", "choices",
                                                  "faults", "get",      "eval",      "list",      "frames",
                                                  "events", "where",    "look",      "scope",     "snapshots",
                                                  "stack",  "source",   "variables", "break"};

bool only_looks(const Json& message, const std::string& word) {
  if (word == "program") return !message.contains("text");  // without a text, it reads the program
  if (message.contains("drop")) return false;
  return std::find(kLooks.begin(), kLooks.end(), word) != kLooks.end();
}

/// Moves a daemon through a recording. The recording is replayed on first use, because the door is created
/// together with the daemon.
class Travel {
 public:
  Travel(Daemon& daemon, const TimelineSetup& setup)
      : daemon_(daemon),
        setup_(setup),
        timeline_(daemon.world(), setup.begin, setup.events, setup.end, [this] { collect(); }) {
    ignore_hosts(true);
    std::sort(moments_.begin(), moments_.end());
    for (const world::RecordedEvent& event : timeline_.events()) {
      const world::RecordedFailure& failed = event.failed;
      if (failed.what.empty()) continue;
      marks_.push_back(Json{{"time_ns", failed.at.count()}, {"what", "failed"}, {"text", failed.what}});
      scenario_ = failed.scenario;
      story_ = world::story_of(daemon.world(), failed, history_.events());
    }
    go_to(std::clamp(setup.at_first, timeline_.begin(), timeline_.end()));
  }

  RecordingStops& stops() { return stops_; }

  Json timeline(const Json& message) {
    require_keys(message, {"do", "from"});
    const std::size_t from = message.contains("from") ? require_count(message, "from") : 0;
    Json marks = Json::array();
    for (std::size_t i = from; i < std::min(marks_.size(), from + kMarksAtOnce); ++i)
      marks.push_back(marks_[i]);
    Json entry{{"begin_ns", timeline_.begin().count()},
               {"end_ns", timeline_.end().count()},
               {"at_ns", daemon_.world().now().count()},
               {"marks", std::move(marks)}};
    Json reply{{"ok", true}, {"timeline", std::move(entry)}};
    if (!scenario_.empty()) reply["timeline"]["scenario"] = scenario_;
    if (story_ && from == 0) reply["timeline"]["story"] = json_of(*story_);
    if (altered_at()) reply["timeline"]["altered_at_ns"] = altered_at()->count();
    if (marks_left_out_ > 0) reply["timeline"]["marks_left_out"] = marks_left_out_;
    if (from + kMarksAtOnce < marks_.size()) reply["next"] = from + kMarksAtOnce;
    return reply;
  }

  /// Handles {"do":"seek","to_ns":N} and {"do":"seek","by":"tick"|"frame"|"event","steps":-1}.
  Json seek(const Json& message) {
    require_keys(message, {"do", "to_ns", "by", "steps"});
    if (altered_at())
      throw MessageError(
          "the recording is altered (what-if); expected `seek` after the return to the recording");
    if (daemon_.is_advancing()) throw MessageError("time is being advanced; expected `seek` after that");
    if (message.contains("to_ns")) {
      go_to(SimTime{static_cast<std::int64_t>(require_count(message, "to_ns", INT64_MAX))});
    } else {
      go_to(stepped(require_text(message, "by"), require_steps(message)));
    }
    return Json{{"ok", true}, {"simulated_time_ns", daemon_.world().now().count()}};
  }

  Json curves(const Json& message) { return curves_message(message, timeline_, other_world()); }
  Json spans(const Json& message) {
    return spans_message(message, timeline_, other_world(), history_, story_ ? &*story_ : nullptr);
  }

  /// Handles {"do":"what-if"}, which allows all commands, and {"do":"what-if","off":true}, which returns to
  /// the moment at which the first one was received.
  Json what_if(const Json& message) {
    require_keys(message, {"do", "off"});
    const bool is_off = message.contains("off") && message["off"] == true;
    if (daemon_.is_advancing()) throw MessageError("time is being advanced; expected `what-if` after that");
    if (!is_off && !altered_at()) {
      altered_at() = daemon_.world().now();
      ignore_hosts(false);
    }
    if (is_off && altered_at()) {
      ignore_hosts(true);
      const SimTime at = *std::exchange(altered_at(), std::nullopt);
      daemon_.set_speed({.kind = Speed::Kind::manual});
      go_to(at);
    }
    return Json{{"ok", true},
                {"simulated_time_ns", daemon_.world().now().count()},
                {"altered", altered_at().has_value()}};
  }
  bool is_altered() const { return daemon_.observers().altered_at.has_value(); }

 private:
  /// The last frames and events between two keyframes.
  struct Stretch {
    std::vector<world::FrameLog::Frame> frames;
    std::vector<world::Event> events;
  };

  static std::int64_t require_steps(const Json& message) {
    if (!message.contains("steps")) return 1;
    const Json& steps = message["steps"];
    constexpr std::int64_t kMax = 1'000'000;
    if (!steps.is_number_integer() || steps.get<std::int64_t>() > kMax || steps.get<std::int64_t>() < -kMax) {
      throw is_not("steps", steps, "a whole number");
    }
    return steps.get<std::int64_t>();
  }

  SimTime stepped(const std::string& by, std::int64_t steps) const {
    const SimTime now = daemon_.world().now();
    if (by == "tick") {
      // Within a tick, one step back leads to its beginning.
      const bool is_within = steps < 0 && time_of(tick_at(now)) < now;
      return std::max(SimTime{0}, time_of(tick_at(now) + steps + (is_within ? 1 : 0)));
    }
    std::vector<SimTime> moments;
    if (by == "frame") {
      moments = moments_;
    } else if (by == "event") {
      moments = event_moments_;
    } else {
      throw MessageError("by: expected tick, frame or event");
    }
    if (moments.empty() || steps == 0) return now;
    const auto behind = std::upper_bound(moments.begin(), moments.end(), now) - moments.begin();
    const auto before = std::lower_bound(moments.begin(), moments.end(), now) - moments.begin();
    const std::int64_t place = steps > 0 ? behind + steps - 1 : before + steps;
    if (place < 0) return timeline_.begin();
    if (place >= static_cast<std::int64_t>(moments.size())) return timeline_.end();
    return moments[static_cast<std::size_t>(place)];
  }

  /// Collects, at each keyframe of the first pass, the times of the frames and events, the events for the
  /// bar, and the last frames and events.
  void collect() {
    history_.collect(daemon_.world(), daemon_.frames(), daemon_.observers().events);
    Stretch stretch{.frames = daemon_.frames().kept_since(next_frame_, kMaxBefore), .events = {}};
    for (const auto& entry : daemon_.frames().since(next_frame_, SIZE_MAX)) {
      moments_.push_back(entry.time);
      next_frame_ = entry.number + 1;
    }
    for (const auto& event : daemon_.observers().events.since(next_event_, SIZE_MAX)) {
      next_event_ = event.number + 1;
      // The first restore is not part of the recording.
      if (event.what != "restored") {
        stretch.events.push_back(event);
        if (event_moments_.empty() || event_moments_.back() < event.time)
          event_moments_.push_back(event.time);
      }
      if (!is_mark(event.what)) continue;
      if (marks_.size() == kMaxMarks) {
        ++marks_left_out_;
        continue;
      }
      Json mark{{"time_ns", event.time.count()}, {"what", event.what}};
      if (!event.device.empty()) mark["device"] = event.device;
      if (!event.line.empty()) mark["line"] = event.line;
      if (!event.text.empty()) mark["text"] = event.text;
      marks_.push_back(std::move(mark));
    }
    if (stretch.events.size() > kMaxBefore)
      stretch.events.erase(stretch.events.begin(), stretch.events.end() - kMaxBefore);
    stretches_.push_back(std::move(stretch));
  }

  /// Returns the last entries before a keyframe, oldest first.
  template <class One>
  std::vector<One> last_before(std::size_t keyframe, std::vector<One> Stretch::*which) const {
    std::vector<One> all;
    for (std::size_t i = keyframe; i-- > 0 && all.size() < kMaxBefore;)
      all.insert(all.end(), (stretches_[i].*which).rbegin(), (stretches_[i].*which).rend());
    all.resize(std::min(all.size(), kMaxBefore));
    std::reverse(all.begin(), all.end());
    return all;
  }

  /// Separates hosts from the recorded lines. Otherwise, the lines would not show what happened.
  void ignore_hosts(bool ignored) {
    for (const auto& port : daemon_.ports()) port->ignore_hosts(ignored);
  }
  std::optional<SimTime>& altered_at() { return daemon_.observers().altered_at; }

  /// Returns a second world of the same bench. It replays stretches without moving the daemon's world.
  world::World& other_world() {
    if (!other_) other_ = std::make_unique<world::World>(setup_.bench, setup_.options, nullptr);
    return *other_;
  }

  /// Moves to a time, without stopping at breakpoints.
  void go_to(SimTime time) {
    world::Debugger& debugger = daemon_.observers().debugger;
    debugger.sleep();
    timeline_.go_to(time, [this](const world::WorldState& state, std::size_t keyframe) {
      daemon_.restore(state);
      daemon_.restart_logs(last_before(keyframe, &Stretch::frames), last_before(keyframe, &Stretch::events));
    });
    debugger.wake();
  }

  Daemon& daemon_;
  const TimelineSetup& setup_;
  std::unique_ptr<world::World> other_;
  world::History history_;
  std::optional<world::Story> story_;
  std::string scenario_;
  std::vector<Stretch> stretches_;  // one before each keyframe except the first, and one before the end
  std::uint64_t next_frame_ = 1;
  std::uint64_t next_event_ = 1;
  std::vector<SimTime> moments_;        // of frames
  std::vector<SimTime> event_moments_;  // each time once
  std::vector<Json> marks_;
  std::uint64_t marks_left_out_ = 0;
  world::Timeline timeline_;  // declared after the members that collect() uses, which its constructor calls
  RecordingStops stops_{daemon_, timeline_, [this](SimTime time) { go_to(time); }};
};

}  // namespace

ControlServer::Handler timeline_handler(Daemon& daemon, TimelineSetup given) {
  const auto setup = std::make_shared<const TimelineSetup>(std::move(given));
  const auto travel = std::make_shared<std::unique_ptr<Travel>>();
  const auto travelled = [=, &daemon] {
    if (!*travel) *travel = std::make_unique<Travel>(daemon, *setup);
  };
  daemon.post(travelled);  // runs before any client is served
  return [=, &daemon](const std::string& line, const ControlServer::Reply& reply) {
    travelled();
    Json message;
    try {
      if (line.size() <= kMaxAtOnce) message = Json::parse(line);
      message.erase("as");
    } catch (const Json::exception&) {
    }
    const std::string word = message.is_object() && message.contains("do") && message["do"].is_string()
                                 ? message["do"].get<std::string>()
                                 : std::string();
    if (word == "timeline") return answer(reply, [&] { return (*travel)->timeline(message); });
    if (word == "seek") return answer(reply, [&] { return (*travel)->seek(message); });
    if (word == "curves") return answer(reply, [&] { return (*travel)->curves(message); });
    if (word == "spans") return answer(reply, [&] { return (*travel)->spans(message); });
    if (word == "what-if") return answer(reply, [&] { return (*travel)->what_if(message); });
    const bool is_recorded = !(*travel)->is_altered();
    if (word == "continue" && is_recorded)
      return answer(reply, [&] { return (*travel)->stops().resume(message); });
    if (word == "step" && is_recorded) return answer(reply, [&] { return (*travel)->stops().step(message); });
    if (is_verb(word) && is_recorded && !only_looks(message, word)) {
      return answer(reply, [&]() -> Json {
        throw MessageError(word +
                           ": a recording cannot be changed; expected `seek`, a command that only reads, "
                           "or `what-if` first");
      });
    }
    handle_message(daemon, line, reply);
  };
}

DoorMaker timeline_door(const std::string& path, const TimelineSetup& setup) {
  return [=](Daemon& daemon, const std::function<void(const std::string&)>&) -> std::unique_ptr<Door> {
    return std::make_unique<ControlServer>(daemon.loop(), path.empty() ? own_control_path() : path,
                                           timeline_handler(daemon, setup));
  };
}

}  // namespace understudy::emulator::serve
