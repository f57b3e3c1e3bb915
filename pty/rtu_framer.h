// Finds where Modbus RTU frames end. A framer is a value: a station pushes characters and takes frames.
//
// There are two rules (docs/wire.md):
//  * strict: only silence ends a frame. A gap of `silence` or more between two characters (idle time,
//    from the stop bit's end to the next start bit) ends it; two frames without a gap are one.
//  * tolerant (default): a frame ends when its length is complete and its checksum right. Characters that do
//    not form such a frame (unknown function, wrong checksum) end after `patience` of silence. A good frame
//    that follows noise, even without a gap, is found. A frame inside another good one is data, never a
//    request: a candidate that may still become complete covers the frames in it.
//    That silence is a pause. An incomplete frame whose first bytes determine its length waits for its rest
//    after a pause, for `rest_patience` in total. If a good frame begins after the pause in the meantime, it
//    replaces the incomplete one.
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
  SimTime silence{0};  // the device's end-of-frame silence; also the earliest reply after the last byte
  // Used only by the tolerant rule, scaled by the pacer: how long incomplete characters wait (10 ms), and
  // how long an incomplete frame of known length waits.
  SimTime patience{0};
  SimTime rest_patience{0};
};

/// A frame with a right checksum. `bytes` includes the address and the CRC.
struct RtuFrame {
  std::array<std::uint8_t, kRtuMaxFrame> bytes{};
  std::size_t size = 0;
  SimTime end{0};                    // when its last character was over
  std::uint64_t last_character = 0;  // its number
};

/// Returns the length of a request that begins with these bytes, by its function and byte count, or nothing
/// if they do not determine it.
std::optional<std::size_t> rtu_request_size(std::span<const std::uint8_t> bytes);

class RtuFramer {
 public:
  explicit RtuFramer(RtuFraming framing = {});

  /// Reports that a character has begun (Station::on_start_bit), which ends a silence before the character
  /// has arrived. Optional: without it only the times of push() count, and take() may end a frame in the
  /// middle the index of a character.
  void start_bit(SimTime at);
  /// Adds a character. Characters must be added in chronological order.
  void push(const TimedByte& byte);
  /// Forgets all characters (another station used the line).
  void reset();
  /// Checks an incomplete frame now, without waiting for the timeout: the first call acts as a pause, the
  /// second as if no more characters would come.
  void give_up_waiting();

  /// Returns when take() is worth calling: at the end of a complete frame plus its silence, or after the
  /// patience for an incomplete one. Nothing while no characters are undecided or ready.
  std::optional<SimTime> due() const;

  /// Returns how many more characters may arrive at one moment before due() may be that moment (Station).
  std::size_t quiet_characters() const;

  /// Returns the next good frame, at due() or later, or nothing if noise or a bad checksum was dropped and
  /// counted. Call it again while it returns a frame or due() is not later than `now`.
  std::optional<RtuFrame> take(SimTime now);

  /// Calls take() until it returns a good frame, and returns nothing if no frame is left. Meant for loops:
  /// it always ends them.
  std::optional<RtuFrame> take_due(SimTime now);

  /// Returns the frame that take() would return without waiting for silence: a complete one or, under the
  /// strict rule, all characters since the last silence, if their checksum is right. Meant for a device that
  /// answers too early.
  std::optional<RtuFrame> peek() const;
  std::optional<RtuFrame> take_early();

  const RtuFraming& framing() const { return framing_; }

  /// Returns the number of the first character that is in a frame not taken yet, or may still become part of
  /// one, or nothing if there is none. All characters before it were taken or dropped.
  std::optional<std::uint64_t> first_open_character() const;

  /// Returns an error in characters dropped since the last call: one for all characters without a silence or
  /// a good frame between them. Call it again while it returns one, after each of the calls above: errors
  /// that were not taken are not part of the state.
  std::optional<ReceiveError> take_error();
  bool has_errors() const { return error_count_ != 0; }

  /// Returns the number of dropped bytes: noise, wrong checksums, cut frames, and characters that did not
  /// fit, but not those that reset() forgot.
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
  /// Received characters. Their values are contiguous, as the checksum needs them.
  struct Characters {
    Queue<std::uint8_t> values;
    Queue<Mark> marks;  // the marks of the same characters

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
  /// The characters, from low to high index, are [ready frames with noise between them] [undecided]. In the
  /// undecided part no frame begins before `candidate`. A frame that may begin there is judged again when it
  /// has `search_again_at` bytes. The undecided part never exceeds two frames: noise that may be the
  /// beginning of a long frame, and a candidate.
  struct State {
    Characters characters;
    Queue<Frame> ready;
    Index undecided = 0;
    Index candidate = 0;
    std::uint16_t search_again_at = 0;
    bool is_paused = false;  // there was a pause after the last character, and its frame waits for the rest
    Index resumed = 0;       // the first character after the last pause; 0: there was no pause
    // The number of characters of this lump that are too many. Strict: those beyond the longest frame, which
    // are not stored. Tolerant: those that were given up before the end of the lump.
    std::uint64_t oversize = 0;
    SimTime last_end{0};
    bool character_under_way = false;
    std::uint64_t dropped = 0;
  };
  const State& save() const { return state_; }
  /// Throws std::invalid_argument if this framer cannot hold the state.
  void check(const State& state) const;
  /// Checks the state, then puts it into effect. If it throws, nothing has changed.
  void restore(const State& state);

 private:
  static constexpr std::size_t kCapacity = 3 * kRtuMaxFrame;  // characters

  Frame undecided() const;
  bool may_be_over() const;
  RtuFrame frame_at(const Frame& place) const;
  RtuFrame take_ready();
  SimTime patience() const;  // for the undecided part, under the rule in effect
  SimTime usual_patience() const;
  bool is_silent(SimTime at) const;
  void be_silent_until(SimTime at);
  void search();
  void check_after_pause();
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
