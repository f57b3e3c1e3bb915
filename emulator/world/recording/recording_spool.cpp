#include "emulator/world/recording/recording_spool.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "base/files/growing_file.h"
#include "base/files/output_file.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/names/names.h"
#include "emulator/world/recording/recorder.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/snapshot_file.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

RecordingSpool::RecordingSpool(World& world, RecordingHeader header, std::unique_ptr<GrowingFile> file,
                               std::size_t cap_bytes, std::function<void(const std::string&)> log)
    : world_(world),
      header_(std::move(header)),
      cap_bytes_(cap_bytes),
      log_(std::move(log)),
      file_(std::move(file)) {
  begin();
}

RecordingSpool::~RecordingSpool() = default;

void RecordingSpool::begin() {
  bytes_ = 0;
  recorder_ = std::make_unique<Recorder>(world_, header_, [this](std::string_view line) {
    bytes_ += line.size();
    file_->take(line);
  });
}

/// Its name is free then for the next one. Throws GrowingFileError.
void RecordingSpool::put_aside() {
  const std::string path = file_->target();
  const std::string kept = path + kOlderPart;
  const auto fail = [&](const std::string& why) {
    return GrowingFileError("it cannot be put aside as " + kept + " (" + why + ")");
  };
  try {
    if (std::rename(path.c_str(), output_target(kept).c_str()) != 0) throw fail(std::strerror(errno));
  } catch (const OutputError& error) {
    throw fail(error.what());
  }
  before_ = std::move(file_);
  file_ = std::make_unique<GrowingFile>(path, "the recording", log_);
}

void RecordingSpool::finish(std::string failed) {
  if (recorder_) recorder_->finish(std::move(failed));
}

void RecordingSpool::look() {
  if (!recorder_ || bytes_ < cap_bytes_) return;
  recorder_->finish();
  recorder_.reset();
  try {
    put_aside();
    header_.snapshot =
        to_text(save(world_), bench_hash(parse_recorded_bench(models_of(world_.known()), header_.bench)));
    begin();
  } catch (const GrowingFileError& error) {
    log_(std::string("the recording ends here: ") + error.what());
  }
}

}  // namespace understudy::emulator::world
