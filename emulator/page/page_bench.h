// Represents a bench on the page: the latest replies of its control socket, and which browser needs which of
// them.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "emulator/page/web.h"

namespace understudy::emulator::page {

/// Holds what a browser wants from a bench, and what the page has already sent.
struct Watching {
  std::vector<std::string> names;
  bool frames = false;
  bool events = false;
  bool status = false;
  // Progress of sending; `seen` is the last look whose changes were sent.
  std::uint64_t seen = 0;
  std::uint64_t epoch = 0;
  std::uint64_t next_frame = 0;
  std::uint64_t next_event = 0;
  std::uint64_t status_seen = 0;
};

class PageBench {
 public:
  /// The shortest time between two requests to the socket.
  static constexpr std::chrono::milliseconds kTurn{34};
  static constexpr std::chrono::milliseconds kRetry{500};  // for a socket that does not answer
  static constexpr std::chrono::milliseconds kStatus{500};
  static constexpr std::chrono::milliseconds kPatience{2'000};  // after this it is reported as silent
  static constexpr std::size_t kFramesKept = 1024;
  static constexpr std::size_t kAsksATurn = 16;
  static constexpr std::size_t kMaxNames = 4'000;  // for all browsers together
  static constexpr std::size_t kNamesAMessage = 1'000;
  static constexpr std::size_t kBytesAMessage = 48 * 1024;  // the size of the names in one message

  enum class State : std::uint8_t { unknown, there, silent, gone };

  struct Callbacks {
    std::function<void()> looked;  // called when there is something new
    std::function<void()> state_changed;
  };
  PageBench(Web& web, std::string socket, Callbacks callbacks);

  const std::string& socket() const { return socket_; }
  State state() const { return state_; }
  /// Grows when another daemon, or a restarted one, answers: numbers of frames and events restart.
  std::uint64_t epoch() const { return epoch_; }

  /// The data that the page observes from now on. If no browser watches, it sends no requests to the bench.
  struct Wanted {
    std::set<std::string> names;
    bool frames = false;
    bool events = false;
    bool status = false;
    bool anybody = false;
  };
  void want(Wanted wanted);

  /// Passes on a browser's message, a line of JSON, at the next turn. The answer is empty if the bench does
  /// not answer.
  void ask(std::string message, ControlWire::Answered answered);

  /// Returns everything new for a browser, as the members of a JSON object, or an empty text.
  std::string news_for(Watching& watching) const;

 private:
  struct Known {
    std::string text = "null";  // as JSON
    std::uint64_t changed = 0;  // the number of the look in which it changed
  };
  struct Numbered {
    std::uint64_t number = 0;
    std::string text;
  };

  /// The names of one message. Once the daemon keeps them, they are requested by their number.
  struct NameList {
    std::vector<std::string> names;
    std::optional<std::uint64_t> look;
  };

  void turn();
  void plan(std::chrono::milliseconds time);
  void look();
  void send_asks();
  /// The first frame and event that a look asked for.
  struct Asked {
    std::uint64_t frames = 0;
    std::uint64_t events = 0;
  };
  void take_look(const std::string& reply, const std::shared_ptr<NameList>& list, const Asked& asked,
                 bool is_last);
  void restart(std::uint64_t who);
  void divide_names();
  void be(State state);
  void lose();

  Web& web_;
  std::string socket_;
  Callbacks callbacks_;
  State state_ = State::unknown;
  std::uint64_t epoch_ = 0;
  Wanted wanted_;
  bool is_planned_ = false;
  std::chrono::steady_clock::time_point last_turn_{};
  std::chrono::steady_clock::time_point last_status_{};
  std::chrono::steady_clock::time_point asked_at_{};
  std::size_t looks_under_way_ = 0;
  std::vector<std::shared_ptr<NameList>> lists_;  // lists of all requested names

  std::uint64_t looks_ = 1;
  std::string time_text_;  // members that every update has
  std::uint64_t time_changed_ = 0;
  std::map<std::string, Known> values_;
  std::deque<Numbered> frames_;
  std::deque<Numbered> events_;
  std::uint64_t next_frame_ = 0;
  std::uint64_t next_event_ = 0;
  std::uint64_t frames_from_ = 0;  // frames with a lower number are from before a restore
  std::uint64_t events_from_ = 0;
  std::string status_;
  std::uint64_t status_changed_ = 0;
  std::uint64_t who_ = 0;       // the process that replies
  std::uint64_t restores_ = 0;  // number of restores of its world

  struct Ask {
    std::string message;
    ControlWire::Answered answered;
  };
  std::deque<Ask> asks_;
  // One wire for each message that has no reply yet.
  std::map<std::uint64_t, std::unique_ptr<ControlWire>> ask_wires_;
  std::uint64_t last_ask_ = 0;
  std::shared_ptr<bool> alive_ =
      std::make_shared<bool>(true);    // lets later callbacks find out whether this object still exists
  std::unique_ptr<ControlWire> wire_;  // for looks
};

}  // namespace understudy::emulator::page
