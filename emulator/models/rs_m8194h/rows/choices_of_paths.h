// RS-M8194H's choices about interpolation.
#pragma once

#include "emulator/models/rs_m8194h/rows/choice_words.h"

namespace understudy::emulator::models::rs_m8194h {

inline constexpr ChoiceRow kPathChoices[] = {
    {"vector_max_v", "7.2.3", "Which axis's MAX_V does a path use?", "of_axis1|the_least", kFollows,
     "Axis 1 is the chip's main axis."},
    {"unfit_profile", "7.2.2", "What happens to a path that does not fit the mode of VECTOR_SPEED?",
     "nearest_profile|void", kProposal, "The command determines the axes and the shape."},
    {"arc_end_off_circle", "7.2.2", "Where does an arc end if its end is not on its circle?",
     "ends_in_the_quadrant|ends_at_its_end", kLikely,
     "The chip does this, and the example of 7.2.2 has such an arc."},
    {"stream_lookahead", "4.14", "How many segments are loaded ahead?", "1|30", kLikely,
     "The chip has room for one."},
    {"stream_starves", "7.4.3", "What happens to a stream that gets no further segment?",
     "ends_at_full_speed|slows_down_in_what_is_left", kFollows, "Only the marked segment decelerates."},
    {"broken_stream", "7.4.3",
     "What happens to the rest of a stream that is broken off, or whose segment may not begin?",
     "is_void_to_its_last_segment_or_initial|is_void_to_its_initial|runs_all_the_same", kProposal,
     "Segments after a lost one would end in the wrong places."},
    {"last_ramp", "7.4.3", "Where is the end ramp of a stream?",
     "over_all_that_is_loaded|in_the_last_segment", kFollows,
     "The last segment of the example is shorter than its ramp."},
    {"slow_stop_without_ramps", "7.5.5", "How does a path at constant speed stop slowly?",
     "ends_in_the_next_tick|slows_down_by_va", kProposal, "Its speed profile has no deceleration."},
    {"continue_without_initial", "7.4.2", "What does CONTINUE do without its INITIAL?",
     "void_with_module_error|as_axis_assign_and_vv_say", kProposal,
     "The manual says to define INITIAL first."},
    {"drive_in_open_stream", "7.4", "What does another drive do for an axis of a stream?",
     "waits_for_its_end|is_void", kProposal, "Any moving axis behaves like this."},
    {"rectangle_start_points", "7.4.1", "Where are Sp0 to Sp7?",
     "counter_clockwise_from_the_lower_side|clockwise_from_the_left_side|middles_from_the_lower_side",
     kProposal, "The drawing is missing."},
    {"helix_speed", "7.4.11", "What does VV of a helix measure?", "of_its_circle|of_its_path", kProposal,
     "A helix has no ramps."},
    {"helix_is_macro", "7.4.11", "What does a helix, which is a software macro, count as?",
     "is_a_path|is_a_running_macro", kProposal, "It has no macro number."},
};

}  // namespace understudy::emulator::models::rs_m8194h
