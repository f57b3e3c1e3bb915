// Lists the kinds of faults and their fields, for forms.
#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/serve/control/look_messages.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/reply_task.h"
#include "emulator/serve/control/reply_text.h"
#include "emulator/world/bench_file/fault_form.h"
#include "emulator/world/bench_file/form.h"
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

std::string_view form_word(world::FaultFieldRow::Schema form) {
  using Schema = world::FaultFieldRow::Schema;
  switch (form) {
    case Schema::number: return "number";
    case Schema::level: return "level";
    case Schema::duration:
    case Schema::ticks:
    case Schema::even_ticks: return "duration";
    case Schema::bytes: return "bytes";
    case Schema::side: return "side";
  }
  return {};
}

std::string_view doc_of(std::string_view key) {
  for (const world::Key& row : world::kFaultKeys) {
    if (row.key == key) return row.doc;
  }
  return {};
}

/// Returns all words that a field can have, if there are only a few.
std::vector<std::string_view> words_of(world::FaultFieldRow::Schema form) {
  using Schema = world::FaultFieldRow::Schema;
  switch (form) {
    case Schema::level: return {"on", "off"};
    case Schema::side: return {"reply", "request", "both"};
    case Schema::number:
    case Schema::duration:
    case Schema::ticks:
    case Schema::even_ticks:
    case Schema::bytes: break;
  }
  return {};
}

Json kind_of(const world::FaultKindRow& kind) {
  Json fields = Json::array();
  for (const world::FaultFieldRow& field : kind.fields) {
    Json entry{{"name", field.name},
               {"form", form_word(field.form)},
               {"required", field.required},
               {"doc", doc_of(field.name)}};
    if (field.form == world::FaultFieldRow::Schema::number) {
      entry["lowest"] = field.lowest;
      entry["highest"] = field.highest;
    }
    for (const std::string_view word : words_of(field.form)) entry["words"].push_back(word);
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
  // In the table, the trigger's fields come after those of the kinds, from "function" on.
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
