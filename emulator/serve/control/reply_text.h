// The text of a reply, written member by member: one that is long need not be a tree of JSON first, nor be
// made all at once.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "emulator/serve/control/message_fields.h"

namespace understudy::emulator::serve {

/// As it stands in a reply. Names and programs come from outside and may not be UTF-8.
std::string text_of(const Json& json);

class ReplyText {
 public:
  /// An object, which says that the message was obeyed.
  ReplyText() : text_("{\"ok\":true") {}

  /// A member of an object.
  void member(std::string_view key, const Json& value);
  /// All members of another object.
  void members(const Json& object);
  /// An element of a list.
  void element(const Json& value);
  void element(std::int64_t value);
  /// Begins an object or a list, that is a member, or an element.
  void open_object(std::string_view key) { open(key, '{'); }
  void open_list(std::string_view key) { open(key, '['); }
  void open_object();
  void open_list();
  void close_object() { text_ += '}'; }
  void close_list() { text_ += ']'; }
  /// The whole of it.
  std::string take();

 private:
  void open(std::string_view key, char bracket);
  void separate();
  void begin_member(std::string_view key);

  std::string text_;
};

}  // namespace understudy::emulator::serve
