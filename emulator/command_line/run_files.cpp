#include "emulator/command_line/run_files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <ios>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/descriptor.h"
#include "base/files/file_claims.h"
#include "base/files/growing_file.h"
#include "base/files/output_file.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/log.h"
#include "emulator/play/performing/observer.h"
#include "emulator/play/performing/performance_recorder.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/case.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/serve/ports/private_folder.h"
#include "emulator/world/bench/bench_text.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/recording/recording_spool.h"
#include "emulator/world/trace/trace_file.h"
#include "emulator/world/trace/world_capture.h"
#include "emulator/world/world.h"

namespace understudy::emulator::command_line {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestName = 100;    // bytes
constexpr std::size_t kPieceOfCopy = 65536;  // bytes

/// Describes one kind of file that a run writes.
struct FileKind {
  const char* flag;
  ContentKind content;
  std::string RunFolders::*folder;
  std::string play::ScenarioResult::*place;
  const char* ending;
  std::array<const char*, 3> of_files;  // file name endings that a folder's name must not have
};
constexpr FileKind kRecording{
    "--record", ContentKind::recording, &RunFolders::recordings, &play::ScenarioResult::recording, ".jsonl",
    {".jsonl"}};
constexpr FileKind kTrace{"--trace", ContentKind::trace, &RunFolders::traces, &play::ScenarioResult::trace,
                          ".csv",    {".csv", ".vcd"}};
constexpr FileKind kCapture{
    "--capture", ContentKind::capture,        &RunFolders::captures, &play::ScenarioResult::capture,
    ".pcapng",   {".pcapng", ".pcap", ".txt"}};
constexpr std::array<FileKind, 3> kKinds{kRecording, kTrace, kCapture};
constexpr FileKind kFailure{
    "--failures", ContentKind::recording, &RunFolders::failures, &play::ScenarioResult::recording, ".jsonl",
    {".jsonl"}};
constexpr std::array<FileKind, 4> kFolders{kRecording, kTrace, kCapture, kFailure};

/// Writes a file about a run. The file contains one course of events: if the run returns to an earlier state,
/// or branches from one, the file is started again.
class PlayFile final : public play::Observer {
 public:
  /// Ends the file. Returns the reason if it ended early, otherwise an empty text.
  using Finish = std::function<std::string()>;
  using Begin = std::function<Finish(world::World&, const std::string& path)>;

  PlayFile(world::World& world, std::string path, const FileKind& kind, Begin begin)
      : world_(world), path_(std::move(path)), kind_(kind), begin_(std::move(begin)) {
    world_restored(0);
  }
  void world_restored(std::size_t) override {
    finish_ = {};  // frees the earlier file first
    finish_ = begin_(world_, path_);
  }
  /// Throws GrowingFileError if the file is incomplete.
  void finish(play::ScenarioResult& result) override {
    const std::string failure = finish_();
    finish_ = {};
    if (!failure.empty()) throw GrowingFileError(std::string(kind_.flag) + ": " + failure);
    result.*kind_.place = path_;
  }

 private:
  world::World& world_;
  std::string path_;
  const FileKind& kind_;
  Begin begin_;
  Finish finish_;  // owns the file
};

/// Returns the name reduced to characters that all file systems accept and no shell needs to quote.
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

/// Returns a lock that lasts as long as the process, or nothing if another process has locked the folder.
Descriptor locked(const std::string& folder) {
  Descriptor lock(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  return lock && ::flock(lock.get(), LOCK_EX | LOCK_NB) == 0 ? std::move(lock) : Descriptor();
}

/// Removes the spools of killed `run` processes, but keeps saved recordings.
void remove_abandoned_spools() {
  const fs::path folders(serve::kPrivateFolders);
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folders.parent_path(), error)) {
    const std::string path = entry.path().string();
    struct stat status = {};
    const bool is_own = path.starts_with(serve::kPrivateFolders) && ::lstat(path.c_str(), &status) == 0 &&
                        S_ISDIR(status.st_mode) && status.st_uid == ::geteuid();
    if (!is_own || !locked(path + "/" + kSpool)) continue;
    fs::remove_all(path + "/" + kSpool, error);
    fs::remove(path, error);  // fails if the folder is not empty
  }
}

