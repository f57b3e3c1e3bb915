#include "interpreter/super_40nc/structure.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/instruction_row.h"
#include "interpreter/super_40nc/operand.h"
#include "interpreter/super_40nc/options.h"
#include "interpreter/super_40nc/program.h"

namespace understudy::interpreter::super_40nc {
namespace {

class Structure {
 public:
  Structure(const AreaProgram& program, Area area, const Options& options)
      : program_(program), area_(area), options_(options) {}

  std::vector<Fault> run() {
    const int capacity = area_ == Area::c ? options_.c_capacity : row_of(area_).steps;
    const bool counts_steps = options_.chose(option("capacity_unit", "steps"));
    int room = capacity;
    const auto& lines = program_.lines;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      line_ = static_cast<int>(i);
      const Op op = lines[i].op;
      room -= counts_steps ? steps_of(lines[i]) : 1;
      if (room < 0 && !is_full_) {
        is_full_ = true;
        fault(Code::memory_full, "does not fit into area " + std::string(row_of(area_).name),
              std::to_string(capacity) + (counts_steps ? " steps" : " lines") + " at most");
      }
      if (op != Op::nop) check_logic(op);
      check_pairs(op);
      if (op == Op::lab) check_label(lines[i].fields[0].number);
      if (names_label(op)) jumps_.emplace_back(line_, lines[i].fields[0].number);
      if (op == Op::out || op == Op::out_tc) check_coil(lines[i].fields[0]);
      has_end_ |= op == Op::end;
      if (op != Op::nop) before_ = op;
    }
    check_end();
    check_jumps();
    std::stable_sort(faults_.begin(), faults_.end(),
                     [](const Fault& a, const Fault& b) { return a.line < b.line; });
    return std::move(faults_);
  }

 private:
  void fault(Code code, std::string what, std::string expected = {}) {
    faults_.push_back({line_, code, std::move(what), std::move(expected)});
  }

  // --- blocks and branches ------------------------------------------------------------------------

  void check_logic(Op op) {
    const bool is_plc = area_ == Area::plc;
    if (!is_plc) check_group(op);
    if (is_contact(op)) {
      if (begins_block(op)) {
        ++blocks_;
        if (++pending_ == stack_depth(options_) + 1) {
          fault(Code::logic, "begins one block too many", "at most " + std::to_string(stack_depth(options_)));
        }
      } else {
        require_block();
      }
    } else if (joins_blocks(op)) {
      if (blocks_ < 2) fault(Code::logic, "joins blocks that were not begun", "two blocks before it");
      pending_ = std::max(0, pending_ - 1);
    } else if (op == Op::mps) {
      require_block();
      if (++branches_ == stack_depth(options_) + 1) {
        fault(Code::logic, "begins one branch too many", "at most " + std::to_string(stack_depth(options_)));
      }
    } else if (op == Op::mrd || op == Op::mpp) {
      if (branches_ == 0) fault(Code::logic, "continues a branch that was not begun", "MPS before it");
      if (op == Op::mpp) branches_ = std::max(0, branches_ - 1);
    } else if (op == Op::inv) {
      require_block();
    } else if (is_plc ? op != Op::end : reads_group(op)) {
      require_block();
      pending_ = 0;
      if (options_.chose(option("block_stack", "each_output_leaves_the_result_alone")))
        blocks_ = std::min(blocks_, 1);
    }
  }

  /// Requires a block before the line. In step programs, look_at_group() checks this.
  void require_block() {
    if (blocks_ == 0 && area_ == Area::plc) fault(Code::logic, "has no condition", "a block before it");
  }

  bool is_loose_allowed() const {
    return options_.chose(option("cj_without_group", "takes_the_last_result"));
  }

  /// In step programs, contacts belong to the jump that follows them.
  void check_group(Op op) {
    if (is_loose_allowed()) return;
    const bool continues = is_contact(before_) || joins_blocks(before_) || reads_group(before_);
    const bool is_part = is_contact(op) || joins_blocks(op);
    if (is_part && !begins_block(op) && !continues) {
      fault(Code::logic, "has no block to continue", "a block before it");
    }
    const bool follows_jump = before_ == Op::cj || before_ == Op::cjn;
    if (reads_group(op) && !is_contact(before_) && !joins_blocks(before_) && !follows_jump) {
      fault(Code::logic, "has no condition", "contacts before it");
    }
    if (!is_part && !reads_group(op) && (is_contact(before_) || joins_blocks(before_))) {
      fault(Code::logic, "follows contacts", "CJ, CJN or IF after them");
    }
  }

