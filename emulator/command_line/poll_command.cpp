// Implements `understudy poll`, a simple Modbus master for quick checks, with libmodbus.
#include <errno.h>
#include <modbus/modbus-rtu.h>
#include <modbus/modbus.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "base/text/parse_real.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/model_option.h"
#include "emulator/device/command_window.h"
#include "emulator/device/modbus/modbus_ascii.h"
#include "emulator/device/model.h"
#include "emulator/device/program_error.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/register_map/wire_words.h"
#include "emulator/play/executors/free_executor.h"

namespace understudy::emulator::command_line {

namespace {

struct Item {
  std::string label;
  Table table = Table::holding;
  std::uint16_t address = 0;
  Type type = Type::u16;
  int count = 1;
  int bit = -1;
  int bits = 1;  // the number of bits, starting at `bit`
  bool low_word_first = true;
  RegisterRow order{};     // a register with its own word order
  bool is_a_half = false;  // the item is one half of a 32-bit register
  bool write = false;
  std::int64_t value = 0;
  std::string range{};                   // the register's range, if it is in the table
  std::vector<std::uint16_t> message{};  // for a command: all words to write
};

std::int64_t require_integer(std::string_view text, const std::string& item) {
  if (const auto value = parse_integer(text)) return *value;
  throw UsageError("poll: " + quoted(item) +
                   " is not understood; expected NAME, ADDRESS or ADDRESS:COUNT, optionally with =VALUE");
}

Type require_type(const std::string& name) {
  if (name == "u16") return Type::u16;
  if (name == "s16") return Type::s16;
  if (name == "u32") return Type::u32;
  if (name == "s32") return Type::s32;
  if (name == "f32") return Type::f32;
  throw UsageError("--type: " + quoted(name) + " is unknown; expected u16, s16, u32, s32 or f32");
}

/// Returns the table that a function code reads.
Table table_of_function(int function) {
  constexpr std::array kTables{Table::coil, Table::discrete, Table::holding, Table::input};
  if (function < 1 || function > static_cast<int>(kTables.size()))
    throw UsageError("--function: expected 1, 2, 3 or 4");
  return kTables[static_cast<std::size_t>(function - 1)];
}

/// Returns the largest count that fits in one request.
int most_at_once(const Item& item) {
  if (item.type == Type::bit) return MODBUS_MAX_READ_BITS;
  return is_32_bit(item.type) ? MODBUS_MAX_READ_REGISTERS / 2 : MODBUS_MAX_READ_REGISTERS;
}

/// Parses the value to write. The item's type must be known.
void read_value_of(Item& item, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) return;
  item.write = true;
  const std::string_view value = std::string_view(text).substr(equals + 1);
  if (item.type != Type::f32) {
    item.value = require_integer(value, text);
    return;
  }
  const auto real = parse_real(value);
  if (!real) throw UsageError("poll: " + quoted(text) + " is not understood; expected NAME=NUMBER");
  const auto single = static_cast<float>(*real);
  if (std::isinf(single)) throw UsageError("poll: " + quoted(text) + " is too large for a 32-bit real");
  item.value = value_of_real(single);
}

void require_rtu(const Model& model) {
  const bool is_ascii = is_modbus_ascii(model);
  if (model.rtu && model.registers != nullptr && !is_ascii) return;
  throw UsageError("poll: " + std::string(model.name) + " speaks " + std::string(model.line.protocol.name) +
                   (is_ascii ? ", but poll supports only Modbus RTU; expected another host"
                             : ", not Modbus; expected a model with registers, or a terminal program"));
}

/// `low_word_first` overrides the word order of the model's table.
Item parse_item(ModelList models, const std::string& text, const PollArguments& arguments,
                std::optional<bool> low_word_first) {
  Item item;
  if (low_word_first) item.low_word_first = *low_word_first;
  const std::size_t equals = text.find('=');
  const std::string what = text.substr(0, equals);
  item.label = what;
  item.table = table_of_function(arguments.function);
  if (!what.empty() && what[0] >= '0' && what[0] <= '9') {
    const std::size_t colon = what.find(':');
    const std::int64_t address = require_integer(std::string_view(what).substr(0, colon), text);
    if (address < 0 || address > 0xFFFF)
      throw UsageError("poll: address " + what + " is out of range; expected 0 to 0xFFFF");
    item.address = static_cast<std::uint16_t>(address);
    item.type = is_table_of_bits(item.table) ? Type::bit : require_type(arguments.type);
    read_value_of(item, text);
    // --function applies only to reads.
    if (item.write && item.table == Table::input) item.table = Table::holding;
    if (colon != std::string::npos) {
      const std::int64_t count = require_integer(std::string_view(what).substr(colon + 1), text);
      if (item.write)
        throw UsageError("poll: " + quoted(text) + " writes a range; expected one ADDRESS=VALUE");
      const int max = most_at_once(item);
      if (count < 1 || count > max)
        throw UsageError("poll: count of " + what + " is out of range; expected 1 to " + std::to_string(max));
      item.count = static_cast<int>(count);
    }
    return item;
  }
  if (arguments.model.empty())
    throw UsageError("poll: " + quoted(what) +
                     " is a name; expected --model MODEL to look it up, or an address");
  const Model& model = require_model(models, arguments.model);
  require_rtu(model);
  const auto found = find_register(model, what, model.firmwares.back());
  if (!found) {
    throw UsageError("poll: " + why_no_register(model, what, model.firmwares.back()));
  }
  const Place& place = found->place;
  // If a model has no input registers, function 4 reads its holding registers.
  const bool is_input_by_function =
      place.row->table == Table::holding && arguments.function == 4 && !model.registers->has(Table::input);
  item.table = is_input_by_function && text == what ? Table::input : place.row->table;
  item.low_word_first = low_word_first.value_or(model.registers->policy().low_word_first);
  item.order = *place.row;
  item.type = place.part == Place::Part::whole ? place.row->type : Type::u16;
  item.is_a_half = place.part != Place::Part::whole;
  const bool second = is_second_word(place, item.low_word_first);
  item.address = static_cast<std::uint16_t>(place.address() + (second ? 1 : 0));
  item.bit = found->bit;
  item.bits = found->width;
  read_value_of(item, text);
  if (place.row->ranged && place.part == Place::Part::whole) item.range = range_text(*place.row);
  if (item.write && item.bit >= 0)
    throw UsageError("poll: " + quoted(text) + " writes a bit; expected a whole register");
  return item;
}

Item command_item(ModelList models, const std::string& text, const PollArguments& arguments,
                  std::optional<bool> low_word_first) {
  if (arguments.model.empty())
    throw UsageError("poll: --command: the names of commands need a model; expected --model MODEL");
  const Model& model = require_model(models, arguments.model);
  const bool is_by_table_low_first = model.registers != nullptr && model.registers->policy().low_word_first;
  try {
    WindowMessage message =
        window_message(model, text,
                       {.firmware = model.firmwares.back(),
                        .low_word_first = low_word_first.value_or(is_by_table_low_first)});
    return {.label = text, .address = message.first, .write = true, .message = std::move(message.words)};
  } catch (const ProgramError& error) {
    throw UsageError("poll: " + quoted(text) + ": " + in_line(error.first()));
  }
}

struct ContextDeleter {
  void operator()(modbus_t* context) const {
    modbus_close(context);
    modbus_free(context);
  }
};
using Context = std::unique_ptr<modbus_t, ContextDeleter>;

// The rates that libmodbus supports. For any other rate, it silently uses 9600.
constexpr std::array kBauds{110,     300,     600,     1200,    2400,    4800,    9600,    19200,
                            38400,   57600,   115200,  230400,  460800,  500000,  576000,  921600,
                            1000000, 1152000, 1500000, 2000000, 2500000, 3000000, 3500000, 4000000};

/// Replaces unset settings of the line and the station with the model's factory values.
PollArguments with_line_of_model(ModelList models, PollArguments arguments) {
  pty::LineSettings line;
  int station = 1;
  if (!arguments.model.empty()) {
    const Model& model = require_model(models, arguments.model);
    const PortRow& port = model.line.ports.front();
    line = port.settings;
    line.baud = port.bauds.front();
    if (arguments.station == PollArguments::kUnsaid && model.rtu) {
      station = make_device(model, DeviceSettings())->station_number().value_or(station);
    }
  }
  if (arguments.station == PollArguments::kUnsaid) arguments.station = station;
  if (arguments.baud == PollArguments::kUnsaid) arguments.baud = line.baud;
  if (arguments.stop_bits == PollArguments::kUnsaid) arguments.stop_bits = line.stop_bits;
  if (arguments.parity.empty()) {
    arguments.parity = line.parity == pty::Parity::none  ? "none"
                       : line.parity == pty::Parity::odd ? "odd"
                                                         : "even";
  }
  return arguments;
}

char letter_of_parity(const std::string& parity) {
  return parity == "even" ? 'E' : parity == "odd" ? 'O' : parity == "none" ? 'N' : '?';
}

/// Describes a failed request: its station, port and settings.
std::string failure_text(const PollArguments& arguments, int error) {
  const std::string station = one_line(arguments.port) + ": station " + std::to_string(arguments.station);
  const std::string line = " at " + std::to_string(arguments.baud) + " 8" +
                           letter_of_parity(arguments.parity) + std::to_string(arguments.stop_bits);
  if (error == ETIMEDOUT) return station + " did not answer within " + arguments.timeout + line;
  if (error > MODBUS_ENOBASE && error < EMBBADCRC) {
    return station + " answered with exception " + std::to_string(error - MODBUS_ENOBASE) + " (" +
           modbus_strerror(error) + ")";
  }
  if (error >= EMBBADCRC) return station + line + ": " + modbus_strerror(error);
  return one_line(arguments.port) + ": " + modbus_strerror(error);
}

Context connect(const PollArguments& arguments) {
  const char parity = letter_of_parity(arguments.parity);
  if (parity == '?')
    throw UsageError("--parity: " + quoted(arguments.parity) + " is unknown; expected even, odd or none");
  const auto timeout = parse_duration(arguments.timeout);
  if (!timeout || *timeout < std::chrono::microseconds(1) || *timeout > std::chrono::hours(1))
    throw UsageError("--timeout: " + quoted(arguments.timeout) +
                     " is not a duration; expected one such as 500ms");
  // This is checked here, because libmodbus would print its own error messages.
  if (std::find(kBauds.begin(), kBauds.end(), arguments.baud) == kBauds.end()) {
    throw UsageError("--baud: " + std::to_string(arguments.baud) +
                     " is not a speed of a serial port; expected one such as 9600, 19200 or 115200");
  }
  if (arguments.stop_bits != 1 && arguments.stop_bits != 2) throw UsageError("--stop-bits: expected 1 or 2");
  if (arguments.station < 0 || arguments.station > 247) throw UsageError("--station: expected 0 to 247");
  if (arguments.times < 0) throw UsageError("--times: expected a number of rounds, or 0 for no limit");
  Context context(modbus_new_rtu(arguments.port.c_str(), arguments.baud, parity, 8, arguments.stop_bits));
  if (!context || modbus_set_slave(context.get(), arguments.station) != 0) {
    throw UsageError("poll: " + std::string(modbus_strerror(errno)) +
                     "; expected a port, a speed and a station from 0 to 247");
  }
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(*timeout);
  const auto rest = std::chrono::duration_cast<std::chrono::microseconds>(*timeout - seconds);
  modbus_set_response_timeout(context.get(), static_cast<std::uint32_t>(seconds.count()),
                              static_cast<std::uint32_t>(rest.count()));
  return context;
}

std::int64_t value_of(const Item& item, const std::uint16_t* words) {
  std::int64_t value = wire_word(item.order, words[0]);
  if (is_32_bit(item.type)) {
    const std::uint32_t bits = bits_of_wire(item.order, words[0], words[1], item.low_word_first);
    value = item.type == Type::s32 ? std::int64_t{static_cast<std::int32_t>(bits)} : std::int64_t{bits};
  } else if (item.type == Type::s16) {
    value = static_cast<std::int16_t>(value);
  }
  return item.bit < 0 ? value : value >> item.bit & ((std::int64_t{1} << item.bits) - 1);
}

bool read_bits(modbus_t* context, const Item& item) {
  std::array<std::uint8_t, MODBUS_MAX_READ_BITS> bits{};
  const auto read = item.table == Table::coil ? modbus_read_bits : modbus_read_input_bits;
  if (read(context, item.address, item.count, bits.data()) < 0) return false;
  for (int i = 0; i < item.count; ++i) {
    const int bit = bits[static_cast<std::size_t>(i)];
    if (item.count == 1) {
      std::printf("%s %d\n", item.label.c_str(), bit);
    } else {
      std::printf("0x%04X %d\n", static_cast<unsigned>(item.address + i), bit);
    }
  }
  return true;
}

bool read_item(modbus_t* context, const Item& item) {
  if (item.type == Type::bit) return read_bits(context, item);
  std::array<std::uint16_t, 125> words{};
  const int words_each = is_32_bit(item.type) ? 2 : 1;
  const auto read = item.table == Table::input ? modbus_read_input_registers : modbus_read_registers;
  if (read(context, item.address, item.count * words_each, words.data()) < 0) return false;
  for (int i = 0; i < item.count; ++i) {
    const std::string value =
        value_text(value_of(item, words.data() + i * words_each), item.bit < 0 ? item.type : Type::u16);
    if (item.count == 1) {
      std::printf("%s %s\n", item.label.c_str(), value.c_str());
    } else {
      std::printf("0x%04X %s\n", static_cast<unsigned>(item.address + i * words_each), value.c_str());
    }
  }
  return true;
}

bool write_item(modbus_t* context, const Item& item) {
  if (!item.message.empty()) {
    const auto size = static_cast<int>(item.message.size());
    return modbus_write_registers(context, item.address, size, item.message.data()) == size;
  }
  const auto bits = static_cast<std::uint32_t>(item.value);
  if (item.type == Type::bit) return modbus_write_bit(context, item.address, item.value != 0 ? 1 : 0) == 1;
  if (!is_32_bit(item.type))
    return modbus_write_register(context, item.address,
                                 wire_word(item.order, static_cast<std::uint16_t>(bits))) == 1;
  const auto words = wire_words(item.order, bits, item.low_word_first);
  return modbus_write_registers(context, item.address, 2, words.data()) == 2;
}

void require_fitting(const Item& item) {
  if (!item.write) return;
  if (item.table == Table::input || item.table == Table::discrete)
    throw UsageError("poll: " + item.label + " can only be read; expected a coil or a holding register");
  const bool is_bit = item.type == Type::bit;
  const bool wide = is_32_bit(item.type);
  const std::int64_t lowest = is_bit ? 0 : wide ? INT32_MIN : INT16_MIN;
  const std::int64_t highest = is_bit ? 1 : wide ? std::int64_t{UINT32_MAX} : std::int64_t{UINT16_MAX};
  if (item.value < lowest || item.value > highest) {
    const std::string words = std::to_string(lowest) + " to " + std::to_string(highest);
    throw UsageError("poll: " + std::to_string(item.value) + " does not fit into " + item.label +
                     "; expected " + (item.range.empty() ? words : item.range));
  }
}

/// Returns true if the model accepts station number 0.
bool answers_at_0(ModelList models, const PollArguments& arguments) {
  if (arguments.model.empty()) return false;
  const auto& numbers = require_model(models, arguments.model).line.station_numbers;
  return numbers && numbers->lowest == 0;
}

/// Returns all items to poll. `low_word_first` has the same meaning as for parse_item().
std::vector<Item> items_of(ModelList models, const PollArguments& arguments,
                           std::optional<bool> low_word_first) {
  std::vector<Item> items;
  for (const std::string& text : arguments.commands) {
    items.push_back(command_item(models, text, arguments, low_word_first));
  }
  for (const std::string& text : arguments.items) {
    items.push_back(parse_item(models, text, arguments, low_word_first));
    require_fitting(items.back());
    if (arguments.station == 0 && !items.back().write && !answers_at_0(models, arguments)) {
      throw UsageError(
          "--station: 0 is a broadcast, which devices do not answer; expected writes only, or 1 to 247");
    }
  }
  return items;
}

/// Returns the word order in the flags, or nothing if no flag sets it.
std::optional<bool> given_word_order(const PollArguments& arguments) {
  if (arguments.word_order.empty()) return std::nullopt;
  if (arguments.word_order == "low") return true;
  if (arguments.word_order == "high") return false;
  throw UsageError("--word-order: " + quoted(arguments.word_order) + " is unknown; expected low or high");
}

/// Returns the register with the device's word order. Returns nothing if no item depends on the order, or if
/// it is known.
std::optional<Item> word_order_item(ModelList models, const PollArguments& arguments,
                                    const std::vector<Item>& items) {
  const bool matters = std::any_of(items.begin(), items.end(), [](const Item& item) {
    return !item.message.empty() || is_32_bit(item.type) || item.is_a_half;
  });
  if (!matters || arguments.model.empty() || !arguments.word_order.empty()) return std::nullopt;
  if (arguments.station == 0) return std::nullopt;  // a broadcast gets no reply
  const Model& model = require_model(models, arguments.model);
  if (model.registers == nullptr || model.registers->policy().word_order_in.empty()) return std::nullopt;
  const std::string name(model.registers->policy().word_order_in);
  const auto found = find_register(model, name, model.firmwares.back());
  if (!found) return std::nullopt;
  return Item{.label = name, .table = found->place.row->table, .address = found->place.address()};
}

void keep_silent(const PollArguments& arguments) {
  // A device needs this pause to detect the end of an earlier frame.
  std::this_thread::sleep_for(play::silence_between_frames({.baud = arguments.baud}));
}

}  // namespace

