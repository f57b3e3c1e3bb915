#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <ios>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/files/text_file.h"
#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/command_line/box_bench.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/log.h"
#include "emulator/command_line/replay_looks.h"
#include "emulator/command_line/replay_story.h"
#include "emulator/command_line/result_file.h"
#include "emulator/command_line/serving.h"
#include "emulator/device/model.h"
#include "emulator/play/report/page.h"
#include "emulator/play/results/result.h"
#include "emulator/serve/control/control_door.h"
#include "emulator/serve/control/timeline_door.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/daemon/door.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/recording/replay.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/world.h"

namespace understudy::emulator::command_line {

namespace {

/// Serves the recorded world with a stopped clock until a signal arrives. `at` is the initial time of the
/// daemon.
int serve_from(const world::Replayed& replayed, const world::WorldState& state, SimTime at,
               const std::string& recording, const serve::DoorMaker& door, std::optional<int> page) {
  signal(SIGPIPE, SIG_IGN);  // the reader of the log may end first
  world::Bench bench = replayed.bench;
  for (world::LineSetup& line : bench.lines)
    line.link.clear();  // another bench on this machine may use the link
  serve::DaemonOptions options;
  options.speed.kind = serve::Speed::Kind::manual;
  options.strict_framing = replayed.header.options.strict_framing;
  options.patience = replayed.header.options.patience;
  options.enforce_settings = replayed.header.options.enforce_settings;
  options.door = door;
  options.bench_path = std::filesystem::weakly_canonical(recording).string();
  options.files.add({recording, "the recording itself"});
  serve::Daemon daemon(bench, options, log_line);
  daemon.restore(state);
  print_ready(daemon);
  std::printf("the clock is at %s: understudy ctl --control %s status\n", format_duration(at).c_str(),
              daemon.control_path().c_str());
  std::fflush(stdout);
  if (page) start_page_beside(daemon.control_path(), *page);
  daemon.run();
  return kExitWell;
}

/// Stores the events of a replay, so that users can move through it in both directions.
class EventCollector final : public world::ReplayWatcher {
 public:
  EventCollector(const world::World& world, std::optional<world::WorldState>& begin,
                 std::optional<SimTime>& begins, std::vector<world::RecordedEvent>& events)
      : events_(events) {
    begin = world::save(world);
    begins = world.now();
  }
  void happened(const world::RecordedEvent& event, std::size_t) override {
    const bool is_kept = event.what != world::RecordedEvent::What::end || !event.failed.what.empty();
    if (is_kept) events_.push_back(event);
  }

