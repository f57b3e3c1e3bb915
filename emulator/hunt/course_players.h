// The course players of one thread, one for each case that it has played recently.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>

#include "emulator/device/model.h"
#include "emulator/hunt/course_player.h"
#include "emulator/play/performing/case_list.h"

namespace understudy::emulator::hunt {

class CoursePlayers {
 public:
  /// `cases` has one file with a plan; it must outlive this object.
  CoursePlayers(const play::CaseList& cases, ModelList models, Player player)
      : reader_(cases), models_(models), player_(std::move(player)) {}

  std::shared_ptr<CoursePlayer> of(std::uint64_t case_number) {
    const auto it = course_players_.find(case_number);
    if (it != course_players_.end()) return it->second;
    if (course_players_.size() >= kMax) course_players_.clear();
    auto course_player =
        std::make_shared<CoursePlayer>(reader_.read({.file = 0, .number = case_number}), models_, player_);
    return course_players_.emplace(case_number, std::move(course_player)).first->second;
  }

 private:
  static constexpr std::size_t kMax = 64;

  play::CaseReader reader_;
  ModelList models_;
  Player player_;
  std::map<std::uint64_t, std::shared_ptr<CoursePlayer>> course_players_;  // by case
};

}  // namespace understudy::emulator::hunt
