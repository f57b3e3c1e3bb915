#include "pty/line.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "pty/line_observer.h"
#include "pty/line_settings.h"
#include "pty/station.h"

namespace understudy::pty {

/// Ties what a station says to the station.
class Line::Voice final : public Transmitter {
 public:
  Voice(Line& line, std::size_t member) : line_(line), member_(member) {}
  void transmit(std::span<const std::uint8_t> bytes) override {
    line_.say(member_, bytes, line_.is_host_open_);
  }
  void answer(std::span<const std::uint8_t> bytes, std::uint64_t last_character) override {
    line_.say(member_, bytes, line_.is_host_open_ && last_character > line_.last_departed_);
  }

 private:
  Line& line_;
  std::size_t member_;
};

Line::Line(std::string name, LineOptions options, std::function<void(const std::string&)> warn)
    : name_(std::move(name)), options_(options), warn_(std::move(warn)), input_(kInputCapacity) {
  if (options_.settings.baud <= 0) throw std::invalid_argument("line " + name_ + ": baud must be positive");
  leaving_.reserve(2 * kOutputCapacity);
  output_.reserve(2 * kOutputCapacity);
}

void Line::add_observer(LineObserver& observer) {
  observers_.push_back(&observer);
  due_changed();
}

void Line::remove_observer(LineObserver& observer) {
  std::erase(observers_, &observer);
  due_changed();
}

void Line::tell_strike(const StruckMessage& message) {
  for (LineObserver* observer : observers_) observer->on_strike(message);
}

void Line::attach(Station& station) {
  members_.emplace_back().station = &station;
  due_changed();
}

void Line::set_settings(const LineSettings& settings) {
  if (settings == options_.settings) return;
  options_.settings = settings;
  // A burst counts characters of one length: what follows is another.
  const auto end = [](Burst& burst) { burst = {burst.end, 0, burst.end}; };
  end(arriving_);
  for (Member& member : members_) end(member.speech);
}

// --- the host's side ---------------------------------------------------------------------------

std::size_t Line::room() const { return kInputCapacity - input_count_; }

void Line::receive(std::span<const std::uint8_t> bytes, SimTime now) { take(bytes, now, !is_host_open_); }

void Line::receive_departed(std::span<const std::uint8_t> bytes, SimTime now) { take(bytes, now, true); }

void Line::take(std::span<const std::uint8_t> bytes, SimTime now, bool is_departed) {
  due_changed();
  bytes = bytes.first(std::min(bytes.size(), room()));
  counters_.bytes_in += bytes.size();
  for (LineObserver* observer : observers_) observer->on_receive(bytes, is_departed);
  const bool was_idle = input_count_ == 0;
  for (const std::uint8_t value : bytes) {
    input_[(input_first_ + input_count_) % kInputCapacity] = place(arriving_, value, now);
    input_[(input_first_ + input_count_) % kInputCapacity].number = ++last_received_;
    ++input_count_;
  }
  if (is_departed) last_departed_ = last_received_;
  if (was_idle && !bytes.empty()) begin_character(input_[input_first_].start);
}

void Line::nothing_more(SimTime now) {
  due_changed();
  if (input_count_ > 0) return;  // the rest is still on the wire
  for (const Member& member : members_) member.station->hear_nothing_more();
  for (LineObserver* observer : observers_) observer->on_nothing_more();
  run(now);
}

void Line::host_opened() {
  due_changed();
  for (LineObserver* observer : observers_) observer->on_host_opened();
  is_host_open_ = true;
  host_settings_.reset();
  has_warned_deaf_ = has_warned_no_speed_ = has_warned_collision_ = false;
}

void Line::host_settings(std::optional<HostSettings> settings) {
  due_changed();
  for (LineObserver* observer : observers_) observer->on_host_settings(settings);
  host_settings_ = settings;
}

void Line::host_closed() {
  due_changed();
  for (LineObserver* observer : observers_) observer->on_host_closed();
  is_host_open_ = false;
  departed_settings_ = host_settings_;
  last_departed_ = last_received_;
  leaving_.clear();
  leaving_first_ = 0;
  output_.clear();
  output_first_ = 0;
}

std::span<const std::uint8_t> Line::output() const { return std::span(output_).subspan(output_first_); }

void Line::take_output(std::size_t count) {
  output_first_ += std::min(count, output_.size() - output_first_);
  if (output_first_ == output_.size()) {
    output_.clear();
    output_first_ = 0;
  }
}

// --- time --------------------------------------------------------------------------------------

const Line::Event& Line::next_event() const {
  if (!next_) next_ = find_next_event();
  return *next_;
}

Line::Event Line::find_next_event() const {
  Event next;
  const auto offer = [&next](What what, SimTime at, std::size_t member) {
    if (next.what == What::nothing || at < next.at) next = {what, at, member};
  };
  const auto offer_input = [&] {
    if (input_count_ > 0) offer(What::character_in, input_[input_first_].end, 0);
  };
  // What is offered first wins at equal times.
  if (!is_instant()) offer_input();
  for (std::size_t i = 0; i < observers_.size(); ++i) {
    if (const auto at = observers_[i]->due()) offer(What::observer, *at, i);
  }
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (const auto at = members_[i].station->due()) offer(What::station, *at, i);
  }
  if (leaving_first_ < leaving_.size()) offer(What::character_out, leaving_[leaving_first_].end, 0);
  if (notices_ > 0) {
    for (std::size_t i = 0; i < members_.size(); ++i) {
      if (members_[i].noticed_at) offer(What::notice, *members_[i].noticed_at, i);
    }
  }
  if (is_instant()) offer_input();
  return next;
}