 private:
  std::vector<world::RecordedEvent>& events_;
};

/// A recording that has been replayed completely, so its timeline can show any moment.
struct Travelled {
  world::Replayed replayed;
  serve::TimelineSetup setup;
};

/// Replays the whole recording. The timeline first shows `at`, or else the failure or the beginning. If the
/// replay differs from the recording, it is shown up to the difference.
Travelled replay_whole(ModelList models, const ReplayArguments& arguments, std::optional<SimTime> at) {
  std::ifstream file(arguments.recording, std::ios::binary);
  std::optional<world::WorldState> begin;
  std::optional<SimTime> begins;
  std::vector<world::RecordedEvent> events;
  world::Replayed replayed = world::replay(models, file, arguments.recording, {}, [&](world::World& world) {
    return std::make_unique<EventCollector>(world, begin, begins, events);
  });
  if (!replayed.result.difference.empty())
    log_line(arguments.recording + ": differs: " + replayed.result.difference);
  const SimTime end = replayed.result.reached;
  SimTime begins_at = *begins;
  for (const world::RecordedEvent& event : events)
    if (!event.failed.what.empty()) begins_at = event.failed.at;
  serve::TimelineSetup setup{.bench = replayed.bench,
                             .options = replayed.header.options,
                             .begin = *begin,
                             .events = std::move(events),
                             .end = end,
                             .at_first = std::clamp(at.value_or(begins_at), *begins, end)};
  return {std::move(replayed), std::move(setup)};
}

/// Like replay_whole(), but throws UsageError if `at` is not in the recording.
Travelled replay_to(ModelList models, const ReplayArguments& arguments, std::optional<SimTime> at) {
  Travelled travelled = replay_whole(models, arguments, at);
  if (at && *at != travelled.setup.at_first)
    throw UsageError("--at: " + arguments.at + " is not in the recording; the nearest time in it is " +
                     format_duration(travelled.setup.at_first));
  return travelled;
}

std::optional<SimTime> duration_of_flag(const char* flag, const std::string& text) {
  if (text.empty()) return std::nullopt;
  const auto duration = parse_duration(text);
  if (!duration)
    throw UsageError(std::string(flag) + ": " + understudy::quoted(text) +
                     " is not a duration; expected one such as 2.5s");
  return duration;
}

}  // namespace

int replay_recording(ModelList models, const ReplayArguments& arguments) {
  const auto until = duration_of_flag("--until", arguments.until);
  const auto at = duration_of_flag("--at", arguments.at);
  require_story_flags(arguments);
  if (const std::string why = why_not_readable(arguments.recording); !why.empty()) {
    throw world::RecordingError(arguments.recording + ": recording: " + why + "; expected a recording");
  }
  if (const std::string why =
          why_no_capture_is_expected(head_of_file(arguments.recording), ContentKind::recording);
      !why.empty()) {
    throw world::RecordingError(arguments.recording + ":1: recording: " + why);
  }
  if (arguments.page) require_page_port("replay: --page", *arguments.page);
  if (wants_story(arguments)) {
    print_story(arguments, replay_to(models, arguments, at).setup);
    return kExitWell;
  }
  if (arguments.page || arguments.serve) {
    const Travelled travelled = replay_whole(models, arguments, until);
    return serve_from(travelled.replayed, travelled.setup.begin, travelled.setup.at_first,
                      arguments.recording, serve::timeline_door(arguments.control, travelled.setup),
                      arguments.page);
  }
  FileClaims claims;
  claims.add({arguments.recording, "the recording itself"});
  require_looks(arguments, claims);
  std::ifstream file(arguments.recording, std::ios::binary);
  ResultFile report("--report", arguments.report, ContentKind::page);
  play::ScenarioResult seen;
  std::optional<world::WorldState> state;
  const auto begin = std::chrono::steady_clock::now();
  const auto watch = [&](world::World& world) {
    return std::make_unique<ReplayLooks>(world, arguments, seen);
  };
  const world::Replayed replayed =
      world::replay(models, file, arguments.recording, until, watch, [&](const world::World& world) {
        if (until) state = world::save(world);
      });
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (report.is_wanted()) {
    const play::ScenarioResult shown = result_of(replayed, arguments.recording, std::move(seen));
    report.replace(play::report_page({&shown, 1}, arguments.version));
  }
  if (replayed.header.version != arguments.version) {
    log_line("the recording is from version " + replayed.header.version + ", this is " + arguments.version);
  }
  const world::ReplayResult& result = replayed.result;
  if (result.verdict == world::ReplayResult::Verdict::different) {
    std::fprintf(stderr, "understudy: %s: differs: %s\n", arguments.recording.c_str(),
                 result.difference.c_str());
    return kExitFailed;
  }
  std::printf("%s: the same: %llu events, %llu bytes sent, %s simulated in %.3f s%s\n",
              arguments.recording.c_str(), static_cast<unsigned long long>(result.events),
              static_cast<unsigned long long>(result.bytes_sent), format_duration(result.reached).c_str(),
              seconds, result.has_end || until ? "" : "; it ends early");
  if (result.verdict != world::ReplayResult::Verdict::stopped) return kExitWell;
  return serve_from(replayed, *state, result.reached, arguments.recording,
                    serve::control_door(arguments.control), {});
}

}  // namespace understudy::emulator::command_line
