// SUPER-40NC: what its manual leaves open, and what we chose, where a bench can ask for another option.
// docs/fidelity/super-40nc.md is made from these rows; the code asks for options by the names that options.h
// gives them.
#pragma once

#include "emulator/device/choices.h"

namespace understudy::emulator::models::super_40nc {

inline constexpr ChoiceRow kChoices[] = {
    {"factory_values", "基本參數說明",
     "the factory's values where the tables of D9 and of the panel's parameters differ", "table_of_d9|panels",
     Confidence::proposal, "M8008 \"resets the D9 parameters\""},
    {"area_bases", "軟體架構", "the numbers of an area's steps, as D8095 counts", "newer|older",
     Confidence::likely, "the Logic chapter, MOV, ZRST and FMV count as an older box with 500 steps for C"},
    {"timer_unit", "LD , LDI , OUT , OUTtc 指令", "the unit of timers", "1ms|10ms|1s", Confidence::follows,
     "K1000 is one second in the examples"},
    {"run_edges", "軟體架構", "outputs that need an edge, at RUN with their condition ON", "once|not_at_all",
     Confidence::proposal, "the FX does so"},
    {"counter_past_preset", "LD , LDI , OUT , OUTtc 指令", "a counter at its preset", "stays|counts_on",
     Confidence::likely, "the FX stops there"},
    {"fmv_end", "FMV 指令", "FMV beyond the end of its block", "clipped|nothing", Confidence::proposal,
     "not printed"},
    {"division_by_zero", "ADD , SUB , MUL , DIV 指令", "what DIV by 0 leaves", "unchanged|zero",
     Confidence::proposal, "not printed"},
    {"product_size", "ADD , SUB , MUL , DIV 指令", "a product beyond 32 bits", "low_half|saturates",
     Confidence::proposal, "one register is printed for it"},
    {"instruction_edges", "ABSC , INCC 指令", "DRV, HOM and STR in the PLC", "on_the_edge|every_scan",
     Confidence::likely, "the example of INCC needs one move a press"},
    {"fresh_start", "F 指令", "what loads feed, mode, plane and speeds anew", "pointer_at_0|every_start",
     Confidence::likely, "\"each time the program is started\""},
    {"slice_length", "軟體架構", "instructions of a step program in a scan", "64_lines|1_line",
     Confidence::proposal, "not printed"},
    {"c21_zero", "C21.", "motion of an axis that its program does not own", "skipped|stops_the_program",
     Confidence::follows, "\"taken as void\""},
    {"ret_without_cal", "CAL , RET 指令", "RET without CAL", "stops_the_program|ignored",
     Confidence::proposal, "each CAL must have its RET"},
    {"cal_count", "CAL , RET 指令", "CAL with a count below 1", "skipped|endless", Confidence::proposal,
     "not printed"},
    {"empty_program", "END 指令", "the start of an area without a program", "ends_silently|is_an_error",
     Confidence::proposal, "not printed"},
    {"vdrv_zero_wait", "VDRV 指令", "whether VDRV 0 waits until its axis stands", "waits|goes_on",
     Confidence::likely, "its example reverses in the next line"},
    {"jog_selector", "MAN(手動)頁操作說明", "what chooses the speed of a jog", "d8022|always_medium",
     Confidence::proposal, "the panel's selector has no register that is printed"},
    {"jog_aliases", "命令範例", "M8519 to M8524, which the table leaves blank", "jog_keys|plain_contacts",
     Confidence::likely, "the examples of commands jog by them"},
    {"zero_set_enable", "主畫面操作說明", "what X60 must be for the SET-ZERO key", "1_enables|0_enables",
     Confidence::likely, "the main page's text, and its name"},
    {"m8514_meaning", "M85x 人機對應接點", "the key M8514", "set_zero|home", Confidence::proposal,
     "\"origin set key\""},
    {"d8002_alias", "命令範例", "a write to D8002", "selects_the_file|plain_register", Confidence::likely,
     "an example of commands selects files by it"},
    {"lock_scope", "C16.", "what the lock masks D9025 and D9x98 block", "keys|nothing", Confidence::proposal,
     "the controller cannot tell who wrote a key"},
    {"edge_contacts_fall", "M8x 特殊接點的功用(XYZU 軸用)",
     "whether M8008, M8x05, M8x06 and M8x07 fall by themselves", "no|when_served", Confidence::proposal,
     "self-reset is printed for others only"},
};

}  // namespace understudy::emulator::models::super_40nc