std::optional<SimTime> Line::due() const {
  const Event& next = next_event();
  if (next.what == What::nothing) return std::nullopt;
  return next.at;
}

void Line::run(SimTime now) {
  // A station that is due again and again, and does nothing, would never let go.
  constexpr int kMostAtOnce = 1 << 23;
  int at_once = 0;
  for (Event next = next_event(); next.what != What::nothing && next.at <= now; next = next_event()) {
    at_once = next.at > clock_ ? 0 : at_once + 1;
    if (at_once > kMostAtOnce) throw std::logic_error(name_ + ": the events that are due never end");
    clock_ = std::max(clock_, next.at);
    due_changed();
    handle(next);
  }
}

void Line::handle(const Event& event) {
  switch (event.what) {
    case What::nothing: break;
    case What::character_in: deliver_character(); break;
    case What::observer: observers_[event.member]->run(clock_); break;
    case What::station: run_station(event.member); break;
    case What::character_out: {
      const std::uint8_t value = leaving_[leaving_first_].value;
      if (++leaving_first_ == leaving_.size()) {
        leaving_.clear();
        leaving_first_ = 0;
      }
      leave_wire(std::span(&value, 1));
      break;
    }
    case What::notice: notify_others(event.member); break;
  }
}

/// The next character of a burst: at `now`, or right after the one before it.
TimedByte Line::place(Burst& burst, std::uint8_t value, SimTime now) const {
  if (is_instant()) return {now, now, value};
  if (now >= burst.end) burst = {now, 0, now};
  const SimTime start = burst.end;
  burst.end = burst.start + options_.settings.duration_of(++burst.count);
  // After `baud` characters the time is a whole number of seconds: begin anew there, without an error,
  // so that the count of a host that never stops does not overflow.
  if (burst.count == options_.settings.baud) burst = {burst.end, 0, burst.end};
  return {start, burst.end, value};
}

// --- from the host -----------------------------------------------------------------------------

/// A start bit: decides who hears the character that follows.
void Line::begin_character(SimTime at) {
  const bool is_departed = input_[input_first_].number <= last_departed_;
  const std::optional<HostSettings>& settings = is_departed ? departed_settings_ : host_settings_;
  const bool is_speed_known = options_.enforce_settings && settings;
  if (options_.enforce_settings && !settings && !is_departed && !members_.empty()) {
    warn_once(has_warned_no_speed_, "the host set no speed; what it sends is assumed to be heard");
  }
  std::size_t deaf = 0;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    Member& member = members_[i];
    member.is_deaf = false;
    if (is_speed_known) {
      const LineSettings expected = member.station->settings();
      member.is_deaf = !is_within(settings->baud, expected.baud, options_.baud_tolerance_ppm) ||
                       expected.stop_bits != settings->stop_bits;
      if (member.is_deaf) warn_deaf(i, *settings, expected);
    }
    if (member.is_deaf) {
      ++deaf;
    } else if (!is_instant()) {
      member.station->hear_start_bit(at);
    }
  }
  is_heard_ = deaf == 0 || deaf < members_.size();
  if (!is_heard_) ++counters_.bytes_unheard;
  if (is_instant()) return;
  for (LineObserver* observer : observers_) observer->on_start_bit(at);
}

/// A character has wholly arrived; the next one, if there is any, begins at that very moment.
void Line::deliver_character() {
  const TimedByte byte = input_[input_first_];
  input_first_ = (input_first_ + 1) % kInputCapacity;
  --input_count_;
  for (const Member& member : members_) {
    if (!member.is_deaf) member.station->hear(byte);
  }
  for (LineObserver* observer : observers_) observer->on_character(byte, is_heard_);
  if (input_count_ > 0) begin_character(input_[input_first_].start);
}

// --- from the stations -------------------------------------------------------------------------

void Line::run_station(std::size_t index) {
  Voice voice(*this, index);
  members_[index].station->run(clock_, voice);
}

