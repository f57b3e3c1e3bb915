// The readers for individual kinds of steps, used by the table in step_rows.cpp.
#pragma once

#include <cstddef>

namespace understudy::emulator::world {
class YamlFields;
}

namespace understudy::emulator::play {

class StepsReader;

// Defined in line_steps.cpp.
void read_write(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_command(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_expect(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_send(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);

// Defined in text_steps.cpp.
void read_send_text(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_hear(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
/// Returns the line in a step's field, or, without the field, the only line.
std::size_t read_line_of(const StepsReader& reader, const world::YamlFields& value);

// Defined in truth_steps.cpp.
void read_wait(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_advance(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_assert(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_always(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_never(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_end(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_reset(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_host(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_say(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);

// Defined in outside_steps.cpp.
void read_inputs(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_turn(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_inject(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_clear(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_power(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_program(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_memory(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_save(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);

// Defined in course_steps.cpp.
void read_snapshot(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_restore(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_fork(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_repeat(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_for(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
void read_include(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);

}  // namespace understudy::emulator::play
