// Choices of the SUPER-40NC show their effects in its registers. All that can be made otherwise have a
// scenario each (scenarios/choices/super-40nc), which is held against the rows.
#include "emulator/models/super_40nc/choices.h"

#include <functional>

#include "tests/emulator/models/super_40nc/one_super40nc.h"

namespace understudy::emulator::models::super_40nc {
namespace choices_test {

using Writes = std::vector<std::pair<std::string, Value>>;

struct Step {
  Writes writes;
  Tick ticks = 1;
  std::vector<std::pair<std::string, std::int32_t>> inputs{};
};

struct Case {
  std::string id;
  std::string program;
  Writes set;
  std::vector<Step> steps;
  std::string shown;                                     // a register
  std::vector<std::pair<std::string, Value>> by_option;  // ours first
  std::function<Value(OneSuper40nc&)> look{};            // instead of `shown`
};

/// A block that is ON, covered by so many that are OFF; then all of them joined.
std::string blocks_over(int count, const std::string& output) {
  std::string text = "AREA PLC\nLD M8003\nOUT Y0\n";
  for (int i = 0; i < count; ++i) text += "LD M1\nOUT Y1\n";
  for (int i = 0; i < count; ++i) text += "ORB\n";
  return text + "OUT " + output + "\nEND";
}

/// Whether a request to station 0 is answered.
Value answers_at_zero(OneSuper40nc& one) {
  return one.ask(OneSuper40nc::kRs232, "00 01 00 00 00 01").empty() ? 0 : 1;
}

/// The code of the exception that a request gets, or 0.
Value exception_to(OneSuper40nc& one, std::string_view request) {
  const std::string reply = one.ask(OneSuper40nc::kRs232, request);
  return reply.size() == 8 ? reply.back() - '0' : 0;  // "00 83 02"
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      // Beyond a soft limit; the contact is on in the scan that follows.
      {"serr_clears",
       "AREA X\nRPM K100\nDRV K5000\nEND",
       {{"D9185", 3000}, {"D9186", -2000}},
       {{{{"M8100", 1}}, 600}},
       "M8124",
       {{"next_start_m8x02_plc_to_run", 1}, {"one_scan", 0}}},
      // D999 and the hole behind T63 and C31.
      {"holes",
       "",
       {},
       {},
       "",
       {{"exception_2", 2}, {"read_0_swallow_writes", 0}},
       [](OneSuper40nc& one) { return exception_to(one, "00 03 0A 08 00 01"); }},
      {"holes",
       "",
       {},
       {},
       "",
       {{"exception_2", 2}, {"read_0_swallow_writes", 0}},
       [](OneSuper40nc& one) { return exception_to(one, "00 06 0A 08 00 01"); }},
      // D8094.
      {"read_only_write",
       "",
       {},
       {},
       "",
       {{"answered_ignored", 0}, {"exception_2", 2}},
       [](OneSuper40nc& one) { return exception_to(one, "00 06 1C 14 00 01"); }},
      // D9003 = 9, of at most 4 axes.
      {"range_checks",
       "",
       {},
       {},
       "D9003",
       {{"stored_limited_when_used", 9}, {"exception_3", 0}, {"nearest_one", 4}},
       [](OneSuper40nc& one) {
         one.ask(OneSuper40nc::kRs232, "00 10 23 2E 00 02 04 00 09 00 00");
         return one.get("D9003");
       }},
      {"range_checks",
       "",
       {},
       {},
       "",
       {{"stored_limited_when_used", 0}, {"exception_3", 3}, {"nearest_one", 0}},
       [](OneSuper40nc& one) { return exception_to(one, "00 10 23 2E 00 02 04 00 09 00 00"); }},
      // What a program writes beyond the range is refused as well: it stays as it was.
      {"range_checks",
       "AREA X\nMOV K9 D9003\nEND",
       {},
       {{{{"M8100", 1}}, 5}},
       "D9003",
       {{"stored_limited_when_used", 9}, {"exception_3", 0}, {"nearest_one", 4}}},
      {"factory_values", "", {}, {}, "D9178", {{"table_of_d9", 100}, {"panels", 500}}},
      {"factory_values", "", {}, {}, "D9181", {{"table_of_d9", 0}, {"panels", 1}}},
      {"factory_values", "", {}, {}, "D9183", {{"table_of_d9", 0}, {"panels", 1000}}},
      {"factory_values", "", {}, {}, "D9007", {{"table_of_d9", 6000}, {"panels", 2000}}},
      {"area_bases",
       "AREA X\nDIV K1 K0 D0\nEND",
       {},
       {{{{"M8100", 1}}, 5}},
       "D8095",
       {{"newer", 1500}, {"older", 500}}},
      {"stack_depth", blocks_over(8, "Y2"), {}, {{{}, 5}}, "Y2", {{"16", 1}, {"8", 0}, {"11", 1}}},
      {"stack_depth", blocks_over(11, "Y3"), {}, {{{}, 5}}, "Y3", {{"16", 1}, {"8", 0}, {"11", 0}}},
      {"counter_contact",
       "AREA PLC\nLD M1\nOUT C0 K2\nLD C0\nOUT Y0\nEND",
       {},
       {{{{"holding.C0", 5}}, 5}},
       "Y0",
       {{"compares_at_each_scan", 1}, {"closed_by_the_last_count", 0}}},
      {"cal_depth",
       "AREA X\nLAB K1\nINC D0\nCAL K1\nEND",
       {},
       {{{{"M8100", 1}}, 50}},
       "D0",
       {{"16", 17}, {"8", 9}}},
      {"timer_unit",
       "AREA PLC\nLD M8003\nOUT T0 K10\nLD T0\nOUT M0\nLD M8003\nOUT T1 K100\nLD T1\nOUT M1\nEND",
       {},
       {{{}, 200}},
       "M0",
       {{"1ms", 1}, {"10ms", 1}, {"1s", 0}}},
      {"timer_unit",
       "AREA PLC\nLD M8003\nOUT T0 K10\nLD T0\nOUT M0\nLD M8003\nOUT T1 K100\nLD T1\nOUT M1\nEND",
       {},
       {{{}, 200}},
       "M1",
       {{"1ms", 1}, {"10ms", 0}, {"1s", 0}}},
      {"run_edges", "AREA PLC\nLD M8003\nALT M0\nEND", {}, {{{}, 5}}, "M0", {{"once", 1}, {"not_at_all", 0}}},
      {"counter_past_preset",
       "AREA PLC\nLD M1\nOUT C0 K2\nEND",
       {},
       {{{}, 5},
        {{{"M1", 1}}, 2},
        {{{"M1", 0}}, 2},
        {{{"M1", 1}}, 2},
        {{{"M1", 0}}, 2},
        {{{"M1", 1}}, 2},
        {{{"M1", 0}}, 2},
        {{{"M1", 1}}, 2},
        {{{"M1", 0}}, 2}},
       "holding.C0",
       {{"stays", 2}, {"counts_on", 4}}},
      {"fmv_end",
       "AREA X\nFMV K5 D998 K9\nEND",
       {},
       {{{{"M8100", 1}}, 5}},
       "D998",
       {{"clipped", 5}, {"nothing", 0}}},
      {"fmv_end",
       "AREA X\nFMV K5 D998 K9\nEND",
       {},
       {{{{"M8100", 1}}, 5}},
       "D999",
       {{"clipped", 5}, {"nothing", 0}}},
      {"division_by_zero",
       "AREA X\nDIV K1 K0 D0\nEND",
       {{"D0", 7}},
       {{{{"M8100", 1}}, 5}},
       "D0",
       {{"unchanged", 7}, {"zero", 0}}},
      {"division_by_zero",
       "AREA X\nDIV K1 K0 D0\nEND",
       {{"D0", 7}},
       {{{{"M8100", 1}}, 5}},
       "D8094",
       {{"unchanged", 8}, {"zero", 8}}},
      {"product_size",
       "AREA X\nMUL K65536 K65536 D0\nEND",
       {},
       {{{{"M8100", 1}}, 5}},
       "D0",
       {{"low_half", 0}, {"saturates", 2147483647}}},
      {"instruction_edges",
       "AREA PLC\nLD M0\nINCC\nRPM K500\nDRV K1000\nEND",
       {},
       {{{{"M0", 1}}, 40}},
       "D8094",
       {{"on_the_edge", 0}, {"every_scan", 21}}},
      {"fresh_start",
       "AREA X\nINCC\nWAT M1\nDRV K100\nEND",
       {{"D8117", 50}},
       {{{{"M8100", 1}}, 5}, {{{"M8100", 0}}, 5}, {{{"M8100", 1}, {"M1", 1}}, 200}},
       "D8117",
       {{"pointer_at_0", 150}, {"every_start", 100}}},
      {"slice_length",
       "AREA X\nSET M1\nINC D0\nINC D0\nINC D0\nINC D0\nINC D0\nINC D0\nINC D0\nINC D0\nEND\nAREA PLC\nLDP "
       "M1\nMOV D0 D1\nEND",
       {},
       {{{{"M8100", 1}}, 20}},
       "D1",
       {{"64_lines", 8}, {"1_line", 0}}},
      {"c21_zero",
       "AREA C\nDRV K1000\nSET M0\nEND",
       {},
       {{{{"M8000", 1}}, 5}},
       "M0",
       {{"skipped", 1}, {"stops_the_program", 0}}},
      {"c21_zero",
       "AREA C\nDRV K1000\nSET M0\nEND",
       {},
       {{{{"M8000", 1}}, 5}},
       "D8094",
       {{"skipped", 16}, {"stops_the_program", 16}}},
      {"ret_without_cal",
       "AREA X\nRET\nSET M0\nEND",
       {},
       {{{{"M8100", 1}}, 5}},
       "M0",
       {{"stops_the_program", 0}, {"ignored", 1}}},
      {"cal_count",
       "AREA X\nCAL K1 K0\nSET M0\nEND\nLAB K1\nRET\nEND",
       {},
       {{{{"M8100", 1}}, 20}},
       "M0",
       {{"skipped", 1}, {"endless", 0}}},
      {"cal_count",
       "AREA X\nCAL K1 K0\nSET M0\nEND\nLAB K1\nRET\nEND",
       {},
       {{{{"M8100", 1}}, 20}},
       "M8100",
       {{"skipped", 0}, {"endless", 1}}},
      {"empty_program", "", {}, {{{{"M8100", 1}}, 5}}, "M8100", {{"ends_silently", 0}, {"is_an_error", 0}}},
      {"empty_program", "", {}, {{{{"M8100", 1}}, 5}}, "D8094", {{"ends_silently", 0}, {"is_an_error", 6}}},
      {"vdrv_zero_wait",
       "AREA X\nVDRV K1000\nTMR K300\nVDRV K0\nSET M0\nEND",
       {},
       {{{{"M8100", 1}}, 350}},
       "M0",
       {{"waits", 0}, {"goes_on", 1}}},
      {"jog_selector",
       "",
       {{"D8022", 2}},
       {{{{"M8103", 1}}, 100}},
       "D8123",
       {{"d8022", 65500}, {"always_medium", 65533}, {"d8022_also_while_it_runs", 65500}}},
      {"jog_aliases", "", {}, {{{{"M8519", 1}}, 5}}, "M8103", {{"jog_keys", 1}, {"plain_contacts", 0}}},
      // The keys that the table has jog all the same.
      {"jog_aliases", "", {}, {{{{"M8560", 1}}, 5}}, "M8103", {{"jog_keys", 1}, {"plain_contacts", 1}}},
      {"jog_aliases", "", {}, {{{{"M8561", 1}}, 5}}, "M8104", {{"jog_keys", 1}, {"plain_contacts", 1}}},
      // A DRV of 7.5 s that M8004 meets.
      {"m8004_scope",
       "AREA X\nRPM K100\nDRV K50000\nEND",
       {},
       {{{{"M8100", 1}}, 200}, {{{"M8004", 1}}, 300}},
       "M8121",
       {{"new_motions_wait_or_are_void_running_ones_go_on", 1}, {"running_ones_are_held", 0}}},
      {"zero_set_enable",
       "",
       {{"D8117", 10}},
       {{{{"M8594", 1}}, 5}},
       "D8117",
       {{"1_enables", 10}, {"0_enables", 0}}},
      {"m8514_meaning",
       "",
       {{"D9174", 1}, {"D8117", 10}, {"D9199", 1}},
       {{{{"M8514", 1}}, 5}},
       "M8197",
       {{"set_zero", 0}, {"home", 1}}},
      {"d8002_alias",
       "",
       {},
       {{{{"D8002", 3}}, 2}},
       "D9001",
       {{"selects_the_file", 3}, {"plain_register", 0}}},
      {"lock_scope",
       "",
       {{"D9198", 10000000}},
       {{{{"M8560", 1}}, 5}},
       "M8103",
       {{"keys", 0}, {"keys_and_d8020", 0}, {"nothing", 1}}},
      {"station_rule",
       "",
       {{"D9000", 5}},
       {},
       "the answer",
       {{"own_number_answered_0_obeyed_in_silence", 0},
        {"0_answered_as_well", 1},
        {"0_is_never_answered", 0}},
       answers_at_zero},
      {"cemg_input",
       "",
       {},
       {{{{"M8103", 1}}, 50}, {{}, 5, {{"CEMG", 1}}}},
       "M8120",
       {{"as_m8002_while_on", 0}, {"only_shown", 1}}},
      {"zero_set_moving",
       "",
       {},
       {{{{"M8103", 1}}, 100}, {{{"M8107", 1}}, 5}},
       "D8094",
       {{"void", 21}, {"carried_out", 0}}},
      {"plc_stop_outputs",
       "AREA PLC\nLD M8003\nOUT Y10\nEND",
       {},
       {{{}, 5}, {{}, 5, {{"PLC_RUN", 0}}}},
       "Y10",
       {{"stay", 1}, {"off", 0}}},
      {"feed_not_positive",
       "AREA C\nF K0\nLIN K5000\nEND",
       {{"D9003", 1}},
       {{{{"M8000", 1}}, 600}},
       "M8000",
       {{"1_lu_s", 1}, {"default_feed", 0}}},
      {"arc_axes",
       "AREA C\nXZP\nF K20000\nCW K10000 K10000 K10000 K0\nEND",
       {{"D9003", 3}},
       {{{{"M8000", 1}}, 300}},
       "M8344",
       {{"first_to_second_axis_c24_to_c26_swap", 0}, {"seen_from_the_third_axis", 1}}},
      {"relative_base",
       "AREA X\nINCC\nRPM K500\nDRV K120000\nDRV K120000\nDRV K120000\nEND",
       {{"D9171", 1}, {"D9172", 36}},
       {{{{"M8100", 1}}, 1000}},
       "D8140",
       {{"last_commanded_lu_while_standing_on_it", 10000}, {"present_position", 9999}}},
      {"continuous",
       "AREA C\nINC D0\nEND",
       {{"M8600", 1}},
       {{{{"M8000", 1}}, 20}},
       "M8000",
       {{"either_on_c_starts_again_at_end", 1}, {"m8007_alone", 0}}},
      {"home_el_stop",
       "",
       {{"D9121", 6}},
       {{{{"M8105", 1}}, 200}, {{}, 5, {{"X1", 1}}}},
       "M8144",
       {{"ramp", 0}, {"by_d9x01", 1}}},
      {"wheel_input",
       "",
       {{"D9115", 0}, {"M8108", 1}},
       {{{}, 5}, {{}, 5, {{"MPG", 100}}}},
       "D8117",
       {{"edges", 25}, {"counts", 100}}},
      {"override_range",
       "AREA C\nF K20000\nLIN K30000\nEND",
       {{"D9003", 1}, {"D8005", 150}},
       {{{{"M8000", 1}}, 1300}},
       "M8000",
       {{"0_to_200", 0}, {"0_to_100", 1}}},
      {"recipe_range",
       "",
       {},
       {{{{"D500", 7}, {"D800", 8}, {"D900", 9}}, 1}, {{{"D9002", 1}}, 1}},
       "D500",
       {{"d500_to_d999", 0}, {"d800_to_d999", 7}, {"d900_to_d999", 7}}},
      {"recipe_range",
       "",
       {},
       {{{{"D500", 7}, {"D800", 8}, {"D900", 9}}, 1}, {{{"D9002", 1}}, 1}},
       "D800",
       {{"d500_to_d999", 0}, {"d800_to_d999", 0}, {"d900_to_d999", 8}}},
      {"recipe_range",
       "",
       {},
       {{{{"D500", 7}, {"D800", 8}, {"D900", 9}}, 1}, {{{"D9002", 1}}, 1}, {{{"D9002", 0}}, 1}},
       "D900",
       {{"d500_to_d999", 9}, {"d800_to_d999", 9}, {"d900_to_d999", 9}}},
      {"m8022_scope",
       "AREA X\nTMR K10000\nEND",
       {},
       {{{{"M8100", 1}}, 5}, {{{"M8588", 1}}, 5}},
       "M8022",
       {{"c_only", 0}, {"every_program", 1}, {"c_also_by_m8000", 0}}},
      {"file_number_range",
       "",
       {},
       {{{{"D9001", 25}}, 5}},
       "D9001",
       {{"old_one_restored_code_20", 0}, {"nearest_one", 19}}},
      {"order_after_failure",
       "",
       {{"D9399", 1}, {"D9199", 2}},
       {{{}, 5, {{"ALM_Z", 1}}}, {{{"M8592", 1}}, 5}},
       "M8197",
       {{"others_of_its_number_finish_next_number_does_not_start", 0}, {"next_number_starts", 1}}},
      {"fsh_restart",
       "AREA X\nDRV K0\nTMR K60\nDRV K0\nEND",
       {{"D9191", 100}},
       {{{{"M8100", 1}}, 130}},
       "Y0",
       {{"time_starts_again", 1}, {"time_goes_on", 0}}},
      {"m8008_running",
       "AREA X\nTMR K10000\nEND",
       {{"D9179", 77}},
       {{{{"M8100", 1}}, 5}, {{{"M8008", 1}}, 5}},
       "D9179",
       {{"carried_out", 500}, {"void", 77}}},
      {"run_resets_steps",
       "AREA X\nNOP\nNOP\nEND",
       {},
       {{{}, 5}, {{{"D8100", 1}}, 5, {{"PLC_RUN", 0}}}, {{}, 5, {{"PLC_RUN", 1}}}},
       "D8100",
       {{"cleared_where_the_program_does_not_run", 0}, {"stay", 1}}},
      {"flash_pages", "", {}, {{{{"D9045", 257}}, 1}}, "D9044", {{"0", 0}, {"lines_by_256", 2}}},
      {"flash_time",
       "AREA PLC\nLD M8003\nINC D0\nEND",
       {},
       {{{}, 10}, {{{"D0", 0}, {"D9002", 1}}, 200}},
       "D0",
       {{"0", 200}, {"100_ms_without_a_scan", 100}}},
      // An EL where a soft limit pauses, and the other way round.
      {"soft_limit_resets",
       "AREA X\nNOP\nRPM K100\nDRV K5000\nEND",
       {},
       {{{{"M8100", 1}}, 100}, {{}, 5, {{"X1", 1}}}},
       "D8100",
       {{"reset", 0}, {"pauses_at_the_line", 0}}},
      {"el_resets",
       "AREA X\nNOP\nRPM K100\nDRV K5000\nEND",
       {{"D9185", 1000}},
       {{{{"M8100", 1}}, 600}},
       "D8100",
       {{"reset", 0}, {"pauses_at_the_line", 0}}},
      {"edge_contacts_fall", "", {}, {{{{"M8107", 1}}, 5}}, "M8107", {{"no", 1}, {"when_served", 0}}},
  };
  return all;
}

TEST(Super40ncChoices, ShowTheirEffects) {
  for (const Case& each : cases()) {
    std::vector<std::string_view> named;
    for (const auto& [option, value] : each.by_option) named.push_back(option);
    for (const ChoiceRow& row : kChoices) {
      if (row.id != each.id) continue;
      EXPECT_EQ(options_of(row), named) << each.id;
    }
    for (const auto& [option, value] : each.by_option) {
      OneSuper40nc one({.set = each.set, .program = each.program, .choices = {{each.id, option}}});
      for (const Step& step : each.steps) {
        for (const auto& [name, written] : step.writes) one.set(name, written);
        for (const auto& [terminal, level] : step.inputs) one.input(terminal, level);
        one.run(step.ticks);
      }
      EXPECT_EQ(each.look ? each.look(one) : one.get(each.shown), value)
          << each.id << ": " << option << ", " << each.shown;
    }
  }
}

TEST(Super40ncChoices, EachHasAnAlternative) {
  for (const ChoiceRow& row : kChoices) EXPECT_GT(options_of(row).size(), 1U) << row.id;
}

}  // namespace choices_test
}  // namespace understudy::emulator::models::super_40nc
