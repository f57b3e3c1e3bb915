#include "emulator/play/reading/scenario_file.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/file_claims.h"
#include "base/files/file_error.h"
#include "base/files/output_file.h"
#include "base/files/text_file.h"
#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/model.h"
#include "emulator/device/program_error.h"
#include "emulator/device/register_map/row.h"
#include "emulator/play/reading/case_table.h"
#include "emulator/play/reading/parameters.h"
#include "emulator/play/reading/scenario_form.h"
#include "emulator/play/reading/steps_reader.h"
#include "emulator/play/reading/trial.h"
#include "emulator/play/scenario/case.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/serve/daemon/nv_keeper.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/bench_file/bench_form.h"
#include "emulator/world/bench_file/complaints.h"
#include "emulator/world/expression/tokens.h"
#include "emulator/world/names/names.h"

namespace understudy::emulator::play {

namespace {

/// Wherever links lead.
bool is_below(const std::string& path, const std::string& folder) {
  namespace fs = std::filesystem;
  std::string target = path;
  try {
    target = output_target(path);
  } catch (const OutputError&) {
    // What is there is refused for what it is.
  }
  const fs::path file = fs::weakly_canonical(fs::absolute(target));
  const fs::path top = fs::weakly_canonical(fs::absolute(folder.empty() ? "." : folder));
  const auto [at_top, at_file] = std::mismatch(top.begin(), top.end(), file.begin(), file.end());
  // A folder that is written with a slash at its end has an empty name there.
  return at_top == top.end() || (at_top->empty() && std::next(at_top) == top.end());
}

}  // namespace

/// Reads one case after the other.
class ScenarioFile::Reader {
 public:
  Reader(const world::YamlFields& root, std::string path, const ReadingOptions& options,
         SharedReading& shared)
      : root_(root),
        path_(std::move(path)),
        save_below_(options.save_below.empty() ? root_.folder() : options.save_below),
        seed_(options.seed),
        file_{.shared = shared} {
    head_.attempt([&] { root_.demand_keys(kScenarioKeys); });
    head_.attempt([&] { root_.at("understudy").integer(world::kVersionForm); });
    // Without its cases nothing more can be said.
    if (!head_.attempt([&] { cases_.emplace(root_, seed_); })) head_.throw_if_any();
  }

  const CaseTable& cases() const { return *cases_; }

  std::string name_of(std::uint64_t number) const {
    const Case which = cases_->at(number);
    Parameters parameters;
    define_all(number, which, parameters);
    return name_with(which, parameters);
  }

  Scenario read(std::uint64_t number) {
    head_.throw_if_any();
    return read_one(number);
  }

  void check(const std::function<void(Scenario)>& take) {
    std::set<std::string> names;
    world::Complaints all = head_;
    saved_before_.emplace();
    all.demand([&] {
      for (const std::uint64_t number : cases_->typical()) {
        const Case which = cases_->at(number);
        try {
          Scenario scenario = read_one(number);
          if (!names.insert(scenario.name).second && !cases_->is_varied()) {
            cases_->place_of(number).fail("makes a second scenario called " +
                                          understudy::quoted(scenario.name) + "; expected different values");
          }
          take(std::move(scenario));
        } catch (const FileError& error) {
          // What is wrong may be so in one case only.
          all.add(error, which.values.empty() ? "" : "  " + to_text(which));
        }
      }
    });
    saved_before_.reset();
  }

 private:
  Scenario read_one(std::uint64_t number) {
    // What is read one by one, as what `vary` makes is, is never all there at once.
    if (cases_->is_varied() || !saved_before_) {
      file_.steps = 0;
      file_.bytes = 0;
    }
    return read_case(number, cases_->at(number));
  }

  /// The case's values, and the defaults of all others; a default may use what is defined before it.
  void define_all(std::uint64_t number, const Case& which, Parameters& parameters) const {
    const auto define = [&](const auto& field, const std::string& name, const std::string& value) {
      try {
        parameters.define(name, value);
      } catch (const world::NameError& error) {
        field().fail(error.what());
      }
    };
    for (const auto& [name, value] : which.values) {
      define([&, &its_name = name] { return cases_->field_of(number, its_name); }, name, value);
    }
    if (!root_.has("parameters")) return;
    const world::YamlFields defaults = root_.at("parameters").with_rule(&parameters);
    defaults.demand_map();
    const auto is_given = [&](const std::string& name) {
      return std::any_of(which.values.begin(), which.values.end(),
                         [&](const auto& value) { return value.first == name; });
    };
    for (const auto& [name, value] : defaults.entries()) {
      if (!is_given(name)) define([&, &field = value] { return field; }, name, value.text());
    }
  }

