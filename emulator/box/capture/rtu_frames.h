// Finds frames of Modbus in bytes by their content: length by function, and checksum. Gaps are no help, since
// adapters cut and join bytes anywhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>

#include "base/simulated_time.h"
#include "emulator/box/capture/capture.h"

namespace understudy::emulator::box {

enum class FrameRole : std::uint8_t { request, reply, either };

struct FoundFrame {
  CapturedBytes bytes{};  // as on a serial line: of Modbus TCP, with its checksum instead of the header
  FrameRole role = FrameRole::request;  // not `either`
  std::optional<SimTime> at{};
  std::size_t place = 0;
  std::uint64_t pair = 0;
};

/// The length of the frame that begins with `bytes`.
struct FrameLength {
  enum class State : std::uint8_t { known, needs_more, none } state = State::none;
  std::size_t size = 0;  // with the checksum
};
FrameLength request_length(std::span<const std::uint8_t> bytes);
FrameLength reply_length(std::span<const std::uint8_t> bytes);

/// Returns true if `reply` can answer `request`: station, function and repeated fields agree.
bool may_answer(std::span<const std::uint8_t> request, std::span<const std::uint8_t> reply);

struct TcpFrame {
  CapturedBytes bytes{};
  std::size_t size = 0;  // on TCP
  std::uint16_t transaction = 0;
};
/// Converts the Modbus TCP frame at the beginning of `bytes` into a serial frame. Returns nothing if there is
/// no complete one. Other bytes may follow the frame.
std::optional<TcpFrame> take_tcp_frame(std::span<const std::uint8_t> bytes);

/// Bytes of one direction, or of both if `role` is `either`.
class FrameFinder {
 public:
  explicit FrameFinder(FrameRole role) : role_(role) {}

  void add(const CapturedPiece& piece);
  /// Returns the next frame. Bytes that do not begin a frame are dropped, and counted in take_dropped().
  /// While a frame may still be completed, returns nothing, unless `gives_up`. `pending` is the request that
  /// is waiting for a reply. Also returns nothing if bytes were dropped, so that they can be accounted for
  /// before the next frame.
  std::optional<FoundFrame> next(const CapturedBytes* pending, bool gives_up);

  bool is_empty() const { return begin_ == bytes_.size(); }
  // The first byte that does not belong to a frame yet:
  std::optional<SimTime> begins() const;
  std::size_t begins_at_place() const { return marks_.empty() ? 0 : marks_.front().place; }
  /// Returns how many bytes were dropped since the last call.
  std::size_t take_dropped();

 private:
  struct Mark {           // of a piece
    std::size_t end = 0;  // counted from the first byte ever added
    std::optional<SimTime> at{};
    std::size_t place = 0;
  };
  /// One interpretation of the beginning of the bytes.
  struct Match {
    std::size_t size = 0;  // 0: it is no frame, or not a whole one yet
    FrameRole role = FrameRole::request;
    bool answers = false;  // it answers the pending request
    bool is_tcp = false;
    bool waits = false;  // more bytes may make it a frame
  };
  std::span<const std::uint8_t> rest() const { return std::span(bytes_).subspan(begin_); }
  Match match(const CapturedBytes* pending) const;
  Match match_as(FrameRole role, const CapturedBytes* pending) const;
  Match match_tcp(const CapturedBytes* pending) const;
  FoundFrame take(const Match& match);
  void drop(std::size_t count);

  FrameRole role_;
  CapturedBytes bytes_;
  std::deque<Mark> marks_;
  std::size_t begin_ = 0;   // in bytes_
  std::size_t passed_ = 0;  // bytes before that
  std::size_t dropped_ = 0;
};

}  // namespace understudy::emulator::box
