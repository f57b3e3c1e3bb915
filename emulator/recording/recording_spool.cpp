#include "emulator/recording/recording_spool.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "emulator/bench/bench_file.h"
#include "emulator/world/snapshot_file.h"

namespace understudy::emulator {

RecordingSpool::RecordingSpool(World& world, RecordingHeader header, std::string path, std::size_t cap_bytes,
                               std::function<void(const std::string&)> log)
    : world_(world),
      header_(std::move(header)),
      path_(std::move(path)),
      cap_bytes_(cap_bytes),
      log_(std::move(log)) {
  begin();
}

RecordingSpool::~RecordingSpool() = default;

void RecordingSpool::begin() {
  file_ = std::make_unique<GrowingFile>(path_, "the recording", log_);
  bytes_ = 0;
  recorder_ = std::make_unique<Recorder>(world_, header_, [this](std::string_view line) {
    bytes_ += line.size();
    file_->take(line);
  });
}

void RecordingSpool::look() {
  if (!recorder_ || bytes_ < cap_bytes_) return;
  recorder_.reset();  // it says that it ends here
  const std::string kept = path_ + kOlderPart;
  if (std::rename(path_.c_str(), kept.c_str()) != 0) {
    log_(path_ + ": the recording ends here: it cannot be put aside as " + kept + " (" +
         std::strerror(errno) + ")");
    return;
  }
  before_ = std::move(file_);
  header_.snapshot = to_text(save(world_), bench_hash(parse_bench(header_.bench, "bench", "")));
  try {
    begin();
  } catch (const GrowingFileError& error) {
    log_(std::string("the recording ends here: ") + error.what());
  }
}

}  // namespace understudy::emulator
