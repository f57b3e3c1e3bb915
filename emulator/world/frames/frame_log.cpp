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
  // The memory of the oldest frame is reused, because this runs for every frame.
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
  if (pty::has_comment(packet)) frame.comment = pty::comment_of(packet);
  ++next_number_;
  if (observer_) observer_(packet);
}

const FrameLog::Frame* FrameLog::request_before(std::size_t reply) const {
  for (std::size_t i = reply; i-- > 0;) {
    if (frames_[i].line != frames_[reply].line || frames_[i].bytes.empty()) continue;
    return frames_[i].direction == pty::Direction::from_host ? &frames_[i] : nullptr;
  }
  return nullptr;
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
  if (frame.bytes.empty()) return decoded;  // the entry only reports what a fault did
  if (frame.direction == pty::Direction::from_host) {
    decoded.text = line.request_text(frame.bytes);
    return decoded;
  }
  const Frame* const request = request_before(place);
  const auto bytes = request == nullptr ? std::span<const std::uint8_t>() : request->bytes;
  decoded.is_refusal = line.protocol.refuses(line.stations, frame.bytes);
  if (request != nullptr) decoded.latency = frame.time - request->time;
  decoded.text = line.reply_text(bytes, frame.bytes);
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
  for (std::size_t i = place; request != nullptr && i-- > 0;) {
    if (&frames_[i] == request) return decode(i);
  }
  return std::nullopt;
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
