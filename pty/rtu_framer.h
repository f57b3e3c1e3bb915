// Where a Modbus RTU frame ends: a value that a station feeds with characters and asks for frames.
//
// Two rules (docs/wire.md):
//  * strict: only silence ends a frame. A gap of `silence` or more between two characters (idle time,
//    from the stop bit's end to the next start bit) ends it; two frames without a gap are one.
//  * tolerant (default): a frame ends when its length is complete and its checksum right. What does
//    not complete that way (unknown function, wrong checksum, cut frame) ends after `patience` of
//    silence; a good frame that follows noise, even without a gap, is found. A frame that lies inside
//    another good one is data, never a request: a candidate that may still become complete covers what
//    is in it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "pty/receive_error.h"
#include "pty/station.h"

namespace understudy::pty {

inline constexpr std::size_t kRtuMaxFrame = 256;  // address, 253 bytes of PDU, CRC

struct RtuFraming {
  bool strict = false;
  SimTime silence{0};   // the device's end-of-frame silence; also earliest reply after the last byte
  SimTime patience{0};  // tolerant only: how long an incomplete frame waits (10 ms, scaled by the pacer)
};

/// A frame with a right checksum. `bytes` includes address and CRC.
struct RtuFrame {
  std::array<std::uint8_t, kRtuMaxFrame> bytes{};
  std::size_t size = 0;
  SimTime end{0};                    // when its last character was over
  std::uint64_t last_character = 0;  // its number
};

/// How long a request that begins with these bytes is, by its function and its byte count; nothing if they do
/// not say.
std::optional<std::size_t> rtu_request_size(std::span<const std::uint8_t> bytes);

class RtuFramer {
 public:
  explicit RtuFramer(RtuFraming framing = {});

  /// A character has begun (Station::hear_start_bit): until it comes, the silence is over. Optional;
  /// without it only the times of push() count, and take() may end a frame under a character's feet.
  void start_bit(SimTime at);
  /// Characters must come in the order of time.
  void push(const TimedByte& byte);
  /// Forget what is buffered (another station used the line).
  void reset();
  /// Nothing more will come of what is incomplete: judge it now, without waiting for patience.
  void give_up_waiting();

  /// When take() is worth calling: end of a complete frame plus the silence rule, or the patience of
  /// an incomplete one. Nothing while the buffer is empty.
  std::optional<SimTime> due() const;

  /// At due() or later: the next good frame, or nothing (noise, bad checksum: dropped and counted).
  /// Call again while it returns a frame or due() is not later than now.
  std::optional<RtuFrame> take(SimTime now);

  /// Calls take() as often as is useful until a good frame comes: nothing when there are none left. For
  /// loops, which it always ends.
  std::optional<RtuFrame> take_due(SimTime now);

  /// The frame that take() would give if no silence had to be waited for: a complete one, or under the strict
  /// rule all that has come since the last silence, if its checksum is right. For a device that is too quick.
  std::optional<RtuFrame> peek() const;
  std::optional<RtuFrame> take_early();

  const RtuFraming& framing() const { return framing_; }

  /// Number of the first character that is in a frame not taken yet, or may still become part of one;
  /// nothing if there is none. What came before it was taken or dropped.
  std::optional<std::uint64_t> first_open_character() const;

  /// What was wrong with something that it has dropped since the last call, once for what came without a
  /// silence or a good frame between. Call again while it returns one. To be asked after each of the calls
  /// above: what nobody has asked for is not part of the state.
  std::optional<ReceiveError> take_error();
  bool has_errors() const { return error_count_ != 0; }

  /// Noise, wrong checksums, cut frames, and what did not fit; not what reset() forgot.
  std::uint64_t dropped_bytes() const { return dropped_; }

  // --- its state -----------------------------------------------------------------------------
  /// What it holds, in as many words as it takes; the framing is not in it.
  struct State {
    struct Character {
      std::uint8_t value = 0;
      SimTime end{0};
      std::uint64_t number = 0;
    };
    struct Frame {
      std::uint16_t first = 0;  // of the characters
      std::uint16_t size = 0;
    };
    std::vector<Character> characters;
    std::vector<Frame> ready;
    std::uint16_t undecided = 0;  // of the characters, as the next two
    std::uint16_t candidate = 0;
    std::uint16_t look_again_at = 0;
    std::uint64_t oversize = 0;
    SimTime last_end{0};
    bool character_under_way = false;
    std::uint64_t dropped = 0;
  };
  State save() const;
  /// Throws std::invalid_argument if this framer cannot hold it.
  void check(const State& state) const;
  /// Like check(); if it throws, nothing has changed.
  void restore(const State& state);

 private:
  // The buffer, from low to high index:  [served] [ready frames, noise between them] [undecided]
  // Within the undecided part, no frame begins before `candidate_`; the one that may begin there needs
  // looking at again when `look_again_at_` bytes of it are in.
  // That part never exceeds two frames: noise that may be the beginning of a long one, and a candidate.
  static constexpr std::size_t kCapacity = 3 * kRtuMaxFrame;
  static constexpr std::size_t kMaxReady = kCapacity / 4;

  struct Mark {
    SimTime end{0};
    std::uint64_t number = 0;
  };
  struct Ready {
    std::uint16_t first = 0;
    std::uint16_t size = 0;
  };

  bool may_be_over() const;
  RtuFrame frame_at(std::size_t first, std::size_t size) const;
  RtuFrame take_ready();
  SimTime patience() const;  // of the undecided part, under the rule in force
  bool is_silent(SimTime at) const;
  void search();
  void end_of_silence();
  void add_ready(std::size_t first, std::size_t size);
  void decide_up_to(std::size_t index);
  void drop_up_to(std::size_t index);
  void add_error(ReceiveError error);
  void give_up_as_overlong(std::size_t index);
  void rewind_if_empty();
  void make_room();
  std::span<const std::uint8_t> bytes(std::size_t first, std::size_t last) const;

  RtuFraming framing_;
  std::array<std::uint8_t, kCapacity> values_{};
  std::array<Mark, kCapacity> marks_{};   // of the same characters
  std::array<Ready, kMaxReady> ready_{};  // a ring
  std::size_t ready_first_ = 0;
  std::size_t ready_count_ = 0;
  std::size_t used_ = 0;
  std::size_t undecided_ = 0;
  std::size_t candidate_ = 0;
  std::size_t look_again_at_ = 0;
  // Bytes of this lump that are too many: strict those beyond the longest frame, which are not stored,
  // tolerant those that were given up before its end.
  std::uint64_t oversize_ = 0;
  SimTime last_end_{0};
  bool character_under_way_ = false;
  std::uint64_t dropped_ = 0;
  std::array<std::uint32_t, 3> errors_{};  // not yet taken, by their kind
  std::uint32_t error_count_ = 0;          // of all kinds
};

}  // namespace understudy::pty
