#include "emulator/scenario/frame_log.h"

#include "emulator/scenario/frame_text.h"

namespace understudy::emulator {

namespace {

// A reply is read by its request, which several other stations' frames may have followed.
constexpr std::size_t kKept = 32;

}  // namespace

FrameLog::FrameLog(World& world) : world_(world) { watch(); }

FrameLog::~FrameLog() { ignore(); }

void FrameLog::watch() {
  for (std::size_t i = 0; i < world_.line_count(); ++i) {
    framers_.push_back(std::make_unique<pty::CaptureFrames>(
        i, world_.line(i).framing, [this](const pty::CapturedPacket& packet) { add(packet); },
        world_.line(i).protocol == Protocol::text));
    world_.line(i).line.add_observer(*framers_.back());
  }
}

void FrameLog::ignore() {
  for (std::size_t i = 0; i < framers_.size(); ++i) world_.line(i).line.remove_observer(*framers_[i]);
  framers_.clear();
}

void FrameLog::begin_anew() {
  ignore();
  frames_.clear();
  watch();
}

void FrameLog::add(const pty::CapturedPacket& packet) {
  // The oldest one's room is used again: this is done for every frame of a run.
  Frame frame;
  if (frames_.size() == kKept) {
    frame = std::move(frames_.front());
    frames_.pop_front();
  }
  frame.line = packet.line;
  frame.way = packet.way;
  frame.time = packet.time;
  frame.bytes.assign(packet.bytes.begin(), packet.bytes.end());
  frame.comment = comment_of(packet);
  frames_.push_back(std::move(frame));
}

const FrameLog::Frame* FrameLog::request_before(std::size_t reply) const {
  for (std::size_t i = reply; i-- > 0;) {
    if (frames_[i].line != frames_[reply].line || frames_[i].bytes.empty()) continue;
    return frames_[i].way == pty::Way::from_host ? &frames_[i] : nullptr;
  }
  return nullptr;
}

std::vector<std::string> FrameLog::last(std::size_t most) {
  for (const auto& framer : framers_) framer->finish();
  std::vector<std::string> texts;
  for (std::size_t i = frames_.size() - std::min(most, frames_.size()); i < frames_.size(); ++i) {
    const Frame& frame = frames_[i];
    std::string text = format_duration(frame.time) + " " + world_.line(frame.line).line.name();
    if (frame.bytes.empty()) {  // only what a fault has done
      text += frame.way == pty::Way::from_host ? " -> " : " <- ";
    } else if (frame.way == pty::Way::from_host) {
      text += " -> " + request_text(world_, frame.line, frame.bytes);
    } else {
      const Frame* const request = request_before(i);
      text += " <- " + reply_text(world_, frame.line,
                                  request == nullptr ? std::span<const std::uint8_t>() : request->bytes,
                                  frame.bytes);
    }
    if (!frame.comment.empty()) text += (frame.bytes.empty() ? "(" : "  (") + frame.comment + ")";
    texts.push_back(std::move(text));
  }
  return texts;
}

}  // namespace understudy::emulator
