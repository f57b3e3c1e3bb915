#include "emulator/box/compare/asked_choices.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/choices.h"
#include "emulator/device/decisions.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/world/view/world_view.h"

namespace understudy::emulator::box {

AskedChoices::AskedChoices(const world::WorldLine& line) : line_(line) {
  for (const auto& station : line_.stations) last_.emplace_back(station->device().model().choices.size());
  note(0);
  agree();
}

void AskedChoices::note(std::size_t place) {
  ++noted_;
  for (std::size_t i = 0; i < last_.size(); ++i) {
    Decisions& decisions = line_.stations[i]->device().decisions();
    for (std::size_t row = 0; row < last_[i].size(); ++row) {
      if (decisions.is_asked(row)) last_[i][row] = {.note = noted_, .place = place};
    }
    decisions.begin();
  }
}

std::vector<AskedChoice> AskedChoices::latest_first() const {
  std::vector<std::pair<std::size_t, AskedChoice>> asked;  // with the numbers of their notes
  for (std::size_t i = 0; i < last_.size(); ++i) {
    const Device& device = line_.stations[i]->device();
    const auto rows = device.model().choices;
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const Last& last = last_[i][row];
      const std::vector<std::string_view> options = options_of(rows[row]);
      if (options.size() < 2 || last.note == 0) continue;
      asked.emplace_back(last.note, AskedChoice{.choice = device.name() + "." + std::string(rows[row].id),
                                                .option = std::string(options[device.choice(row)]),
                                                .section = std::string(rows[row].section),
                                                .place = last.place,
                                                .is_since_agreement = last.note > agreed_});
    }
  }
  std::ranges::stable_sort(asked, std::ranges::greater{}, &std::pair<std::size_t, AskedChoice>::first);
  std::vector<AskedChoice> choices;
  for (auto& [note, choice] : asked) choices.push_back(std::move(choice));
  return choices;
}

}  // namespace understudy::emulator::box
