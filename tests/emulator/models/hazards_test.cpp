// What a write or a command can do in a real controller, against a list that was made from the manuals: which
// registers start motion, switch outputs, are stored, or change how the controller answers.
#include "emulator/device/register_map/hazards.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "emulator/device/command_window.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/models.h"

namespace understudy::emulator {
namespace hazards_test {

// Letters: s settings, m memory, o output, x motion, a stops answering. Every write changes a value.
Hazards of_letters(const std::string& letters) {
  const std::map<char, Hazards> all{{'s', Hazards::settings},
                                    {'m', Hazards::memory},
                                    {'o', Hazards::output},
                                    {'x', Hazards::motion},
                                    {'a', Hazards::stops_answering}};
  Hazards hazards = Hazards::reads;
  for (const char letter : letters) hazards = hazards | all.at(letter);
  return hazards;
}

struct Range {
  Table table;
  int first;
  int last;
  const char* letters;
};

constexpr Table H = Table::holding;
constexpr Table C = Table::coil;

// Simple2-R3, list of addresses.
const std::vector<Range> kSimple2{
    {H, 0x0A00, 0x0A0D, "smox"},  // functions of inputs and outputs
    {H, 0x0D00, 0x0D06, "so"},   {H, 0x0DF0, 0x0DF0, "so"},   {H, 0x0E00, 0x0E07, "sx"},
    {H, 0x0E0A, 0x0E0D, "smx"},  {H, 0x1000, 0x1001, "s"},    {H, 0x1002, 0x1005, "sx"},
    {H, 0x1006, 0x1007, "s"},    {H, 0x1008, 0x1012, "sx"},   {H, 0x1013, 0x1018, "sox"},
    {H, 0x1019, 0x101D, "sx"},   {H, 0x2000, 0x204F, "sm"},   {H, 0x20A0, 0x20BF, "sm"},
    {H, 0x2100, 0x2108, "sx"},   {H, 0x3000, 0x3000, "smox"}, {H, 0x3001, 0x3001, "sx"},
    {H, 0x3004, 0x3004, "sm"},   {H, 0x4000, 0x43FF, "smox"}, {H, 0x8000, 0x803F, "sm"},
    {H, 0x8100, 0x813F, "s"},    {H, 0xF000, 0xF001, "sm"},   {H, 0xF002, 0xF005, "smx"},
    {H, 0xF006, 0xF009, "sx"},   {H, 0xF010, 0xF011, "sm"},   {H, 0xF012, 0xF013, "smox"},
    {H, 0xF014, 0xF019, "smx"},  {H, 0xF01A, 0xF01D, "sm"},   {H, 0xF01E, 0xF01E, "smox"},
    {H, 0xF020, 0xF023, "smx"},  {H, 0xF024, 0xF026, "sx"},   {H, 0xF027, 0xF02A, "smx"},
    {H, 0xF100, 0xF129, "s"},    {H, 0xFF02, 0xFF05, "sm"},   {H, 0xFF06, 0xFF06, "smoxa"},
    {H, 0xFF07, 0xFF07, "s"},    {H, 0xFF09, 0xFF09, "sm"},
};

// RS-M8194H, chapter 12, and 3.18 and 3.19.
const std::vector<Range> kRs{
    {H, 0, 7, "so"},       {H, 8, 8, "smox"},        {H, 9, 9, "smox"},  {H, 14, 14, "sx"},
    {H, 20, 30, "sma"},    {H, 82, 105, "sx"},       {H, 128, 255, "s"}, {H, 300, 1323, "s"},
    {H, 3000, 7095, "sm"}, {H, 8000, 8100, "smoxa"}, {C, 0, 127, "so"},
};

int relay(int number) { return number < 8000 ? 1000 + number : number - 6000; }
int data(int number) {
  return number < 1000 ? 2 * number : number < 9000 ? 7000 + 2 * (number - 8000) : 9000 + 2 * (number - 9000);
}

// SUPER-40NC, the lists of contacts and registers.
std::vector<Range> super_40nc() {
  std::vector<Range> all{
      {C, 0, 31, "so"},       // Y
      {C, 200, 279, "sox"},   // S
      {C, 280, 327, "smox"},  // S, kept
      {C, 600, 655, "sox"},
      {C, 656, 663, "smox"},  // T
      {C, 800, 815, "sox"},
      {C, 816, 831, "smox"},  // C
      {C, relay(0), relay(399), "sox"},
      {C, relay(400), relay(511), "smox"},
      {C, relay(8000), relay(8007), "sox"},
      {C, relay(8008), relay(8008), "smoxa"},  // parameters to factory values, the station number as well
      {C, relay(8009), relay(8499), "sox"},
      {C, relay(8500), relay(8599), "smox"},  // the panel
      {C, relay(8600), relay(8699), "smox"},
      {H, data(0), data(499) + 1, "s"},
      {H, data(500), data(999) + 1, "sm"},
      {H, 2000, 2111, "sox"},
      {H, 2112, 2127, "smox"},
      {H, 2500, 2531, "sox"},
      {H, 2532, 2563, "smox"},
      {H, 3000, 6999, "s"},  // the buffer of the user program
      {H, data(8000), data(8001) + 1, "sox"},
      {H, data(8002), data(8002) + 1, "smox"},
      {H, data(8003), data(8004) + 1, "so"},  // Vout1, Vout2
      {H, data(8005), data(8019) + 1, "sox"},
      {H, data(8020), data(8020) + 1, "smox"},  // the user command
      {H, data(8021), data(8099) + 1, "sox"},
      {H, data(8100), data(8599) + 1, "sx"},
      {H, data(9000), data(9000) + 1, "sma"},  // the station number
      {H, data(9001), data(9002) + 1, "smox"},
      {H, data(9003), data(9005) + 1, "smx"},
      {H, data(9006), data(9010) + 1, "sm"},
      {H, data(9011), data(9016) + 1, "smx"},
      {H, data(9017), data(9019) + 1, "smx"},  // C24 to C26: arcs turn the other way
      {H, data(9020), data(9099) + 1, "sm"},
      {H, data(9100), data(9499) + 1, "smx"},
  };
  return all;
}

/// Returns what is wrong, a line for each register.
std::string differences(const Model& model, const std::vector<Range>& expected) {
  std::ostringstream wrong;
  for (const RegisterRow& row : register_rows(model)) {
    if (!can_be_written(row)) continue;
    for (int i = 0; i < row.count; ++i) {
      const int address = row.address + i * row.stride;
      const Range* found = nullptr;
      for (const Range& range : expected)
        if (range.table == row.table && address >= range.first && address <= range.last) found = &range;
      const Hazards hazards = hazards_of(row);
      if (found != nullptr && hazards == of_letters(found->letters)) continue;
      wrong << RegisterMap::name_of(row, i) << " at " << address << ": " << to_text(hazards) << "; expected "
            << (found == nullptr ? "a range" : to_text(of_letters(found->letters))) << "\n";
    }
  }
  return wrong.str();
}

const Model& model_called(const char* name) { return *find_model(models::all_models(), name); }

TEST(Hazards, EveryRegisterOfSimple2HasThoseOfTheList) {
  EXPECT_EQ(differences(model_called("simple2-r3"), kSimple2), "");
}
TEST(Hazards, EveryRegisterOfRsHasThoseOfTheList) {
  EXPECT_EQ(differences(model_called("rs-m8194h"), kRs), "");
}
TEST(Hazards, EveryRegisterOfSuperHasThoseOfTheList) {
  EXPECT_EQ(differences(model_called("super-40nc"), super_40nc()), "");
}

// --- commands of RS-M8194H: by the sections of the manual ------------------------------------------

struct Command {
  const char* text;
  const char* letters;
};
const std::vector<Command> kRsCommands{
    {"RSM_RESET_CARD", "smoxa"},    {"RSM_SET_PULSE_MODE X 0", "sox"}, {"RSM_SET_MAX_V X 20000", "sx"},
    {"RSM_SERVO_ON X", "sox"},      {"RSM_SERVO_OFF X", "sox"},        {"RSM_WRITE_VAR VAR6 66", "s"},
    {"RSM_SET_A X 1000", "s"},      {"RSM_SET_V X 1000", "sx"},        {"RSM_NORMAL_SPEED X 0", "s"},
    {"RSM_FIXED_MOVE X 100", "sx"}, {"RSM_CONTINUE_MOVE X 100", "sx"}, {"RSM_HOME_START X", "sx"},
    {"RSM_STOP_SUDDENLY X", "sx"},  {"RSM_EMERGENCY_STOP 0", "sx"},    {"RSM_LOAD_INITIAL", "sox"},
    {"RSM_MP_CREATE 1", "sm"},      {"RSM_MP_CALL 1", "smox"},         {"RSM_ENABLE_INT", "smox"},
};

TEST(Hazards, CommandsOfRsHaveThoseOfTheirSections) {
  const Model& model = model_called("rs-m8194h");
  for (const Command& command : kRsCommands) {
    std::vector<std::uint16_t> words;
    try {
      words = window_message(model, command.text, {}).words;
    } catch (const ProgramError& error) {
      ADD_FAILURE() << command.text << ": " << in_text(error.first());
      continue;
    }
    EXPECT_EQ(to_text(model.hazards_of_command(words)), to_text(of_letters(command.letters))) << command.text;
  }
}
TEST(Hazards, AnUnknownCodeOfRsCanDoAnything) {
  const std::vector<std::uint16_t> unknown{0x0A00};
  EXPECT_EQ(model_called("rs-m8194h").hazards_of_command(unknown), Hazards::all);
}

// --- commands of SLIM ------------------------------------------------------------------------------

const std::vector<Command> kSlimLines{
    {"?PE", ""},          {"?T1VM", ""},    {"ULP", ""},
    {"ULC", ""},          {"MA 100", "x"},  {"T1MR -5", "x"},
    {"JGF", "x"},         {"JG0", "x"},     {"H", "x"},
    {"HON", "x"},         {"2MA 1,2", "x"}, {"TASTOP", "x"},
    {"SET P1", "o"},      {"CLR P2", "o"},  {"OUTP 3", "o"},
    {"N0=5", "s"},        {"R1=2.5", "s"},  {"NS(3)=1", "sm"},
    {"SAVE C", "m"},      {"SAVE P", "m"},  {"G", "mox"},
    {"PG", "m"},          {"DLP", "m"},     {"VM=100", "oxa"},
    {"RESET H", "smoxa"}, {"DF", "oxa"},    {"what is it", "smoxa"},
};

TEST(Hazards, LinesOfSlimHaveThoseOfTheirCommands) {
  for (const Command& line : kSlimLines)
    EXPECT_EQ(to_text(model_called("slim").hazards_of_line(line.text)), to_text(of_letters(line.letters)))
        << line.text;
}

// Manual PG, PE, PI, PA, DL: an empty line, EXIT or ESC ends them; PE and PI take one line.
TEST(Hazards, LinesOfSlimBeginAndEndPrograms) {
  const struct {
    const char* line;
    EditMark mark;
  } cases[] = {
      {"PG", EditMark::begins},
      {"DLP", EditMark::begins},
      {"PE 1", EditMark::begins_one_line},
      {"PI 1", EditMark::begins_one_line},
      {"", EditMark::ends},
      {"EXIT", EditMark::ends},
      {"\x1B", EditMark::ends},
      {"MA 100", EditMark::none},
      {"?PE", EditMark::none},
      {"PD 1", EditMark::none},
      {"what is it", EditMark::none},
  };
  for (const auto& row : cases)
    EXPECT_EQ(model_called("slim").edit_mark_of_line(row.line), row.mark) << row.line;
}

TEST(Hazards, EveryModelCanBeStopped) {
  for (const auto& listed : models::all_models()) {
    const Model& model = *listed;
    EXPECT_FALSE(model.stop.empty()) << model.name;
    for (const StopStep& step : model.stop) {
      const bool is_register = find_register(model, step.text, model.firmwares.back()).has_value();
      const bool is_line =
          model.hazards_of_line != nullptr && model.hazards_of_line(step.text) == Hazards::motion;
      bool is_command = false;
      if (model.window != nullptr) is_command = !window_message(model, step.text, {}).words.empty();
      EXPECT_TRUE(is_register || is_line || is_command) << model.name << " " << step.text;
    }
  }
}

}  // namespace hazards_test
}  // namespace understudy::emulator
