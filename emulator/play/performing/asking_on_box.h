// Queries real controllers for the values of the names in expressions. Only performance_on_box.cpp includes
// this file.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "base/text/parse_real.h"
#include "emulator/play/performing/asked_names.h"
#include "emulator/play/performing/performance_on_box.h"
#include "emulator/play/scenario/requests.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/protocol/received_lines.h"

namespace understudy::emulator::play {

class Performance::OnBox::Asking {
 public:
  Asking(OnBox& on_box, Via via)
      : on_box_(on_box), names_(on_box.performance_.world_observers_->world), via_(via) {}

  world::Expression parse(const std::string& text) const { return world::parse_expression(text, names_); }

  /// Queries all names in an expression. Throws Skip if a value is not available.
  void ask(const world::Expression& expression) {
    std::vector<Target> targets;
    std::vector<std::int32_t> handles;
    for (const std::int32_t handle : world::names_in(expression)) {
      const AskedNames::Place place = names_.place_of(handle);
      if (place.reg) {
        on_box_.require_reachable(place.reg->device, via_);
        targets.push_back(*place.reg);
        handles.push_back(handle);
      } else if (place.device) {
        on_box_.require_reachable(*place.device, via_);
        names_.set(handle, query(place));
      } else if (place.is_time) {
        names_.set(handle, on_box_.performance_.executor_->now().count());
      } else {
        names_.set(handle, reported(place.name));
      }
    }
    read(targets, handles);
  }
  const AskedNames& names() const { return names_; }

 private:
  void read(const std::vector<Target>& targets, const std::vector<std::int32_t>& handles) {
    if (targets.empty()) return;
    Performance& performance = on_box_.performance_;
    // Sorted by address, so that neighbouring registers are read in one request.
    std::vector<bool> low_word_first;
    const std::vector<Words> words = performance.words_of_all(targets, low_word_first);
    std::vector<std::size_t> order(targets.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::stable_sort(order, {}, [&](std::size_t i) {
      return std::tuple(words[i].device, words[i].table, words[i].first);
    });
    std::vector<Target> sorted;
    for (const std::size_t i : order) sorted.push_back(targets[i]);
    const auto came = performance.read_over_line(sorted, {}, via_);
    for (std::size_t i = 0; i < order.size(); ++i) {
      const Value value = value_in(sorted[i], came[i], low_word_first[order[i]]);
      names_.set(handles[order[i]], number_of(sorted[i], value).value_or(0));
    }
  }

  world::Number query(const AskedNames::Place& place) {
    Performance& performance = on_box_.performance_;
    const world::LinesWanted single{.lines = {""}, .is_answer = true};
    const std::size_t line = performance.lines_[*place.device].front();
    if (const auto why = on_box_.box_.why_no_query(line)) throw Skip(*why, true);
    const std::vector<std::string> lines =
        performance.executor_->exchange_text(line, place.query, single, std::chrono::milliseconds(500));
    for (const std::string& received : lines) {
      const std::size_t begin = received.find_first_not_of("> ");
      if (begin == std::string::npos) continue;
      if (const auto value = parse_real(received.substr(begin))) return world::finite_number(*value);
    }
    throw Skip(place.query + " is not answered with a number:  " + world::lines_text(lines), true);
  }

  world::Number reported(const std::string& name) {
    const auto text = on_box_.box_.tell(name);
    const auto value = text ? parse_real(*text) : std::nullopt;
    if (value) return world::finite_number(*value);
    throw Skip(name + " cannot be read over the line", true);
  }

  OnBox& on_box_;
  AskedNames names_;
  Via via_;
};

}  // namespace understudy::emulator::play