[[noreturn]] void refuse(const char* flag, const std::string& path, const std::error_code& error) {
  throw std::system_error(error, std::string(flag) + ": " + path + " cannot be written");
}

/// Copies a file. If the copy fails, it removes the partial copy.
void copy_file(const std::string& from, const std::string& to, ContentKind content) {
  OutputFile file(to, content);
  file.begin("");
  std::ifstream source(from, std::ios::binary);
  std::string piece(kPieceOfCopy, '\0');
  while (source.read(piece.data(), static_cast<std::streamsize>(piece.size())), source.gcount() > 0) {
    const auto size = static_cast<std::size_t>(source.gcount());
    const int failure = file.write(std::string_view(piece).substr(0, size));
    if (failure == 0) continue;
    std::error_code ignored;
    fs::remove(to, ignored);
    throw OutputError(std::generic_category().message(failure));
  }
}

/// Moves a file, even between file systems.
void move_file(const char* flag, const std::string& from, const std::string& path, ContentKind content) {
  std::error_code error;
  try {
    const std::string to = output_target(path);
    require_replaceable(to, content);
    if (const auto access = access_of(to)) give_access(from, *access);
    fs::rename(from, to, error);
    if (!error) return;
    copy_file(from, to, content);
  } catch (const OutputError& refused) {
    throw GrowingFileError(std::string(flag) + ": " + path + " cannot be written: " + refused.what());
  }
  fs::remove(from, error);
}

// The older part of a large recording is a separate file.
constexpr std::array<const char*, 2> kParts = {"", world::kOlderPart};

}  // namespace

void require_folders(const FileClaims& claims, const RunFolders& folders) {
  if (folders.traces.empty() && !folders.trace_also.empty()) {
    throw UsageError("--trace-also: has no effect without --trace; expected --trace DIR");
  }
  if (!folders.failures.empty() && !folders.recordings.empty()) {
    throw UsageError("--failures: --record keeps all recordings in its folder; expected one of the two");
  }
  for (const FileKind& kind : kFolders) {
    const std::string& folder = folders.*kind.folder;
    if (folder.empty()) continue;
    const auto refuse_it = [&](const std::string& why) {
      throw UsageError(std::string(kind.flag) + ": " + folder + ": " + why);
    };
    for (const char* const ending : kind.of_files) {
      if (ending == nullptr || !folder.ends_with(ending) || fs::is_directory(folder)) continue;
      refuse_it("is a file name; expected a folder, for one file per scenario");
    }
    std::vector<std::string> endings;
    for (const char* const part : kParts) endings.push_back(std::string(kind.ending) + part);
    if (const std::string why = claims.objection_to_folder(folder, endings); !why.empty()) refuse_it(why);
  }
}

RunFiles::RunFiles(RunFolders folders, FileClaims claims, Recorded recorded, std::string version)
    : folders_(std::move(folders)),
      claims_(std::move(claims)),
      recorded_(recorded),
      version_(std::move(version)) {
  std::error_code error;
  for (const FileKind& kind : kFolders) {
    const std::string& folder = folders_.*kind.folder;
    if (!folder.empty()) fs::create_directories(folder, error);
    if (error) refuse(kind.flag, folder, error);
  }
  remove_abandoned_spools();
  serve::remove_left_overs();
  // The folder gets its final name only after it is locked. Otherwise another process would consider it
  // abandoned.
  const std::string unlocked = private_folder_.path() + "/unlocked";
  spool_ = private_folder_.path() + "/" + kSpool;
  fs::create_directory(unlocked, error);
  if (error) refuse(kRecording.flag, spool_, error);
  lock_ = locked(unlocked);
  fs::rename(unlocked, spool_, error);
  if (error) refuse(kRecording.flag, spool_, error);
}

