#include "emulator/command_line/run_recordings.h"

#include <array>
#include <cctype>
#include <filesystem>
#include <system_error>
#include <utility>

#include "emulator/bench/bench_text.h"
#include "emulator/scenario/play_recorder.h"

namespace understudy::emulator {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestName = 100;  // bytes

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

[[noreturn]] void refuse(const std::string& path, const std::error_code& error) {
  throw std::system_error(error, "--record: " + path + " cannot be written");
}

/// Also from one file system to another.
void move_file(const std::string& from, const std::string& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (!error) return;
  error.clear();
  fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);
  if (error) refuse(to, error);
  fs::remove(from, error);
}

// A recording that had grown too large has its older part in a file of its own.
constexpr std::array<const char*, 2> kParts = {"", ".1"};

}  // namespace

RunRecordings::RunRecordings(std::string folder, bool real_time, std::string version)
    : folder_(std::move(folder)), real_time_(real_time), version_(std::move(version)) {
  std::error_code error;
  if (!folder_.empty()) fs::create_directories(folder_, error);
  if (error) refuse(folder_, error);
  spool_ = private_folder_.path() + "/spool";
  fs::create_directory(spool_, error);
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
  return free + ".jsonl";
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
