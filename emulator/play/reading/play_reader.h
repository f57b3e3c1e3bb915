// Reads one play of a scenario file, which is a bench and steps, with its cases. A file contains either one
// play, or a list of `plays`.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/files/file_claims.h"
#include "emulator/play/reading/case_table.h"
#include "emulator/play/reading/parameters.h"
#include "emulator/play/reading/steps_reader.h"
#include "emulator/play/reading/trial.h"
#include "emulator/play/scenario/case.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::play {

/// Data that all plays of a file share.
struct FilePlays {
  std::string path;
  std::string save_below;             // saved files must be below this folder
  std::optional<std::uint64_t> seed;  // replaces the file's own seed
  std::vector<std::string> command;   // see ReadingOptions
  FileReading reading;
  /// The files that earlier cases save. This is set only while all cases are being read.
  std::optional<std::vector<FileClaim>> saved_before{};
  /// The file's own parameters that a play has used.
  std::set<std::string> used_parameters{};
};

class PlayReader {
 public:
  /// Reads a file that consists of one play.
  PlayReader(const world::YamlFields& root, FilePlays& file);
  /// Reads one of several plays. `common` is the part of the file that applies to all plays. Throws
  /// FileError.
  PlayReader(const world::YamlFields& play, const world::YamlFields& common, FilePlays& file);

  const CaseTable& cases() const { return cases_; }
  Case case_of(std::uint64_t number) const;
  std::string name_of(std::uint64_t number) const;
  /// The name without the values of a case. It is empty if the play has the name of the file.
  std::string written_name() const;
  /// Reads a case and checks everything in it. Throws FileError.
  Scenario read(std::uint64_t number);

 private:
  void define_all(std::uint64_t number, const Case& which, Parameters& parameters) const;
  void require_all_used(std::uint64_t number, const Case& which, const Parameters& parameters) const;
  std::string name_with(const Case& which, const Parameters& parameters) const;
  world::Bench bench_at(const world::YamlFields& field) const;
  world::Bench read_its_bench(const world::YamlFields& root) const;
  void choose(std::uint64_t number, world::Bench& bench) const;
  Scenario read_case(std::uint64_t number, const Case& which);
  void read_command(const world::YamlFields& root, const Parameters& parameters, Scenario& scenario) const;
  void require_own_paths(const StepsReader& steps, Scenario& scenario);

  world::YamlFields own_;   // as written in the file
  world::YamlFields root_;  // includes the common part of the file
  FilePlays& file_;
  bool is_one_of_several_ = false;
  CaseTable cases_;
};

}  // namespace understudy::emulator::play
