#include "emulator/box/capture/exchange_builder.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/capture/rtu_frames.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator::box {

namespace {

/// Bytes of a frame come together within this time, also through an adapter that holds them back.
constexpr SimTime kLongestFrame = std::chrono::milliseconds(500);
/// Requests that may wait for a reply: masters of Modbus TCP do not always wait for one.
constexpr std::size_t kOpenRequests = 32;
constexpr std::size_t kPiecesToTellSides = 256;

/// Returns how clearly bytes are those of a host (positive) or of a controller.
int host_likeness(const std::vector<CapturedPiece>& pieces, Side side) {
  FrameFinder finder(FrameRole::either);
  for (const CapturedPiece& piece : pieces)
    if (piece.side == side) finder.add(piece);
  int likeness = 0;
  while (const auto frame = finder.next(nullptr, true)) {
    const FrameLength request = request_length(frame->bytes);
    const FrameLength reply = reply_length(frame->bytes);
    const auto fits = [&](const FrameLength& length) {
      return length.state == FrameLength::State::known && length.size == frame->bytes.size();
    };
    if (fits(request) && !fits(reply)) ++likeness;
    if (fits(reply) && !fits(request)) --likeness;
  }
  return likeness;
}

/// Returns true for a reply that is equal to its request.
bool repeats_request(const CapturedBytes& reply) {
  constexpr std::size_t kRepeats = 8;
  return reply.size() == kRepeats && (reply[1] == 0x05 || reply[1] == 0x06);
}

/// Returns true for the reply to a read, and for a refusal.
bool changes_nothing(const CapturedBytes& reply) {
  const std::uint8_t code = reply[1];
  return (code & 0x80) != 0 || (code >= 0x01 && code <= 0x04) || code == 0x07 || code == 0x0B ||
         code == 0x0C || code == 0x11 || code == 0x2B;
}

bool is_text(const CapturedBytes& bytes) {
  return std::ranges::all_of(bytes, [](std::uint8_t byte) {
    constexpr std::uint8_t kFirstControl = 0x08, kLastControl = 0x0D, kEscape = 0x1B;
    return (byte >= ' ' && byte <= '~') || (byte >= kFirstControl && byte <= kLastControl) || byte == kEscape;
  });
}

bool ends_line(std::uint8_t byte) { return byte == '\r' || byte == '\n'; }

}  // namespace

ExchangeBuilder::ExchangeBuilder(const std::string& path, const CaptureSettings& settings,
                                 CaptureNotes& notes, const ExchangeSink& sink)
    : path_(path), settings_(settings), notes_(notes), sink_(sink) {}

CaptureReadError ExchangeBuilder::refuse(std::size_t place, const std::string& what) const {
  return CaptureReadError(path_ + ":" + std::to_string(place) + ": " + what);
}

bool ExchangeBuilder::is_of_wanted_line(const CapturedPiece& piece) {
  // Only captures of a bench name its lines; what other files name is an interface or a server.
  const bool is_ours = piece.counts_from_power_up;
  if (is_ours && !settings_.line.empty() && piece.line != settings_.line) {
    others_ = piece.line;
    return false;
  }
  if (!has_pieces_) notes_.line = piece.line;
  if (piece.line != notes_.line)
    throw CaptureReadError(
        path_ + ": has several lines, " + quoted(notes_.line) + " and " + quoted(piece.line) +
        (is_ours ? "; expected --line with one of them" : "; expected a capture of one of them"));
  return true;
}

/// Bytes that are no text, with the checksum of a frame, are none by accident.
void ExchangeBuilder::require_protocol(const CapturedPiece& piece) const {
  if (!settings_.is_text || is_text(piece.bytes) || !pty::rtu_crc_ok(piece.bytes)) return;
  throw refuse(
      piece.place,
      "is a frame of Modbus, but the line of the bench speaks text; expected a capture of that line");
}

void ExchangeBuilder::require_rising_time(const CapturedPiece& piece) {
  if (!piece.at) {
    if (!settings_.every)
      throw refuse(
          piece.place,
          "has no times; expected a log with times (`ts` adds them while it is written), or --every 20ms, "
          "the time between requests");
    return;
  }
  std::optional<SimTime>& last =
      piece.side == Side::station || piece.side == Side::other ? station_last_ : host_last_;
  if (last && *piece.at < *last)
    throw refuse(piece.place, "the time of " +
                                  std::string(piece.side == Side::host ? "this request" : "these bytes") +
                                  " is before the last one; expected increasing times");
  last = piece.at;
  newest_ = std::max(newest_.value_or(*piece.at), *piece.at);
}

