// Named texts that a device stores immediately, such as files, recipes and macros. Copies of this class share
// the texts. The model's table lists the kinds and their limits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "base/state/fields.h"
#include "base/state/shared_text.h"
#include "emulator/device/memory/nv_image.h"

namespace understudy::emulator {

/// A kind of block, which is a row of the model's table.
struct BlockKind {
  std::string_view name;    // "files": a key of the image
  std::size_t max = 0;      // entries
  std::size_t longest = 0;  // bytes per entry
  /// Returns why an entry cannot have this name, or an empty text if it can. Null: any name is allowed.
  std::string (*why_not_called)(const std::string& name) = nullptr;
  /// Returns what is wrong with a text, "line 3: ...", or an empty text. Null: any text is allowed.
  std::string (*why_not_text)(const std::string& text) = nullptr;
};

class TextBlocks {
 public:
  TextBlocks() = default;
  explicit TextBlocks(std::span<const BlockKind> kinds) : kinds_(kinds) {}

  std::span<const BlockKind> kinds() const { return kinds_; }
  const NamedBlocks& all() const { return all_; }
  /// Returns the present texts as an object that never changes. A new object is created after each change.
  std::shared_ptr<const NamedBlocks> shared() const;
  /// Returns null if there is no such text.
  const SharedText* find(std::string_view kind, std::string_view name) const;

  /// Stores a text and returns "", or returns why it is refused; in that case, nothing changes. Storing the
  /// same text again changes nothing.
  std::string put(std::string_view kind, const std::string& name, SharedText text);
  /// Returns true if the text existed.
  bool erase(std::string_view kind, std::string_view name);
  /// Throws NvError, "blocks: files: 'A': what is wrong", for blocks that do not fit. The error includes the
  /// line in the file if it is known.
  void check(const NamedBlocks& blocks, const BlockLines& lines = {}) const;
  /// Replaces all texts. The caller must have called check().
  void replace(const NamedBlocks& blocks);
  /// Increases with every change.
  std::uint64_t revision() const { return revision_; }

  bool operator==(const TextBlocks& other) const {
    return revision_ == other.revision_ && all_ == other.all_;
  }

  // --- its state as bytes (StateOf<TextBlocks> below) --------------------------------------------
  void check_restored(const TextBlocks& earlier);

 private:
  template <class T>
  friend struct understudy::StateOf;
  const BlockKind* kind(std::string_view name) const;
  void changed();
  static std::string why_not(const BlockKind& kind, const std::string& name, const SharedText& text);

  std::uint64_t revision_ = 0;
  NamedBlocks all_;  // kinds without entries are omitted
  std::span<const BlockKind> kinds_;
  mutable std::shared_ptr<const NamedBlocks> shared_;  // `all_` at this revision, if requested
};

}  // namespace understudy::emulator

namespace understudy {

template <>
struct StateOf<emulator::TextBlocks> {
  using Value = emulator::TextBlocks;
  static constexpr auto fields = FieldList{field("blocks", &Value::all_), field<&Value::revision_>()};
  static constexpr std::size_t members = 4;
  static constexpr std::size_t apart = 2;  // the model's table, and values derived from the blocks
  static void name_all(Value& all) {       // does not compile if a member is missing
    [[maybe_unused]] auto& [revision, blocks, kinds, shared] = all;
  }
};

}  // namespace understudy
