#include "emulator/box/calibrate/calibration.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/choices.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/compare/comparison.h"
#include "emulator/box/compare/drift.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::box {

namespace {

constexpr std::size_t kWidth = 12;    // hypotheses that are kept at each level
constexpr std::size_t kDeepest = 16;  // options that differ from the bench's

/// The part of the captures that a hypothesis explains.
struct Reach {
  std::size_t explained = 0;  // exchanges
  bool is_whole = false;
  std::size_t capture = 0;  // of the first contradiction
  std::size_t exchange = 0;
  std::uint64_t fingerprint = 0;  // of the bench's replies up to there
  std::size_t bytes = 0;          // of the reply that contradicts, in which it agrees

  bool is_further_than(const Reach& other) const {
    if (is_whole != other.is_whole) return is_whole;
    return std::pair(explained, bytes) > std::pair(other.explained, other.bytes);
  }
};

const Model& model_of(const world::Bench& bench, ChoiceKey key) { return *bench.devices[key.device].model; }

std::size_t option_count(const world::Bench& bench, ChoiceKey key) {
  const Model& model = model_of(bench, key);
  return key.row == ChoiceKey::kFirmware ? model.firmwares.size() : options_of(model.choices[key.row]).size();
}

std::uint8_t option_in_bench(const world::Bench& bench, ChoiceKey key) {
  const world::DeviceSetup& device = bench.devices[key.device];
  if (key.row != ChoiceKey::kFirmware)
    return resolve_choices(device.model->choices, device.settings.choices)[key.row];
  const auto& versions = device.model->firmwares;
  const auto found = std::ranges::find(versions, device.settings.firmware);
  return static_cast<std::uint8_t>((found == versions.end() ? versions.end() - 1 : found) - versions.begin());
}

world::Bench bench_with(const world::Bench& bench, const Hypothesis& hypothesis) {
  world::Bench changed = bench;
  for (const auto& [key, number] : hypothesis) {
    if (key.row == ChoiceKey::kFirmware) {
      changed.devices[key.device].settings.firmware = model_of(bench, key).firmwares[number];
    } else {
      changed.devices[key.device].settings.choices[choice_id(bench, key)] = option_name(bench, key, number);
    }
  }
  return changed;
}

/// Ends a search from within.
struct Interrupted {};

class Search {
 public:
  Search(const world::Bench& bench, const std::vector<Capture>& captures, const CalibrateSettings& settings,
         const CalibrateWatch& watch)
      : bench_(bench), captures_(captures), settings_(settings), watch_(watch) {
    std::set<std::size_t> devices;
    for (const world::StationSetup& station : bench.lines[settings.compare.line].stations)
      devices.insert(station.device);
    for (const std::size_t device : devices) {
      const auto rows = bench.devices[device].model->choices;
      for (std::size_t row = 0; row < rows.size(); ++row) {
        if (options_of(rows[row]).size() >= 2) add_key({.device = device, .row = row});
      }
      if (bench.devices[device].model->firmwares.size() >= 2)
        add_key({.device = device, .row = ChoiceKey::kFirmware});
    }
  }

  Calibration run() {
    Calibration result;
    try {
      explain(result);
      if (result.explains) try_each_option(result);
    } catch (const Interrupted&) {
      result.is_interrupted = true;
      // It may have been interrupted before the explanations were complete.
      if (result.explanations.empty()) finish(result, {best_}, best_reach_);
    }
    result.tried = tried_;
    return result;
  }

  /// Returns the hypotheses that add one other option.
  std::vector<Hypothesis> neighbours_of(const Hypothesis& hypothesis) const {
    std::vector<Hypothesis> all;
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      if (hypothesis.contains(keys_[i])) continue;
      const std::size_t count = option_count(bench_, keys_[i]);
      for (std::size_t option = 0; option < count; ++option) {
        if (option == own_[i]) continue;
        all.push_back(hypothesis);
        all.back().emplace(keys_[i], static_cast<std::uint8_t>(option));
      }
    }
    return all;
  }

