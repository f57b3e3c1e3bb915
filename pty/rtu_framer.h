// Where a Modbus RTU frame ends: a value that a station feeds with characters and asks for frames.
//
// Two rules (docs/wire.md):
//  * strict: only silence ends a frame. A gap of `silence` or more between two characters (idle time,
//    from the stop bit's end to the next start bit) ends it; two frames without a gap are one.
//  * tolerant (default): a frame ends when its length is complete and its checksum right. What does
//    not complete that way (unknown function, wrong checksum) ends after `patience` of silence; a good
//    frame that follows noise, even without a gap, is found. A frame that lies inside another good one is
//    data, never a request: a candidate that may still become complete covers what is in it.
//    After that silence, a pause, a frame that has begun and whose length follows from what it begins with
//    waits for its rest for `rest_patience` in all; until then a good frame that begins behind a pause takes
//    its place.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "base/queue.h"
#include "pty/receive_error.h"
#include "pty/station.h"

namespace understudy::pty {

inline constexpr std::size_t kRtuMaxFrame = 256;  // address, 253 bytes of PDU, CRC

struct RtuFraming {
  bool strict = false;
  SimTime silence{0};  // the device's end-of-frame silence; also earliest reply after the last byte
  // Tolerant only, scaled by the pacer: how long what is incomplete waits (10 ms), and how long a frame of
  // known length does.
  SimTime patience{0};
  SimTime rest_patience{0};
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
  /// Judges what is incomplete now, without waiting for patience: the first time as after a pause, the second
  /// time as if nothing more would come.
  void give_up_waiting();

  /// When take() is worth calling: end of a complete frame plus the silence rule, or the patience of
  /// an incomplete one. Nothing while the buffer is empty.
  std::optional<SimTime> due() const;

  /// How many more characters may come at one moment before due() may be that moment (Station).
  std::size_t quiet_characters() const;

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
  std::uint64_t dropped_bytes() const { return state_.dropped; }

  // --- its state: the framing is not in it ---------------------------------------------------
  struct Mark {
    SimTime end{0};
    std::uint64_t number = 0;
  };
  struct Character {
    std::uint8_t value = 0;
    SimTime end{0};
    std::uint64_t number = 0;
  };
  /// What has been heard; the values lie side by side, as a checksum wants them.
  struct Characters {
    Queue<std::uint8_t> values;
    Queue<Mark> marks;  // of the same characters

    std::size_t size() const { return values.size(); }
    Character operator[](std::size_t number) const {
      return {values[number], marks[number].end, marks[number].number};
    }
    void push_back(const Character& character) {
      values.push_back(character.value);
      marks.push_back({character.end, character.number});
    }
    void pop_front(std::size_t count) {
      values.pop_front(count);
      marks.pop_front(count);
    }
    void clear() {
      values.clear();
      marks.clear();
    }
  };
  using Index = std::uint16_t;  // of a character
  struct Frame {
    Index first = 0;
    std::uint16_t size = 0;
  };
  /// The characters, from low to high index:  [ready frames, noise between them] [undecided]
  /// Within the undecided part, no frame begins before `candidate`; the one that may begin there needs
  /// looking at again when `look_again_at` bytes of it are in.
  /// That part never exceeds two frames: noise that may be the beginning of a long one, and a candidate.
  struct State {
    Characters characters;
    Queue<Frame> ready;
    Index undecided = 0;
    Index candidate = 0;
    std::uint16_t look_again_at = 0;
    bool is_paused = false;  // after the last character there was a pause, and its frame waits for the rest
    Index resumed = 0;       // the first character behind the last pause; 0: there was none
    // Bytes of this lump that are too many: strict those beyond the longest frame, which are not stored,
    // tolerant those that were given up before its end.
    std::uint64_t oversize = 0;
    SimTime last_end{0};
    bool character_under_way = false;
    std::uint64_t dropped = 0;
  };
  const State& save() const { return state_; }
  /// Throws std::invalid_argument if this framer cannot hold it.
  void check(const State& state) const;
  /// Like check(); if it throws, nothing has changed.
  void restore(const State& state);

 private:
  static constexpr std::size_t kCapacity = 3 * kRtuMaxFrame;  // characters

  Frame undecided() const;
  bool may_be_over() const;
  RtuFrame frame_at(const Frame& place) const;
  RtuFrame take_ready();
  SimTime patience() const;  // of the undecided part, under the rule in force
  SimTime usual_patience() const;
  bool is_silent(SimTime at) const;
  void be_silent_until(SimTime at);
  void search();
  void look_behind_pause();
  void end_of_silence();
  bool take_whole(Index first);
  bool take_good_ones();
  Index beginning(bool is_clean) const;
  void add_ready(Index first, std::uint16_t size);
  void decide_up_to(Index index);
  void drop_up_to(Index index);
  void add_error(ReceiveError error);
  void give_up_as_overlong(Index index);
  void forget_served();
  void drop_oldest();
  Index used() const { return static_cast<Index>(state_.characters.size()); }
  std::span<const std::uint8_t> bytes(std::size_t first, std::size_t last) const;

  RtuFraming framing_;
  State state_;
  std::array<std::uint32_t, 3> errors_{};  // not yet taken, by their kind
  std::uint32_t error_count_ = 0;          // of all kinds
};

}  // namespace understudy::pty
