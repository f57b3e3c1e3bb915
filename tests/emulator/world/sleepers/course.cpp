#include "tests/emulator/world/sleepers/course.h"

#include <sstream>
#include <stdexcept>

#include "emulator/world/bench_file/bench_file.h"
#include "tests/emulator/model_file/described.h"
#include "tests/emulator/world/sleepers/lives.h"

namespace understudy::emulator::world::sleepers {

namespace sleepers_course {

/// It shows what it sees, so a late effect on it becomes visible, too.
constexpr const char* kNeighbour =
    "JMP1: Wait_IO DIN_3 ON\nCounter_Increase 1\nOut DOUT_4 ON\nWait_IO DIN_3 OFF\nOut DOUT_4 OFF\nJump "
    "JMP1\n";

std::string settings(Draw& draw, const Model& model, std::int64_t one_in) {
  std::string text;
  for (const ChoiceRow& row : model.choices) {
    const auto options = options_of(row);
    if (options.size() == 1 || !draw.one_in(one_in)) continue;
    text += (text.empty() ? "" : ", ") + std::string(row.id) + ": " + std::string(draw.one_of(options));
  }
  return ", choices: { " + text + " }";
}

std::string machine(Draw& draw, const std::string& axis) {
  std::string what = "position: " + draw.number(-500, 500);
  const auto add = [&](const std::string& more) { what += ", " + more; };
  if (draw.one_in(2)) {
    add("encoder: { per_revolution: " + std::to_string(draw.of_any_size(20'000)) +
        ", motor_pulses_per_revolution: " + std::to_string(draw.of_any_size(4'000)) +
        (draw.one_in(3) ? ", reversed: true }" : " }"));
  }
  if (draw.one_in(2)) {
    add("home: { at: " + draw.number(-2000, 2000) + ", width: " + draw.number(1, 600) + ", hysteresis: 3 }");
  }
  if (draw.one_in(2)) {
    add("limits: { lower: " + draw.number(-90'000, -1'000) + ", upper: " + draw.number(1'000, 60'000) +
        (draw.one_in(4) ? ", contact: opens }" : " }"));
  }
  if (draw.one_in(4)) add("travel: [" + draw.number(-90'000, -600) + ", 70000]");
  if (draw.one_in(5)) add("drive: { ready_after: " + draw.number(1, 300) + "ms }");
  return "  " + axis + ": { " + what + " }\n";
}

std::string some_terminal(Draw& draw, const Model& model, bool inputs) {
  for (;;) {
    const auto& row = draw.one_of(model.terminals.first(std::min<std::size_t>(model.terminals.size(), 220)));
    const bool is_digital =
        row.kind == (inputs ? TerminalRow::Kind::digital_in : TerminalRow::Kind::digital_out);
    if (is_digital) return "m." + std::string(row.name);
  }
}

std::string wires(Draw& draw, const Model& model) {
  std::string text = "wires: [ n.DOUT_5 -> n.DIN_5";
  const auto count = static_cast<int>(draw.between(1, 4));
  for (int i = 0; i < count; ++i)
    text += ", " + some_terminal(draw, model, false) + " -> n.DIN_" + std::to_string(i == 0 ? 3 : 5 + i);
  for (int i = 0; i < 2; ++i) text += ", n.DOUT_4 -> " + some_terminal(draw, model, true);
  return text + " ]\n";
}

std::string indented(const std::string& listing) {
  std::istringstream lines(listing);
  std::string text;
  for (std::string line; std::getline(lines, line);) text += "      " + line + "\n";
  return text;
}

}  // namespace sleepers_course

/// An impossible bench is drawn again.
Course course_of(std::string_view name, std::uint64_t seed) {
  using namespace sleepers_course;
  const std::unique_ptr<Life> life = life_of(name);
  std::string diagnostic;
  for (std::uint64_t tries = 0; tries < 20; ++tries) {
    Draw draw(seed * 32 + tries);
    const bool is_calm = draw.one_in(2);  // more sleep, less of everything else
    const std::string model_text = life->model(draw);
    const Model* const listed = find_model(models::all_models(), name);
    const Model* model = listed;
    try {
      if (listed == nullptr) {
        model = parse_bench(model_file::with_described(),
                            "understudy: 1\nlines: { a: { stations: [ { name: it, model: " + model_text +
                                " } ] } }\n",
                            "model.yaml", ".")
                    .devices[0]
                    .model;
      }
      Course course;
      std::string program = life->program(draw);
      course.bench_text =
          "understudy: 1\nseed: 7\nlines:\n  a: { timing: " +
          std::string(draw.one_in(3) ? "wire" : "instant") +
          ", stations: [ { device: m } ] }\n  b: { timing: instant, stations: [ { device: n } ] }\ndevices:\n"
          "  m:\n    { model: " +
          model_text + life->keys(draw) + settings(draw, *model, is_calm ? 40 : 8) +
          (program.empty() ? "" : ", program: " + model_file::quoted_scalar(program)) + " }\n" +
          "  n:\n    { model: simple2-r3, set: { AutoStart_MainProg: 1, ALL_SVON: 1 }, program: " +
          model_file::quoted_scalar(kNeighbour) + " }\nplant:\n" + machine(draw, "n.A");
      for (const AxisRow& axis : model->axes.first(std::min<std::size_t>(model->axes.size(), 4))) {
        if (!draw.one_in(4)) course.bench_text += machine(draw, "m." + std::string(axis.name));
      }
      course.bench_text += wires(draw, *model);
      course.bench = parse_bench(model_file::with_described(), course.bench_text, "course.yaml", ".");
      const World possible(course.bench, {}, {});
      course.acts = life->first_acts(draw);
      for (int i = 0; i < (is_calm ? 12 : 25); ++i) {
        Act act = draw.one_in(is_calm ? 2 : 3) ? any_act(draw, *model) : life->act(draw);
        act.before = draw.one_in(3) ? SimTime{draw.between(0, 20'000'000)}
                                    : SimTime{draw.of_any_size(draw.one_in(3) ? 2'000'000'000 : 400'000'000)};
        course.acts.push_back(act);
      }
      return course;
    } catch (const std::exception& error) {
      diagnostic = error.what();
    }
  }
  throw std::runtime_error("no bench can be made of this: " + diagnostic);
}

std::unique_ptr<Life> life_of(std::string_view model) {
  if (model == "simple2-r3") return life_of_simple2();
  if (model == "super-40nc") return life_of_super_40nc();
  if (model == "rs-m8194h") return life_of_rs_m8194h();
  if (model == "slim") return life_of_slim();
  return model == "imported" ? life_of_imported() : nullptr;
}

}  // namespace understudy::emulator::world::sleepers
