#include "emulator/play/reading/scenario_file.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/file_error.h"
#include "base/files/text_file.h"
#include "base/text/suggestion.h"
#include "emulator/device/model.h"
#include "emulator/play/reading/play_reader.h"
#include "emulator/play/reading/scenario_schema.h"
#include "emulator/play/reading/shared_reading.h"
#include "emulator/play/scenario/case.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/bench_file/bench_schema.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::play {

/// Reads the cases one by one, scenario by scenario.
class ScenarioFile::Reader {
 public:
  Reader(const world::YamlFields& root, std::string path, const ReadingOptions& options,
         SharedReading& shared)
      : root_(root),
        file_{.path = std::move(path),
              .save_below = options.save_below.empty() ? root.folder() : options.save_below,
              .seed = options.seed,
              .command = options.command,
              .reading = {.shared = shared}} {
    head_.attempt([&] { root_.require_keys(kScenarioKeys); });
    head_.attempt([&] { root_.at("understudy").integer(world::kVersionSchema); });
    // Without the cases, nothing more can be reported.
    if (!head_.attempt([&] { read_plays(); })) head_.throw_if_any();
  }

  std::uint64_t size() const { return first_.back(); }
  bool is_varied() const {
    return std::any_of(plays_.begin(), plays_.end(),
                       [](const PlayReader& play) { return play.cases().is_varied(); });
  }
  Case case_of(std::uint64_t number) const {
    const auto [play, of_play] = find(number);
    return plays_[play].case_of(of_play);
  }
  std::string name_of(std::uint64_t number) const {
    const auto [play, of_play] = find(number);
    return plays_[play].name_of(of_play);
  }

  Scenario read(std::uint64_t number) {
    head_.throw_if_any();
    const auto [play, of_play] = find(number);
    return read_one(plays_[play], of_play);
  }

  void check(const std::function<void(Scenario)>& take) {
    std::set<std::string> names;
    world::Diagnostics all = head_;
    file_.saved_before.emplace();
    all.require([&] {
      for (PlayReader& play : plays_) {
        for (const std::uint64_t number : play.cases().typical()) check_one(play, number, names, all, take);
      }
      all.attempt([&] { require_common_parameters_used(); });
    });
    file_.saved_before.reset();
  }

 private:
  void read_plays() {
    if (!root_.has("plays")) {
      plays_.emplace_back(root_, file_);
      first_ = {0, plays_.front().cases().size()};
      return;
    }
    if (root_.has("steps"))
      root_.at("steps").fail("cannot be combined with `plays`; expected `steps` in each play");
    // The file's name describes all its scenarios; each of them has its own name.
    static constexpr std::array<std::string_view, 3> kOfTheFile{"understudy", "name", "plays"};
    const world::YamlFields common = root_.without(kOfTheFile);
    const auto plays = root_.at("plays").elements();
    if (plays.empty()) root_.at("plays").fail("is empty; expected at least one play");
    world::Diagnostics diagnostics;
    std::set<std::string> names;
    for (const world::YamlFields& play : plays) {
      diagnostics.attempt([&] {
        PlayReader read(play, common, file_);
        if (!names.insert(read.written_name()).second) {
          play.fail("is called " + understudy::quoted(read.written_name()) +
                    ", like another play; expected a different name");
        }
        plays_.push_back(std::move(read));
        first_.push_back(first_.back() + plays_.back().cases().size());
      });
    }
    diagnostics.throw_if_any();
  }

  /// Returns the index of the scenario to which a case belongs, and the number of the case within it.
  std::pair<std::size_t, std::uint64_t> find(std::uint64_t number) const {
    const auto behind = std::upper_bound(first_.begin(), first_.end(), number);
    const auto play = static_cast<std::size_t>(behind - first_.begin()) - 1;
    return {play, number - first_[play]};
  }

  void check_one(PlayReader& play, std::uint64_t number, std::set<std::string>& names,
                 world::Diagnostics& all, const std::function<void(Scenario)>& take) {
    try {
      Scenario scenario = read_one(play, number);
      if (!names.insert(scenario.name).second && !play.cases().is_varied()) {
        play.cases().place_of(number).fail("makes a second scenario called " +
                                           understudy::quoted(scenario.name) + "; expected different values");
      }
      take(std::move(scenario));
    } catch (const FileError& error) {
      // The error may occur in this case only, so the message contains its name.
      const Case which = play.cases().at(number);
      all.add(error, which.values.empty() ? "" : "  " + to_text(which));
    }
  }

