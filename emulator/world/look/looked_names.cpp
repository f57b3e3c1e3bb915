#include "emulator/world/look/looked_names.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/world/names/names.h"
#include "emulator/world/probe/probes.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

namespace {

constexpr std::string_view kDriver = "@by";

struct TerminalPlace {
  std::size_t device = 0;
  int terminal = 0;
};

/// Finds "feeder.DIN_3", or "DIN_3" if there is only one device.
std::optional<TerminalPlace> find_place(const KnownDevices& devices, std::string_view name) {
  for (std::size_t i = 0; i < devices.size(); ++i) {
    std::string_view rest = name;
    if (rest.starts_with(devices[i].name) && rest.substr(devices[i].name.size()).starts_with('.')) {
      rest.remove_prefix(devices[i].name.size() + 1);
    } else if (devices.size() > 1) {
      continue;
    }
    if (const int terminal = find_terminal(*devices[i].model, rest); terminal >= 0)
      return TerminalPlace{i, terminal};
  }
  return std::nullopt;
}

}  // namespace

std::string to_text(const TerminalDrivers& drivers) {
  std::string text;
  const auto add = [&](bool is_one, const char* word) {
    if (is_one) text += (text.empty() ? "" : "+") + std::string(word);
  };
  add(drivers.device, "device");
  add(drivers.fault, "fault");
  add(drivers.held, "held");
  add(drivers.machine, "machine");
  add(drivers.wire, "wire");
  return text;
}

TerminalDrivers drivers_of(const World& world, std::size_t device, int terminal) {
  const TerminalRow& row = world.device(device).model().terminals[static_cast<std::size_t>(terminal)];
  if (!is_input(row.kind)) return {.device = world.device(device).powered()};
  const World::Input& input = world.input(device, terminal);
  return {.fault = input.stuck.has_value(),
          .held = row.kind == TerminalRow::Kind::digital_in && input.external != 0,
          .machine = input.plant,
          .wire = input.wired};
}

LookedNames::List* LookedNames::find_list(std::uint64_t number) {
  const auto found =
      std::find_if(lists_.begin(), lists_.end(), [&](const List& one) { return one.number == number; });
  return found == lists_.end() ? nullptr : &*found;
}

const LookedNames::List* LookedNames::find_list(std::uint64_t number) const {
  const auto found =
      std::find_if(lists_.begin(), lists_.end(), [&](const List& one) { return one.number == number; });
  return found == lists_.end() ? nullptr : &*found;
}

bool LookedNames::is_kept(std::uint64_t number) const { return find_list(number) != nullptr; }

/// Frees space for a list with this number of names.
void LookedNames::make_room(std::size_t names) {
  // Probes keep all names forever, so they are replaced from time to time.
  if (!probes_ || resolved_ + names > 4 * kMaxKept) {
    lists_.clear();
    probes_.emplace(world_);
    resolved_ = 0;
  }
  const auto kept = [&] {
    std::size_t sum = 0;
    for (const List& list : lists_) sum += list.names.size();
    return sum;
  };
  while (!lists_.empty() && (lists_.size() >= kMaxLists || kept() + names > kMaxKept)) {
    lists_.erase(std::min_element(lists_.begin(), lists_.end(),
                                  [](const List& a, const List& b) { return a.looked_at < b.looked_at; }));
  }
}

std::uint64_t LookedNames::keep(const std::vector<std::string>& names) {
  const auto same =
      std::find_if(lists_.begin(), lists_.end(), [&](const List& one) { return one.names == names; });
  if (same != lists_.end()) return same->number;
  make_room(names.size());
  List& list = lists_.emplace_back();
  list.number = ++last_number_;
  list.looked_at = ++looks_;
  list.names = names;
  list.known.resize(names.size());
  return last_number_;
}

void LookedNames::begin(std::uint64_t number) {
  List* const list = find_list(number);
  if (list == nullptr) return;
  list->looked_at = ++looks_;
  list->left.clear();
  std::vector<bool> power(world_.device_count());
  for (std::size_t i = 0; i < power.size(); ++i) power[i] = world_.device(i).powered();
  const bool tries_all = power != list->power;
  const auto is_unknown = [&](std::size_t i) { return list->known[i].what == Known::What::nothing; };
  if (tries_all) {
    list->power = std::move(power);
    for (std::size_t i = list->names.size(); i-- > 0;) {
      if (is_unknown(i)) list->left.push_back(i);
    }
    return;
  }
  for (std::size_t looked = 0; looked < list->names.size() && list->left.size() < kTriedAgain; ++looked) {
    list->next_again = (list->next_again + 1) % list->names.size();
    if (is_unknown(list->next_again)) list->left.push_back(list->next_again);
  }
}

bool LookedNames::look_up_next(std::uint64_t number) {
  List* const list = find_list(number);
  if (list == nullptr || list->left.empty()) return false;
  const std::size_t place = list->left.back();
  list->left.pop_back();
  list->known[place] = find(list->names[place]);
  return true;
}

LookedNames::Known LookedNames::find(const std::string& name) {
  if (name.ends_with(kDriver)) {
    const auto place =
        find_place(world_.known(), std::string_view(name).substr(0, name.size() - kDriver.size()));
    if (!place) return {};
    return {.what = Known::What::driver, .device = place->device, .terminal = place->terminal};
  }
  try {
    Known known{.what = Known::What::value, .handle = probes_->resolve(name).handle};
    ++resolved_;
    static_cast<void>(probes_->value(known.handle));  // throws for a name that only scenarios have
    if (const auto device = probes_->device_read(known.handle)) {
      known.needs_power = true;
      known.device = *device;
    }
    return known;
  } catch (const NameError&) {
    return {};
  }
}

LookedNames::Looked LookedNames::value_of(const Known& known) const {
  switch (known.what) {
    case Known::What::nothing: return {};
    case Known::What::driver: return drivers_of(world_, known.device, known.terminal);
    case Known::What::value: break;
  }
  if (known.needs_power && !world_.device(known.device).powered()) return {};
  return probes_->value(known.handle);
}

bool LookedNames::look(std::uint64_t number, std::vector<Looked>& values) const {
  const List* const list = find_list(number);
  if (list == nullptr) return false;
  values.clear();
  values.reserve(list->known.size());
  for (const Known& known : list->known) values.push_back(value_of(known));
  return true;
}

}  // namespace understudy::emulator::world
