// Writes the text of a reply member by member, so that a long reply does not need a JSON tree and can be
// written in pieces.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "emulator/serve/control/message_fields.h"

namespace understudy::emulator::serve {

/// Returns JSON in the form for replies. Names and programs come from outside and may not be valid UTF-8.
std::string text_of(const Json& json);

class ReplyText {
 public:
  /// Begins an object that reports success.
  ReplyText() : text_("{\"ok\":true") {}

  /// Adds a member to an object.
  void member(std::string_view key, const Json& value);
  /// Adds all members of another object.
  void members(const Json& object);
  /// Adds an element to a list.
  void element(const Json& value);
  void element(std::int64_t value);
  /// Begin an object or a list as a member, or as an element.
  void open_object(std::string_view key) { open(key, '{'); }
  void open_list(std::string_view key) { open(key, '['); }
  void open_object();
  void open_list();
  void close_object() { text_ += '}'; }
  void close_list() { text_ += ']'; }
  /// Returns the whole text.
  std::string take();

 private:
  void open(std::string_view key, char bracket);
  void separate();
  void begin_member(std::string_view key);

  std::string text_;
};

}  // namespace understudy::emulator::serve