  Scenario read_one(PlayReader& play, std::uint64_t number) {
    // Cases that are read one by one, like those of `vary`, are never in memory at the same time.
    if (play.cases().is_varied() || !file_.saved_before) {
      file_.reading.steps = 0;
      file_.reading.bytes = 0;
    }
    return play.read(number);
  }

  void require_common_parameters_used() const {
    if (!root_.has("plays") || !root_.has("parameters")) return;
    for (const auto& [name, value] : root_.at("parameters").entries()) {
      if (!file_.used_parameters.contains(name)) {
        value.fail(understudy::quoted(name) + " is not used; expected ${" + name + "} in one of the plays");
      }
    }
  }

  world::YamlFields root_;
  FilePlays file_;
  world::Diagnostics head_;  // errors that do not belong to a case
  std::vector<PlayReader> plays_;
  std::vector<std::uint64_t> first_{0};  // the first case of each scenario, followed by the total
};

ScenarioFile::ScenarioFile(const std::string& text, const std::string& path, const ReadingOptions& options,
                           SharedReading& shared) {
  const world::YamlFields root =
      world::YamlFields::parse(text, path, "scenario", "`understudy: 1`, `bench:` and `steps:`");
  if (root.has("lines") && !root.has("bench") && !root.has("steps") && !root.has("plays")) {
    throw FileError({path, 1, 1},
                    "scenario: is a bench; expected a scenario (`understudy serve` serves benches)");
  }
  if ((root.has("registers") || root.has("model")) && !root.has("steps") && !root.has("plays")) {
    throw FileError({path, 1, 1},
                    "scenario: is a model file; expected a scenario, with a bench whose stations name it");
  }
  reader_ = std::make_unique<Reader>(root, path, options, shared);
}

ScenarioFile::ScenarioFile(const std::string& path, const ReadingOptions& options, SharedReading& shared)
    : ScenarioFile(
          [&] {
            auto text = read_text_file(path);
            if (!text) throw FileError(path + ": scenario: " + text.why + "; expected a scenario file");
            return std::move(*text);
          }(),
          path, options, shared) {}

ScenarioFile::~ScenarioFile() = default;

std::uint64_t ScenarioFile::size() const { return reader_->size(); }
bool ScenarioFile::is_varied() const { return reader_->is_varied(); }
Case ScenarioFile::case_of(std::uint64_t number) const { return reader_->case_of(number); }
std::string ScenarioFile::name_of(std::uint64_t number) const { return reader_->name_of(number); }
Scenario ScenarioFile::read(std::uint64_t number) { return reader_->read(number); }
void ScenarioFile::check(const std::function<void(Scenario)>& take) { reader_->check(take); }

std::vector<Scenario> parse_scenarios(ModelList models, const std::string& text, const std::string& path,
                                      const std::string& save_below) {
  SharedReading shared{.models = models, .benches = {}, .included = {}};
  std::vector<Scenario> scenarios;
  ScenarioFile(text, path, {.save_below = save_below, .seed = {}}, shared).check([&](Scenario scenario) {
    scenarios.push_back(std::move(scenario));
  });
  return scenarios;
}

std::vector<Scenario> load_scenarios(const std::string& path, const std::string& save_below,
                                     SharedReading& shared) {
  std::vector<Scenario> scenarios;
  ScenarioFile(path, {.save_below = save_below, .seed = {}}, shared).check([&](Scenario scenario) {
    scenarios.push_back(std::move(scenario));
  });
  return scenarios;
}

std::vector<Scenario> load_scenarios(ModelList models, const std::string& path,
                                     const std::string& save_below) {
  SharedReading shared{.models = models, .benches = {}, .included = {}};
  return load_scenarios(path, save_below, shared);
}

FileKind kind_of_file(const std::string& path) {
  const auto text = read_text_file(path);
  if (!text) throw FileError(path + ": file: " + text.why + "; expected a bench or a scenario");
  const world::YamlFields root = world::YamlFields::parse(
      *text, path, "file",
      "a bench (`lines:`), a scenario (`bench:` and `steps:`) or a model (`registers:`)");
  // The user may have forgotten the second key.
  const bool is_of_model = root.has("registers") || root.has("model");
  if (is_of_model && !root.has("lines")) return FileKind::model;
  if (root.has("plays")) return FileKind::scenario;
  if (!root.has("steps"))
    return root.has("bench") && !root.has("lines") ? FileKind::scenario : FileKind::bench;
  return root.has("bench") || root.has("name") ? FileKind::scenario : FileKind::steps;
}

}  // namespace understudy::emulator::play
