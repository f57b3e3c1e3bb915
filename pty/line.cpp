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

#include "base/queue.h"
#include "pty/line_observer.h"
#include "pty/line_settings.h"
#include "pty/station.h"

namespace understudy::pty {

/// Passes a station's transmissions to the line with the station's number.
class Line::LineTransmitter final : public Transmitter {
 public:
  LineTransmitter(Line& line, std::size_t member) : line_(line), member_(member) {}
  void transmit(std::span<const std::uint8_t> bytes) override {
    line_.transmit(member_, bytes, line_.state_.is_host_open, 0);
  }
  void answer(std::span<const std::uint8_t> bytes, std::uint64_t last_character) override {
    const bool is_present = line_.state_.is_host_open && last_character > line_.state_.last_departed;
    line_.transmit(member_, bytes, is_present, last_character);
  }
  void served(std::span<const std::uint8_t> request, std::span<const std::uint8_t> answer,
              std::uint64_t last_character, std::string_view why) override {
    for (LineObserver* observer : line_.observers_) {
      observer->on_served({member_, line_.state_.edge.clock, last_character, request, answer, why});
    }
  }

 private:
  Line& line_;
  std::size_t member_;
};

Line::Line(std::string name, LineOptions options, std::function<void(const std::string&)> warn)
    : name_(std::move(name)), options_(options), warn_(std::move(warn)) {
  if (options_.settings.baud <= 0) throw std::invalid_argument("line " + name_ + ": baud must be positive");
  state_.settings = options_.settings;
}

LineOptions Line::options() const {
  LineOptions options = options_;
  options.settings = state_.settings;
  return options;
}

void Line::add_observer(LineObserver& observer) {
  observers_.push_back(&observer);
  due_changed();
}

void Line::remove_observer(LineObserver& observer) {
  std::erase(observers_, &observer);
  due_changed();
}

void Line::report_strike(const StruckMessage& message) {
  for (LineObserver* observer : observers_) observer->on_strike(message);
}

void Line::attach(Station& station) {
  stations_.push_back(&station);
  state_.members.emplace_back();
  due_changed();
}

void Line::set_settings(const LineSettings& settings) {
  if (settings == state_.settings) return;
  state_.settings = settings;
  // A burst counts characters of one length, so a change of speed begins another burst.
  const auto end = [](Burst& burst) { burst = {burst.end, 0, burst.end}; };
  end(state_.arriving);
  for (Member& member : state_.members) end(member.transmission);
}

// --- the host's side ---------------------------------------------------------------------------

std::size_t Line::room() const { return kInputCapacity - state_.input.size(); }

void Line::receive(std::span<const std::uint8_t> bytes, SimTime now) {
  take(bytes, now, !state_.is_host_open);
}

void Line::receive_departed(std::span<const std::uint8_t> bytes, SimTime now) { take(bytes, now, true); }

void Line::take(std::span<const std::uint8_t> bytes, SimTime now, bool is_departed) {
  due_changed();
  if (is_unplugged()) return;
  bytes = bytes.first(std::min(bytes.size(), room()));
  state_.edge.counters.bytes_in += bytes.size();
  for (LineObserver* observer : observers_) observer->on_receive(bytes, is_departed);
  const bool was_idle = state_.input.empty();
  for (const std::uint8_t value : bytes) {
    TimedByte character = place(state_.arriving, value, now);
    character.number = ++state_.last_received;
    state_.input.push_back(character);
  }
  if (is_departed) state_.last_departed = state_.last_received;
  if (was_idle && !bytes.empty()) begin_character(state_.input.front().start);
}

void Line::host_purged() {
  due_changed();
  for (LineObserver* observer : observers_) observer->on_host_purged();
  discard_unsent();
}

void Line::discard_unsent() {
  if (state_.input.empty()) return;
  // The first character is already on the wire, and this host cannot take back characters of the previous
  // one.
  const std::uint64_t first = std::max(state_.input.front().number, state_.last_departed);
  state_.input.remove_if([&](const TimedByte& character) { return character.number > first; });
  const SimTime end = state_.input.back().end;
  if (!is_instant()) state_.arriving = {end, 0, end};
}

void Line::nothing_more(SimTime now) {
  due_changed();
  if (!state_.input.empty()) return;  // the rest is still on the wire
  for (Station* station : stations_) station->on_idle();
  for (LineObserver* observer : observers_) observer->on_nothing_more();
  run(now);
}

void Line::host_opened() {
  due_changed();
  for (LineObserver* observer : observers_) observer->on_host_opened();
  state_.is_host_open = true;
  state_.host_settings.reset();
  state_.warned = {};
}

void Line::host_settings(std::optional<HostSettings> settings) {
  due_changed();
  for (LineObserver* observer : observers_) observer->on_host_settings(settings);
  state_.host_settings = settings;
}

void Line::host_closed() {
  due_changed();
  for (LineObserver* observer : observers_) observer->on_host_closed();
  state_.is_host_open = false;
  state_.departed_settings = state_.host_settings;
  state_.last_departed = state_.last_received;
  state_.leaving.clear();
  state_.lump.clear();
  state_.lump_at.reset();
  state_.edge.output.clear();
}

std::span<const std::uint8_t> Line::output() const { return state_.edge.output.values(); }

void Line::take_output(std::size_t count) {
  state_.edge.output.pop_front(std::min(count, state_.edge.output.size()));
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
    if (!state_.input.empty()) offer(What::character_in, state_.input.front().end, 0);
  };
  // At equal times the first offer wins.
  if (!is_instant()) offer_input();
  for (std::size_t i = 0; i < observers_.size(); ++i) {
    if (const auto at = observers_[i]->due()) offer(What::observer, *at, i);
  }
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    if (const auto at = stations_[i]->due()) offer(What::station, *at, i);
  }
  if (!state_.leaving.empty()) offer(What::character_out, state_.leaving.front().end, 0);
  if (state_.lump_at) offer(What::lump_out, *state_.lump_at, 0);
  if (notices_ > 0) {
    for (std::size_t i = 0; i < state_.members.size(); ++i) {
      if (const auto at = state_.members[i].noticed_at) offer(What::notice, *at, i);
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
  // Stops a station that is due again and again without making progress.
  constexpr int kMaxAtOnce = 1 << 23;
  int at_once = 0;
  SimTime& clock = state_.edge.clock;
  for (Event next = next_event(); next.what != What::nothing && next.at <= now; next = next_event()) {
    at_once = next.at > clock ? 0 : at_once + 1;
    if (at_once > kMaxAtOnce) throw std::logic_error(name_ + ": the events that are due never end");
    clock = std::max(clock, next.at);
    due_changed();
    handle(next);
  }
}

void Line::handle(const Event& event) {
  switch (event.what) {
    case What::nothing: break;
    case What::character_in: deliver_characters(); break;
    case What::observer: observers_[event.member]->run(state_.edge.clock); break;
    case What::station: run_station(event.member); break;
    case What::character_out: {
      const std::uint8_t value = state_.leaving.front().value;
      state_.leaving.pop_front();
      leave_wire(std::span(&value, 1));
      break;
    }
    case What::lump_out: give_lump(); break;
    case What::notice: notify_others(event.member); break;
  }
}

/// Places the next character of a burst: at `now`, or right after the character before it.
TimedByte Line::place(Burst& burst, std::uint8_t value, SimTime now) const {
  if (is_instant()) return {now, now, value};
  if (now >= burst.end) burst = {now, 0, now};
  const SimTime start = burst.end;
  burst.end = burst.start + state_.settings.duration_of(++burst.count);
  // After `baud` characters the time is a whole number of seconds. The burst restarts there without a
  // rounding error, so that the count of a host that never stops does not overflow.
  if (burst.count == state_.settings.baud) burst = {burst.end, 0, burst.end};
  return {start, burst.end, value};
}

// --- from the host -----------------------------------------------------------------------------

/// Handles a start bit: decides which stations receive the character.
void Line::begin_character(SimTime at) {
  const bool is_departed = state_.input.front().number <= state_.last_departed;
  const std::optional<HostSettings>& settings = is_departed ? state_.departed_settings : state_.host_settings;
  const bool is_speed_known = options_.enforce_settings && settings;
  if (options_.enforce_settings && !settings && !is_departed && !stations_.empty()) {
    warn_once(state_.warned.of_no_speed,
              "the host has not set a speed; its bytes are assumed to arrive intact");
  }
  std::size_t deaf = 0;
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    Member& member = state_.members[i];
    member.is_deaf = false;
    if (is_speed_known) {
      const LineSettings expected = stations_[i]->settings();
      member.is_deaf = !accepts(expected, *settings, options_.baud_tolerance_ppm);
      if (member.is_deaf) warn_deaf(i, *settings, expected);
    }
    if (member.is_deaf) {
      ++deaf;
    } else if (!is_instant()) {
      stations_[i]->on_start_bit(at);
    }
  }
  state_.is_received = deaf == 0 || deaf < stations_.size();
  if (!state_.is_received) ++state_.edge.counters.bytes_unheard;
  if (is_instant()) return;
  for (LineObserver* observer : observers_) observer->on_start_bit(at);
}

