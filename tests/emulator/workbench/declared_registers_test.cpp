// The whole register maps of two large controllers, written down with the vocabulary of rows, and read and
// written over Modbus as their manuals say. The maps are facts from the manuals: a line for each register, or
// for a run of them (declared/*.csv).
#include <gtest/gtest.h>

#include <map>

#include "emulator/device/device_of.h"
#include "emulator/device/register_map/access.h"
#include "tests/emulator/workbench/workbench.h"
#include "tests/emulator/world/stations/pdus.h"
#include "tests/interpreter/facts.h"

namespace understudy::emulator::workbench {
namespace declared_registers_test {

using world::Bytes;
using Words = std::vector<std::uint16_t>;

/// A line of a map.
struct Declaration {
  Table table = Table::holding;
  int address = 0;
  std::string name;
  int first_number = 0;
  int count = 1;
  Type type = Type::u16;
  std::string access;  // R, R/W, W; "-": a hole that the manual mentions
  std::string held;    // stored, view, window, hole
  bool is_persistent = false;
  Value power_up = 0;

  int words() const { return is_32_bit(type) ? 2 : 1; }
};

Type type_called(const std::string& word) {
  constexpr std::pair<std::string_view, Type> kTypes[] = {{"u16", Type::u16}, {"s16", Type::s16},
                                                          {"u32", Type::u32}, {"s32", Type::s32},
                                                          {"bit", Type::bit}, {"f32", Type::f32}};
  for (const auto& [name, type] : kTypes) {
    if (name == word) return type;
  }
  throw std::invalid_argument(word);
}

std::vector<Declaration> facts_of(const std::string& controller) {
  std::vector<Declaration> facts;
  for (const auto& cells : read_facts(TEST_FACTS "/workbench/declared/" + controller + ".csv")) {
    const auto at = [&](const char* column) { return cells.at(column); };
    facts.push_back({.table = *table_called(at("table")),
                     .address = std::stoi(at("address")),
                     .name = at("name"),
                     .first_number = std::stoi(at("first_number")),
                     .count = std::stoi(at("count")),
                     .type = type_called(at("type")),
                     .access = at("access"),
                     .held = at("held"),
                     .is_persistent = at("kept") == "1",
                     .power_up = std::stoll(at("power_up"))});
  }
  return facts;
}

/// Holds the values of its rows; views show numbers outside the image, by the row's number.
class Declared final : public DeviceOf<Declared>, public RegisterBankOf<Declared> {
 public:
  Declared(const Model& model, const DeviceSettings& settings)
      : DeviceOf(model, settings), RegisterBankOf(*this, *model.registers, settings.firmware) {
    for (const RegisterRow& row : model.registers->rows()) {
      const auto count = static_cast<std::size_t>(row.count);
      if (row.is_view) {
        views[row.argument].assign(count, row.factory);
      } else {
        stored.insert(stored.end(), count, static_cast<std::uint32_t>(row.factory));
      }
    }
  }
  std::span<std::uint32_t> image() override { return stored; }
  std::span<const std::uint32_t> image() const override { return stored; }
  void register_written(const RegisterRow&, std::size_t) override {}
  void warn_not_implemented(const RegisterRow&) const override {}

  std::vector<std::uint32_t> stored;
  std::map<int, std::vector<Value>> views;
  std::vector<Words> messages;