void Line::say(std::size_t index, std::span<const std::uint8_t> bytes, bool is_anybody_listening) {
  if (bytes.empty()) return;
  Member& member = members_[index];
  const bool is_new = is_instant() || clock_ >= member.speech.end;
  // A station that keeps talking faster than the wire carries must not run ahead of it without bound.
  const SimTime latest = clock_ + options_.settings.duration_of(kOutputCapacity);
  SimTime first_start = clock_;
  SimTime first_end = clock_;
  bool has_collided = false;
  if (is_instant() && is_anybody_listening) leave_wire(bytes);
  for (std::size_t i = 0; i < bytes.size() && !is_instant(); ++i) {
    if (member.speech.end >= latest) {
      counters_.bytes_discarded += bytes.size() - i;
      bytes = bytes.first(i);
      break;
    }
    TimedByte character = place(member.speech, bytes[i], clock_);
    character.number = index;
    if (i == 0) {
      first_start = character.start;
      first_end = character.end;
    }
    // It takes the wire's time whether anybody listens or not.
    if (is_anybody_listening) put_on_wire(character, has_collided);
  }
  if (is_new && !member.noticed_at) {
    member.noticed_at = first_end;
    ++notices_;
  }
  if (!bytes.empty()) {
    for (LineObserver* observer : observers_) {
      observer->on_speech({bytes, first_start, has_collided, is_anybody_listening});
    }
  }
  if (!has_collided) return;
  ++counters_.collisions;
  warn_once(has_warned_collision_, "two stations spoke at once; what they said is garbled");
}

/// A character that runs into one of another station is lost in it: the receiver follows the start bit
/// that came first and reads the AND of both, as the dominant level wins. (A station never runs into
/// itself, so what overlaps is always another's.)
void Line::put_on_wire(const TimedByte& character, bool& has_collided) {
  if (leaving_first_ == leaving_.size() || leaving_.back().end <= character.start) {
    if (leaving_.size() == leaving_.capacity()) {
      leaving_.erase(leaving_.begin(), leaving_.begin() + static_cast<std::ptrdiff_t>(leaving_first_));
      leaving_first_ = 0;
    }
    leaving_.push_back(character);
    return;
  }
  const auto begin = leaving_.begin() + static_cast<std::ptrdiff_t>(leaving_first_);
  const auto other =
      std::find_if(begin, leaving_.end(), [&](const TimedByte& sent) { return sent.end > character.start; });
  if (other->start < character.end) {
    other->value &= character.value;
    has_collided = true;
  } else {
    leaving_.insert(other, character);
  }
}

void Line::hush(const Station& station, SimTime now) {
  due_changed();
  for (std::size_t i = 0; i < members_.size(); ++i) {
    Member& member = members_[i];
    if (member.station != &station) continue;
    const auto is_unsent = [&](const TimedByte& sent) { return sent.number == i && sent.start >= now; };
    leaving_.erase(std::remove_if(leaving_.begin() + static_cast<std::ptrdiff_t>(leaving_first_),
                                  leaving_.end(), is_unsent),
                   leaving_.end());
    if (leaving_first_ == leaving_.size()) {
      leaving_.clear();
      leaving_first_ = 0;
    }
    member.speech = {};
  }
}

/// Stations that talk at this moment hear nothing but themselves.
void Line::notify_others(std::size_t speaker) {
  members_[speaker].noticed_at.reset();
  --notices_;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const bool is_talking = !is_instant() && members_[i].speech.end > clock_;
    if (i != speaker && !is_talking) members_[i].station->hear_other_station();
  }
}

void Line::leave_wire(std::span<const std::uint8_t> bytes) {
  const std::size_t room = kOutputCapacity - (output_.size() - output_first_);
  const std::size_t lost = bytes.size() - std::min(bytes.size(), room);
  counters_.bytes_discarded += lost;
  bytes = bytes.first(bytes.size() - lost);
  if (output_.size() + bytes.size() > output_.capacity()) {
    output_.erase(output_.begin(), output_.begin() + static_cast<std::ptrdiff_t>(output_first_));
    output_first_ = 0;
  }
  output_.insert(output_.end(), bytes.begin(), bytes.end());
  counters_.bytes_out += bytes.size();
}

// --- warnings ----------------------------------------------------------------------------------

void Line::warn_once(bool& has_warned, std::string_view what) {
  if (has_warned) return;
  has_warned = true;
  if (warn_) warn_("line " + name_ + ": " + std::string(what));
}

void Line::warn_deaf(std::size_t index, const HostSettings& settings, const LineSettings& expected) {
  if (has_warned_deaf_) return;
  const std::string which =
      members_.size() == 1 ? "the station" : "station " + std::to_string(index + 1) + " of the line";
  const std::string stop_bits = settings.stop_bits == 1 ? "1 stop bit" : "2 stop bits";
  warn_once(has_warned_deaf_, "the host set " + std::to_string(settings.baud) + " baud, " + stop_bits + "; " +
                                  which + " expects " + to_string(expected) + ": it hears nothing");
}

}  // namespace understudy::pty
