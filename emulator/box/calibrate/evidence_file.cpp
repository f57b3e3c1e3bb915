#include "emulator/box/calibrate/evidence_file.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/files/sha256.h"
#include "base/text/one_line.h"

namespace understudy::emulator::box {

namespace {

using nlohmann::json;
using WrittenJson = nlohmann::ordered_json;

std::string text_in(const json& object, const char* key) {
  if (!object.is_object()) return "";
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

std::size_t number_in(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number_unsigned() ? found->get<std::size_t>() : 0;
}

const json* list_in(const json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found != object.end() && found->is_array() ? &*found : nullptr;
}

std::vector<std::string> texts_in(const json& list) {
  std::vector<std::string> texts;
  for (const json& one : list)
    if (one.is_string()) texts.push_back(one.get<std::string>());
  return texts;
}

std::string joined(const std::vector<std::string>& texts, const char* between) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : between) + text;
  return all;
}

}  // namespace

EvidenceFile parse_evidence(std::string_view text, const std::string& path) {
  const auto refuse = [&](const std::string& what) {
    return EvidenceError(path + ": evidence: " + what +
                         "; expected a file of `understudy calibrate -o` or `probe -o`");
  };
  const json file = json::parse(text, nullptr, false);
  if (text_in(file, "kind") != "evidence") throw refuse("is none");
  const json* const devices = list_in(file, "devices");
  const json* const choices = list_in(file, "choices");
  if (devices == nullptr || choices == nullptr) throw refuse("has no devices or no choices");
  EvidenceFile evidence{.path = path,
                        .sha256 = sha256_of(text),
                        .box = text_in(file, "box"),
                        .bench = text_in(file, "bench"),
                        .port = text_in(file, "port"),
                        .is_explained = file.value("explained", json(true)) == json(true),
                        .is_interrupted = file.value("interrupted", json(false)) == json(true)};
  for (const json& device : *devices) {
    if (text_in(device, "model").empty()) throw refuse("has a device without a model");
    evidence.devices.push_back(
        {text_in(device, "name"), text_in(device, "model"), text_in(device, "firmware")});
  }
  if (const json* const captures = list_in(file, "captures"))
    for (const json& one : *captures)
      if (one.is_object())
        evidence.captures.push_back(
            {text_in(one, "file"), number_in(one, "exchanges"), text_in(one, "sha256")});
  if (const json* const two = list_in(file, "contradictory")) evidence.contradictory = texts_in(*two);
  for (const json& choice : *choices) {
    const std::string name = text_in(choice, "choice");
    const std::size_t point = name.find('.');
    const auto device = std::ranges::find(evidence.devices, name.substr(0, point), &EvidenceDevice::name);
    const json* const options = list_in(choice, "options");
    if (point == std::string::npos || device == evidence.devices.end() || options == nullptr)
      throw refuse(quoted(name) + " is not a choice of a device in it");
    evidence.rows.push_back({.device = device->name,
                             .model = device->model,
                             .firmware = device->firmware,
                             .choice = name.substr(point + 1),
                             .state = text_in(choice, "state"),
                             .options = texts_in(*options),
                             .expected = text_in(choice, "expected"),
                             .capture = text_in(choice, "capture"),
                             .place = number_in(choice, "place"),
                             .proof = text_in(choice, "proof")});
  }
  return evidence;
}

std::string evidence_text(const EvidenceFile& evidence) {
  WrittenJson file{{"understudy", 1}, {"kind", "evidence"}};
  const auto add = [](WrittenJson& to, const char* key, const std::string& text) {
    if (!text.empty()) to[key] = text;
  };
  add(file, "box", evidence.box);
  add(file, "bench", evidence.bench);
  add(file, "port", evidence.port);
  file["devices"] = WrittenJson::array();
  for (const EvidenceDevice& one : evidence.devices)
    file["devices"].push_back({{"name", one.name}, {"model", one.model}, {"firmware", one.firmware}});
  if (!evidence.captures.empty()) {
    file["captures"] = WrittenJson::array();
    for (const EvidenceCapture& one : evidence.captures)
      file["captures"].push_back({{"file", one.file}, {"exchanges", one.exchanges}, {"sha256", one.sha256}});
    file["explained"] = evidence.is_explained;
    if (evidence.is_interrupted) file["interrupted"] = true;
    file["drift_ppm"] = evidence.drift_ppm;
  }
  if (!evidence.contradictory.empty()) file["contradictory"] = evidence.contradictory;
  file["choices"] = WrittenJson::array();
  for (const EvidenceRow& row : evidence.rows) {
    WrittenJson written{
        {"choice", row.label()}, {"state", row.state}, {"options", row.options}, {"expected", row.expected}};
    add(written, "capture", row.capture);
    if (!row.capture.empty()) written["place"] = row.place;
    add(written, "proof", row.proof);
    add(written, "why_not", one_line(row.why_not));
    for (const auto& [option, why] : row.seen) written["seen"][option] = one_line(why);
    file["choices"].push_back(std::move(written));
  }
  return file.dump(1, ' ', false, WrittenJson::error_handler_t::replace) + "\n";
}

std::string evidence_table(const EvidenceFile& evidence, std::string_view remark) {
  std::string text;
  for (const EvidenceRow& row : evidence.rows) {
    if (row.state == kEvidenceStates.back()) continue;
    const bool is_new = row.state == kEvidenceStates.front() && row.options.front() != row.expected;
    std::string state = row.state;
    state.resize(std::max(state.size(), kEvidenceStates[1].size()), ' ');
    text += "  " + state + " " + row.label() + ": " +
            (row.options.empty() ? "none of its options" : joined(row.options, " or ")) +
            (is_new ? "  (" + std::string(remark) + ")" : "") + "\n";
  }
  std::string counts;
  for (const std::string_view state : kEvidenceStates) {
    const auto count = std::ranges::count(evidence.rows, state, &EvidenceRow::state);
    counts += (counts.empty() ? "" : ", ") + std::to_string(count) + " " + std::string(state);
  }
  std::ranges::replace(counts, '_', ' ');
  text += counts + "\n";
  std::map<std::string, int> reasons;
  for (const EvidenceRow& row : evidence.rows)
    if (!row.why_not.empty()) ++reasons[one_line(row.why_not)];
  for (const auto& [why, count] : reasons)
    text += "  " + std::to_string(count) + " not exercised: " + why + "\n";
  return text;
}

}  // namespace understudy::emulator::box
