#include <chrono>
#include <cstdio>
#include <fstream>

#include "emulator/command_line/commands.h"
#include "emulator/command_line/log.h"
#include "emulator/recording/replay.h"

namespace understudy::emulator {

int replay_recording(const ReplayArguments& arguments) {
  std::optional<SimTime> until;
  if (!arguments.until.empty()) {
    until = parse_duration(arguments.until);
    if (!until)
      throw UsageError("--until: '" + arguments.until + "' is no duration; expected one such as 2.5s");
  }
  std::ifstream file(arguments.recording, std::ios::binary);
  const auto begin = std::chrono::steady_clock::now();
  const Replayed replayed = replay(file, arguments.recording, until);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (replayed.header.version != arguments.version) {
    log_line("the recording is from version " + replayed.header.version + ", this is " + arguments.version);
  }
  const ReplayResult& result = replayed.result;
  if (result.verdict == ReplayResult::Verdict::different) {
    std::fprintf(stderr, "understudy: %s: differs: %s\n", arguments.recording.c_str(),
                 result.difference.c_str());
    return kExitFailed;
  }
  std::printf("%s: the same: %llu events, %llu bytes said, %s simulated in %.3f s%s\n",
              arguments.recording.c_str(), static_cast<unsigned long long>(result.events),
              static_cast<unsigned long long>(result.bytes_said), format_duration(result.reached).c_str(),
              seconds, result.has_end || until ? "" : "; it breaks off before its end");
  return kExitWell;
}

}  // namespace understudy::emulator
