// Lists the kinds of faults and their fields, for forms.
#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/serve/control/look_messages.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/reply_task.h"
#include "emulator/serve/control/reply_text.h"
#include "emulator/world/bench_file/fault_schema.h"
#include "emulator/world/bench_file/schema.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/faults/kinds.h"

namespace understudy::emulator::serve {

namespace {

std::string_view place_word(world::FaultKindRow::Place place) {
  switch (place) {
    case world::FaultKindRow::Place::axis: return "axis";
    case world::FaultKindRow::Place::wheel: return "wheel";
    case world::FaultKindRow::Place::input: return "input";
    case world::FaultKindRow::Place::device: return "device";
    case world::FaultKindRow::Place::device_or_line: return "device_or_line";
    case world::FaultKindRow::Place::line: return "line";
  }
  return {};
}

std::string_view type_word(world::FaultFieldRow::ValueType type) {
  using ValueType = world::FaultFieldRow::ValueType;
  switch (type) {
    case ValueType::number: return "number";
    case ValueType::level: return "level";
    case ValueType::duration:
    case ValueType::ticks:
    case ValueType::even_ticks: return "duration";
    case ValueType::bytes: return "bytes";
    case ValueType::side: return "side";
  }
  return {};
}

std::string_view doc_of(std::string_view key) {
  for (const world::Key& row : world::kFaultKeys) {
    if (row.key == key) return row.doc;
  }
  return {};
}

/// Returns all words that a field accepts, if there are only a few.
std::vector<std::string_view> words_of(world::FaultFieldRow::ValueType type) {
  using ValueType = world::FaultFieldRow::ValueType;
  switch (type) {
    case ValueType::level: return {"on", "off"};
    case ValueType::side: return {"reply", "request", "both"};
    case ValueType::number:
    case ValueType::duration:
    case ValueType::ticks:
    case ValueType::even_ticks:
    case ValueType::bytes: break;
  }
  return {};
}

Json kind_of(const world::FaultKindRow& kind) {
  Json fields = Json::array();
  for (const world::FaultFieldRow& field : kind.fields) {
    Json entry{{"name", field.name},
               {"form", type_word(field.type)},
               {"required", field.required},
               {"doc", doc_of(field.name)}};
    if (field.type == world::FaultFieldRow::ValueType::number) {
      entry["lowest"] = field.lowest;
      entry["highest"] = field.highest;
    }
    for (const std::string_view word : words_of(field.type)) entry["words"].push_back(word);
    fields.push_back(std::move(entry));
  }
  return Json{{"name", kind.name},
              {"place", place_word(kind.place)},
              {"doc", doc_of(kind.name)},
              {"of_frames", world::is_of_frames(kind.kind)},
              {"fields", std::move(fields)}};
}

}  // namespace

ReplyTask faults_message(Daemon& daemon, Json message) {
  require_keys(message, {"do"});
  const Pause pause(daemon);
  ReplyText text;
  text.open_list("kinds");
  for (const world::FaultKindRow& kind : world::fault_kinds()) {
    text.element(kind_of(kind));
    co_await pause;
  }
  text.close_list();
  // In the table, the fields of the trigger come after those of the kinds, beginning with "function".
  text.open_list("trigger");
  const auto* const first = std::find_if(world::kFaultKeys.begin(), world::kFaultKeys.end(),
                                         [](const world::Key& row) { return row.key == "function"; });
  for (const auto* row = first; row != world::kFaultKeys.end(); ++row) {
    text.element({{"name", row->key}, {"doc", row->doc}});
  }
  text.close_list();
  co_return text.take();
}

}  // namespace understudy::emulator::serve