  /// Throws Interrupted if the search is over.
  std::vector<Reach> reach_of(const std::vector<Hypothesis>& hypotheses) {
    std::vector<Reach> reaches(hypotheses.size());
    std::atomic<std::size_t> next = 0;
    std::exception_ptr failure;
    std::mutex mutex;
    const auto work = [&] {
      for (std::size_t i = next++; i < hypotheses.size() && !is_over(); i = next++) {
        try {
          reaches[i] = reach_of_one(hypotheses[i]);
          ++tried_;
          if (watch_.tally != nullptr) ++watch_.tally->tried;
        } catch (...) {
          const std::lock_guard lock(mutex);
          failure = std::current_exception();
        }
      }
    };
    const unsigned cores = settings_.threads != 0 ? settings_.threads : std::thread::hardware_concurrency();
    const std::size_t count = std::min<std::size_t>(std::max(1U, cores), hypotheses.size());
    std::vector<std::thread> threads;
    for (std::size_t i = 1; i < count; ++i) threads.emplace_back(work);
    work();
    for (std::thread& thread : threads) thread.join();
    if (failure) std::rethrow_exception(failure);
    for (std::size_t i = 0; i < hypotheses.size(); ++i)
      if (reaches[i].is_further_than(best_reach_)) note_best(hypotheses[i], reaches[i]);
    if (is_over()) throw Interrupted();
    return reaches;
  }

 private:
  void explain(Calibration& result) {
    std::vector<Hypothesis> level{Hypothesis()};
    plan(1);
    Reach best_reach = reach_of({Hypothesis()}).front();
    Hypothesis best;
    for (std::size_t depth = 0; depth <= kDeepest && !best_reach.is_whole && !level.empty(); ++depth) {
      std::vector<Hypothesis> further = further_than_parents(level);
      plan(further.size());
      const std::vector<Reach> reaches = reach_of(further);
      keep_best(further, reaches);
      if (further.empty()) break;
      level = std::move(further);
      best_reach = level_reaches_.front();
      best = level.front();
    }
    finish(result, best_reach.is_whole ? whole_ones(level) : std::vector{best}, best_reach);
  }

  static void finish(Calibration& result, std::vector<Hypothesis> explanations, const Reach& reach) {
    result.explains = reach.is_whole;
    result.explanations = std::move(explanations);
    result.capture = reach.capture;
    result.exchange = reach.exchange;
  }

  void try_each_option(Calibration& result) {
    if (watch_.tally != nullptr && watch_.tally->phase == CalibrateTally::Phase::explaining)
      watch_.tally->phase = CalibrateTally::Phase::trying_each;
    std::size_t options = 0;
    for (const ChoiceKey key : keys_) options += option_count(bench_, key);
    plan(options * result.explanations.size());
    for (std::size_t i = 0; i < keys_.size(); ++i) result.findings.push_back(finding_of(i, result));
  }

  bool is_over() const { return watch_.is_over && watch_.is_over(); }
  void plan(std::size_t hypotheses) {
    if (watch_.tally != nullptr) watch_.tally->planned += hypotheses;
  }
  void note_best(const Hypothesis& hypothesis, const Reach& reach) {
    best_ = hypothesis;
    best_reach_ = reach;
    // Later searches are about some of the captures.
    if (watch_.tally == nullptr || watch_.tally->phase != CalibrateTally::Phase::explaining) return;
    watch_.tally->explained = reach.explained;
    watch_.tally->captures = reach.is_whole ? captures_.size() : reach.capture;
  }

  void add_key(ChoiceKey key) {
    keys_.push_back(key);
    own_.push_back(option_in_bench(bench_, key));
  }

