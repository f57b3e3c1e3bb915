#include "emulator/world/coverage/program_coverage.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/program_watch.h"
#include "base/state/state_bytes.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/program_language.h"
#include "emulator/device/program_parts.h"
#include "emulator/device/user_program.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

struct LineCounts {
  std::int64_t runs = 0;
  std::int64_t yes = 0;
  std::int64_t no = 0;
};

/// A program that a device has contained.
struct CountedProgram {
  std::vector<ProgramPart> parts;
  std::vector<std::vector<LineCounts>> counts;           // [part][line]
  std::vector<std::vector<LineCounts>*> by_part_number;  // by the part's number; null: no such part

  explicit CountedProgram(std::vector<ProgramPart> of) : parts(std::move(of)), counts(parts.size()) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      counts[i].resize(parts[i].lines.size());
      const auto number = static_cast<std::size_t>(parts[i].number);
      if (by_part_number.size() <= number) by_part_number.resize(number + 1);
      // If several parts have the same number, only the first one runs, because stored files are also parts.
      if (by_part_number[number] == nullptr) by_part_number[number] = &counts[i];
    }
  }

  LineCounts* find(int part, int line) {
    if (part < 0 || line < 0 || static_cast<std::size_t>(part) >= by_part_number.size()) return nullptr;
    std::vector<LineCounts>* const lines = by_part_number[static_cast<std::size_t>(part)];
    const auto number = static_cast<std::size_t>(line);
    return lines == nullptr || number >= lines->size() ? nullptr : &(*lines)[number];
  }
};

namespace {

/// Returns the path relative to the working directory if the file is below that directory.
std::string path_for_people(const std::string& path) {
  const std::filesystem::path normal = std::filesystem::path(path).lexically_normal();
  if (!normal.is_absolute()) return normal.string();
  std::error_code error;
  const std::filesystem::path here = std::filesystem::current_path(error);
  const std::filesystem::path near = error ? normal : normal.lexically_relative(here);
  return near.empty() || *near.begin() == ".." ? normal.string() : near.string();
}

void add_part(CoveredLines& lines, const ProgramPart& part, const std::vector<LineCounts>& counts) {
  for (std::size_t i = 0; i < part.lines.size(); ++i) {
    if (part.lines[i].text_line == 0) continue;
    lines[part.lines[i].text_line].add(
        {.runs = counts[i].runs, .decides = part.lines[i].decides, .yes = counts[i].yes, .no = counts[i].no});
  }
}

}  // namespace

class ProgramCoverage::DeviceCounts final : public ProgramWatch {
 public:
  explicit DeviceCounts(Device& device) : device_(device) {
    present();
    device_.user_program()->add_watch(*this);
  }
  ~DeviceCounts() override { device_.user_program()->remove_watch(*this); }
  DeviceCounts(const DeviceCounts&) = delete;
  DeviceCounts& operator=(const DeviceCounts&) = delete;

  void program_loaded(std::uint64_t mark) override {
    if (mark == mark_) return;
    mark_ = mark;
    program_ = nullptr;
  }
  void runs(int part, int line, std::int64_t times) override {
    if (LineCounts* const counts = program().find(part, line)) counts->runs += times;
  }
  void decides(int part, int line, bool outcome, std::int64_t times) override {
    LineCounts* const counts = program().find(part, line);
    if (counts != nullptr) (outcome ? counts->yes : counts->no) += times;
  }

  std::map<std::string, CoveredLine> by_first_word() const {
    std::map<std::string, CoveredLine> words;
    for (const auto& [text, program] : programs_) {
      for (std::size_t i = 0; i < program->parts.size(); ++i) {
        for (std::size_t l = 0; l < program->parts[i].lines.size(); ++l) {
          const ProgramLine& line = program->parts[i].lines[l];
          const LineCounts& counts = program->counts[i][l];
          words[line.code.substr(0, line.code.find(' '))].add(
              {.runs = counts.runs, .decides = line.decides, .yes = counts.yes, .no = counts.no});
        }
      }
    }
    return words;
  }