void ExchangeBuilder::add(CapturedPiece piece) {
  if (settings_.is_over && settings_.is_over()) throw CaptureInterrupted();
  if (piece.bytes.empty() || !is_of_wanted_line(piece)) return;
  require_protocol(piece);
  require_rising_time(piece);
  last_place_ = piece.place;
  if (!has_pieces_ && piece.at && !notes_.begins_at_power_up) first_ = notes_.first_at = *piece.at;
  has_pieces_ = true;
  if (piece.at) piece.at = *piece.at - first_;
  if ((piece.side == Side::one || piece.side == Side::other) && !host_) {
    hold_until_sides_are_known(std::move(piece));
    return;
  }
  add_with_side(std::move(piece));
}

void ExchangeBuilder::hold_until_sides_are_known(CapturedPiece piece) {
  held_.push_back(std::move(piece));
  // A whole exchange is needed at least. Then it is tried at every doubling.
  const std::size_t count = held_.size();
  if (settings_.is_text || count >= kPiecesToTellSides || (count >= 16 && (count & (count - 1)) == 0))
    decide_sides();
}

void ExchangeBuilder::decide_sides() {
  if (held_.empty()) return;
  const int one = settings_.is_text ? 0 : host_likeness(held_, Side::one);
  const int other = settings_.is_text ? 0 : host_likeness(held_, Side::other);
  // A controller does not speak first.
  host_ = one > other ? Side::one : other > one ? Side::other : held_.front().side;
  notes_.is_side_inferred = true;
  for (CapturedPiece& piece : std::exchange(held_, {})) add_with_side(std::move(piece));
}

void ExchangeBuilder::add_with_side(CapturedPiece piece) {
  if (piece.side == Side::one || piece.side == Side::other)
    piece.side = piece.side == *host_ ? Side::host : Side::station;
  if (settings_.is_text && !piece.is_frame) {
    add_text(std::move(piece));
    return;
  }
  if (piece.is_frame) {
    notes_.is_modbus_tcp = notes_.is_modbus_tcp || piece.pair != 0;
    FoundFrame frame{
        .bytes = std::move(piece.bytes), .at = piece.at, .place = piece.place, .pair = piece.pair};
    piece.side == Side::host ? take_request(std::move(frame)) : take_reply(std::move(frame), true);
    return;
  }
  is_mixed_ = is_mixed_ || piece.side == Side::unknown;
  if (piece.side == Side::unknown) {
    notes_.is_side_inferred = true;
    mixed_.add(piece);
  } else {
    (piece.side == Side::host ? requests_ : replies_).add(piece);
  }
  find_frames(false);
}

/// A line of the host ends with a carriage return; everything of the controller up to the next one is its
/// reply.
void ExchangeBuilder::add_text(CapturedPiece piece) {
  if (piece.side == Side::unknown)
    throw refuse(piece.place, "does not tell who sent a line of text; expected a capture that does");
  if (piece.side == Side::station) {
    FoundFrame sent{.bytes = std::move(piece.bytes), .at = piece.at, .place = piece.place};
    if (!text_line_) {
      take_reply(std::move(sent));
    } else if (!text_echo_) {
      text_echo_ = std::move(sent);
    } else {
      text_echo_->bytes.insert(text_echo_->bytes.end(), sent.bytes.begin(), sent.bytes.end());
    }
    return;
  }
  for (const std::uint8_t byte : piece.bytes) {
    // A line feed after the carriage return belongs to the line before.
    const bool is_second_end = !text_line_ && ends_line(byte) && !pending_.empty();
    if (is_second_end) continue;
    if (!text_line_) text_line_ = CapturedPiece{.at = piece.at, .side = Side::host, .place = piece.place};
    text_line_->bytes.push_back(byte);
    if (!ends_line(byte)) continue;
    take_request({.bytes = std::move(text_line_->bytes), .at = text_line_->at, .place = text_line_->place});
    text_line_.reset();
    // A controller that echoes answers each character before the line is over.
    if (text_echo_) take_reply(std::move(*text_echo_));
    text_echo_.reset();
  }
}