 protected:
  void write_own_state(StateWriter&) const override {}
  std::function<void()> read_own_state(StateReader&) override {
    return [] {};
  }
  std::string own_difference(StateReader&, StateReader&) const override { return ""; }
};

Value seen(const Declared& device, Cell cell) {
  return device.views.at(cell.argument)[static_cast<std::size_t>(cell.index)];
}
void take(Declared& device, Cell cell, Value value) {
  device.views.at(cell.argument)[static_cast<std::size_t>(cell.index)] = value;
}
DeviceAnswer receive(Declared& device, Cell, std::span<const std::uint16_t> words) {
  device.messages.emplace_back(words.begin(), words.end());
  return Refusal::none;
}

RegisterRow row_of(const Declaration& fact, int number) {
  const auto address = static_cast<std::uint16_t>(fact.address);
  if (fact.held == "window")
    return emulator::window<receive>(address, fact.name, fact.count).also("Sub_Function_Code");
  const Access access = fact.access == "R"   ? Access::read
                        : fact.access == "W" ? Access::write
                                             : Access::read_write;
  RegisterRow row = reg(fact.table, address, fact.name, fact.type, access).from_factory(fact.power_up);
  if (fact.count > 1 || fact.name.find("{}") != std::string::npos) {
    row.times(fact.count, fact.words(), fact.first_number);
  }
  if (fact.held == "view") row.shows<seen, Varies::in_ticks>(number);
  if (fact.held == "view" && access != Access::read) row.does<take>(number);
  return fact.is_persistent ? row.persists() : row;
}

std::vector<RegisterRow> rows_of(std::span<const Declaration> facts) {
  std::vector<RegisterRow> rows;
  for (std::size_t i = 0; i < facts.size(); ++i) {
    if (facts[i].held != "hole") rows.push_back(row_of(facts[i], static_cast<int>(i)));
  }
  return rows;
}

constexpr std::uint8_t kAllFunctions[] = {0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0x0F, 0x10};
constexpr std::uint8_t kWithoutInputRegisters[] = {0x01, 0x02, 0x03, 0x05, 0x06, 0x0F, 0x10};

// The rules of its chapter on exceptions, and on pairs and holes.
constexpr MapPolicy kRsM8194H{.unmapped = MapPolicy::Unmapped::holes_read_zero,
                              .write_only = MapPolicy::WriteOnly::refused,
                              .read_only = MapPolicy::ReadOnly::refused,
                              .halves = MapPolicy::Halves::come_whole,
                              .read_halves = MapPolicy::ReadHalves::come_whole,
                              .low_word_first = false};
constexpr MapPolicy kSuper40Nc{.unmapped = MapPolicy::Unmapped::refused,
                               .read_only = MapPolicy::ReadOnly::ignores_writes,
                               .halves = MapPolicy::Halves::may_be_written_alone,
                               .low_word_first = true};

struct Controller {
  Controller(const std::string& name, const MapPolicy& policy, std::span<const std::uint8_t> functions)
      : facts(facts_of(name)),
        map(rows_of(facts), policy),
        model{.name = "declared",
              .title = "",
              .firmwares = kFirmwares,
              .registers = &map,
              .choices = {},
              .terminals = {},
              .axes = {},
              .state_registers = {},
              .known_limitations = {},
              .line = {.protocol = kModbusRtu, .ports = kPorts},
              .rtu = RtuRules{.functions = functions},
              .make = nullptr},
        device(model, settings()) {}
  static DeviceSettings settings() {
    DeviceSettings made;
    made.name = "it";
    made.firmware = 100;
    return made;
  }

  std::string ask(const Bytes& pdu) { return world::answer(device, pdu); }

