#include "emulator/world/frames/frame_log.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <utility>
#include <vector>
#include "base/simulated_time.h"
#include "emulator/world/world.h"
#include "pty/capture.h"

namespace understudy::emulator::world {

FrameLog::FrameLog(World& world, std::size_t kept) : world_(world), kept_(kept) { watch(); }

FrameLog::~FrameLog() { ignore(); }

void FrameLog::watch() {
  for (std::size_t i = 0; i < world_.line_count(); ++i) {
    framers_.push_back(world_.line(i).packets(i, [this](const pty::CapturedPacket& packet) { add(packet); }));
    world_.add_observer(i, *framers_.back());
  }
}

void FrameLog::ignore() {
  for (std::size_t i = 0; i < framers_.size(); ++i) world_.remove_observer(i, *framers_[i]);
  framers_.clear();
}

void FrameLog::restart() {
  ignore();
  frames_.clear();
  watch();
}

std::vector<FrameLog::Frame> FrameLog::kept_since(std::uint64_t number, std::size_t max) const {
  const std::uint64_t first = next_number_ - frames_.size();
  const std::uint64_t from = std::clamp(number, first, next_number_);
  const auto count = static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(next_number_ - from, max));
  return {frames_.end() - count, frames_.end()};
}

void FrameLog::restart_after(std::vector<Frame> frames) {
  restart();
  next_number_ += frames.size();
  frames_.assign(std::move_iterator(frames.begin()), std::move_iterator(frames.end()));
  while (frames_.size() > kept_) frames_.pop_front();
}

void FrameLog::add(const pty::CapturedPacket& packet) {
  // The memory of the oldest frame is reused, because this code runs for every frame.
  if (frames_.size() == kept_) {
    frames_.push_back(std::move(frames_.front()));
    frames_.pop_front();
  } else {
    frames_.emplace_back();
  }
  Frame& frame = frames_.back();
  frame.line = packet.line;
  frame.direction = packet.direction;
  frame.time = packet.time;
  frame.bytes.assign(packet.bytes.begin(), packet.bytes.end());
  frame.comment.clear();
  frame.why = packet.why;
  pty::CapturedPacket without_why = packet;
  without_why.why = {};
  if (pty::has_comment(without_why)) frame.comment = pty::comment_of(without_why);
  frame.last_character = packet.last_character;
  frame.addressed.clear();
  if (packet.direction == pty::Direction::from_host && !packet.bytes.empty()) {
    const WorldLine& line = world_.line(packet.line);
    frame.addressed = line.protocol.addressed(line.stations, packet.bytes);
  }
  ++next_number_;
  if (observer_) observer_(packet);
}

/// Returns the request to which a reply belongs: the request that ended with the character in the reply, even
/// if other frames came in between. Replies without such a character, and lines of text, belong to the last
/// request. Only the first reply belongs to a request.
const FrameLog::Frame* FrameLog::request_before(std::size_t place) const {
  const Frame& reply = frames_[place];
  const bool is_named = reply.last_character != 0 && !world_.line(reply.line).protocol.carries_text();
  for (std::size_t i = place; i-- > 0;) {
    const Frame& frame = frames_[i];
    if (frame.line != reply.line || frame.bytes.empty()) continue;
    if (is_named && frame.last_character != reply.last_character) continue;
    return frame.direction == pty::Direction::from_host ? &frame : nullptr;
  }
  return nullptr;
}

/// Returns the device that a request addressed when it was sent. Without a request, returns the device that
/// the address in a reply refers to now.
const Device* FrameLog::device_of(const Frame* request, const Frame& frame) const {
  const WorldLine& line = world_.line(frame.line);
  if (request == nullptr) return line.device_addressed(frame.bytes);
  return request->addressed.empty() ? nullptr : &line.stations[request->addressed.front()]->device();
}

std::uint64_t FrameLog::number_of(const Frame& kept) const {
  const auto place =
      std::find_if(frames_.rbegin(), frames_.rend(), [&](const Frame& frame) { return &frame == &kept; });
  return next_number_ - 1 - static_cast<std::uint64_t>(place - frames_.rbegin());
}

FrameLog::Decoded FrameLog::decode(std::size_t place) const {
  const Frame& frame = frames_[place];
  const WorldLine& line = world_.line(frame.line);
  Decoded decoded{.number = next_number_ - frames_.size() + place,
                  .time = frame.time,
                  .line = line.line.name(),
                  .direction = frame.direction,
                  .text = {},
                  .remark = frame.comment,
                  .bytes = frame.bytes};
  if (frame.bytes.empty()) return decoded;  // the entry only reports the effect of a fault
  if (frame.direction == pty::Direction::from_host) {
    decoded.text = line.protocol.request_text(line.stations, device_of(&frame, frame), frame.bytes);
    for (const std::size_t station : frame.addressed)
      decoded.devices.push_back(&line.stations[station]->device());
    return decoded;
  }
  const Frame* const request = request_before(place);
  const auto bytes = request == nullptr ? std::span<const std::uint8_t>() : request->bytes;
  decoded.is_refusal = line.protocol.refuses(line.stations, frame.bytes);
  if (request != nullptr) {
    decoded.latency = frame.time - request->time;
    decoded.request = number_of(*request);
  }
  decoded.text = line.protocol.reply_text(line.stations, device_of(request, frame), bytes, frame.bytes);
  if (!frame.why.empty()) decoded.text += (decoded.is_refusal ? ": " : ", but ") + frame.why;
  decoded.is_ignored = !frame.why.empty() && !decoded.is_refusal;
  return decoded;
}

std::vector<FrameLog::Decoded> FrameLog::since(std::uint64_t number, std::size_t max) const {
  const std::uint64_t first = next_number_ - frames_.size();
  std::vector<Decoded> all;
  for (std::uint64_t next = std::max(number, first); next < next_number_ && all.size() < max; ++next) {
    all.push_back(decode(next - first));
  }
  return all;
}

std::optional<FrameLog::Decoded> FrameLog::request_of(std::uint64_t number) const {
  const std::uint64_t first = next_number_ - frames_.size();
  if (number < first || number >= next_number_) return std::nullopt;
  const std::size_t place = number - first;
  if (frames_[place].direction == pty::Direction::from_host) return std::nullopt;
  const Frame* const request = request_before(place);
  if (request == nullptr) return std::nullopt;
  return decode(number_of(*request) - first);
}

std::vector<std::string> FrameLog::last(std::size_t max) {
  for (const auto& framer : framers_) framer->finish();
  std::vector<std::string> texts;
  for (std::size_t i = frames_.size() - std::min(max, frames_.size()); i < frames_.size(); ++i) {
    const Decoded frame = decode(i);
    std::string text = format_duration(frame.time) + " " + frame.line +
                       (frame.direction == pty::Direction::from_host ? " -> " : " <- ") + frame.text;
    if (!frame.remark.empty()) text += (frame.text.empty() ? "(" : "  (") + frame.remark + ")";
    texts.push_back(std::move(text));
  }
  return texts;
}

}  // namespace understudy::emulator::world