bool ExchangeBuilder::gives_up(const FrameFinder& finder, bool at_end) const {
  if (at_end) return true;
  const auto begins = finder.begins();
  return begins && newest_ && *newest_ - first_ > *begins + kLongestFrame;
}

void ExchangeBuilder::find_frames(bool at_end) {
  if (is_mixed_) take_mixed(at_end);
  take_sides(at_end);
}

void ExchangeBuilder::take_mixed(bool at_end) {
  while (true) {
    const bool waits_for_reply = !pending_.empty() && pending_.back().exchange.reply.empty();
    auto frame =
        mixed_.next(waits_for_reply ? &pending_.back().exchange.request : nullptr, gives_up(mixed_, at_end));
    if (const std::size_t dropped = mixed_.take_dropped(); dropped != 0) {
      // Nobody knows who sent them.
      note_broken_reply(dropped);
      lost_ += dropped;
      continue;
    }
    if (!frame) return;
    frame->role == FrameRole::request ? take_request(std::move(*frame)) : take_reply(std::move(*frame));
  }
}

void ExchangeBuilder::note_broken_reply(std::size_t bytes) {
  notes_.bytes_of_no_frame += bytes;
  if (!pending_.empty() && pending_.back().exchange.reply.empty())
    pending_.back().exchange.has_broken_reply = true;
}

/// Takes frames of both directions in their order in the file. A reply waits while the request before it may
/// still be completed; when the next request begins, the reply is over.
void ExchangeBuilder::take_sides(bool at_end) {
  while (true) {
    if (!next_request_) {
      next_request_ = requests_.next(nullptr, gives_up(requests_, at_end));
      if (const std::size_t dropped = requests_.take_dropped(); dropped != 0) {
        notes_.bytes_of_no_frame += dropped;
        lost_ += dropped;
        continue;
      }
    }
    const std::size_t request_at = next_request_           ? next_request_->place
                                   : !requests_.is_empty() ? requests_.begins_at_place()
                                                           : std::numeric_limits<std::size_t>::max();
    const bool is_first = !replies_.is_empty() && replies_.begins_at_place() < request_at;
    if (is_first) {
      const bool is_over = next_request_ || gives_up(replies_, at_end);
      auto reply = replies_.next(nullptr, is_over);
      if (const std::size_t dropped = replies_.take_dropped(); dropped != 0) {
        note_broken_reply(dropped);
        continue;
      }
      if (!reply) return;
      take_reply(std::move(*reply));
    } else if (next_request_) {
      take_request(std::move(*next_request_));
      next_request_.reset();
    } else {
      return;
    }
  }
}

void ExchangeBuilder::take_request(FoundFrame frame) {
  // One byte is a disturbance, as when a driver switches on.
  if (lost_ > 1) {
    follows_loss_ = true;
    ++notes_.lost_requests;
  }
  lost_ = 0;
  has_text_ = has_text_ || is_text(frame.bytes);
  const SimTime at = frame.at
                         ? *frame.at
                         : static_cast<std::int64_t>(notes_.exchanges) * settings_.every.value_or(SimTime{0});
  begin({.at = at, .request = std::move(frame.bytes), .place = frame.place}, frame.pair);
}

void ExchangeBuilder::begin(Exchange exchange, std::uint64_t pair) {
  exchange.follows_loss = follows_loss_;
  // A request that was restored from its reply has the reply's time, by another adapter's clock.
  exchange.at = last_at_ = std::max(last_at_, exchange.at);
  ++notes_.exchanges;
  pending_.push_back({.exchange = std::move(exchange), .pair = pair, .early = std::exchange(early_, {})});
  hand_on_all_but(pair == 0 ? 1 : kOpenRequests);
}

void ExchangeBuilder::hand_on_all_but(std::size_t count) {
  while (pending_.size() > count) {
    Pending first = std::move(pending_.front());
    pending_.pop_front();
    take_early(first);
    last_request_ = first.exchange.request;
    last_passed_at_ = first.exchange.at;
    sink_(std::move(first.exchange));
  }
}

/// Of two adapters, the one at the controller may have been the faster: the last of the early replies may
/// belong to this request. The requests of all others are missing.
void ExchangeBuilder::take_early(Pending& first) {
  std::vector<FoundFrame> early = std::exchange(first.early, {});
  const bool is_own = !early.empty() && first.exchange.reply.empty() &&
                      may_answer(first.exchange.request, early.back().bytes);
  if (is_own) {
    first.exchange.reply = std::move(early.back().bytes);
    early.pop_back();
  }
  for (const FoundFrame& unasked : early)
    if (account_for(unasked, first.exchange)) first.exchange.follows_loss = true;
}