  /// Where one was meant and another was written, both are left over.
  void demand_all_used(std::uint64_t number, const Case& which, const Parameters& parameters) const {
    const auto fail = [&](const std::string& name, const world::YamlFields& field) {
      field.fail(understudy::quoted(name) + " is not used; expected ${" + name +
                 "} somewhere in the scenario");
    };
    for (const auto& [name, value] : which.values) {
      if (!parameters.was_used(name)) fail(name, cases_->field_of(number, name));
    }
    if (!root_.has("parameters")) return;
    for (const auto& [name, value] : root_.at("parameters").entries()) {
      if (!parameters.was_used(name)) fail(name, value);
    }
  }

  /// What is written, and the values that tell this case from the others.
  std::string name_with(const Case& which, const Parameters& parameters) const {
    std::string name = std::filesystem::path(path_).stem().string();
    if (!root_.has("name")) return which.values.empty() ? name : name + " " + to_text(which);
    const std::string written = root_.at("name").text();
    name = world::on_one_line(root_.with_rule(&parameters).at("name").text());
    if (which.values.empty()) return name;
    if (!which.is_varied) return name != written ? name : name + " " + to_text(which);
    Case untold;
    const auto told = parameters.used_in(written);
    for (const auto& value : which.values) {
      if (!told.contains(value.first)) untold.values.push_back(value);
    }
    return untold.values.empty() ? name : name + " " + to_text(untold);
  }

  world::Bench bench_at(const world::YamlFields& field) const {
    auto& benches = file_.shared.benches;
    auto it = benches.find(field.path());
    if (it == benches.end())
      it = benches.emplace(field.path(), world::load_bench(file_.shared.models, field)).first;
    return it->second;
  }

  world::Bench read_its_bench(const world::YamlFields& root) const {
    const world::YamlFields field = root.at("bench");
    world::Bench bench =
        field.is_map() ? world::read_bench(file_.shared.models, field, field.folder()) : bench_at(field);
    if (root.has("nv")) {
      const world::YamlFields nv = root.at("nv");
      nv.demand_map();
      for (const auto& [name, image] : nv.entries()) {
        world::DeviceSetup& device = demand_device(bench, image, name);
        device.nv_path = image.path();
        if (const std::string why = why_not_readable(device.nv_path); !why.empty())
          image.fail(device.nv_path + " " + why + "; expected an NV image");
      }
    }
    if (root.has("firmware")) read_firmwares(root.at("firmware"), bench);
    return bench;
  }

  static world::DeviceSetup& demand_device(world::Bench& bench, const world::YamlFields& field,
                                           const std::string& name) {
    std::vector<std::string> names;
    for (world::DeviceSetup& device : bench.devices) {
      if (device.settings.name == name) return device;
      names.push_back(device.settings.name);
    }
    field.fail("no device is called " + understudy::quoted(name) + suggestion(name, names));
  }

  static void read_firmwares(const world::YamlFields& fields, world::Bench& bench) {
    const auto read = [](const world::YamlFields& field) {
      const Firmware firmware = parse_firmware(field.text());
      if (firmware == 0)
        field.fail(understudy::quoted(field.text()) + " is not a version; expected one like \"1.52\"");
      return firmware;
    };
    if (!fields.is_map()) {
      for (world::DeviceSetup& device : bench.devices) device.settings.firmware = read(fields);
      return;
    }
    fields.demand_map();
    for (const auto& [name, field] : fields.entries()) {
      demand_device(bench, field, name).settings.firmware = read(field);
    }
  }

