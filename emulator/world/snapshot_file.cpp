// Reads and writes the JSON of snapshots. Only this file depends on the format.
#include "emulator/world/snapshot_file.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "base/simulated_time.h"
#include "base/state/base64.h"
#include "base/state/shared_text.h"
#include "base/state/state_bytes.h"
#include "base/text/one_line.h"
#include "base/version.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench/bench_text.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/strict_json.h"

namespace understudy::emulator::world {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSnapshotKind = "snapshot";
constexpr int kSnapshotFormat = 1;
constexpr int kDeepest = 2;  // the object that contains the parts, inside that of the file

std::string hex(std::uint64_t number) {
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(number));
  return digits.data();
}

std::uint64_t hash_of_text(std::string_view text, std::uint64_t onto) {
  return hash_of(std::as_bytes(std::span(text)), onto);
}

/// Returns a checksum of all parts and their names, which detects changes to the text.
std::uint64_t checksum(const WorldState& state) {
  std::uint64_t sum = hash_of_text(std::to_string(state.time.count()), hash_of({}));
  for (const WorldState::Part& part : state.parts) sum = hash_of(part.bytes, hash_of_text(part.name, sum));
  return sum;
}

const Json& require_key(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) throw SnapshotError(std::string(key) + ": is missing; expected a snapshot");
  return *found;
}

std::string text_of(const Json& object, const char* key) {
  const Json& text = require_key(object, key);
  if (!text.is_string()) throw SnapshotError(std::string(key) + ": is not text; expected a snapshot");
  return text.get<std::string>();
}

Json parse_json(const std::string& text) {
  static const std::set<std::string> kKnown{"understudy",        "kind",     "version", "bench",
                                            "simulated_time_ns", "checksum", "state"};
  Json parsed;
  try {
    parsed = parse_strict_json<Json>(
        text,
        [](const std::string& key) {
          return SnapshotError(understudy::quoted(key) + ": appears twice; expected it only once");
        },
        {.deepest = kDeepest});
  } catch (const TooDeepJson& error) {
    throw SnapshotError(std::string("file: ") + error.what() + "; expected a snapshot");
  } catch (const Json::exception&) {
    throw SnapshotError("file: is damaged or not JSON; expected a snapshot");
  }
  if (!parsed.is_object()) return parsed;
  for (const auto& [key, value] : parsed.items()) {
    if (!kKnown.contains(key)) {
      throw SnapshotError(understudy::quoted(key) + ": is not a key of a snapshot; expected none");
    }
  }
  return parsed;
}

std::optional<WorldState::Part> parse_part(const std::string& name, std::string_view text) {
  WorldState::Part part{.name = name, .bytes = {}};
  for (bool is_first = true; !text.empty() || is_first; is_first = false) {
    const std::size_t end = text.find('.');
    const auto decoded = from_base64(std::string(text.substr(0, end)));
    if (!decoded) return std::nullopt;
    if (is_first) {
      part.bytes = *decoded;
    } else {
      part.texts.emplace_back(std::string(reinterpret_cast<const char*>(decoded->data()), decoded->size()));
    }
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
    if (text.empty()) part.texts.emplace_back();
  }
  return part;
}

}  // namespace

std::uint64_t bench_hash(const Bench& bench) {
  Bench without_memories = bench;
  for (DeviceSetup& device : without_memories.devices) device.settings.nv.reset();
  return hash_of_text(to_text(without_memories), hash_of({}));
}

std::string to_text(const WorldState& state, std::uint64_t bench) {
  Json parts = Json::object();
  for (const WorldState::Part& part : state.parts) {
    // The bytes come first. Each text follows after a dot.
    std::string encoded = to_base64(part.bytes);
    for (const SharedText& text : part.texts) {
      encoded += '.';
      encoded += to_base64(std::as_bytes(std::span(text.text())));
    }
    parts[part.name] = std::move(encoded);
  }
  const Json file{{"understudy", kSnapshotFormat},
                  {"kind", kSnapshotKind},
                  {"version", program_version()},
                  {"bench", hex(bench)},
                  {"simulated_time_ns", state.time.count()},
                  {"checksum", hex(checksum(state))},
                  {"state", std::move(parts)}};
  return file.dump(2) + "\n";
}

WorldState parse_snapshot(const std::string& text, std::uint64_t bench) {
  const Json file = parse_json(text);
  if (!file.is_object() || !file.contains("understudy")) {
    throw SnapshotError("understudy: is missing; expected a snapshot");
  }
  if (!file["understudy"].is_number_integer() || file["understudy"] != kSnapshotFormat) {
    throw SnapshotError("understudy: has a different format; expected " + std::to_string(kSnapshotFormat));
  }
  if (text_of(file, "kind") != kSnapshotKind) {
    throw SnapshotError("kind: is " + understudy::quoted(text_of(file, "kind")) + "; expected " +
                        kSnapshotKind);
  }
  if (text_of(file, "version") != program_version()) {
    throw SnapshotError("version: was written by " + understudy::quoted(text_of(file, "version")) +
                        "; expected " + std::string(program_version()));
  }
  if (text_of(file, "bench") != hex(bench)) {
    throw SnapshotError("bench: is a different bench; expected the one that the snapshot was taken from");
  }
  WorldState state;
  const Json& time = require_key(file, "simulated_time_ns");
  if (!time.is_number_unsigned() ||
      time.get<std::uint64_t>() > static_cast<std::uint64_t>(kHorizon.count())) {
    throw SnapshotError("simulated_time_ns: is not a time; expected a whole number");
  }
  state.time = SimTime{time.get<std::int64_t>()};
  const Json& parts = require_key(file, "state");
  if (!parts.is_object()) throw SnapshotError("state: is not an object; expected the parts of a world");
  for (const auto& [name, bytes] : parts.items()) {
    auto part = bytes.is_string() ? parse_part(name, bytes.get_ref<const std::string&>()) : std::nullopt;
    if (!part) throw SnapshotError("state: " + understudy::quoted(name) + ": is not base64; expected bytes");
    state.parts.push_back(*std::move(part));
  }
  if (text_of(file, "checksum") != hex(checksum(state))) {
    throw SnapshotError("checksum: does not match the state; expected the file as it was written");
  }
  return state;
}

}  // namespace understudy::emulator::world
