#include "emulator/world/recording/recording_spool.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/files/content_kind.h"
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

std::string why_no_older_part(const std::string& path) {
  struct stat status = {};
  if (::lstat(path.c_str(), &status) != 0) return errno == ENOENT ? "" : std::strerror(errno);
  if (S_ISREG(status.st_mode)) return why_not_writable(path, ContentKind::recording);
  // Links are not followed, because the older part stays in the folder of the recording.
  return "it is " + kind_of_file(status.st_mode) + "; expected a recording to replace, or a free path";
}

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

/// Renames the file, so that its name is available for the next file. Throws GrowingFileError.
void RecordingSpool::put_aside() {
  const std::string path = file_->target();
  const std::string kept = path + kOlderPart;
  std::string why = why_no_older_part(kept);
  const std::optional<FileAccess> access = access_of(path);
  if (why.empty() && std::rename(path.c_str(), kept.c_str()) != 0) why = std::strerror(errno);
  if (!why.empty()) throw GrowingFileError("it cannot be renamed to " + kept + ": " + why);
  before_ = std::move(file_);
  if (access) make_like(path, *access);
  file_ = std::make_unique<GrowingFile>(path, ContentKind::recording, log_);
}

void RecordingSpool::finish(RecordedFailure failed) {
  if (recorder_) recorder_->finish(std::move(failed));
}

void RecordingSpool::note(RecordedEvent event) {
  if (recorder_) recorder_->note(std::move(event));
}

std::string RecordingSpool::close() {
  recorder_.reset();
  for (const auto* const file : {&before_, &file_}) {
    const std::string failure = *file ? (*file)->finish() : "";
    if (failure_.empty()) failure_ = failure;
  }
  return failure_;
}

void RecordingSpool::poll() {
  if (!recorder_ || bytes_ < cap_bytes_) return;
  recorder_->finish();
  recorder_.reset();
  try {
    put_aside();
    header_.snapshot =
        to_text(save(world_), bench_hash(parse_recorded_bench(models_of(world_.known()), header_.bench)));
    begin();
  } catch (const GrowingFileError& error) {
    failure_ = std::string("the recording ends here: ") + error.what();
    log_(failure_);
  }
}

}  // namespace understudy::emulator::world