  /// A combination of options that the model refuses explains nothing.
  Reach reach_of_one(const Hypothesis& hypothesis) const {
    const world::Bench changed = bench_with(bench_, hypothesis);
    Reach reach;
    for (std::size_t i = 0; i < captures_.size(); ++i) {
      Comparison comparison;
      try {
        comparison = compare(changed, captures_[i], settings_.compare, Extent::to_difference);
      } catch (const std::runtime_error&) {
        reach.capture = i;
        return reach;
      }
      reach.fingerprint = reach.fingerprint * 31 + comparison.fingerprint;
      if (comparison.first_difference) {
        reach.explained += *comparison.first_difference;
        reach.capture = i;
        reach.exchange = *comparison.first_difference;
        reach.bytes = comparison.agreeing_bytes;
        return reach;
      }
      reach.explained += captures_[i].exchanges.size();
    }
    reach.is_whole = true;
    return reach;
  }

  /// Tries single options first. If none of them gets further, tries pairs: an option that changes any reply,
  /// with any other option.
  std::vector<Hypothesis> further_than_parents(const std::vector<Hypothesis>& level) {
    std::set<Hypothesis> found;
    for (const Hypothesis& parent : level) plan(1 + neighbours_of(parent).size());
    for (const Hypothesis& parent : level) {
      const Reach reach = reach_of({parent}).front();
      const std::vector<Hypothesis> singles = neighbours_of(parent);
      const std::vector<Reach> reaches = reach_of(singles);
      std::vector<Hypothesis> felt;
      for (std::size_t i = 0; i < singles.size(); ++i) {
        if (reaches[i].is_further_than(reach)) found.insert(singles[i]);
        if (reaches[i].fingerprint != reach.fingerprint) felt.push_back(singles[i]);
      }
      if (!found.empty()) continue;
      for (const Hypothesis& one : felt) plan(neighbours_of(one).size());
      for (const Hypothesis& one : felt) {
        const std::vector<Hypothesis> pairs = neighbours_of(one);
        const std::vector<Reach> of_pairs = reach_of(pairs);
        for (std::size_t i = 0; i < pairs.size(); ++i)
          if (of_pairs[i].is_further_than(reach)) found.insert(pairs[i]);
      }
    }
    return {found.begin(), found.end()};
  }

  /// Keeps those that get furthest, and all that explain everything.
  void keep_best(std::vector<Hypothesis>& hypotheses, const std::vector<Reach>& reaches) {
    std::vector<std::size_t> order(hypotheses.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::stable_sort(
        order, [&](std::size_t a, std::size_t b) { return reaches[a].is_further_than(reaches[b]); });
    std::vector<Hypothesis> kept;
    level_reaches_.clear();
    for (const std::size_t i : order) {
      if (kept.size() >= kWidth && !reaches[i].is_whole) break;
      kept.push_back(hypotheses[i]);
      level_reaches_.push_back(reaches[i]);
    }
    hypotheses = std::move(kept);
  }

  std::vector<Hypothesis> whole_ones(const std::vector<Hypothesis>& level) {
    if (level_reaches_.empty()) return level;
    std::vector<Hypothesis> whole;
    for (std::size_t i = 0; i < level.size(); ++i)
      if (level_reaches_[i].is_whole) whole.push_back(level[i]);
    return whole;
  }

  /// Tries each option of a choice in each explanation.
  RowFinding finding_of(std::size_t key_number, const Calibration& result) {
    const ChoiceKey key = keys_[key_number];
    RowFinding finding{.key = key, .before = own_[key_number]};
    const auto count = static_cast<std::uint8_t>(option_count(bench_, key));
    std::vector<Hypothesis> tried;
    for (const Hypothesis& explanation : result.explanations) {
      for (std::uint8_t option = 0; option < count; ++option) {
        tried.push_back(explanation);
        tried.back()[key] = option;
      }
    }
    const std::vector<Reach> reaches = reach_of(tried);
    std::set<std::uint64_t> fingerprints;
    for (std::size_t i = 0; i < tried.size(); ++i) {
      fingerprints.insert(reaches[i].fingerprint);
      if (reaches[i].is_whole) {
        finding.remaining.insert(static_cast<std::uint8_t>(i % count));
      } else if (!finding.capture) {
        finding.capture = reaches[i].capture;
        finding.place = captures_[reaches[i].capture].exchanges[reaches[i].exchange].place;
      }
    }
    using State = RowFinding::State;
    const bool is_felt = fingerprints.size() > result.explanations.size();
    finding.state = finding.remaining.size() == 1 ? State::measured
                    : is_felt || finding.capture  ? State::undecided
                                                  : State::not_exercised;
    return finding;
  }

  const world::Bench& bench_;
  const std::vector<Capture>& captures_;
  const CalibrateSettings& settings_;
  const CalibrateWatch& watch_;
  std::vector<ChoiceKey> keys_;
  std::vector<std::uint8_t> own_;  // the bench's options, one for each key
  std::vector<Reach> level_reaches_;
  Hypothesis best_;
  Reach best_reach_;
  std::atomic<std::size_t> tried_ = 0;
};

/// Looks for two captures that are explained one by one, but not together.
std::optional<std::pair<std::size_t, std::size_t>> contradictory_captures(
    const world::Bench& bench, const std::vector<Capture>& captures, const CalibrateSettings& settings,
    const CalibrateWatch& watch, std::size_t failed) {
  if (watch.tally != nullptr) watch.tally->phase = CalibrateTally::Phase::contradicting;
  const auto explains = [&](const std::vector<Capture>& some) {
    return Search(bench, some, settings, watch).run().explains;
  };
  if (captures.size() < 2 || !explains({captures[failed]})) return {};
  for (std::size_t i = 0; i < captures.size(); ++i) {
    if (i == failed || !explains({captures[i]}) || explains({captures[i], captures[failed]})) continue;
    return std::pair{std::min(i, failed), std::max(i, failed)};
  }
  return {};
}

}  // namespace

