#include "emulator/world/stations/text_station.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "emulator/device/text/text_device.h"
#include "emulator/world/stations/station_fields.h"
#include "pty/state_reach.h"

namespace understudy::emulator::world {

using Heard = pty::HeardText::What;

namespace {

std::vector<std::uint8_t> bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

pty::TextLineRules rules_of(const TextSpeaker& speaker) {
  const TextRules rules = speaker.text_rules();
  return {.longest = rules.longest_line,
          .echoes = rules.echo,
          .line_feed_ends = rules.line_feed_ends,
          .has_flow_control = rules.has_flow_control,
          .echoed_end = rules.echoed_end};
}

TextSpeaker& speaker_of(Device& device) {
  if (device.speaker() == nullptr) throw std::logic_error(device.name() + ": does not speak text");
  return *device.speaker();
}

}  // namespace

TextStation::TextStation(Device& device, bool is_instant)
    : LineStation(device), speaker_(speaker_of(device)), is_instant_(is_instant) {}

void TextStation::hear(const pty::TimedByte& byte) {
  if (!device_.powered()) return;
  const pty::TextLineRules rules = rules_of(speaker_);
  pty::TextLines::Outcome outcome = lines_.push(byte, rules);
  if (!rules.echoes) outcome.echo.clear();
  if (!outcome.heard && outcome.echo.empty()) return;
  pty::HeardText heard{.end = byte.end, .last_character = byte.number};
  if (outcome.heard) heard = std::move(*outcome.heard);
  waiting_.push_back({outcome.heard.has_value(), std::move(heard), std::move(outcome.echo)});
}

std::optional<pty::SimTime> TextStation::due() const {
  std::optional<pty::SimTime> due;
  const auto offer = [&](pty::SimTime at) { due = std::min(due.value_or(at), at); };
  if (!waiting_.empty()) offer(waiting_.front().heard.end);
  if (!late_.empty()) offer(late_.front().at);
  if (is_held_) return due;
  if (!outgoing_.empty()) offer(free_at_);
  if (speaks_at_) offer(*speaks_at_);
  return due;
}

void TextStation::run(pty::SimTime now, pty::Transmitter& out) {
  run_late(now);
  for (const Waiting& waiting : std::exchange(waiting_, {})) {
    if (!waiting.echo.empty()) echo(waiting, out);
    if (waiting.has_heard) carry_out(waiting.heard, now);
  }
  send(now, out);
  if (is_held_ || !speaks_at_ || *speaks_at_ > now) return;
  speaks_at_.reset();
  if (!outgoing_.empty() || free_at_ > now) {
    speaks_at_ = free_at_;
  } else if (speaker_.has_speech()) {
    outgoing_.push_back({.text = speaker_.take_speech()});
    send(now, out);
  }
}

void TextStation::reset() {
  lines_.reset();
  waiting_.clear();
  late_.clear();
  outgoing_.clear();
  free_at_ = pty::SimTime{0};
  speaks_at_.reset();
  is_held_ = false;
}

bool TextStation::look_for_speech(pty::SimTime now) {
  if (speaks_at_ || !device_.powered() || !speaker_.has_speech()) return false;
  speaks_at_ = std::max(now, free_at_);
  return true;
}

// --- what it has heard ---------------------------------------------------------------------------

void TextStation::echo(const Waiting& waiting, pty::Transmitter& out) {
  if (!is_held_) return out.answer(bytes_of(waiting.echo), waiting.heard.last_character);
  if (outgoing_size() < kMostOutgoing) outgoing_.push_back({waiting.heard.last_character, waiting.echo});
}

void TextStation::carry_out(const pty::HeardText& heard, pty::SimTime now) {
  if (faults_ == nullptr || heard.what != Heard::line) return serve(heard, now);
  const std::vector<std::uint8_t> bytes = bytes_of(heard.text + '\r');
  const auto stages = faults_->on_request(frame_of(bytes, heard.last_character, now));
  if (stages.empty()) return serve(heard, now);
  for (const pty::WirePiece& piece : pty::through_faults(bytes, stages)) {
    const std::string text(piece.bytes.begin(), piece.bytes.end());
    if (piece.late == pty::SimTime{0}) {
      serve_garbled(text, heard.last_character, now);
    } else {
      keep_late({now + piece.late, false, heard.last_character, text});
    }
  }
}

void TextStation::serve(const pty::HeardText& heard, pty::SimTime now) {
  FrameFaults::Treatment treatment;
  switch (heard.what) {
    case Heard::line: {
      ++counters_.requests;
      const std::vector<std::uint8_t> bytes = bytes_of(heard.text);
      if (faults_ != nullptr) treatment = faults_->on_serving(frame_of(bytes, heard.last_character, now));
      speaker_.hear_line(heard.text);
      break;
    }
    case Heard::overlong: speaker_.hear_overlong(); break;
    case Heard::escape: speaker_.hear_escape(); break;
    case Heard::hold: is_held_ = true; return;
    case Heard::go_on: is_held_ = false; return;
  }
  if (!speaker_.has_speech() || outgoing_size() >= kMostOutgoing) return;
  std::string text = speaker_.take_speech();
  if (!treatment.is_answered || text.empty()) return;
  ++counters_.replies;
  answer(std::move(text), heard, now);
}

void TextStation::answer(std::string text, const pty::HeardText& heard, pty::SimTime now) {
  const std::vector<std::uint8_t> request = bytes_of(heard.text);
  const auto stages = faults_ == nullptr ? std::vector<pty::WireFault>{}
                                         : faults_->on_reply(frame_of(request, heard.last_character, now));
  if (stages.empty()) {
    outgoing_.push_back({heard.last_character, std::move(text)});
    return;
  }
  for (const pty::WirePiece& piece : pty::through_faults(bytes_of(text), stages)) {
    keep_late({now + piece.late, true, heard.last_character, {piece.bytes.begin(), piece.bytes.end()}});
  }
  run_late(now);
}

HeardFrame TextStation::frame_of(std::span<const std::uint8_t> bytes, std::uint64_t last_character,
                                 pty::SimTime now) const {
  return {.device = device_number_,
          .bytes = bytes,
          .last_character = last_character,
          .is_for_device = true,
          .now = now};
}

/// What the wire has made of a line, judged as if it had come so.
void TextStation::serve_garbled(const std::string& text, std::uint64_t last_character, pty::SimTime now) {
  for (const char character : text) {
    const auto value = static_cast<std::uint8_t>(character);
    auto outcome =
        lines_.push({.start = now, .end = now, .value = value, .number = last_character}, rules_of(speaker_));
    if (outcome.heard) serve(*outcome.heard, now);
  }
}

void TextStation::keep_late(Late message) {
  if (late_.size() == kMostLate) return;
  const auto place = std::upper_bound(late_.begin(), late_.end(), message.at,
                                      [](pty::SimTime at, const Late& other) { return at < other.at; });
  late_.insert(place, std::move(message));
}

void TextStation::run_late(pty::SimTime now) {
  while (!late_.empty() && late_.front().at <= now) {
    Late message = std::move(late_.front());
    late_.erase(late_.begin());
    if (message.is_reply) {
      outgoing_.push_back({message.last_character, std::move(message.text)});
    } else {
      serve_garbled(message.text, message.last_character, now);
    }
  }
}

// --- what it says --------------------------------------------------------------------------------

void TextStation::send(pty::SimTime now, pty::Transmitter& out) {
  const std::size_t piece =
      is_instant_ || !speaker_.text_rules().has_flow_control ? kPiece : kPieceThatCanBeHeld;
  while (!is_held_ && !outgoing_.empty() && free_at_ <= now) {
    Outgoing& first = outgoing_.front();
    const std::size_t size = std::min(first.text.size(), piece);
    const std::vector<std::uint8_t> bytes = bytes_of(std::string_view(first.text).substr(0, size));
    if (first.last_character == 0) {
      out.transmit(bytes);
    } else {
      out.answer(bytes, first.last_character);
    }
    // Where characters take no time, a long text takes it all the same: nobody could read it so fast.
    const bool takes_time = !is_instant_ || size == kPiece;
    if (takes_time) free_at_ = now + settings().duration_of(static_cast<std::int64_t>(size));
    first.text.erase(0, size);
    if (first.text.empty()) outgoing_.erase(outgoing_.begin());
  }
}

std::size_t TextStation::outgoing_size() const {
  std::size_t size = 0;
  for (const Outgoing& outgoing : outgoing_) size += outgoing.text.size();
  return size;
}

// --- its state -----------------------------------------------------------------------------------

TextStation::State TextStation::save() const {
  return {.lines = lines_.save(),
          .counters = counters_,
          .waiting = waiting_,
          .late = late_,
          .outgoing = outgoing_,
          .free_at = free_at_,
          .speaks_at = speaks_at_,
          .is_held = is_held_};
}

void TextStation::check(const State& state) const {
  const auto demand = [](bool holds) {
    if (!holds) throw std::invalid_argument("a station cannot have such text");
  };
  pty::TextLines::check(state.lines);
  demand(state.waiting.size() <= 1);
  for (const Waiting& waiting : state.waiting) demand(pty::is_within_reach(waiting.heard.end));
  demand(state.late.size() <= kMostLate);
  pty::SimTime before{0};
  for (const Late& message : state.late) {
    demand(message.at >= before && pty::is_within_reach(message.at) && !message.text.empty());
    before = message.at;
  }
  for (const Outgoing& outgoing : state.outgoing) demand(!outgoing.text.empty());
  demand(state.free_at >= pty::SimTime{0} && pty::is_within_reach(state.free_at));
  demand(!state.speaks_at || pty::is_within_reach(*state.speaks_at));
}

void TextStation::restore(const State& state) {
  lines_.restore(state.lines);
  counters_ = state.counters;
  waiting_ = state.waiting;
  late_ = state.late;
  outgoing_ = state.outgoing;
  free_at_ = state.free_at;
  speaks_at_ = state.speaks_at;
  is_held_ = state.is_held;
}

void TextStation::write_state(StateWriter& writer) const { writer.write<StationFields>(save()); }

std::function<void()> TextStation::read_state(StateReader& reader) { return read_state_of(*this, reader); }

}  // namespace understudy::emulator::world