  // --- partners -------------------------------------------------------------------------------------

  struct OpenIf {
    int line;
    bool has_else = false;
  };

  void check_pairs(Op op) {
    if (op == Op::if_) {
      ifs_.push_back({line_});
      if (static_cast<int>(ifs_.size()) == if_depth(options_) + 1) {
        fault(Code::pairing, "nests IF too deep", "at most " + std::to_string(if_depth(options_)));
      }
    } else if (op == Op::else_) {
      if (ifs_.empty()) return fault(Code::pairing, "has no partner", "IF before it");
      if (std::exchange(ifs_.back().has_else, true)) {
        fault(Code::pairing, "is a second ELSE in the same IF", "one at most");
      }
    } else if (op == Op::endi) {
      if (ifs_.empty()) return fault(Code::pairing, "has no partner", "IF before it");
      ifs_.pop_back();
    }
  }

  void check_label(std::int32_t label) {
    const auto [first, is_new] = labels_.emplace(label, line_);
    if (is_new) return;
    faults_.push_back({line_, Code::label_twice, "label K" + std::to_string(label) + " appears twice", "one",
                       first->second,
                       options_.chose(option("duplicate_label", "first_is_taken")) ? Fault::Weight::warning
                                                                                   : Fault::Weight::error});
  }

  static bool names_label(Op op) { return op == Op::jmp || op == Op::cj || op == Op::cjn || op == Op::cal; }

  void check_jumps() {
    for (const auto& [line, label] : jumps_) {
      if (labels_.contains(label)) continue;
      if (options_.chose(option("label_scope", "the_first_area_has_it")) &&
          !options_.chose(option("missing_label", "refused_at_load")))
        continue;  // the label may be in another area
      faults_.push_back({line, Code::label_missing, "names a label that the area does not have",
                         "LAB K" + std::to_string(label), -1,
                         options_.chose(option("missing_label", "refused_at_load")) ? Fault::Weight::error
                                                                                    : Fault::Weight::note});
    }
  }

  void check_coil(const Operand& coil) {
    if (options_.chose(option("double_coils", "last_wins"))) return;
    if (!coils_.emplace(std::pair(static_cast<int>(coil.letter), coil.number), line_).second) {
      fault(Code::logic, "switches a coil that another OUT switches", "one OUT");
    }
  }

  void check_end() {
    if (program_.lines.empty()) return;
    line_ = static_cast<int>(program_.lines.size()) - 1;
    const bool is_open = area_ != Area::plc && (is_contact(before_) || joins_blocks(before_));
    if (is_open && !is_loose_allowed())
      fault(Code::logic, "is a contact without a jump", "CJ, CJN or IF after it");
    if (!has_end_ && !options_.chose(option("missing_end", "as_if_it_had_one")))
      fault(Code::no_end, "is the last line", "END");
    for (const OpenIf& open : ifs_) {
      faults_.push_back({open.line, Code::pairing, "has no partner", "ENDI after it"});
    }
  }

  const AreaProgram& program_;
  Area area_;
  const Options& options_;
  std::vector<Fault> faults_;
  int line_ = 0;
  Op before_ = Op::end;  // the last line, ignoring NOP
  int blocks_ = 0;       // how many have begun in the area so far
  int pending_ = 0;      // how many have begun since the result was last read
  int branches_ = 0;
  bool has_end_ = false;
  bool is_full_ = false;
  std::vector<OpenIf> ifs_;
  std::map<std::int32_t, int> labels_;
  std::vector<std::pair<int, std::int32_t>> jumps_;  // lines, and the labels to which they refer
  std::map<std::pair<int, std::int32_t>, int> coils_;
};

}  // namespace

std::vector<Fault> faults_of(const AreaProgram& program, Area area, const Options& options) {
  return Structure(program, area, options).run();
}

}  // namespace understudy::interpreter::super_40nc
