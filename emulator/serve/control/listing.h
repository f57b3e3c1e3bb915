// Writes frames or events to a reply, one after another.
#pragma once

#include <cstddef>
#include <cstdint>

#include "emulator/serve/control/reply_text.h"

namespace understudy::emulator::serve {

class Daemon;

class Listing {
 public:
  enum class What : std::uint8_t { frames, events };

  /// Starts at the entry `first`. With `is_raw`, frames include their bytes and latency.
  Listing(Daemon& daemon, What what, std::uint64_t first, bool is_raw = false)
      : daemon_(daemon), what_(what), is_raw_(is_raw), next_(first) {}

  /// Performs one step, which may add one entry. Returns false if no entries are left, or if the reply is
  /// full.
  bool add_next(ReplyText& text);
  /// Returns the number with which the next request continues.
  std::uint64_t next() const { return next_; }

 private:
  bool add_frame(ReplyText& text);
  bool add_event(ReplyText& text);

  Daemon& daemon_;
  What what_;
  bool is_raw_;
  std::uint64_t next_;
  std::size_t count_ = 0;
};

}  // namespace understudy::emulator::serve
