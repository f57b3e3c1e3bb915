#include "emulator/device/memory/text_blocks.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/state/shared_text.h"
#include "base/state/state_error.h"
#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "base/text/utf8.h"
#include "emulator/device/memory/nv_entry_error.h"
#include "emulator/device/memory/nv_image.h"

namespace understudy::emulator {

const BlockKind* TextBlocks::kind(std::string_view name) const {
  const auto found =
      std::find_if(kinds_.begin(), kinds_.end(), [&](const BlockKind& one) { return one.name == name; });
  return found == kinds_.end() ? nullptr : &*found;
}

const SharedText* TextBlocks::find(std::string_view kind, std::string_view name) const {
  const auto entries = all_.find(kind);
  if (entries == all_.end()) return nullptr;
  const auto found = entries->second.find(name);
  return found == entries->second.end() ? nullptr : &found->second;
}

std::shared_ptr<const NamedBlocks> TextBlocks::shared() const {
  if (!shared_) shared_ = std::make_shared<const NamedBlocks>(all_);
  return shared_;
}

void TextBlocks::changed() {
  ++revision_;
  shared_.reset();
}

std::string TextBlocks::why_not(const BlockKind& kind, const std::string& name, const SharedText& text) {
  const std::string& letters = text.text();
  if (name.empty()) return "has no name; expected one";
  if (first_not_utf8(name)) return "has a name that is not UTF-8; expected text";
  if (const auto at = first_not_utf8(letters)) {
    const auto end = letters.begin() + static_cast<std::ptrdiff_t>(*at);
    return "line " + std::to_string(1 + std::count(letters.begin(), end, '\n')) +
           ": is not UTF-8; expected text";
  }
  if (letters.size() > kind.longest) {
    return "has " + std::to_string(letters.size()) + " bytes; expected at most " +
           std::to_string(kind.longest);
  }
  if (kind.why_not_called != nullptr) {
    if (auto why = kind.why_not_called(name); !why.empty()) return why;
  }
  return kind.why_not_text != nullptr ? kind.why_not_text(letters) : "";
}

std::string TextBlocks::put(std::string_view kind, const std::string& name, SharedText text) {
  const BlockKind* const of = this->kind(kind);
  if (of == nullptr) return quoted(std::string(kind)) + " is not a kind of block";
  const SharedText* const before = find(kind, name);
  if (before != nullptr && *before == text) return "";
  if (std::string why = why_not(*of, name, text); !why.empty()) return why;
  const auto there = all_.find(kind);
  if (before == nullptr && (there == all_.end() ? 0 : there->second.size()) >= of->max) {
    return "there is no room; expected at most " + std::to_string(of->max);
  }
  all_[std::string(kind)][name] = std::move(text);
  changed();
  return "";
}

bool TextBlocks::erase(std::string_view kind, std::string_view name) {
  const auto entries = all_.find(kind);
  if (entries == all_.end()) return false;
  const auto found = entries->second.find(name);
  if (found == entries->second.end()) return false;
  entries->second.erase(found);
  if (entries->second.empty()) all_.erase(entries);
  changed();
  return true;
}

void TextBlocks::check(const NamedBlocks& blocks, const BlockLines& lines) const {
  const auto refuse = [&](const std::string& kind_name, const std::string& name, const std::string& whose,
                          const std::string& why) {
    const auto line = lines.find({kind_name, name});
    throw NvEntryError(NvEntryError::List::blocks, kind_name, name, why, "blocks: " + whose + why,
                       line == lines.end() ? 0 : line->second);
  };
  for (const auto& [kind_name, entries] : blocks) {
    const BlockKind* const of = kind(kind_name);
    if (of == nullptr) {
      std::vector<std::string> known;
      for (const BlockKind& one : kinds_) known.emplace_back(one.name);
      refuse(kind_name, {}, "", quoted(kind_name) + " is not a kind of block" + suggestion(kind_name, known));
    }
    if (entries.size() > of->max) {
      refuse(
          kind_name, {}, kind_name + ": ",
          "has " + std::to_string(entries.size()) + " entries; expected at most " + std::to_string(of->max));
    }
    for (const auto& [name, text] : entries) {
      const std::string why = why_not(*of, name, text);
      if (!why.empty()) refuse(kind_name, name, kind_name + ": " + quoted(name) + ": ", why);
    }
  }
}

void TextBlocks::replace(const NamedBlocks& blocks) {
  NamedBlocks without_empty = blocks;
  std::erase_if(without_empty, [](const auto& kind) { return kind.second.empty(); });
  if (without_empty == all_) return;
  all_ = std::move(without_empty);
  changed();
}

void TextBlocks::check_restored(const TextBlocks& earlier) {
  kinds_ = earlier.kinds_;
  shared_.reset();
  // Only blocks that have changed are checked again, because parsing a megabyte of programs takes ten times
  // as long as the rest.
  NamedBlocks fresh = all_;
  for (auto& [kind_name, entries] : fresh) {
    std::erase_if(entries, [&, of = kind_name](const auto& entry) {
      const SharedText* const before = earlier.find(of, entry.first);
      return before != nullptr && *before == entry.second;
    });
  }
  try {
    check(fresh);
  } catch (const NvError& wrong) {
    throw StateError(wrong.what());
  }
  for (const auto& [name, entries] : all_) {
    require_state(!entries.empty(), "a kind of block is empty");
    require_state(entries.size() <= kind(name)->max, "a kind of block has too many entries");
  }
}

}  // namespace understudy::emulator
