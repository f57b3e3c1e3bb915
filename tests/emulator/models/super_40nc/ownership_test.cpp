// Who gets an axis: every cell of the table, by contacts where they can bring it about (《CHK 指令》, 《VDRV
// 指令》 and 5.7 of what we made of them).
#include <gtest/gtest.h>

#include "emulator/models/super_40nc/ownership.h"
#include "tests/emulator/models/super_40nc/one_super40nc.h"

namespace understudy::emulator::models::super_40nc {
namespace ownership_test {

constexpr Holder kByContact[] = {Holder::nobody, Holder::jog, Holder::home, Holder::zero, Holder::wheel};
constexpr Request kAskedByContact[] = {Request::jog, Request::home_or_zero, Request::wheel, Request::stop};

void bring_about(OneSuper40nc& one, Holder holder) {
  one.set("D8117", 100000);
  switch (holder) {
    case Holder::nobody: break;
    case Holder::jog: one.set("M8103", 1); break;
    case Holder::home: one.set("M8105", 1); break;
    case Holder::zero: one.set("M8106", 1); break;
    case Holder::wheel: one.set("M8108", 1); break;
    case Holder::move:
    case Holder::rest:
    case Holder::vdrv: break;
  }
  one.run(20);
  EXPECT_EQ(one.it().axis(0).holder, holder);
}

/// A contact that was ON already is switched OFF first.
const char* contact_of(Request request, bool second) {
  switch (request) {
    case Request::jog: return "M8104";
    case Request::home_or_zero: return second ? "M8106" : "M8105";
    case Request::wheel: return "M8109";
    case Request::line:
    case Request::mpg_line:
    case Request::plc_drv:
    case Request::vdrv:
    case Request::vdrv_0: break;
    case Request::stop: return "M8102";
  }
  return "";
}

TEST(Super40ncOwnership, IsAsTheTableSays) {
  for (const Holder holder : kByContact) {
    for (const Request request : kAskedByContact) {
      for (const bool second : {false, true}) {
        OneSuper40nc one;
        bring_about(one, holder);
        if (second && request != Request::home_or_zero) continue;
        const std::string contact = contact_of(request, second);
        one.set(contact, 0);
        one.run(1);
        one.set(contact, 1);
        one.run(1);
        const Holder after = one.it().axis(0).holder;
        const Value code = one.get("D8094");
        switch (grant(holder, request)) {
          case Grant::starts:
            EXPECT_NE(after, Holder::nobody) << contact;
            EXPECT_EQ(code, 0);
            break;
          case Grant::refused:
          case Grant::same_or_no:  // these are of the other direction, and of another source
            EXPECT_EQ(after, holder) << contact;
            EXPECT_EQ(code, 21) << contact;
            break;
          case Grant::stops:
          case Grant::nothing:
            EXPECT_EQ(after, Holder::nobody) << contact;
            EXPECT_EQ(code, 0);
            break;
          case Grant::waits:
          case Grant::new_speed: ADD_FAILURE() << "not by a contact";
        }
      }
    }
  }
}

}  // namespace ownership_test
}  // namespace understudy::emulator::models::super_40nc