  std::vector<Declaration> facts;
  RegisterMap map;
  Model model;
  Declared device;
};

Bytes bytes_of_bits(std::uint32_t bits, Type type, bool low_word_first) {
  if (type == Type::bit) return {static_cast<std::uint8_t>(bits & 1)};
  Bytes bytes;
  if (is_32_bit(type) && !low_word_first) world::put(bytes, bits >> 16);
  world::put(bytes, bits & 0xFFFF);
  if (is_32_bit(type) && low_word_first) world::put(bytes, bits >> 16);
  return bytes;
}

std::uint8_t reading(Table table) {
  constexpr std::uint8_t kCodes[] = {0x03, 0x04, 0x01, 0x02};  // in the order of Table
  return kCodes[static_cast<std::size_t>(table)];
}

Bytes read_of(const Declaration& fact, int index) {
  return world::read_pdu(reading(fact.table), static_cast<std::size_t>(fact.address + index * fact.words()),
                         static_cast<std::size_t>(fact.words()));
}

/// Functions 0F and 10: as many as the register has.
Bytes write_of(const Declaration& fact, int index, std::uint32_t bits, bool low_word_first) {
  const bool is_bit = fact.type == Type::bit;
  Bytes pdu =
      world::read_pdu(is_bit ? 0x0F : 0x10, static_cast<std::size_t>(fact.address + index * fact.words()),
                      static_cast<std::size_t>(fact.words()));
  const Bytes data = bytes_of_bits(bits, fact.type, low_word_first);
  pdu.push_back(static_cast<std::uint8_t>(data.size()));
  pdu.insert(pdu.end(), data.begin(), data.end());
  return pdu;
}

std::string good_reply(const Declaration& fact, std::uint32_t bits, bool low_word_first) {
  const Bytes data = bytes_of_bits(bits, fact.type, low_word_first);
  return world::text(Bytes{reading(fact.table), static_cast<std::uint8_t>(data.size())}) + " " +
         world::text(data);
}

std::string refusal(std::uint8_t function, int exception) {
  return world::text(Bytes{static_cast<std::uint8_t>(function | 0x80), static_cast<std::uint8_t>(exception)});
}

/// A value that each register can hold, a different one for each.
std::uint32_t some_bits(const Declaration& fact, int index) {
  const std::uint32_t mixed = static_cast<std::uint32_t>(fact.address + index * 7 + 1) * 2654435761U;
  if (fact.type == Type::bit) return 1;
  if (fact.type == Type::f32) return static_cast<std::uint32_t>(value_of_real(static_cast<float>(mixed) / 3));
  return is_32_bit(fact.type) ? mixed : mixed >> 16;
}

/// The first, middle and last register of each row.
std::vector<int> sample_of(const Declaration& fact) {
  std::vector<int> indices{0};
  if (fact.count > 2) indices.push_back(fact.count / 2);
  if (fact.count > 1) indices.push_back(fact.count - 1);
  return indices;
}

void expect_as_written_down(Controller& controller) {
  const bool low_first = controller.map.policy().low_word_first;
  const bool ignores = controller.map.policy().read_only == MapPolicy::ReadOnly::ignores_writes;
  int seen_registers = 0;
  for (const Declaration& fact : controller.facts) {
    for (const int index : sample_of(fact)) {
      SCOPED_TRACE(fact.name + " at " + std::to_string(fact.address) + "[" + std::to_string(index) + "]");
      const Bytes read = read_of(fact, index);
      if (fact.held == "hole") {
        EXPECT_EQ(controller.ask(read), good_reply(fact, 0, low_first));
        continue;
      }
      ++seen_registers;
      const auto before = static_cast<std::uint32_t>(fact.power_up);
      const std::string as_it_was = good_reply(fact, before, low_first);
      const bool can_be_read = fact.access != "W";
      EXPECT_EQ(controller.ask(read), can_be_read ? as_it_was : refusal(read[0], 2));
      if (fact.table == Table::input || fact.table == Table::discrete) continue;
      const std::uint32_t bits = some_bits(fact, index);
      const Bytes write = write_of(fact, index, bits, low_first);
      const std::string done = world::text(Bytes(write.begin(), write.begin() + 5));
      const bool can_be_written = fact.access != "R";
      const bool is_in_a_window = fact.held == "window" && index > 0;
      EXPECT_EQ(controller.ask(write), (can_be_written && !is_in_a_window) || (ignores && !can_be_written)
                                           ? done
                                           : refusal(write[0], 2));
      if (can_be_read) {
        EXPECT_EQ(controller.ask(read), can_be_written ? good_reply(fact, bits, low_first) : as_it_was);
      }
    }
  }
  EXPECT_GT(seen_registers, 200);
}

TEST(DeclaredRegisters, OfTheRsM8194HAnswerAsItsManualSays) {
  Controller controller("rs-m8194h", kRsM8194H, kAllFunctions);
  expect_as_written_down(controller);
  EXPECT_EQ(controller.device.messages.size(), 1U);
}

TEST(DeclaredRegisters, OfTheSuper40NcAnswerAsItsManualSays) {
  Controller controller("super-40nc", kSuper40Nc, kWithoutInputRegisters);
  expect_as_written_down(controller);
  EXPECT_EQ(controller.ask(world::read_pdu(0x04, 0, 1)), "84 01");
}

TEST(DeclaredRegisters, EachIsFoundByItsNameInItsTable) {
  const Controller controllers[] = {{"rs-m8194h", kRsM8194H, kAllFunctions},
                                    {"super-40nc", kSuper40Nc, kWithoutInputRegisters}};
  for (const Controller& controller : controllers) {
    for (const RegisterRow& row : controller.map.rows()) {
      for (int i = 0; i < row.count; ++i) {
        const std::string name = std::string(to_string(row.table)) + "." + RegisterMap::name_of(row, i);
        const auto found = controller.map.find(name, 100);
        ASSERT_TRUE(found) << name;
        EXPECT_EQ(found->place.address(), row.address + i * row.stride) << name;
      }
    }
  }
  const RegisterMap& map = controllers[1].map;
  EXPECT_EQ(map.find("D8117", 100)->place.address(), 7234);
  EXPECT_EQ(map.find("D53", 100)->place.address(), 106);
  EXPECT_EQ(map.why_not("T7", 100), "'T7' is in several tables; expected one of holding.T7, coil.T7");
  const RegisterMap& other = controllers[0].map;
  EXPECT_EQ(other.find("Sub_Function_Code", 100)->place.address(), 8000);
  EXPECT_EQ(other.find("Reg100", 100)->place.address(), 8100);
  EXPECT_EQ(other.find("input.Logic Position U", 100)->place.address(), 32);
  EXPECT_TRUE(other.find("MD1024", 100)->is_real());
}

TEST(DeclaredRegisters, HolesAreWhatTheManualsSay) {
  Controller rsm("rs-m8194h", kRsM8194H, kAllFunctions);
  EXPECT_EQ(rsm.ask(world::hex("04 00 1A 00 20")).size(), 3U * 66 - 1) << "the positions of all axes";
  EXPECT_EQ(rsm.ask(world::hex("04 00 1B 00 02")), "84 02") << "from the second word";
  EXPECT_EQ(rsm.ask(world::hex("04 00 1A 00 01")), "84 02") << "the first alone";
  EXPECT_EQ(rsm.ask(world::hex("06 00 5A 00 01")), "86 02") << "half a position";
  EXPECT_EQ(rsm.ask(world::hex("03 1F A4 00 01")), "83 02")
      << "the last register of the window is write-only";
  EXPECT_EQ(rsm.ask(world::hex("03 1F A5 00 01")), "83 02") << "beyond the table";
  EXPECT_EQ(rsm.ask(world::hex("03 02 00 00 02")), "03 04 00 00 00 00");
  EXPECT_EQ(rsm.ask(world::hex("06 0A 00 00 01")), "86 02") << "a hole stores nothing";
  Controller super("super-40nc", kSuper40Nc, kWithoutInputRegisters);
  const std::pair<const char*, const char*> cases[] = {
      {"01 00 20 00 01", "81 02"}, {"01 00 1F 00 02", "81 02"}, {"01 0A 8C 00 01", "81 02"},
      {"03 08 50 00 01", "83 02"}, {"03 27 10 00 01", "83 02"}, {"06 20 08 00 01", "86 02"},
      {"05 03 E0 FF 00", "85 02"}, {"02 00 30 00 01", "82 02"}};
  for (const auto& [request, reply] : cases) EXPECT_EQ(super.ask(world::hex(request)), reply) << request;
  EXPECT_EQ(super.ask(world::hex("06 00 6A 02 2B")), "06 00 6A 02 2B") << "a low word alone";
  EXPECT_EQ(super.ask(world::hex("03 00 6A 00 02")), "03 04 02 2B 00 00") << "D53, as in the manual";
}

}  // namespace declared_registers_test
}  // namespace understudy::emulator::workbench
