// The flash of a SUPER-40NC: programs, path files and recipes, all of which are texts (files.h), and their
// capacity.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/program_error.h"
#include "emulator/device/program_parts.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/programs/program_state.h"
#include "interpreter/super_40nc/listing.h"
#include "interpreter/super_40nc/options.h"
#include "interpreter/super_40nc/program.h"

namespace understudy::emulator::models::super_40nc {

class StoredPrograms : protected OnGround {
 public:
  StoredPrograms(Ground& ground, ProgramState& state)
      : OnGround(ground), state_(state), options_(ground.language_options()) {}

  std::string program_text() const;
  /// Returns the errors of `text` as a program.
  std::vector<ProgramMistake> mistakes_in(std::string_view text) const;
  /// Returns the warnings about `text`, which loads although something is odd.
  std::vector<ProgramMistake> warnings_about(std::string_view text) const;
  interpreter::super_40nc::Checked check(std::string_view text) const;
  /// Returns the areas in `text`, and its files as programs for area C. For observers.
  std::vector<ProgramPart> parts_of(std::string_view text) const;
  /// Returns the program that is stored under this kind and name, or nothing.
  std::optional<interpreter::super_40nc::AreaProgram> area(std::string_view kind, std::string_view name,
                                                           Area area) const;
  /// Stores the areas and files of a program. An empty area is erased.
  void store(const interpreter::super_40nc::Program& program);
  /// Returns true if a stored program exceeds the capacity of C.
  bool is_too_long(std::string_view kind, std::string_view name) const;
  /// Stores the C program as the present file, and replaces it with the program in file `number`. A file that
  /// is too long is reported and leaves C empty.
  void change_c(std::int32_t number);
  void flash_written(bool is_recipe);

  /// Changes the recipe (D9002).
  void change_recipe(std::int32_t number);
  /// Called at power-up. Reads the stored file and recipe again, if a choice requires it.
  void read_files_again();
  /// Computes D9042 and D9043 from D9045.
  void show_capacities();
  /// Shows the numbers of steps in the programs in D9036 to D9042, rather than the capacities, if a choice
  /// requires it.
  void show_line_counts();

 private:
  interpreter::super_40nc::Options options_with_room() const;
  std::int32_t room_of_c() const;
  bool shows_line_counts() const { return chose(option("line_counts", "steps_of_the_programs")); }
  int first_of_recipe() const;
  void take_recipe(std::int32_t number);
  void copy(std::string_view from, const std::string& from_name, std::string_view to,
            const std::string& to_name);

  ProgramState& state_;
  const interpreter::super_40nc::Options& options_;
};

/// Returns all errors of a checked listing.
std::vector<ProgramMistake> mistakes_of(const interpreter::super_40nc::Checked& checked);

}  // namespace understudy::emulator::models::super_40nc
