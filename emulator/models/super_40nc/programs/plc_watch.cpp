#include "emulator/models/super_40nc/programs/plc_watch.h"

#include <cstddef>
#include <cstdint>

#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "interpreter/super_40nc/ladder.h"
#include "interpreter/super_40nc/operand.h"

namespace understudy::emulator::models::super_40nc {

void PlcWatch::find(const interpreter::super_40nc::Ladder& ladder) {
  using interpreter::super_40nc::Letter;
  places_.clear();
  some_move_ = false;
  for (const interpreter::super_40nc::Operand& read : ladder.reads()) {
    Place place;
    if (read.letter == Letter::x) {
      place = bank_.at(Table::discrete, static_cast<std::uint16_t>(read.number));
    } else if (read.letter == Letter::y) {  // signals appear and disappear
      place = bank_.at(Table::coil, static_cast<std::uint16_t>(read.number));
    } else if (is_special(read)) {
      place = read.letter == Letter::m ? bank_.at(Table::coil, relay_address(read.number))
                                       : bank_.at(Table::holding, data_address(read.number));
    }
    if (!place) continue;
    place.part = Place::Part::whole;
    places_.push_back(place);
    some_move_ |= place.row->moves();
  }
}

void PlcWatch::note() {
  seen_.resize(places_.size());
  for (std::size_t i = 0; i < places_.size(); ++i) seen_[i] = read_value(bank_, places_[i]);
}

bool PlcWatch::is_as_seen() const {
  bool is_same = seen_.size() == places_.size();  // otherwise, the ladder was replaced
  for (std::size_t i = 0; is_same && i < places_.size(); ++i) {
    is_same = read_value(bank_, places_[i]) == seen_[i];
  }
  return is_same;
}

}  // namespace understudy::emulator::models::super_40nc
