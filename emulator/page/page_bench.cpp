#include "emulator/page/page_bench.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "emulator/page/page_verbs.h"
#include "emulator/page/web.h"

namespace understudy::emulator::page {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMaxInAnUpdate = 200;  // frames, and as many events

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string quoted_json(const std::string& text) { return text_of(Json(text)); }

/// Writes `"frames":[...]` with the frames from `next` on, and the number of frames that were missed before
/// or between them, because the browser or this page was too slow. Frames with a number below `from` no
/// longer exist and do not count as missed.
template <class Ring>
std::string listed(const Ring& ring, std::uint64_t from, std::uint64_t& next, const std::string& key) {
  if (ring.empty() || ring.back().number < next) return {};
  std::uint64_t expected = next == 0 ? 0 : std::max(next, from);  // 0: accepts any number
  std::uint64_t lost = 0;
  std::string text = ",\"" + key + "\":[";
  std::size_t count = 0;
  const auto begin =
      std::lower_bound(ring.begin(), ring.end(), next,
                       [](const auto& one, std::uint64_t number) { return one.number < number; });
  for (auto it = begin; it != ring.end() && count < kMaxInAnUpdate; ++it, ++count) {
    text += (count > 0 ? "," : "") + it->text;
    if (expected != 0 && it->number > expected) lost += it->number - expected;
    expected = next = it->number + 1;
  }
  return text + "]" + (lost > 0 ? ",\"" + key + "_lost\":" + std::to_string(lost) : "");
}

/// Returns the number of the first frame or event in a look. If the look has none, returns the number of the
/// next one.
std::uint64_t first_of(const Json& look, const char* key, const char* next_key) {
  const Json& list = look.at(key);
  return (list.empty() ? look.at(next_key) : list.front().at("number")).get<std::uint64_t>();
}

/// Takes the frames or events from a look, if it has any. If the page has discarded its own list since the
/// request, the look's list no longer continues it and is ignored.
template <class Ring>
void take_list(const Json& look, const char* key, const char* next_key, std::uint64_t asked, Ring& ring,
               std::uint64_t& next) {
  if (!look.contains(key) || asked != next) return;
  for (const Json& one : look[key]) ring.push_back({one.at("number").get<std::uint64_t>(), text_of(one)});
  while (ring.size() > PageBench::kFramesKept) ring.pop_front();
  next = look.at(next_key).get<std::uint64_t>();
}

}  // namespace

PageBench::PageBench(Web& web, std::string socket, Callbacks callbacks)
    : web_(web), socket_(std::move(socket)), callbacks_(std::move(callbacks)), wire_(web.wire(socket_)) {}

void PageBench::want(Wanted wanted) {
  for (const std::string& name : wanted.names) values_.try_emplace(name);
  std::erase_if(values_, [&](const auto& known) { return !wanted.names.contains(known.first); });
  // A browser that requests them later gets those that the daemon still has.
  if (!wanted.frames) {
    frames_.clear();
    next_frame_ = 0;
  }
  if (!wanted.events) {
    events_.clear();
    next_event_ = 0;
  }
  wanted_ = std::move(wanted);
  divide_names();
  if (wanted_.anybody) plan(kTurn);
}

void PageBench::ask(std::string message, ControlWire::Answered answered) {
  asks_.push_back({std::move(message), std::move(answered)});
  plan(kTurn);
}

/// Schedules the next turn `time` after the last one.
void PageBench::plan(std::chrono::milliseconds time) {
  if (std::exchange(is_planned_, true)) return;
  const auto since = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - last_turn_);
  web_.after(std::max(std::chrono::milliseconds(0), time - since),
             [this, alive = std::weak_ptr<bool>(alive_)] {
               if (alive.expired()) return;
               is_planned_ = false;
               turn();
             });
}

void PageBench::turn() {
  last_turn_ = Clock::now();
  send_asks();
  if (wanted_.anybody) {
    if (looks_under_way_ == 0) {
      look();
    } else if (last_turn_ - asked_at_ > kPatience) {
      be(State::silent);
    }
  }
  if (wanted_.anybody || !asks_.empty()) plan(state_ == State::gone ? kRetry : kTurn);
}

void PageBench::send_asks() {
  for (std::size_t i = 0; i < kAsksATurn && !asks_.empty(); ++i) {
    Ask ask = std::move(asks_.front());
    asks_.pop_front();
    // Each message has a separate connection, because some are answered only at a later simulated time.
    const std::uint64_t number = ++last_ask_;
    auto& wire = ask_wires_[number] = web_.wire(socket_);
    wire->ask(std::move(ask.message),
              [this, number, answered = std::move(ask.answered)](std::optional<std::string> reply) {
                answered(std::move(reply));
                web_.after(std::chrono::milliseconds(0), [this, number, alive = std::weak_ptr<bool>(alive_)] {
                  if (!alive.expired()) ask_wires_.erase(number);
                });
              });
  }
}

void PageBench::divide_names() {
  lists_.assign(1, std::make_shared<NameList>());
  std::size_t bytes = 0;
  for (const std::string& name : wanted_.names) {
    if (lists_.back()->names.size() == kNamesAMessage || bytes + name.size() > kBytesAMessage) {
      lists_.push_back(std::make_shared<NameList>());
      bytes = 0;
    }
    bytes += name.size() + 8;
    lists_.back()->names.push_back(name);
  }
}