  CoverageReport report(const std::vector<ProgramSource>& sources) {
    present();  // the current program, even if it has never run
    std::vector<std::pair<std::string, std::vector<ProgramPart>>> known;
    const DeviceSettings& settings = device_.settings();
    if (!settings.program_name.empty()) known.emplace_back(settings.program_name, parts_of(settings.program));
    for (const ProgramSource& source : sources) {
      if (source.path != settings.program_name) known.emplace_back(source.path, parts_of(source.text));
    }
    CoverageReport report;
    for (const auto& [text, program] : programs_) {
      for (std::size_t i = 0; i < program->parts.size(); ++i) {
        add(report, program->parts[i], program->counts[i], known, text);
      }
    }
    return report;
  }

 private:
  std::vector<ProgramPart> parts_of(const std::string& text) const {
    return device_.model().language->parts(text, device_.settings());
  }

  /// Returns the counts of the running program. A program that is observed but never runs, such as a program
  /// that a host is writing line by line, has no counts.
  CountedProgram& program() {
    if (program_ != nullptr) return *program_;
    CountedProgram*& known = by_mark_[*mark_];
    if (known == nullptr) known = &present();
    program_ = known;
    return *program_;
  }

  /// Returns the counts of the present program of the device.
  CountedProgram& present() {
    const std::string text = device_.user_program()->program_text();
    std::unique_ptr<CountedProgram>& program = programs_[text];
    if (program == nullptr) program = std::make_unique<CountedProgram>(parts_of(text));
    return *program;
  }

  void add(CoverageReport& report, const ProgramPart& part, const std::vector<LineCounts>& counts,
           const std::vector<std::pair<std::string, std::vector<ProgramPart>>>& known,
           const std::string& text) const {
    bool has_file = false;
    for (const auto& [path, source_parts] : known) {
      if (has_file) break;  // another device may have a file with the same instructions
      for (const ProgramPart& source : source_parts) {
        if (source.number != part.number || source.lines != part.lines) continue;
        add_part(report.files[path_for_people(path)].lines, source, counts);
        has_file = true;
      }
    }
    // Lines that are in no listing, such as those after the end, are not part of the program.
    const bool is_shown = std::any_of(part.lines.begin(), part.lines.end(),
                                      [](const ProgramLine& line) { return line.text_line > 0; });
    if (has_file || !is_shown) return;
    CoveredFile& file = report.files[name_of_listing(text)];
    file.listing = text;
    add_part(file.lines, part, counts);
  }

  /// Returns the same name for the same program, regardless of the device.
  std::string name_of_listing(const std::string& text) const {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx",
                  static_cast<unsigned long long>(hash_of(std::as_bytes(std::span(text)))));
    return std::string(device_.model().name) + "-" + std::string(digits, 8) +
           std::string(device_.model().language->file_ending());
  }

  Device& device_;
  std::map<std::string, std::unique_ptr<CountedProgram>> programs_;  // by text
  std::map<std::uint64_t, CountedProgram*> by_mark_;
  std::optional<std::uint64_t> mark_;  // the running program's mark
  CountedProgram* program_ = nullptr;  // the running program's counts, once a line has run
};

ProgramCoverage::ProgramCoverage(World& world) {
  for (std::size_t d = 0; d < world.device_count(); ++d) {
    Device& device = world.device(d);
    const bool has_program = device.user_program() != nullptr && device.model().language != nullptr;
    devices_.push_back(has_program ? std::make_unique<DeviceCounts>(device) : nullptr);
  }
}

ProgramCoverage::~ProgramCoverage() = default;

CoverageReport ProgramCoverage::report(const std::vector<ProgramSource>& sources) const {
  CoverageReport report;
  for (std::size_t d = 0; d < devices_.size(); ++d) report.add(report_of(d, sources));
  return report;
}

CoverageReport ProgramCoverage::report_of(std::size_t device,
                                          const std::vector<ProgramSource>& sources) const {
  return devices_[device] == nullptr ? CoverageReport{} : devices_[device]->report(sources);
}

std::map<std::string, CoveredLine> ProgramCoverage::by_first_word(std::size_t device) const {
  return devices_[device] == nullptr ? std::map<std::string, CoveredLine>{}
                                     : devices_[device]->by_first_word();
}

}  // namespace understudy::emulator::world