/// With Timing::instant all characters of a lump arrive at one moment. This delivers as many as possible
/// before a station or observer has to act.
void Line::deliver_characters() {
  const SimTime moment = state_.input.front().end;
  deliver_character();
  if (!is_instant()) return;
  const auto is_departed = [this] { return state_.input.front().number <= state_.last_departed; };
  const auto is_of_lump = [&] { return !state_.input.empty() && state_.input.front().end == moment; };
  if (!is_of_lump()) return;
  const bool begun_departed = is_departed();
  for (std::size_t left = quiet_characters(); left > 0; --left) {
    report_character();
    if (left > 1 && is_of_lump() && is_departed() == begun_departed) {
      if (!state_.is_received) ++state_.edge.counters.bytes_unheard;  // like the character before it
      continue;
    }
    if (!state_.input.empty()) begin_character(state_.input.front().start);
    return;
  }
}

/// Returns how many characters may be delivered before stations and observers must be asked for due().
std::size_t Line::quiet_characters() const {
  std::size_t min = kInputCapacity;
  for (const LineObserver* observer : observers_) min = std::min(min, observer->quiet_characters());
  for (const Station* station : stations_) min = std::min(min, station->quiet_characters());
  return min;
}

/// Delivers a character that has completely arrived. If another one is waiting, it begins at that moment.
void Line::deliver_character() {
  report_character();
  if (!state_.input.empty()) begin_character(state_.input.front().start);
}