std::string choice_id(const world::Bench& bench, ChoiceKey key) {
  return key.row == ChoiceKey::kFirmware ? "firmware" : std::string(model_of(bench, key).choices[key.row].id);
}

std::string option_name(const world::Bench& bench, ChoiceKey key, std::uint8_t number) {
  const Model& model = model_of(bench, key);
  return key.row == ChoiceKey::kFirmware ? version_text(model.firmwares[number])
                                         : std::string(options_of(model.choices[key.row])[number]);
}

Calibration calibrate(const world::Bench& bench, const std::vector<Capture>& captures,
                      const CalibrateSettings& settings, const CalibrateWatch& watch) {
  Calibration found = Search(bench, captures, settings, watch).run();
  if (found.explains || found.is_interrupted) return found;
  // Options and the clock cannot be found at the same time, so one follows the other.
  CalibrateSettings with = settings;
  with.compare.drift_ppm = fit_drift(bench_with(bench, found.explanations.front()), captures[found.capture],
                                     settings.compare, watch.is_over);
  if (with.compare.drift_ppm != 0) {
    Calibration drifted = Search(bench, captures, with, watch).run();
    drifted.tried += found.tried;
    drifted.drift_ppm = with.compare.drift_ppm;
    if (drifted.explains) return drifted;
  }
  found.contradictory = contradictory_captures(bench, captures, with, watch, found.capture);
  found.is_interrupted = watch.is_over && watch.is_over();
  if (found.is_interrupted) found.contradictory.reset();
  return found;
}

std::vector<Hypothesis> remedies(const world::Bench& bench, const Capture& capture,
                                 std::size_t first_difference, const CalibrateSettings& settings,
                                 const CalibrateWatch& watch) {
  std::vector<Capture> until{capture};
  until.front().exchanges.resize(first_difference + 1);
  until.front().is_cut = true;  // so a missing reply at its end is a difference
  Search search(bench, until, settings, watch);
  std::vector<Hypothesis> good;
  const std::vector<Hypothesis> all = search.neighbours_of({});
  try {
    const std::vector<Reach> reaches = search.reach_of(all);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (reaches[i].is_whole) good.push_back(all[i]);
  } catch (const Interrupted&) {
    good.clear();
  }
  return good;
}

}  // namespace understudy::emulator::box