int poll_port(ModelList models, const PollArguments& arguments) {
  const PollArguments polled = with_line_of_model(models, arguments);
  if (polled.items.empty() && polled.commands.empty())
    throw UsageError("poll: nothing to read; expected names or addresses, such as 0x0E04");
  std::vector<Item> items = items_of(models, polled, given_word_order(polled));
  SimTime every{0};
  if (!polled.every.empty()) {
    const auto parsed = parse_duration(polled.every);
    if (!parsed)
      throw UsageError("--every: " + quoted(polled.every) + " is not a duration; expected one such as 500ms");
    every = *parsed;
  }
  const Context context = connect(polled);
  if (modbus_connect(context.get()) != 0) {
    std::fprintf(stderr, "understudy: poll: %s: %s; expected a serial port\n", one_line(polled.port).c_str(),
                 modbus_strerror(errno));
    return kExitNoResource;
  }
  const auto order = word_order_item(models, polled, items);
  if (order) {
    std::uint16_t word = 0;
    keep_silent(polled);
    if (modbus_read_registers(context.get(), order->address, 1, &word) < 0) {
      const std::string why = failure_text(polled, errno);
      std::fprintf(stderr, "understudy: poll: %s, word order: %s (--word-order sets it)\n",
                   order->label.c_str(), why.c_str());
      return kExitFailed;
    }
    items = items_of(models, polled, word == 1);
  }
  for (int round = 0; round < polled.times || polled.times == 0; ++round) {
    if (round > 0) std::this_thread::sleep_for(every);
    for (std::size_t i = 0; i < items.size(); ++i) {
      const Item item = items[i];
      keep_silent(polled);
      const bool good = item.write ? write_item(context.get(), item) : read_item(context.get(), item);
      // A broadcast gets no reply.
      const bool is_broadcast = polled.station == 0 && item.write && errno == ETIMEDOUT;
      if (good && order && item.write && item.table == order->table && item.address == order->address)
        items = items_of(models, polled, item.value == 1);  // the new order applies from here on
      if (good || is_broadcast) continue;
      const std::string why = failure_text(polled, errno);
      std::fprintf(stderr, "understudy: poll: %s: %s\n", item.label.c_str(), why.c_str());
      return kExitFailed;
    }
    std::fflush(stdout);
  }
  return kExitWell;
}

}  // namespace understudy::emulator::command_line
