// A session of the Debug Adapter Protocol. It answers requests by sending messages to a daemon.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/dap/bench_link.h"

namespace understudy::emulator::dap {

/// A daemon that was started or found.
struct Launched {
  std::unique_ptr<BenchLink> link;
  std::function<void()> end{};          // ends the daemon; empty if the session does not own it
  std::function<std::string()> news{};  // what it has printed since the last call; may be empty
};
/// Starts or finds a daemon for the request `launch` or `attach` with these arguments. A daemon that it
/// starts has a stopped clock. Throws an exception whose message is one sentence.
using Launcher = std::function<Launched(std::string_view request, const Json& arguments)>;

class Session {
 public:
  enum class Phase : std::uint8_t { fresh, ready, configuring, stopped, running, ended, over };

  using Send = std::function<void(const Json& message)>;
  Session(Launcher launcher, Send send) : launcher_(std::move(launcher)), send_(std::move(send)) {}
  ~Session() { end(); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Answers a request.
  void handle(const std::string& text);
  bool is_over() const { return phase_ == Phase::over; }
  /// Returns true if poll() must be called regularly.
  bool has_bench() const { return link_ != nullptr; }
  bool is_running() const { return phase_ == Phase::running; }
  /// Returns the descriptor that reports the end of an advance, or -1.
  int awaited() const { return link_ ? link_->awaited() : -1; }
  /// Tells the client what has happened on the bench.
  void poll();
  /// Shows the client a message that is not an answer.
  void print(const std::string& text, const char* category = "important");

 private:
  struct Row {
    std::string_view command;
    Json (Session::*answer)(const Json& arguments);
    unsigned phases;
  };
  static std::span<const Row> rows();

  struct DeviceInfo {
    std::string name;
    bool has_program = false;
    bool has_many = false;  // several programs at once; otherwise it has only one thread
    std::vector<std::pair<std::int64_t, std::string>> sections{};  // the number of rows, and the title
    std::map<std::string, Json> registers{};                       // rows of a `registers` reply
    std::string mapped{};       // the file that has the text of its program, if the bench names none
    std::string mapped_text{};  // that text
  };
  struct Thread {
    std::size_t device = 0;
    std::string program{};
  };
  /// An instruction of a program, counted from 0. Clients refer to it by a number.
  struct Address {
    std::size_t space = 0;  // an index into spaces_
    std::int64_t instruction = 0;
  };
  /// The program of a device: its text, and the file that it comes from, if there is one.
  struct Source {
    std::string path;
    std::string text;
    Json lines;  // the lines that have an instruction
  };
  /// A breakpoint in a device. A client's breakpoint in a file that several devices run becomes several of
  /// these.
  struct SetPoint {
    int id = 0;
    std::string key{};  // the source, or one of the constants below
    Json message{};
    int number = 0;  // the daemon's number; 0 if the daemon does not have it
    std::size_t device = 0;
    int line = 0;  // 0 if it is not at a line, or was not found
  };
  // References above this are registers with bits: this number plus the place in with_bits_, from 1.
  static constexpr std::int64_t kFirstBits = 1'000'000'000;
  static constexpr const char* kEvents = "events";
  static constexpr const char* kData = "data";
  static constexpr const char* kInstructions = "instructions";
  static constexpr const char* kLongTime = "1h";  // of simulated time

  // session.cpp
  Json answer(const std::string& command, const Json& arguments);
  void event(std::string_view name, Json body);
  Json initialize(const Json& arguments);

  // opening.cpp
  Json launch(const Json& arguments);
  Json attach(const Json& arguments);
  Json configuration_done(const Json& arguments);
  void stop_at_entry();
  Json restart(const Json& arguments);
  Json terminate(const Json& arguments);
  Json disconnect(const Json& arguments);
  void open(std::string_view request, const Json& arguments);
  void find_devices();
  void map_sources(const Json& arguments);
  void print_ports();
  void end();

  // stacks.cpp
  Json threads(const Json& arguments);
  Json stack_trace(const Json& arguments);
  Json source(const Json& arguments);
  Json stack_of(std::size_t device) const;
  std::vector<std::string> programs_of(std::size_t device) const;
  Source source_of(std::size_t device) const;
  Json source_json(std::size_t device) const;
  const Thread& thread_of(const Json& arguments) const;
  std::string thread_name(const Thread& thread) const;
  int thread_number(std::size_t device, const std::string& program);
  std::size_t device_of_source(std::int64_t reference) const;
  std::size_t device_of_frame(const Json& arguments) const;

  // disassembly.cpp
  Json disassemble(const Json& arguments);
  Json set_instruction_breakpoints(const Json& arguments);
  std::string address_of(std::size_t device, const std::string& program, std::int64_t instruction);
  Address parsed_address(const Json& arguments, const char* key) const;

  // continuing.cpp
  Json continue_program(const Json& arguments);
  Json next(const Json& arguments);
  Json step_in(const Json& arguments);
  Json step_out(const Json& arguments);
  Json step_back(const Json& arguments);
  Json reverse(const Json& arguments);
  Json pause(const Json& arguments);
  Json step(const Json& arguments, const char* what, bool is_back = false);
  void report_stop(const Json& stop, const char* reason, const std::string& text = {});
  const char* reason_of(const Json& stop, Json& body) const;
  void receive_events(const Json& events);
  Json check_bench();
  void follow(const Json& seen);
  void has_ended(const std::string& why);

  // breakpoints.cpp
  Json set_breakpoints(const Json& arguments);
  Json breakpoint_locations(const Json& arguments);
  Json set_exception_breakpoints(const Json& arguments);
  Json set_data_breakpoints(const Json& arguments);
  Json data_breakpoint_info(const Json& arguments);
  Json set_one(const std::string& key, int id, Json message);
  Json set_line(const std::string& key, const Json& wanted, const std::vector<std::size_t>& devices);
  void delete_those(const std::string& key);
  void delete_from_bench();
  void set_again();
  std::vector<std::size_t> devices_with(const Json& source, std::string& why_none, std::string& what_differs);

  // values.cpp
  Json scopes(const Json& arguments);
  Json variables(const Json& arguments);
  void add_state(std::size_t device, Json& all);
  void add_scope(std::size_t device, const std::string& scope, bool as_hex, Json& all);
  void add_section(std::size_t device, std::int64_t section, const Json& arguments, Json& all);
  void add_bits(const std::string& whole, Json& all);
  Json entry(std::size_t device, const std::string& name, const Json& value, bool as_hex, bool is_register);
  const Json* known_register(std::size_t device, const std::string& name);
  std::size_t device_of_reference(std::int64_t reference) const;
  const std::string& register_of_reference(std::int64_t reference) const;

  // expressions.cpp
  Json evaluate(const Json& arguments);
  Json set_variable(const Json& arguments);
  Json set_expression(const Json& arguments);
  Json completions(const Json& arguments);
  Json value_of(const std::string& expression, std::size_t device) const;
  Json set_value(const std::string& whole, const std::string& value) const;
  Json set_bit(const std::string& whole, const std::string& bit, const std::string& value);
  Json words_of(std::size_t device) const;
  std::vector<std::string> names_of(const DeviceInfo& device, const std::string& part) const;
  std::size_t device_of_name(const std::string& whole) const;
  std::string whole_name(const std::string& name, std::size_t device) const;

  Launcher launcher_;
  Send send_;
  Phase phase_ = Phase::fresh;
  std::int64_t next_sequence_ = 1;
  int line_offset_ = 0;    // added to the client's line numbers
  int column_offset_ = 0;  // added to the client's columns
  bool stops_at_entry_ = false;
  bool is_manual_ = true;
  bool wants_pause_ = false;
  bool is_recording_ = false;
  bool goes_back_ = false;
  std::string failure_{};    // the failure at the end of a scenario's recording, in a sentence
  bool was_paused_ = false;  // true if time was stopped when the session attached
  std::string speed_{};      // of a launched bench
  Launched launched_{};
  std::unique_ptr<BenchLink> link_{};
  std::vector<DeviceInfo> devices_{};
  std::vector<Thread> threads_{};         // by number, from 1
  std::vector<Thread> spaces_{};          // programs whose instructions have been given addresses
  std::vector<std::string> with_bits_{};  // whole names of registers
  Json stop_{};                           // the bench's current stop, or null
  std::uint64_t next_event_ = 1;
  std::vector<SetPoint> points_{};
  int last_id_ = 0;
};

}  // namespace understudy::emulator::dap
