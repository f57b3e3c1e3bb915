// RS-M8194H's choices about interpolation.
#pragma once

#include "emulator/models/rs_m8194h/rows/choice_words.h"

namespace understudy::emulator::models::rs_m8194h {

inline constexpr ChoiceRow kPathChoices[] = {
    {"vector_max_v", "7.2.3", "whose MAX_V a path goes by", "of_axis1|the_least", kFollows,
     "the chip's main axis"},
    {"unfit_profile", "7.2.2", "a path that the mode of VECTOR_SPEED is not for", "nearest_profile|void",
     kProposal, "its axes and its shape are those of the command"},
    {"arc_end_off_circle", "7.2.2", "an arc whose end is not on its circle",
     "ends_in_the_quadrant|ends_at_its_end", kLikely, "the chip does so, and the example of 7.2.2 has one"},
    {"stream_lookahead", "4.14", "segments that are loaded ahead", "1|30", kLikely,
     "the chip has room for one"},
    {"stream_starves", "7.4.3", "a stream that gets no further segment",
     "ends_at_full_speed|slows_down_in_what_is_left", kFollows, "only the segment that is marked slows down"},
    {"broken_stream", "7.4.3", "what is left of a stream that is broken off, or whose segment may not begin",
     "is_void_to_its_last_segment_or_initial|is_void_to_its_initial|runs_all_the_same", kProposal,
     "what is behind a lost segment would go to other places"},
    {"last_ramp", "7.4.3", "where a stream's end ramp lies", "over_all_that_is_loaded|in_the_last_segment",
     kFollows, "the last segment of the example is shorter than its ramp"},
    {"slow_stop_without_ramps", "7.5.5", "a slow stop of a path at constant speed",
     "ends_in_the_next_tick|slows_down_by_va", kProposal, "its speed profile has nothing to slow down by"},
    {"continue_without_initial", "7.4.2", "CONTINUE without its INITIAL",
     "void_with_module_error|as_axis_assign_and_vv_say", kProposal, "INITIAL should be defined before"},
    {"drive_in_open_stream", "7.4", "another drive for an axis of a stream", "waits_for_its_end|is_void",
     kProposal, "as for any axis that moves"},
    {"rectangle_sides", "7.4.1", "Lp and Wp of a RECTANGLE", "outer_length_and_width|straight_parts",
     kProposal, "the drawing is lost"},
    {"rectangle_ends", "7.4.1", "the greatest Lp, Wp and Rp, printed as 2,000,000,00", "2000000000|200000000",
     kLikely, "all other distances end at 2,000,000,000"},
    {"rectangle_start_points", "7.4.1", "where Sp0 to Sp7 are",
     "counter_clockwise_from_the_lower_side|clockwise_from_the_left_side|middles_from_the_lower_side",
     kProposal, "the drawing is lost"},
    {"helix_speed", "7.4.11", "what VV of a helix is", "of_its_circle|of_its_path", kProposal,
     "it has no ramps"},
    {"helix_cycle", "7.4.11", "a negative cycle of a helix", "turns_the_other_way|exception_3", kProposal,
     "it is in the printed range"},
    {"helix_cycle_0", "7.4.11", "a helix with a cycle of 0", "is_void|exception_3", kProposal,
     "it is in the printed range"},
    {"helix_is_macro", "7.4.11", "a helix, which is a software macro", "is_a_path|is_a_running_macro",
     kProposal, "it has no number"},
};

}  // namespace understudy::emulator::models::rs_m8194h
