#include "emulator/box/calibrate/evidence_file.h"

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/text/one_line.h"

namespace understudy::emulator::box {

namespace {

using nlohmann::json;

std::string text_in(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

const json* list_in(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_array() ? &*found : nullptr;
}

}  // namespace

EvidenceFile parse_evidence(std::string_view text, const std::string& path) {
  const auto refuse = [&](const std::string& what) {
    return EvidenceError(path + ": evidence: " + what + "; expected a file of `understudy calibrate -o`");
  };
  const json file = json::parse(text, nullptr, false);
  if (!file.is_object() || text_in(file, "kind") != "evidence") throw refuse("is none");
  const json* const devices = list_in(file, "devices");
  const json* const choices = list_in(file, "choices");
  if (devices == nullptr || choices == nullptr) throw refuse("has no devices or no choices");
  std::map<std::string, std::pair<std::string, std::string>> models;  // and firmware, by the device's name
  for (const json& device : *devices) {
    if (!device.is_object() || text_in(device, "model").empty()) throw refuse("has a device without a model");
    models[text_in(device, "name")] = {text_in(device, "model"), text_in(device, "firmware")};
  }
  EvidenceFile evidence{.path = path, .box = text_in(file, "box"), .rows = {}};
  for (const json& choice : *choices) {
    const std::string name = choice.is_object() ? text_in(choice, "choice") : "";
    const std::size_t point = name.find('.');
    const auto device = models.find(name.substr(0, point));
    const json* const options = choice.is_object() ? list_in(choice, "options") : nullptr;
    if (point == std::string::npos || device == models.end() || options == nullptr)
      throw refuse(quoted(name) + " is not a choice of a device in it");
    EvidenceRow row{.model = device->second.first,
                    .firmware = device->second.second,
                    .choice = name.substr(point + 1),
                    .state = text_in(choice, "state"),
                    .options = {},
                    .capture = text_in(choice, "capture")};
    for (const json& option : *options)
      if (option.is_string()) row.options.push_back(option.get<std::string>());
    if (const auto place = choice.find("place"); place != choice.end() && place->is_number_unsigned())
      row.place = place->get<std::size_t>();
    evidence.rows.push_back(std::move(row));
  }
  return evidence;
}

}  // namespace understudy::emulator::box
