#include "emulator/box/photograph/photo_file.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/text/parse_real.h"
#include "emulator/box/asking/asked.h"
#include "emulator/box/photograph/photograph.h"
#include "emulator/box/wire/wire.h"

namespace understudy::emulator::box {

namespace {

using OrderedJson = nlohmann::ordered_json;

std::string hex_of(const Bytes& bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    char pair[4];
    std::snprintf(pair, sizeof pair, "%02X", byte);
    text += (text.empty() ? "" : " ") + std::string(pair);
  }
  return text;
}

std::int64_t in_microseconds(WallTime time) {
  return std::chrono::duration_cast<std::chrono::microseconds>(time).count();
}

/// Returns a number if JSON writes it with the same digits, and a text otherwise.
OrderedJson json_value(const std::string& text) {
  OrderedJson number = OrderedJson::parse(text, nullptr, false);
  if (number.is_number() && number.dump() == text) return number;
  return text;
}

OrderedJson place_of(const std::string& table, std::uint16_t address) {
  char text[8];
  std::snprintf(text, sizeof text, "0x%04X", address);
  return table + "." + text;
}

}  // namespace

Latencies latencies_of(const Photograph& photo) {
  std::vector<WallTime> all;
  for (const Asked& asked : photo.exchanges)
    if (!asked.reply.empty()) all.push_back(asked.latency);
  if (all.empty()) return {};
  std::ranges::sort(all);
  return {.min = all.front(), .median = all[all.size() / 2], .max = all.back()};
}

std::string photo_json(const Photograph& photo) {
  OrderedJson json;
  json["understudy"] = 1;
  json["kind"] = "photograph";
  json["model"] = photo.model;
  json["port"] = photo.place;
  if (!photo.line.empty()) json["line"] = photo.line;
  if (photo.station >= 0) json["station"] = photo.station;
  json["echo"] = photo.is_echoing;
  if (!photo.ended.empty()) json["ended"] = photo.ended;
  const Latencies latencies = latencies_of(photo);
  json["latency_us"] = {{"least", in_microseconds(latencies.min)},
                        {"median", in_microseconds(latencies.median)},
                        {"most", in_microseconds(latencies.max)}};
  json["values"] = OrderedJson::array();
  for (const PhotoValue& value : photo.values) {
    OrderedJson row{{"name", value.name}};
    if (!value.table.empty()) row["place"] = place_of(value.table, value.address);
    row["value"] = json_value(value.value);
    json["values"].push_back(row);
  }
  json["refused"] = OrderedJson::array();
  for (const PhotoRefusal& refusal : photo.refused) {
    OrderedJson row{{"name", refusal.name}};
    if (!refusal.table.empty()) row["place"] = place_of(refusal.table, refusal.address);
    row["why"] = refusal.why;
    json["refused"].push_back(row);
  }
  json["not_in_image"] = OrderedJson::array();
  for (const auto& [name, why] : photo.left_out)
    json["not_in_image"].push_back({{"name", name}, {"why", why}});
  json["exchanges"] = OrderedJson::array();
  for (const Asked& asked : photo.exchanges) {
    json["exchanges"].push_back({{"request", hex_of(asked.request)},
                                 {"reply", hex_of(asked.reply)},
                                 {"us", in_microseconds(asked.latency)}});
  }
  return json.dump(1) + "\n";
}

}  // namespace understudy::emulator::box
