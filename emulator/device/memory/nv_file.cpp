#include "emulator/device/memory/nv_file.h"

#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/file_error.h"
#include "base/files/output_file.h"
#include "base/files/text_file.h"
#include "base/text/one_line.h"
#include "emulator/device/memory/nv_image.h"

namespace understudy::emulator {

FileError::Diagnostic diagnostic_of(const NvError& wrong, const std::string& path) {
  return {.place = {.file = path, .line = static_cast<int>(wrong.line)},
          .text = one_line(wrong.in_file(path))};
}

std::optional<NvImage> read_nv_file(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error) && !error) return std::nullopt;
  const auto text = read_text_file(path);
  if (!text)
    throw FileError({{.place = {path}, .text = path + ": file: " + text.why + "; expected an NV image"}});
  if (const std::string why = is_another_kind(*text, ContentKind::nv_image); !why.empty()) {
    throw FileError({{.place = {path}, .text = path + ": file: " + why}});
  }
  try {
    return parse_nv_image(*text);
  } catch (const NvError& wrong) {
    throw FileError({diagnostic_of(wrong, path)});
  }
}

NvWriter::NvWriter() : thread_([this] { run(); }) {}

NvWriter::~NvWriter() {
  {
    const std::lock_guard lock(mutex_);
    is_finishing_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void NvWriter::write(const std::string& path, std::string contents) { take(path, std::move(contents)); }

void NvWriter::write(const std::string& path, LateImage image) { take(path, std::move(image)); }

void NvWriter::take(const std::string& path, Contents contents) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.insert_or_assign(path, std::move(contents));
  }
  changed_.notify_all();
}

void NvWriter::flush() {
  std::unique_lock lock(mutex_);
  is_hurried_ = true;
  changed_.notify_all();
  changed_.wait(lock, [this] { return waiting_.empty() && !is_busy_; });
  is_hurried_ = false;
}

bool NvWriter::is_idle() const {
  const std::lock_guard lock(mutex_);
  return waiting_.empty() && !is_busy_ && news_.empty();
}

std::vector<std::string> NvWriter::take_news() {
  const std::lock_guard lock(mutex_);
  return std::exchange(news_, {});
}

void NvWriter::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return !waiting_.empty() || is_finishing_; });
    if (waiting_.empty()) return;
    changed_.wait_for(lock, kCoalesce, [this] { return is_finishing_ || is_hurried_; });
    const auto work = std::exchange(waiting_, {});
    is_busy_ = true;
    lock.unlock();
    for (const auto& [path, contents] : work) {
      const auto* const image = std::get_if<LateImage>(&contents);
      replace(path, image != nullptr ? to_json((*image)()) : std::get<std::string>(contents));
    }
    lock.lock();
    is_busy_ = false;
    changed_.notify_all();
  }
}

void NvWriter::replace(const std::string& path, const std::string& contents) {
  const std::string why = replace_text_file(path, contents, ContentKind::nv_image);
  bool& has_failed = has_failed_[path];
  if (!why.empty() == has_failed) return;
  has_failed = !why.empty();
  const std::lock_guard lock(mutex_);
  news_.push_back(path + (why.empty()
                              ? ": can be written again"
                              : ": cannot be written (" + why + "); the file keeps its previous contents"));
}

}  // namespace understudy::emulator
