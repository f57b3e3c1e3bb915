#include "emulator/command_line/replay_story.h"

#include <algorithm>
#include <filesystem>
#include <future>
#include <string>
#include <string_view>
#include <utility>

#include "base/files/content_kind.h"
#include "base/files/file_claims.h"
#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/log.h"
#include "emulator/command_line/output_paths.h"
#include "emulator/command_line/result_file.h"
#include "emulator/page/drawing.h"
#include "emulator/page/story_file.h"
#include "emulator/page/story_picture.h"
#include "emulator/serve/control/timeline_door.h"
#include "emulator/serve/daemon/daemon_thread.h"
#include "emulator/serve/loop/pacer.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::command_line {

namespace {

/// A daemon for the recording's bench, without ports and without a control socket.
class RecordingDaemon {
 public:
  explicit RecordingDaemon(serve::TimelineSetup setup)
      : thread_(without_ports(setup.bench), options_of(setup.options), log_line) {
    thread_.daemon().restore(setup.begin);
    handler_ = serve::timeline_handler(thread_.daemon(), std::move(setup));
    thread_.start();
  }
  ~RecordingDaemon() { thread_.stop(); }
  RecordingDaemon(const RecordingDaemon&) = delete;
  RecordingDaemon& operator=(const RecordingDaemon&) = delete;

  std::string ask(const std::string& message) {
    std::promise<std::string> reply;
    thread_.daemon().post(
        [&] { handler_(message, [&](const std::string& line) { reply.set_value(line); }); });
    return reply.get_future().get();
  }

 private:
  static world::Bench without_ports(world::Bench bench) {
    for (world::LineSetup& line : bench.lines) {
      line.link.clear();
      line.has_pty = false;
      line.tcp.clear();
    }
    return bench;
  }
  static serve::DaemonOptions options_of(const world::WorldOptions& recorded) {
    serve::DaemonOptions options;
    options.speed.kind = serve::Speed::Kind::manual;
    options.strict_framing = recorded.strict_framing;
    options.patience = recorded.patience;
    options.enforce_settings = recorded.enforce_settings;
    options.watch_signals = false;
    return options;
  }

  serve::ControlServer::Handler handler_;
  serve::DaemonThread thread_;
};

bool is_svg(const std::string& path) { return path.ends_with(".svg"); }

}  // namespace

bool wants_story(const ReplayArguments& arguments) {
  return !arguments.story.empty() || !arguments.picture.empty();
}

void require_story_flags(const ReplayArguments& arguments) {
  if (!arguments.at.empty() && !wants_story(arguments))
    throw UsageError("replay: --at: has no effect alone; expected --export or --picture");
  if (!arguments.panel.empty() && arguments.picture.empty())
    throw UsageError("replay: --panel: has no effect alone; expected --picture");
  if (is_svg(arguments.story) || arguments.story.ends_with(".png"))
    throw UsageError("replay: --export: " + arguments.story +
                     ": is the name of a picture; expected FILE.html, or --picture");
  if (!arguments.picture.empty() && !is_svg(arguments.picture) && !arguments.picture.ends_with(".png"))
    throw UsageError("replay: --picture: " + arguments.picture +
                     ": has an unknown format; expected FILE.svg or FILE.png");
  const auto& panels = page::kPicturePanels;
  if (!arguments.panel.empty() && std::find(panels.begin(), panels.end(), arguments.panel) == panels.end())
    throw UsageError("replay: --panel: " + understudy::quoted(arguments.panel) +
                     " is not a panel; expected timeline, axes, path or bus");
}

void print_story(const ReplayArguments& arguments, serve::TimelineSetup setup) {
  FileClaims claims;
  claims.add({arguments.recording, "the recording itself"});
  ResultFile story("--export", require_output(claims, "--export", arguments.story), ContentKind::page);
  ResultFile picture("--picture", require_output(claims, "--picture", arguments.picture),
                     ContentKind::picture);
  RecordingDaemon daemon(std::move(setup));
  const auto ask = [&](const std::string& message) { return daemon.ask(message); };
  const std::string name = std::filesystem::path(arguments.recording).filename().string();
  if (story.is_wanted()) story.replace(page::story_file(ask, name, arguments.version));
  if (!picture.is_wanted()) return;
  const std::string_view panel = arguments.panel.empty() ? page::kPicturePanels.front() : arguments.panel;
  try {
    const page::Drawing drawing = page::story_picture(ask, name, panel);
    picture.replace(is_svg(arguments.picture) ? page::svg_of(drawing, page::picture_words(ask, name, panel))
                                              : page::png_of(drawing));
  } catch (const page::RefusedError& error) {
    throw UsageError("replay: --picture: " + std::string(error.what()));
  }
}

}  // namespace understudy::emulator::command_line
