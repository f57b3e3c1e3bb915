// Any bytes as a list of registers for `import` are refused with errors, or they are registers that make a
// map. Any text as a model file, including its list, is refused with errors of one line each, or it is a
// model: then its description gives the same model, and a device of it accepts any write to its
// registers, with the same result by single ticks and after a restore.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/files/file_error.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/model_file/list_fields.h"
#include "emulator/model_file/list_reading.h"
#include "emulator/model_file/model_files.h"
#include "emulator/model_file/starter.h"
#include "emulator/model_file/thing_reader.h"
#include "emulator/models/imported/model.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/world.h"
#include "tests/fuzz/fuzzing.h"

namespace {

using namespace understudy;
using namespace understudy::emulator;
using fuzzing::require;

constexpr std::size_t kLongest = 4096;
constexpr std::size_t kMaxWritten = 64;  // registers

void write_each(world::World& world, std::uint32_t& number) {
  Device& device = world.device(0);
  RegisterBank& bank = *device.register_bank();
  const auto rows = bank.map().rows();
  for (std::size_t i = 0; i < rows.size() && i < kMaxWritten; ++i) {
    if (rows[i].access == Access::read) continue;
    number = number * 1664525 + 1013904223;
    const Place place = bank.at(rows[i].table, rows[i].address);
    NamedPlace named{.place = place};
    named.place.part = Place::Part::whole;
    const Value value = number % 3 == 0 ? static_cast<Value>(number >> 28) : value_of(number, rows[i].type);
    PreparedWrite write;
    if (prepare_value(bank, named, value, write) == Refusal::none) world.write(0, write);
  }
  for (std::size_t terminal = 0; terminal < device.model().terminals.size(); ++terminal) {
    number = number * 1664525 + 1013904223;
    const TerminalRow& row = device.model().terminals[terminal];
    if (is_input(row.kind) && row.highest == 1)
      world.set_external_input(0, static_cast<int>(terminal), static_cast<std::int32_t>(number >> 31));
  }
}

void run(const Model& model) {
  DeviceSettings settings;
  settings.name = "it";
  world::Bench bench = world::bench_of_one(model, settings, "");
  world::World world(bench, {}, {});
  world::World by_ticks(bench, {}, {});
  by_ticks.set_bulk_ticks(false);
  std::uint32_t number = 1;
  std::uint32_t same_number = 1;
  for (const int ticks : {1, 30, 400}) {
    write_each(world, number);
    write_each(by_ticks, same_number);
    world.advance_to(world.now() + ticks * kTickLength);
    by_ticks.advance_to(by_ticks.now() + ticks * kTickLength);
    require(world::hash(world) == world::hash(by_ticks), "many ticks in one step are the same as one by one");
  }
  world::World restored(bench, {}, {});
  world::restore(restored, world::save(world));
  restored.advance_to(restored.now() + 50 * kTickLength);
  world.advance_to(world.now() + 50 * kTickLength);
  require(world::hash(world) == world::hash(restored), "a state that is saved is one that goes on alike");
}

void require_map(const model_file::RegisterList& list) {
  std::vector<std::vector<BitField>> fields;
  const RegisterMap map(models::imported::plain_rows(list.registers, {}, fields), {});
  map.require_distinct_names();
  require(!list.registers.empty(), "a list has a register");
}

/// Reads bytes as `import` does, with the first byte choosing how.
void import_list(const std::string& bytes) {
  constexpr std::array kReadings{model_file::AddressReading::wire, model_file::AddressReading::from_one,
                                 model_file::AddressReading::modicon};
  model_file::ListReading reading{.guesses_addresses = true};
  const auto choice = bytes.empty() ? std::size_t{0} : static_cast<unsigned char>(bytes.front()) % 8U;
  if (choice < kReadings.size()) reading.addresses = kReadings[choice];
  if (choice == 4) reading.table = Table::coil;
  if (choice == 5) reading.encoding = "gbk";
  if (choice == 6) model_file::parse_columns("address=A,name=B", reading);
  try {
    require_map(model_file::is_thing(bytes) ? model_file::read_thing(bytes, "thing.json", {}).list
                                            : model_file::read_list_file(bytes, "list.csv", reading));
  } catch (const FileError& error) {
    require(error.what()[0] != '\0', "an error says something");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > kLongest) return 0;
  import_list(std::string(fuzzing::text_of(data, size)));
  model_file::DescribedModels files({});
  const Model* model = nullptr;
  try {
    model = &files.parse(std::string(fuzzing::text_of(data, size)), "model.yaml");
  } catch (const FileError& error) {
    require(error.what()[0] != '\0', "an error says something");
    return 0;
  }
  const Model& again = files.parse(std::string(model->description), "again.yaml");
  require(&again == model, "a model's description is the same model");
  if (fuzzing::is_checked_wholly({data, size})) run(*model);
  return 0;
}
