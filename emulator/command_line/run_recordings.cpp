#include "emulator/command_line/run_recordings.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <filesystem>
#include <system_error>
#include <utility>

#include "emulator/bench/bench_text.h"
#include "emulator/recording/recording_spool.h"
#include "emulator/scenario/play_recorder.h"

namespace understudy::emulator {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestName = 100;  // bytes
constexpr const char* kEnding = ".jsonl";

/// What any file system takes, and no shell needs quotes for.
std::string file_name_of(const std::string& name) {
  std::string text;
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    const bool is_plain = std::isalnum(letter) != 0 || c == '-' || (c == '.' && !text.empty());
    if (is_plain) {
      text += c;
    } else if (!text.empty() && text.back() != '_') {
      text += '_';
    }
  }
  text.resize(std::min(text.size(), kLongestName));
  while (!text.empty() && text.back() == '_') text.pop_back();
  return text.empty() ? "scenario" : text;
}

constexpr const char* kSpool = "spool";

/// A lock that lasts as long as the process; nothing if somebody else has it.
pty::Descriptor locked(const std::string& folder) {
  pty::Descriptor lock(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  return lock && ::flock(lock.get(), LOCK_EX | LOCK_NB) == 0 ? std::move(lock) : pty::Descriptor();
}

/// What a `run` that was killed has left behind. The recordings that it kept stay.
void remove_abandoned_spools() {
  const fs::path folders(kPrivateFolders);
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folders.parent_path(), error)) {
    const std::string path = entry.path().string();
    struct stat status = {};
    const bool is_own = path.starts_with(kPrivateFolders) && ::lstat(path.c_str(), &status) == 0 &&
                        S_ISDIR(status.st_mode) && status.st_uid == ::geteuid();
    if (!is_own || !locked(path + "/" + kSpool)) continue;
    fs::remove_all(path + "/" + kSpool, error);
    fs::remove(path, error);  // if nothing else is in it
  }
}

[[noreturn]] void refuse(const std::string& path, const std::error_code& error) {
  throw std::system_error(error, "--record: " + path + " cannot be written");
}

/// Also from one file system to another.
void move_file(const std::string& from, const std::string& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (!error) return;
  fs::remove(to, error);  // a link there is replaced, as it is by a rename, and not written through
  fs::copy_file(from, to, error);
  if (error) refuse(to, error);
  fs::remove(from, error);
}

// A recording that had grown too large has its older part in a file of its own.
constexpr std::array<const char*, 2> kParts = {"", kOlderPart};

}  // namespace

RunRecordings::RunRecordings(std::string folder, bool real_time, std::string version)
    : folder_(std::move(folder)), real_time_(real_time), version_(std::move(version)) {
  std::error_code error;
  if (!folder_.empty()) fs::create_directories(folder_, error);
  if (error) refuse(folder_, error);
  remove_abandoned_spools();
  remove_left_overs();
  // It gets its name when it is locked: before, others would take it for abandoned.
  const std::string unlocked = private_folder_.path() + "/unlocked";
  spool_ = private_folder_.path() + "/" + kSpool;
  fs::create_directory(unlocked, error);
  if (error) refuse(spool_, error);
  lock_ = locked(unlocked);
  fs::rename(unlocked, spool_, error);
  if (error) refuse(spool_, error);
}

RunRecordings::~RunRecordings() {
  std::error_code ignored;
  fs::remove_all(spool_, ignored);
}

std::unique_ptr<Onlooker> RunRecordings::record(World& world, const Scenario& scenario) {
  RecordingHeader header{.version = version_,
                         .bench = to_text(scenario.bench),
                         .options = {},
                         .seed = scenario.bench.seed,
                         .snapshot = {}};
  header.options.strict_framing = !real_time_;
  return std::make_unique<PlayRecorder>(world, std::move(header),
                                        spool_ + "/" + std::to_string(++count_) + ".jsonl");
}

std::string RunRecordings::free_name(const std::string& name) {
  const std::string plain = file_name_of(name);
  std::string free = plain;
  for (int i = 2; !names_.insert(free).second; ++i) free = plain + "-" + std::to_string(i);
  return free + kEnding;
}

std::vector<std::string> RunRecordings::file_endings() {
  std::vector<std::string> endings;
  for (const char* const part : kParts) endings.push_back(std::string(kEnding) + part);
  return endings;
}

void RunRecordings::settle(ScenarioResult& result) {
  if (result.recording.empty()) return;
  const std::string spooled = std::exchange(result.recording, {});
  const bool is_kept = !folder_.empty() || result.failure;
  if (is_kept) {
    result.recording =
        (fs::path(folder_.empty() ? private_folder_.path() : folder_) / free_name(result.name)).string();
  }
  for (const char* const part : kParts) {
    std::error_code error;
    if (!fs::exists(spooled + part, error)) continue;
    if (is_kept) {
      move_file(spooled + part, result.recording + part);
    } else {
      fs::remove(spooled + part, error);
    }
  }
}

}  // namespace understudy::emulator
