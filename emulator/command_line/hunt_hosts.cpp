#include "emulator/command_line/hunt_hosts.h"

#include <unistd.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/state/state_bytes.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/host_case.h"
#include "emulator/command_line/hunt_files.h"
#include "emulator/command_line/worker_processes.h"
#include "emulator/device/model.h"
#include "emulator/hunt/course.h"
#include "emulator/hunt/course_player.h"
#include "emulator/hunt/course_players.h"
#include "emulator/hunt/course_state.h"
#include "emulator/play/performing/case_list.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/results/result.h"
#include "emulator/play/results/result_state.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::command_line {

void require_hunted_steps(const play::Scenario& scenario, ModelList models, bool has_command) {
  require_steps_for(scenario, has_command, "hunt");
  if (!has_command) return;
  play::Scenario disturbing = scenario;
  disturbing.steps =
      hunt::CoursePlayer(std::make_shared<play::Scenario>(scenario), models, {}).disturbing_steps();
  require_steps_for(disturbing, has_command, "hunt");
}

std::vector<play::ScenarioResult> run_beside(const play::Scenario& scenario, play::RunOptions options,
                                             const HuntArguments& arguments, const std::string& recording) {
  RunArguments run;
  run.host = arguments.host;
  run.timeout = arguments.timeout;
  run.version = arguments.version;
  return run_host_case(scenario, std::move(options), run, recording);
}

HuntHosts::HuntHosts(const play::CaseList& cases, ModelList models, const HuntArguments& arguments, int jobs)
    : cases_(cases),
      models_(models),
      arguments_(arguments),
      workers_(jobs + 2, [this] { return make_work(); }) {}

std::vector<play::ScenarioResult> HuntHosts::play_here(const play::Scenario& scenario,
                                                       const play::RunOptions& options) const {
  return run_beside(scenario, options, arguments_, "");
}

/// Creates the work of a process. A question is either a course, or the path of a scenario to show.
Work HuntHosts::make_work() const {
  setpgid(0, 0);  // Ctrl-C must not interrupt a course: it ends the hunt, which ends this process
  auto stages = std::make_shared<hunt::CoursePlayers>(
      cases_, models_,
      hunt::Player{.here = [this](const play::Scenario& scenario,
                                  const play::RunOptions& options) { return play_here(scenario, options); },
                   .can_begin_later = false});
  return [this, stages](std::span<const std::byte> question) {
    StateReader reader(question);
    StateWriter answer;
    std::string path;
    reader.read(path);
    if (path.empty()) {
      hunt::Course course;
      bool has_reached = false;
      reader.read(course);
      reader.read(has_reached);
      answer.write(stages->of(course.case_number)->play_here(course, has_reached));
    } else {
      std::vector<std::string> command;
      reader.read(command);
      answer.write(show_finding(models_, arguments_, path, command));
    }
    return answer.take();
  };
}

hunt::Player HuntHosts::player() {
  hunt::Player player{.can_begin_later = false};
  player.here = [this](const play::Scenario& scenario, const play::RunOptions& options) {
    return play_here(scenario, options);
  };
  player.elsewhere = [this, worker = taken_++](const hunt::Course& course, bool has_reached) {
    StateWriter question;
    question.write(std::string());
    question.write(course);
    question.write(has_reached);
    const std::vector<std::byte> answer = workers_.ask(worker, question.take());
    hunt::Playing playing{.results = {}};
    StateReader(answer).read(playing);
    return playing;
  };
  return player;
}

std::vector<play::ScenarioResult> HuntHosts::show(const std::string& path,
                                                  const std::vector<std::string>& command) {
  StateWriter question;
  question.write(path);
  question.write(command);
  const std::vector<std::byte> answer = workers_.ask(0, question.take());
  std::vector<play::ScenarioResult> results;
  StateReader(answer).read(results);
  return results;
}

}  // namespace understudy::emulator::command_line
