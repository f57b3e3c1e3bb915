// SUPER-40NC: choices about programs, the PLC and step programs.
#pragma once

#include "base/choices.h"
#include "emulator/models/super_40nc/rows/choice_words.h"

namespace understudy::emulator::models::super_40nc {

inline constexpr ChoiceRow kProgramChoices[] = {
    // --- programs and the PLC ---
    {"scan_order", "END 指令", "What is the order inside a scan?",
     "wire_plc_keys_contacts_programs_motion_status|contacts_before_the_plc", kProposal,
     "The manual is silent."},
    {"plc_stop_outputs", "END 指令", "What do outputs do in STOP?", "stay|off", kProposal,
     "The manual is silent. The FX clears them."},
    {"m8501_runs_plc", "END 指令", "What does the rising edge of M8501 do?", "run|nothing", kLikely,
     "Leaving the edit page must trigger M8501. With the switch ON, only M8507 stops the PLC "
     "(page_contacts)."},
    {"plc_stop_timers", "END 指令", "What do timers of the PLC do in STOP?", "stand|are_cleared", kProposal,
     "The manual is silent. The FX clears them."},
    {"run_resets_steps", "END 指令", "What happens to D8000 and D8x00 at the change from STOP to RUN?",
     "cleared_where_the_program_does_not_run|stay", kProposal,
     "The manual says \"cleared when the PLC initialises\"."},
    // --- contacts, registers, terminals ---
    // --- programs and the PLC ---
    {"plc_several_axes", "DRV 指令",
     "What do the PLC's DRV and HOM for several axes do if one of the axes is in use?",
     "each_that_is_free|none", kProposal, "The manual is silent. Each axis moves independently."},
    {"both_jogs", "Motion指令一覽表", "What happens if both jog directions are ON?",
     "first_goes_on_from_rest_none|both_stop_it", kProposal, "The manual is silent."},
    // --- step programs ---
    {"emergency_of_axis_programs", "M8 特殊接點的功用(一般用途)",
     "What happens to programs X, Y, Z and U at M8002 and CEMG?", "reset_as_c|they_pause_at_their_line",
     kProposal, "The text of M8002 says this of C. The text of M8000 says that E-STOP resets M8x00."},
    {"stp_stops", "STP 指令", "How do STP, a STOP key and M8x02 stop a motor?", "at_once|by_its_ramp",
     kProposal,
     "For STP the manual prints \"at once\"; for the keys and M8x02 it prints only \"stopped\". One rule for "
     "all is "
     "assumed."},
    {"fsh_without_motion", "Motion指令一覽表",
     "Do Y0 to Y3 and Y8 go ON for a motion line whose axes are already at the target?", "come|do_not_come",
     kProposal, "The manual is silent."},
    {"end_and_vdrv", "VDRV 指令", "What does an axis under VDRV do when its program reaches END?",
     "turns_on|ends_by_its_ramp", kProposal,
     "The manual is silent. Several programs can name the same axis."},
    {"vdrv_zero_stop", "VDRV 指令", "How does VDRV 0 stop an axis?", "by_its_ramp|at_once", kProposal,
     "The manual says \"at once\" only of STP."},
    {"vector_feed", "LIN 指令", "What does F of a LIN measure if U takes part with other axes?",
     "over_all_axes|u_is_carried_along", kProposal, "The manual is silent. U may be a rotary axis."},
    {"drv_of_c", "X2./X3.", "Which ramp times and S sections do DRV, MRK and VDRV use in C?",
     "x2_to_x5|c11_to_c14", kProposal,
     "X2 and X3 name the instructions. C13 and C14 say \"program motion\"."},
    {"radius_too_small", "CWR , CCWR 指令", "What happens if a radius is below half the chord?",
     "skipped_with_code_17|half_circle", kProposal, "The manual is silent."},
    {"c3p_points", "Motion指令一覽表", "Are the points of C3P relative in relative mode?",
     "relative|absolute", kProposal,
     "The manual is silent here. For CW and CCW it says this only of the centre."},
    {"step_shown", "D8 特殊暫存器的功用(一般用途)",
     "Which step do D8000 and D8x00 show while a motion line runs?", "the_lines_own|the_next_ones", kProposal,
     "The manual says \"about to be executed\"."},
    {"step_numbers_relative", "STR 指令", "How do D8000 and D8x00 number the steps?",
     "relative_to_the_area|absolute", kProposal, "A reset goes to line 0."},
    {"feed_not_positive", "Motion指令一覽表", "What does F of 0 or less do?", "1_lu_s|default_feed",
     kProposal, "The manual is silent."},
    {"arc_off_circle", "Motion指令一覽表", "What happens to an arc whose end point is off the circle?",
     "up_to_10_lu_blended_else_code_17|a_line_to_the_end", kProposal, "The chip can draw the line."},
    {"arc_axes", "Motion指令一覽表", "Which direction is CW in XZ and YZ?",
     "first_to_second_axis_c24_to_c26_swap|seen_from_the_third_axis", kProposal, "The manual is silent."},
    {"relative_base", "Motion指令一覽表", "What is the base of relative targets?",
     "last_commanded_lu_while_standing_on_it|present_position", kProposal,
     "This keeps rounding errors from adding up."},
    {"mrk_course", "Motion指令一覽表",
     "What speed does MRK have at the target, does an earlier signal count, and how does MRK stop on the "
     "mark?",
     "creep_reached_at_the_target_ignored_on_the_spot|slows_behind_the_target|signal_before_it_counts|"
     "stops_by_a_ramp",
     kLikely, "The manual says \"keeps running at creep speed\"."},
    {"mark_without_distance", "MRK 指令", "What does a limit's signal do in MRK with X16 = 0?",
     "resets_the_program|a_plain_move", kLikely,
     "The manual says \"the signal resets the program\". It does not say which limit, or what applies if X33 "
     "and X34 are 0."},
    {"mark_edge", "MRK 指令", "What happens if a mark is already ON when the search begins?",
     "is_found|has_to_come_anew", kProposal, "The manual says that the signal \"comes\"."},
    {"mrk_against", "Motion指令一覽表", "What happens if X16 points against the direction of travel?",
     "stop_reverse|void_with_a_code", kProposal, "The manual is silent."},
    {"vdrv_zero_others", "Motion指令一覽表", "What does VDRV 0 do while another motion runs?",
     "stops_it_by_a_ramp|waits", kFollows, "The manual says \"any motion command\"."},
    {"level_after_stop", "STP 指令", "What happens to levels that are still ON after M8002 or M8x02?",
     "need_a_new_edge|act_at_once", kProposal, "This is the safe reading."},
    {"pause_scope", "STP 指令", "What do M8006 and PAUSE hold?",
     "motions_and_waits_of_the_program_also_vdrv_not_the_wheel|not_vdrv_nor_the_wheel", kLikely,
     "The manual says \"running motion to rate 0\"."},
    {"pause_home", "STP 指令", "What does PAUSE do during HOM?",
     "ramp_search_begins_again|the_search_ends_first", kProposal, "The manual is silent."},
    {"pause_manual", "STP 指令",
     "What does an axis's PAUSE key do during its jog, homing or zero by contact?",
     "nothing|ends_it_by_a_ramp", kProposal,
     "The manual says \"when the program is started\". Nothing would start these motions again."},
    {"m8022_scope", "STP 指令", "Which programs does M8022 cover?", "c_only|every_program|c_also_by_m8000",
     kLikely, "It is in the common table."},
    {"m8004_scope", "STP 指令", "What does M8004 inhibit?",
     "new_motions_wait_or_are_void_running_ones_go_on|running_ones_are_held", kProposal,
     "The manual prints only \"motion inhibit\"."},
    {"axis_stop_in_c", "STP 指令", "What does STP or M8x02 do for an axis that C moves?",
     "stops_it_and_resets_c|stops_the_axis_alone", kProposal,
     "A path cannot continue without one of its axes."},
    {"manual_motion_events", "STP 指令",
     "What do M8006 and the main PAUSE key do while axes are moved by hand?", "they_go_on|end_by_a_ramp",
     kProposal,
     "PAUSE is for the path program. manual_motions.h lists the other stops. The manual prints M8x02 and "
     "M8002."},
    {"m8008_running", "STP 指令", "What does M8008 do while programs run?", "carried_out|void", kProposal,
     "The manual is silent."},
    {"axis_conflicts", "CHK 指令", "What happens to a motion for an axis that is in use?",
     "who_has_it_keeps_it_programs_wait_but_not_for_vdrv_and_the_wheel|programs_always_wait", kProposal,
     "The manual prints only DRV after DRV."},
    // --- the panel ---
    {"error_codes", "M85x 人機對應接點", "Which values does D8094 have?", "table_of_8|always_0", kProposal,
     "The manual has no list."},
};

}  // namespace understudy::emulator::models::super_40nc