  Scenario read_case(std::uint64_t number, const Case& which) {
    Parameters parameters;
    define_all(number, which, parameters);
    const world::YamlFields root = root_.with_rule(&parameters);
    Scenario scenario;
    scenario.file = path_;
    scenario.which = which;
    scenario.name = std::filesystem::path(path_).stem().string();
    // Without its bench nothing can be said of the steps.
    scenario.bench = read_its_bench(root);
    for (const world::DeviceSetup& device : scenario.bench.devices) {
      if (device.nv_path.empty()) continue;
      scenario.files.push_back(
          {device.nv_path, "the initial memory of " + understudy::quoted(device.settings.name)});
    }
    const Trial trial = make_trial(root, scenario.bench);
    world::Complaints all;
    all.attempt([&] { scenario.name = name_with(which, parameters); });
    all.attempt([&] {
      if (root.has("gap")) scenario.gap = root.at("gap").duration();
    });
    all.attempt([&] {
      if (!root.has("seed")) return;
      scenario.bench.seed = static_cast<std::uint64_t>(root.at("seed").integer(world::kSeedForm));
    });
    if (seed_) scenario.bench.seed = *seed_;
    scenario.seed = scenario.bench.seed;
    StepsReader steps(trial, file_, path_);
    all.attempt([&] { scenario.steps = steps.read(root.at("steps"), parameters); });
    all.throw_if_any();
    demand_all_used(number, which, parameters);
    scenario.files.push_back({path_, "the scenario itself"});
    for (const auto& files : {scenario.bench.files, steps.files()}) {
      scenario.files.insert(scenario.files.end(), files.begin(), files.end());
    }
    demand_own_paths(steps, scenario);
    return scenario;
  }

  /// What is saved may be saved again, but by the same case: several may be played at a time.
  void demand_own_paths(const StepsReader& steps, Scenario& scenario) {
    FileClaims claims;
    claims.add(scenario.files);
    if (saved_before_) claims.add(*saved_before_);
    for (const auto& [path, field] : steps.saved()) {
      if (const std::string why = claims.objection_to(path); !why.empty()) field.fail(path + " " + why);
      if (!is_below(path, save_below_)) {
        field.fail(path + " is outside " + (save_below_.empty() ? "this folder" : save_below_) +
                   "; expected a path in it (`--save-below FOLDER` allows another folder)");
      }
      if (const std::string why = why_not_writable(path, ContentKind::nv_image); !why.empty()) {
        field.fail(path + " cannot be written: " + why);
      }
      scenario.saved.push_back(path);
      if (saved_before_) saved_before_->push_back({path, "what another case saves"});
    }
  }

  /// The bench by itself has been checked, but a memory may not suit it, and another firmware may know less.
  static Trial make_trial(const world::YamlFields& root, world::Bench& bench) {
    const std::string key = root.has("firmware") ? "firmware" : "bench";
    const world::YamlFields field = root.at(key);
    try {
      serve::read_memories(bench, "");
      // What is played leaves the files as they are; `save` writes them.
      for (world::DeviceSetup& device : bench.devices) device.nv_path.clear();
      return Trial(bench);
    } catch (const SettingError& error) {
      const std::string what = error.what();
      field.fail(error.setting == key ? what.substr(key.size() + 2) : what);
    } catch (const NvError& error) {
      throw FileError(error.what());
    } catch (const ProgramError& error) {
      field.fail("program: " + in_text(error.first()));
    }
  }

  world::YamlFields root_;
  std::string path_;
  std::string save_below_;
  std::optional<std::uint64_t> seed_;
  FileReading file_;
  world::Complaints head_;  // what is wrong beside the cases
  std::optional<CaseTable> cases_;
  std::optional<std::vector<FileClaim>> saved_before_{};  // by the cases so far, while all are read
};

ScenarioFile::ScenarioFile(const std::string& text, const std::string& path, const ReadingOptions& options,
                           SharedReading& shared) {
  const world::YamlFields root =
      world::YamlFields::parse(text, path, "scenario", "`understudy: 1`, `bench:` and `steps:`");
  if (root.has("lines") && !root.has("bench") && !root.has("steps")) {
    throw FileError({path, 1, 1},
                    "scenario: is a bench; expected a scenario (`understudy serve` takes benches)");
  }
  if ((root.has("registers") || root.has("model")) && !root.has("steps")) {
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

std::uint64_t ScenarioFile::size() const { return reader_->cases().size(); }
bool ScenarioFile::is_varied() const { return reader_->cases().is_varied(); }
Case ScenarioFile::case_of(std::uint64_t number) const { return reader_->cases().at(number); }
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
  const bool is_of_model = root.has("registers") || root.has("model");  // one of the two may be forgotten
  if (is_of_model && !root.has("lines")) return FileKind::model;
  if (!root.has("steps"))
    return root.has("bench") && !root.has("lines") ? FileKind::scenario : FileKind::bench;
  return root.has("bench") || root.has("name") ? FileKind::scenario : FileKind::steps;
}

}  // namespace understudy::emulator::play