void Line::report_character() {
  const TimedByte byte = state_.input.front();
  state_.input.pop_front();
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    if (!state_.members[i].is_deaf) stations_[i]->receive(byte);
  }
  for (LineObserver* observer : observers_) observer->on_character(byte, state_.is_received);
  const bool echoes = options_.echoes || state_.adapter.echoes;
  if (echoes && state_.is_host_open && byte.number > state_.last_departed)
    leave_wire(std::span(&byte.value, 1));
}

// --- from the stations -------------------------------------------------------------------------

void Line::run_station(std::size_t index) {
  LineTransmitter voice(*this, index);
  stations_[index]->run(state_.edge.clock, voice);
}

void Line::transmit(std::size_t index, std::span<const std::uint8_t> bytes, bool is_anybody_listening,
                    std::uint64_t last_character) {
  if (bytes.empty()) return;
  Member& member = state_.members[index];
  const SimTime clock = state_.edge.clock;
  const bool is_new = is_instant() || clock >= member.transmission.end;
  // The backlog of a station that transmits faster than the wire is bounded.
  const SimTime latest = clock + state_.settings.duration_of(kOutputCapacity);
  SimTime first_start = clock;
  SimTime first_end = clock;
  bool has_collided = false;
  if (is_instant() && is_anybody_listening) leave_wire(bytes);
  for (std::size_t i = 0; i < bytes.size() && !is_instant(); ++i) {
    if (member.transmission.end >= latest) {
      state_.edge.counters.bytes_discarded += bytes.size() - i;
      bytes = bytes.first(i);
      break;
    }
    TimedByte character = place(member.transmission, bytes[i], clock);
    character.number = index;
    if (i == 0) {
      first_start = character.start;
      first_end = character.end;
    }
    // A transmission takes the wire's time even if no host has the line open.
    if (is_anybody_listening) put_on_wire(character, has_collided);
  }
  if (is_new && !member.noticed_at) {
    member.noticed_at = first_end;
    ++notices_;
  }
  if (!bytes.empty()) {
    for (LineObserver* observer : observers_) {
      observer->on_transmission({bytes, first_start, has_collided, is_anybody_listening, last_character});
    }
  }
  if (!has_collided) return;
  ++state_.edge.counters.collisions;
  warn_once(state_.warned.of_collision, "two stations replied at once; their replies are garbled");
}

/// A character that overlaps one of another station is merged into it: the receiver follows the start bit
/// that came first and reads the AND of both, as the dominant level wins. (A station never overlaps itself,
/// so the other character is always another station's.)
void Line::put_on_wire(const TimedByte& character, bool& has_collided) {
  Queue<TimedByte>& leaving = state_.leaving;
  if (leaving.empty() || leaving.back().end <= character.start) {
    leaving.push_back(character);
    return;
  }
  const auto other =
      std::ranges::find_if(leaving, [&](const TimedByte& sent) { return sent.end > character.start; });
  if (other->start < character.end) {
    other->value &= character.value;
    has_collided = true;
  } else {
    leaving.insert(other, character);
  }
}

void Line::discard_pending(const Station& station, SimTime now) {
  due_changed();
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    if (stations_[i] != &station) continue;
    state_.leaving.remove_if([&](const TimedByte& sent) { return sent.number == i && sent.start >= now; });
    state_.members[i].transmission = {};
  }
}

/// Notifies the other stations, except those that are transmitting: they receive only themselves.
void Line::notify_others(std::size_t sender) {
  state_.members[sender].noticed_at.reset();
  --notices_;
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    const bool is_talking = !is_instant() && state_.members[i].transmission.end > state_.edge.clock;
    if (i != sender && !is_talking) stations_[i]->on_other_station();
  }
}

// --- warnings ----------------------------------------------------------------------------------

void Line::warn_once(bool& has_warned, std::string_view what) {
  if (has_warned) return;
  has_warned = true;
  if (warn_) warn_("line " + name_ + ": " + std::string(what));
}

void Line::warn_deaf(std::size_t index, const HostSettings& settings, const LineSettings& expected) {
  if (state_.warned.of_deafness) return;
  const std::string which =
      stations_.size() == 1 ? "the station" : "station " + std::to_string(index + 1) + " of the line";
  warn_once(state_.warned.of_deafness, "the host set " + to_string(settings) + "; " + which + " expects " +
                                           to_string(expected) + ", so it receives nothing");
}

}  // namespace understudy::pty
