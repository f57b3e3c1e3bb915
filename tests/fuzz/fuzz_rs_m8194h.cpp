// Writes of a host to the window of an RS-M8194H: messages of any registers. Each is refused with a reason,
// or converts to text and back without loss; downloads follow, and their macros run.
//
// A message starts with a byte: how many registers (0 to 31) and, above that, the word order and how many
// ticks run first; then come the registers, high bytes first.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/state/state_bytes.h"
#include "interpreter/rs_m8194h/download.h"
#include "interpreter/rs_m8194h/listing.h"
#include "interpreter/rs_m8194h/run.h"
#include "interpreter/rs_m8194h/state_fields.h"
#include "interpreter/rs_m8194h/text.h"
#include "interpreter/rs_m8194h/window.h"
#include "tests/fuzz/fuzzing.h"

namespace {

using namespace understudy::interpreter::rs_m8194h;
using understudy::fuzzing::require;

class Controller : public Machine {
 public:
  const Macro* macro(const MacroName& name) const override {
    const auto found = macros.find(name);
    return found == macros.end() ? nullptr : &found->second;
  }
  std::int32_t variable(std::size_t number) const override { return variables.at(number); }
  void set_variable(std::size_t number, std::int32_t value) override { variables.at(number) = value; }
  std::uint8_t byte_variable(std::size_t number) const override { return byte_variables.at(number); }
  std::int32_t read(const Command& command) const override {
    check_numbers(command);
    return static_cast<std::int32_t>(now_ms);
  }
  bool stand(std::uint32_t axes) const override { return (now_ms & axes) == 0; }
  bool frnet_input(std::uint32_t group, std::uint32_t channel) const override {
    require(group >= 8 && group <= 15 && channel <= 15, "an input exists");
    return (now_ms >> 2U & 1) != 0;
  }
  Took carry_out(const Command& command) override {
    check_numbers(command);
    return command.row().use.starts_motion && now_ms % 3 == 0 ? Took::waits : Took::done;
  }
  int take_isr() override { return std::exchange(isr, 0); }
  void mp_ended() override {}
  void terminated() override {}
  void report(const ExecutionFault& fault) override {
    require(fault.fault != Fault::none && macro(fault.macro) != nullptr, "a fault has its macro");
  }

  static void check_numbers(const Command& command) {
    Command plain = command;
    plain.code = real_time_code(command.verb());
    require(!bad_parameter(plain, Options{option("rectangle_radius", "drawn_shorter")}),
            "a macro's numbers are in their ranges");
  }

  std::map<MacroName, Macro> macros;
  std::array<std::int32_t, kVariableCount> variables{};
  std::array<std::uint8_t, kByteVariableCount> byte_variables{};
  std::int64_t now_ms = 0;
  int isr = 0;
};

class Box {
 public:
  void take(const std::vector<std::uint16_t>& registers, WordOrder order) {
    const State state = !download_               ? State::ready
                        : download_->name.is_isr ? State::isr_download
                                                 : State::mp_download;
    const Decoded decoded = decode(registers, state, order);
    if (decoded.fault != Fault::none) {
      require(row_of(decoded.fault).exception != 0, "a fault has its exception");
      if (download_ && !registers.empty()) refuse(*download_, registers[0], decoded.fault);
      return;
    }
    const Command& command = decoded.command;
    check_command(command, order);
    switch (command.verb()) {
      case Verb::mp_create: download_ = Download{.name = {false, static_cast<int>(command.values[0])}}; break;
      case Verb::isr_create: download_ = Download{.name = {true, static_cast<int>(command.values[0])}}; break;
      case Verb::mp_close:
      case Verb::isr_close: end_download(); break;
      default: download_ ? add_line(command) : carry_out(command);
    }
  }

  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      ++controller_.now_ms;
      run_tick(execution_, controller_.now_ms, 8, false, {}, controller_);
      require(is_sound(execution_, controller_), "what runs is sound");
    }
  }

  void check_state() const {
    understudy::StateWriter writer;
    writer.write(execution_);
    writer.write(download_.value_or(Download{.name = {false, 1}}));
    const std::vector<std::byte> bytes = writer.take();
    understudy::StateReader reader(bytes);
    Execution execution;
    Download download;
    reader.read(execution);
    reader.read(download);
    require(execution == execution_, "what runs is saved whole");
    require(!download_ || download == *download_, "a download is saved whole");
    Listing listing;
    for (const auto& [name, macro] : controller_.macros) listing.macros.push_back({name, macro});
    const ParsedListing again = parse_listing(text_of(listing));
    require(again.errors.empty() && again.listing == listing, "stored macros are read back from their text");
  }

 private:
  static void check_command(const Command& command, WordOrder order) {
    Command again;
    require(read_registers(encode(command, order), order, again) == Fault::none && again == command,
            "a command is the same again by its registers");
    if (bad_operand(command)) return;
    const ParsedCommand parsed = parse_command(text_of(command));
    require(parsed.command == command, "a command is the same again by its text");
  }

  void add_line(const Command& command) {
    const std::size_t before = download_->lines.size();
    const Fault fault = add(*download_, command);
    require(download_->lines.size() == before + (fault == Fault::none ? 1 : 0),
            "a refused line is not stored");
  }

  void end_download() {
    Closed closed = close(*download_);
    require(closed.macro.has_value() == (download_->fault == Fault::none), "what has no error is stored");
    require((status_of(*download_, {}).error == 0) == closed.macro.has_value(), "an error has its code");
    if (closed.macro) {
      controller_.macros[download_->name] = std::move(*closed.macro);
      replaced(execution_, download_->name, controller_);
    }
    download_.reset();
  }

  void carry_out(const Command& command) {
    const auto number = static_cast<int>(command.values[0]);
    if (command.verb() == Verb::mp_call && !execution_.mp.is_alive()) {
      start_mp(execution_, number, controller_.now_ms + 1, controller_);
    }
    if (command.verb() == Verb::isr_call) controller_.isr = number;
    if (command.verb() == Verb::mp_terminate) terminate(execution_);
    if (command.verb() == Verb::write_var) {
      controller_.variables[variable_number(command.values[0])] = command.signed_value(1);
    }
    if (command.verb() == Verb::write_byte_var) {
      controller_.byte_variables[byte_variable_number(command.values[0])] =
          static_cast<std::uint8_t>(command.values[1]);
    }
    if (command.verb() == Verb::clear_card_buffer) drop_wait(execution_, controller_);
  }

  Controller controller_;
  Execution execution_;
  std::optional<Download> download_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Box box;
  std::size_t at = 0;
  while (at < size) {
    const unsigned head = data[at++];
    const std::size_t count = std::min<std::size_t>(head & 31U, (size - at) / 2);
    std::vector<std::uint16_t> registers;
    for (std::size_t i = 0; i < count; ++i, at += 2) {
      registers.push_back(static_cast<std::uint16_t>(data[at] << 8U | data[at + 1]));
    }
    box.run(static_cast<int>(head >> 6U));
    box.take(registers, (head & 32U) != 0 ? WordOrder::low_first : WordOrder::high_first);
  }
  box.run(20);
  if (understudy::fuzzing::is_checked_wholly({data, size}, 16)) box.check_state();
  return 0;
}