/// A reply whose request is missing altogether. A write that the reply repeats is passed on before `next`; of
/// another one, the values are lost, and it returns true. The same reply once more is the echo of an adapter.
bool ExchangeBuilder::account_for(const FoundFrame& unasked, const Exchange& next) {
  const bool is_write = !settings_.is_text && unasked.bytes.size() >= 5 && !changes_nothing(unasked.bytes) &&
                        !may_answer(last_request_, unasked.bytes);
  if (is_write && repeats_request(unasked.bytes)) {
    ++notes_.restored_requests;
    ++notes_.exchanges;
    last_request_ = unasked.bytes;
    last_passed_at_ = std::clamp(unasked.at.value_or(next.at), last_passed_at_, next.at);
    sink_({.at = last_passed_at_,
           .request = unasked.bytes,
           .replied_at = unasked.at,
           .reply = unasked.bytes,
           .place = unasked.place,
           .follows_loss = next.follows_loss});
    return false;
  }
  ++notes_.unasked;
  if (!is_write) return false;
  ++notes_.lost_requests;
  follows_loss_ = true;
  for (Pending& later : pending_) later.exchange.follows_loss = true;
  return true;
}

/// A reply to a request that was not found tells what it was, if it repeats the request, and that it changed
/// nothing, if it is the reply to a read or a refusal.
bool ExchangeBuilder::restore_request(const FoundFrame& reply) {
  const bool repeats = repeats_request(reply.bytes);
  if (!repeats && !changes_nothing(reply.bytes)) return false;
  lost_ = 0;
  if (!repeats) return true;
  ++notes_.restored_requests;
  const SimTime at =
      reply.at.value_or(static_cast<std::int64_t>(notes_.exchanges) * settings_.every.value_or(SimTime{0}));
  begin({.at = at, .request = reply.bytes, .reply = reply.bytes, .place = reply.place}, 0);
  return true;
}

void ExchangeBuilder::take_reply(FoundFrame frame, bool is_whole_piece) {
  ++replies_taken_;
  const bool is_rtu = !settings_.is_text && frame.bytes.size() >= 5;
  if (is_rtu && lost_ > 1 && restore_request(frame)) return;
  auto found = pending_.rbegin();
  if (frame.pair != 0)
    found = std::find_if(pending_.rbegin(), pending_.rend(),
                         [&](const Pending& one) { return one.pair == frame.pair; });
  const bool has_place =
      found != pending_.rend() && (settings_.is_text || is_whole_piece || found->exchange.reply.empty());
  if (!has_place) {
    if (settings_.is_text) {
      ++notes_.unasked;
    } else {
      early_.push_back(std::move(frame));
    }
    return;
  }
  Exchange& exchange = found->exchange;
  if (!exchange.replied_at && frame.at) exchange.replied_at = frame.at;
  exchange.reply.insert(exchange.reply.end(), frame.bytes.begin(), frame.bytes.end());
}

void ExchangeBuilder::finish() {
  decide_sides();
  find_frames(true);
  notes_.unasked += early_.size();
  hand_on_all_but(0);
  if (notes_.exchanges == 0) {
    if (!others_.empty())
      throw CaptureReadError(path_ + ": has no line called " + quoted(settings_.line) +
                             "; expected one such as " + quoted(others_));
    if (notes_.bytes_of_no_frame != 0 && replies_taken_ == 0)
      throw CaptureReadError(
          path_ + ": has " + std::to_string(notes_.bytes_of_no_frame) +
          " bytes, but no frame of Modbus RTU or TCP; expected a capture of a line of this bench");
    throw CaptureReadError(path_ + ": has no request from a host; expected a capture of both directions");
  }
  if (settings_.is_text && !has_text_)
    throw CaptureReadError(path_ + ": none of its " + std::to_string(notes_.exchanges) +
                           " requests is a line of text, as the line of the bench has them; expected a "
                           "capture of that line");
  if (replies_taken_ == 0 && !notes_.begins_at_power_up)
    throw CaptureReadError(path_ + ": has " + std::to_string(notes_.exchanges) +
                           " requests, but no reply; expected a capture of both directions");
}

}  // namespace understudy::emulator::box