/// Sends one message, or several if there are many names. Frames and events come with the first.
void PageBench::look() {
  asked_at_ = last_turn_;
  looks_under_way_ = lists_.size();
  for (std::size_t i = 0; i < lists_.size(); ++i) {
    const auto& list = lists_[i];
    Json message{{"do", "look"}};
    if (list->look) {
      message["look"] = *list->look;
    } else if (!list->names.empty()) {
      message["names"] = list->names;
    }
    if (i == 0) {
      if (wanted_.frames) message["frames"] = next_frame_;
      if (wanted_.events) message["events"] = next_event_;
      if (wanted_.status && last_turn_ - last_status_ >= kStatus) {
        message["status"] = true;
        last_status_ = last_turn_;
      }
    }
    const bool is_last = i + 1 == lists_.size();
    const Asked asked{.frames = next_frame_, .events = next_event_};
    wire_->ask(text_of(message), [this, list, asked, is_last](const std::optional<std::string>& reply) {
      if (looks_under_way_ > 0) --looks_under_way_;
      if (!reply) return lose();
      take_look(*reply, list, asked, is_last);
    });
  }
}

void PageBench::take_look(const std::string& reply, const std::shared_ptr<NameList>& list, const Asked& asked,
                          bool is_last) {
  Json look;
  const std::vector<std::string>& names = list->names;
  try {
    look = Json::parse(reply);
    if (!look.at("ok").get<bool>()) {
      // The daemon no longer has the list, so the next look spells out the names.
      if (std::exchange(list->look, std::nullopt)) return;
      return lose();
    }
    const std::string time =
        "\"time_ns\":" + text_of(look.at("simulated_time_ns")) + ",\"paused\":" + text_of(look.at("paused")) +
        ",\"speed\":" + text_of(look.at("speed")) + ",\"advancing\":" + text_of(look.at("advancing")) +
        ",\"restores\":" + std::to_string(look.value("restores", std::uint64_t{0})) +
        (look.contains("altered_at_ns") ? ",\"altered_at_ns\":" + text_of(look["altered_at_ns"]) : "");
    const std::uint64_t who = look.at("pid").get<std::uint64_t>();
    if (who != who_) {
      // The numbers of lists belong to the old daemon.
      const bool is_by_number = list->look.has_value();
      for (const auto& one : lists_) one->look.reset();
      list->look.reset();
      if (is_by_number) return;
      restart(who);
    }
    // The frames and events before a restore do not belong to the current run.
    const std::uint64_t restores = look.value("restores", std::uint64_t{0});
    if (std::exchange(restores_, restores) != restores) {
      frames_.clear();
      events_.clear();
      if (look.contains("next_frame")) frames_from_ = first_of(look, "frames", "next_frame");
      if (look.contains("next_event")) events_from_ = first_of(look, "events", "next_event");
    }
    be(State::there);
    if (time != time_text_) {
      time_text_ = time;
      time_changed_ = looks_;
    }
    if (!names.empty() && look.contains("look")) list->look = look["look"].get<std::uint64_t>();
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto known = values_.find(names[i]);
      if (known == values_.end()) continue;
      std::string text = text_of(look.at("values").at(i));
      if (text == known->second.text && known->second.changed != 0) continue;
      known->second = {std::move(text), looks_};
    }
    take_list(look, "frames", "next_frame", asked.frames, frames_, next_frame_);
    take_list(look, "events", "next_event", asked.events, events_, next_event_);
    if (look.contains("status")) {
      status_ = text_of(look["status"]);
      status_changed_ = looks_;
    }
  } catch (const Json::exception&) {
    return lose();  // the reply is not from understudy
  }
  if (!is_last) return;
  ++looks_;
  callbacks_.looked();
}

/// Starts again when another daemon answers, or the same one has restarted.
void PageBench::restart(std::uint64_t who) {
  who_ = who;
  ++epoch_;
  next_frame_ = next_event_ = frames_from_ = events_from_ = 0;
  for (auto& [name, known] : values_) known = {};
  status_changed_ = 0;
  frames_.clear();
  events_.clear();
  be(State::unknown);
}

void PageBench::lose() {
  who_ = 0;
  for (const auto& list : lists_) list->look.reset();
  be(State::gone);
}

void PageBench::be(State state) {
  if (state_ == state) return;
  const bool is_reported = state != State::unknown;
  state_ = state;
  if (is_reported) callbacks_.state_changed();
}

std::string PageBench::news_for(Watching& watching) const {
  std::string values;
  for (const std::string& name : watching.names) {
    const auto known = values_.find(name);
    if (known == values_.end() || known->second.changed <= watching.seen) continue;
    values += (values.empty() ? "" : ",") + quoted_json(name) + ":" + known->second.text;
  }
  std::string news;
  if (!values.empty()) news += ",\"values\":{" + values + "}";
  if (watching.frames) news += listed(frames_, frames_from_, watching.next_frame, "frames");
  if (watching.events) news += listed(events_, events_from_, watching.next_event, "events");
  if (watching.status && status_changed_ > watching.status_seen) {
    news += ",\"status\":" + status_;
    watching.status_seen = status_changed_;
  }
  const bool is_later = time_changed_ > watching.seen;
  watching.seen = looks_ - 1;
  if (news.empty() && !is_later) return {};
  return time_text_ + news;
}

}  // namespace understudy::emulator::page
