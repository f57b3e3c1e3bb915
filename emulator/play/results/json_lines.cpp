// Writes results as JSON lines. If two rows are about the same case, the later row counts.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <ios>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/growing_file.h"
#include "base/files/output_file.h"
#include "base/state/state_bytes.h"
#include "emulator/play/results/results_file.h"
#include "emulator/play/scenario/case.h"

namespace understudy::emulator::play {

namespace {

std::uint64_t hash_of_key(const std::string& file, const std::string& case_id, const std::string& made_of) {
  const std::string all = file + "\n" + case_id + "\n" + made_of;
  return hash_of(std::as_bytes(std::span(all)));
}

class JsonLines final : public ResultsFile {
 public:
  JsonLines(const std::string& path, bool continues) : path_(path) {
    try {
      file_.emplace(path, ContentKind::results);
      if (continues) read();
    } catch (const OutputError& error) {
      refuse(error.what());
    }
  }

  bool has_rows() override {
    std::error_code error;
    return std::filesystem::file_size(file_->target(), error) > 0 && !error;
  }

  void begin() override {
    try {
      file_->begin("");
    } catch (const OutputError& error) {
      refuse(error.what());
    }
  }

  std::optional<bool> has_failed(const CaseKey& key) override {
    const std::uint64_t hash =
        hash_of_key(key.file, identity_text(key.identity), identity_text(key.made_of)) & ~kFailed;
    const auto it = std::lower_bound(played_.begin(), played_.end(), hash);
    if (it == played_.end() || (*it & ~kFailed) != hash) return std::nullopt;
    return (*it & kFailed) != 0;
  }

  void add(std::span<const ResultRow> rows) override {
    // Branches come first, because a case counts as stored as soon as its own row is stored.
    std::string text;
    for (const ResultRow& row : rows) text += row.branch.empty() ? "" : json_text(row) + "\n";
    for (const ResultRow& row : rows) text += row.branch.empty() ? json_text(row) + "\n" : "";
    if (const int error = file_->write(text); error != 0) refuse(std::generic_category().message(error));
  }

  void finish() override {}

 private:
  static constexpr std::string_view kBeginOfRow = "{\"file\":\"";
  // The lowest bit of the entry of a case. The other bits are from its hash.
  static constexpr std::uint64_t kFailed = 1;

  [[noreturn]] void refuse(const std::string& why) const {
    throw GrowingFileError("--results: " + path_ + " cannot be written: " + why);
  }

  [[noreturn]] void refuse_line(std::uint64_t number) const {
    throw GrowingFileError("--results: " + path_ + ":" + std::to_string(number) +
                           ": is not a row of results; expected a file that `--results` wrote");
  }

  /// Returns true if an incomplete last line may be a row. The remains of a killed run are dropped, but not
  /// the content of other files.
  static bool begins_as_row(std::string_view line) {
    const std::size_t both = std::min(line.size(), kBeginOfRow.size());
    return line.substr(0, both) == kBeginOfRow.substr(0, both);
  }

  /// Reads the earlier results, and keeps 8 bytes per row. If the last line has no line ending, it is from a
  /// run that was killed.
  void read() {
    std::ifstream before(path_, std::ios::binary);
    std::uint64_t size = 0;
    std::string line;
    std::vector<std::uint64_t> failed_branches;
    std::uint64_t number = 1;
    for (; std::getline(before, line) && !before.eof(); ++number) {
      size += line.size() + 1;
      const auto json = nlohmann::json::parse(line, nullptr, false);
      if (!is_row(json)) refuse_line(number);
      const std::string verdict = json["verdict"];
      const std::uint64_t failed = verdict == "failed" ? kFailed : 0;
      const std::uint64_t hash = hash_of_key(json["file"], json["case_id"], json["made_of"]) & ~kFailed;
      if (!json["branch"].get_ref<const std::string&>().empty()) {
        if (failed != 0) failed_branches.push_back(hash);
      } else if (verdict != "unreadable") {
        played_.push_back(hash | failed);
      }
    }
    if (!begins_as_row(line)) refuse_line(number);
    std::sort(played_.begin(), played_.end());
    for (const std::uint64_t hash : failed_branches) {
      const auto it = std::lower_bound(played_.begin(), played_.end(), hash);
      if (it != played_.end() && (*it & ~kFailed) == hash) *it |= kFailed;
    }
    file_->continue_at(size);
  }

  static bool is_row(const nlohmann::json& json) {
    if (!json.is_object()) return false;
    for (const char* const key : {"file", "branch", "case_id", "verdict", "made_of"}) {
      if (!json.contains(key) || !json[key].is_string()) return false;
    }
    return true;
  }

  std::string path_;
  std::optional<OutputFile> file_;
  std::vector<std::uint64_t> played_;
};

}  // namespace

std::unique_ptr<ResultsFile> open_json_lines(const std::string& path, bool continues) {
  return std::make_unique<JsonLines>(path, continues);
}

}  // namespace understudy::emulator::play