RunFiles::~RunFiles() {
  std::error_code ignored;
  fs::remove_all(spool_, ignored);
}

std::string RunFiles::next_spool(const std::string& ending) {
  // Several processes may use the same spool.
  return spool_ + "/" + std::to_string(::getpid()) + "-" + std::to_string(++count_) + ending;
}

play::ObserverMaker RunFiles::recorder(const play::Scenario& scenario) {
  return [this, &scenario](world::World& world) {
    world::RecordingHeader header{.version = version_,
                                  .bench = world::to_text(scenario.bench),
                                  .options = {},
                                  .seed = scenario.bench.seed,
                                  .snapshot = {}};
    header.options.strict_framing = recorded_ == Recorded::again;
    return std::make_unique<play::PerformanceRecorder>(world, std::move(header),
                                                       next_spool(kRecording.ending));
  };
}

std::vector<play::ObserverMaker> RunFiles::observers(const play::Scenario& scenario) {
  std::vector<play::ObserverMaker> makers;
  // Most recordings of varied cases would be discarded. In virtual time, a failed case can run again.
  const bool is_varied_again = recorded_ == Recorded::again && scenario.which.is_varied;
  if (recorded_ != Recorded::apart && (!is_varied_again || !folders_.recordings.empty()))
    makers.push_back(recorder(scenario));
  const auto add = [&](const FileKind& kind, const PlayFile::Begin& begin) {
    if ((folders_.*kind.folder).empty()) return;
    makers.push_back([this, &kind, begin](world::World& world) {
      return std::make_unique<PlayFile>(world, next_spool(kind.ending), kind, begin);
    });
  };
  add(kTrace, [this](world::World& world, const std::string& path) {
    auto trace = std::make_shared<world::TraceFile>(world, path, folders_.trace_also, log_line);
    trace->begin();
    return [trace] { return trace->finish(); };
  });
  add(kCapture, [](world::World& world, const std::string& path) {
    auto capture = std::make_shared<world::WorldCapture>(world, path, log_line);
    capture->begin();
    return [capture] { return capture->finish(); };
  });
  return makers;
}

std::string RunFiles::free_name(const play::ScenarioResult& result) {
  std::string plain = file_name_of(result.name);
  // There may be too many varied cases to remember their names.
  if (result.which.is_varied) {
    if (!result.branch.empty()) plain += "-" + file_name_of(result.branch);
    return plain + "-" + play::identity_text(play::identity_of(result.which));
  }
  std::string free = plain;
  for (int i = 2; !names_.insert(free).second; ++i) free = plain + "-" + std::to_string(i);
  return free;
}

void RunFiles::settle(play::ScenarioResult& result, bool is_new) {
  std::string name;
  for (const FileKind& kind : kKinds) {
    std::string& place = result.*kind.place;
    if (place.empty()) continue;
    const std::string spooled = std::exchange(place, {});
    std::string folder = folders_.*kind.folder;
    const bool is_kept = !folder.empty() || (result.failure && is_new);
    if (is_kept) {
      if (folder.empty()) folder = folders_.failures.empty() ? private_folder_.path() : folders_.failures;
      if (name.empty()) name = free_name(result);
      place = (fs::path(folder) / (name + kind.ending)).string();
    }
    const bool is_of_failure = kind.place == kFailure.place && (folders_.*kind.folder).empty();
    const char* const flag = is_of_failure ? kFailure.flag : kind.flag;
    for (const char* const part : kParts) {
      std::error_code error;
      if (!fs::exists(spooled + part, error)) continue;
      if (is_kept) {
        if (const std::string why = claims_.objection_to(place + part); !why.empty()) {
          throw GrowingFileError(std::string(flag) + ": " + place + part + ": " + why);
        }
        move_file(flag, spooled + part, place + part, kind.content);
      } else {
        fs::remove(spooled + part, error);
      }
    }
  }
}

}  // namespace understudy::emulator::command_line
