// SUPER-40NC: parameters D9, in the manual's order. If the manual prints no range or factory value for a D9,
// the row has that of the panel's parameter (《基本參數說明》, 《X(Y/Z/U)軸參數說明》; parameters.h). No
// value is refused: a value outside its range is stored, and limited where it is used.
#pragma once

#include "emulator/models/super_40nc/row_words.h"

namespace understudy::emulator::models::super_40nc {

// clang-format off
inline constexpr auto kGeneralParameterRows = section("D9 參數暫存器的功用(一般用)", {
    data(9000).kept_at_once().range(0, 15),  // station number
    data(9001).kept_at_once().range(0, 29999).does<select_file>(),
    data(9002).kept_at_once().range(0, 99).does<select_recipe>(),
    data(9003).kept_at_once().range(0, 4).in("axes"),  // C21
    data(9004).kept_at_once().range(1, 9999999).in("0.001 mm/s").from_factory(10000),  // C10
    data(9005).kept_at_once().range(0, 1),  // continuous path: a choice
    data(9006).kept_at_once().range(0, 1),  // C20
    data(9007).kept_at_once().range(0, 10000).in("ms").from_factory(6000),  // C0
    data(9008, 9009).kept_at_once(),
    data(9010).kept_at_once().not_modelled("the panel's lines"),
    data(9011).kept_at_once().range(1, 10000).in("RPM").from_factory(5000),  // C22
    data(9012).kept_at_once().range(1, 32767).in("multiplier pps").from_factory(1),  // C11
    data(9013).kept_at_once().range(1, 32767).in("multiplier pps").from_factory(1),  // C12
    data(9014).kept_at_once().range(1, 10000).in("ms").from_factory(500),  // C13
    data(9015).kept_at_once().range(1, 10000).in("ms").from_factory(500),  // C14
    data(9016).kept_at_once().range(0, 2).from_factory(2),  // C23
    data(9017, 9019).kept_at_once(),  // C24 to C26
    data(9020).kept_at_once(),
    data(9021).kept_at_once().not_modelled("the panel's edit page"),  // C15
    data(9022, 9024).kept_at_once(),
    data(9025).kept_at_once().range(0, 111111),  // C16
    data(9026).kept_at_once().from_factory(1234).not_modelled("the panel's password"),  // C3
    data(9027).kept_at_once(),
    data(9028).kept_at_once().range(0, 9999).in("ms"),  // C4
    data(9029).kept_at_once().range(0, 9999).in("ms"),  // C5
    data(9030, 9034).kept_at_once(),
    data(9035, R).kept_at_once(),
    data(9036, R).kept_at_once().in("lines").from_factory(1000),  // PLC
    data(9037, R).kept_at_once().in("lines").from_factory(500),   // X
    data(9038, R).kept_at_once().in("lines").from_factory(500),   // Y
    data(9039, R).kept_at_once().in("lines").from_factory(500),   // Z
    data(9040, R).kept_at_once().in("lines").from_factory(500),   // U
    data(9041, R).kept_at_once().in("lines"),                     // GM
    data(9042, R).kept_at_once().in("lines").from_factory(1500),  // C
    data(9043, R).kept_at_once().in("files").from_factory(20),
    data(9044, R).kept_at_once().in("pages"),
    data(9045).kept_at_once().range(1, 30000).in("lines").from_factory(1500).does<lay_out_files>(),
    data(9046, 9099).kept_at_once(),
});

/// The chip's counters, among which D9x27 to D9x30 and D9x55 choose.
inline constexpr BitField kCounterBits[] = {bits(0, "C1"), bits(1, "C2"), bits(2, "C3"), bits(3, "C4")};
inline constexpr BitField kCountersButTheFirst[] = {bits(0, "C2"), bits(1, "C3"), bits(2, "C4")};

inline constexpr auto kAxisParameterRows = section("D9x 參數暫存器的功用(XYZU 軸用)", {
    parameter(0).range(1, 7).from_factory(1),  // X0
    parameter(1).range(0, 1).does<change_axis>(1),
    parameter(2).range(0, 1).does<change_axis>(2),  // X32
    parameter(3).range(0, 1).does<change_axis>(3),
    parameter(4).range(0, 1).from_factory(1).not_modelled("ERC"),
    parameter(5).range(0, 1).from_factory(1).not_modelled("ERC"),
    parameter(6).range(0, 7).from_factory(4).not_modelled("ERC"),
    parameter(7).range(0, 1).from_factory(1).not_modelled("there is no CSTA"),
    parameter(8).range(0, 1).from_factory(1).not_modelled("there is no CSTP"),
    parameter(9).range(0, 3).not_modelled("there is no CLR"),
    parameter(10).range(0, 1).from_factory(1).not_modelled("there is no PCS"),
    parameter(11).range(0, 1).from_factory(1).not_modelled("the shape of pulses"),
    parameter(12).range(0, 3).not_modelled("an encoder gives counts"),
    parameter(13).range(0, 1).does<change_axis>(13),
    parameter(14).range(0, 1).from_factory(1).not_modelled("the edge of EZ"),
    parameter(15).range(0, 3).from_factory(2).does<change_axis>(15),  // X40
    parameter(16).range(0, 1).does<change_axis>(16),  // X41
    parameter(17).range(0, 1),
    parameter(18).range(0, 1).not_modelled("synchronous starts"),
    parameter(19).range(0, 1).does<change_axis>(19),
    parameter(20).range(0, 1).does<change_axis>(20),
    parameter(21).range(0, 12).from_factory(4),  // X20
    parameter(22).range(0, 15).in("count"),  // X31
    parameter(23).range(0, 2).does<change_axis>(23),
    parameter(24).range(0, 2).does<change_axis>(24),
    parameter(25).range(0, 3).does<change_axis>(25),
    parameter(26).range(0, 1).does<change_axis>(26),
    parameter(27).range(0, 15).with_bits(kCounterBits).not_modelled("there is no CLR"),
    parameter(28).range(0, 15).with_bits(kCounterBits).from_factory(15),
    parameter(29).range(0, 15).with_bits(kCounterBits),
    parameter(30).range(0, 7).with_bits(kCountersButTheFirst).does<change_axis>(30),
    parameter(31).range(0, 3).does<change_axis>(31),
    parameter(32).range(0, 6).from_factory(6).does<change_axis>(32),  // X35
    parameter(33).range(0, 3).from_factory(1).does<change_axis>(33),  // X35
    parameter(34).range(0, 1).not_modelled("ring counters"),
    parameter(35).range(0, 3).does<change_axis>(35),
    parameter(36).range(0, 6).from_factory(6).does<change_axis>(36),  // X36
    parameter(37).range(0, 3).from_factory(1).does<change_axis>(37),  // X36
    parameter(38).range(0, 1).not_modelled("ring counters"),
    parameter(39).range(0, 3).does<change_axis>(39),
    parameter(40).range(0, 5).does<change_axis>(40),
    parameter(41).range(0, 3).does<change_axis>(41),
    parameter(42).range(0, 1).not_modelled("there is no IDX"),
    parameter(43).range(0, 3).does<change_axis>(43),
    parameter(44).range(0, 10).does<change_axis>(44),
    parameter(45).range(0, 3).does<change_axis>(45),
    parameter(46).range(0, 5).does<change_axis>(46),
    parameter(47).range(0, 5).does<change_axis>(47),
    parameter(48).range(0, 3).does<change_axis>(48),
    parameter(49).range(0, 7).in("pulse").not_modelled("idle pulses"),
    parameter(50).range(0, 3).from_factory(1).does<change_axis>(50),
    parameter(51).range(0, 1).does<change_axis>(51),
    parameter(52).range(0, 1).does<change_axis>(52),
    parameter(53).range(0, 11).not_modelled("synchronous starts"),
    parameter(54).range(0, 3).not_modelled("synchronous starts"),
    parameter(55).range(0, 15).with_bits(kCounterBits).does<change_axis>(55),
    parameter(56).range(0, 4095).in("pulse"),  // X1
    parameter(57).range(0, 2),
    parameter(58).range(0, 1).not_modelled("pulses of the wheel behind a stop"),
    parameter(59).range(0, 2047).in("n/2048").not_modelled("X42 to X44 are the ratio"),
    parameter(60).range(0, 31).not_modelled("X42 to X44 are the ratio"),
    parameter(61).range(0, 65535).in("1.6 us").not_modelled("vibration suppression"),
    parameter(62).range(0, 65535).in("1.6 us").not_modelled("vibration suppression"),
    parameter(63).range(0, 2).from_factory(1).does<change_axis>(63),  // X33
    parameter(64).range(0, 2).from_factory(1).does<change_axis>(64),  // X34
    parameter(65).range(0, 3).in("digits").from_factory(3).not_modelled("the panel's decimal point"),  // X61
    parameter(66).range(1, 65535).in("ms").from_factory(500),  // X2
    parameter(67).range(1, 65535).in("ms").from_factory(500),  // X3
    parameter(68).range(0, 32767).in("multiplier pps").from_factory(1),  // X4
    parameter(69).range(0, 32767).in("multiplier pps").from_factory(1),  // X5
    parameter(70).range(200, 131072).in("pulse/rev").from_factory(4000),  // X6
    parameter(71).range(1, 131072).from_factory(1).does<change_axis>(71),  // X10
    parameter(72).range(1, 131072).from_factory(1).does<change_axis>(72),  // X11
    parameter(73).range(0, 1),  // X15
    parameter(74).range(0, 1),  // X60
    parameter(75).range(1, 10000).in("RPM").from_factory(3000),  // X12
    parameter(76).range(1, 10000).in("RPM").from_factory(1),  // X13
    parameter(77).range(1, 10000).in("RPM").from_factory(500),  // X26
    parameter(78).range(1, 10000).in("RPM").from_factory(100),  // X14
    parameter(79).range(1, 10000).in("RPM").from_factory(500),  // X21
    parameter(80).range(1, 10000).in("RPM").from_factory(20),  // X22
    parameter(81).range(0, 1),  // X23
    parameter(82).range(-9999999, 9999999).in("0.001 mm"),  // X24
    parameter(83).range(-9999999, 9999999).in("0.001 mm"),  // X30
    parameter(84).range(0, 4),  // X51
    parameter(85).range(-9999999, 9999999).in("0.001 mm").from_factory(9999999).does<change_axis>(85),  // X35
    parameter(86).range(-9999999, 9999999).in("0.001 mm").from_factory(-9999999).does<change_axis>(86),  // X36
    parameter(87).range(0, 9999).from_factory(1).does<change_axis>(87),  // X42
    parameter(88).range(0, 9999).from_factory(10).does<change_axis>(88),  // X43
    parameter(89).range(0, 9999).from_factory(100).does<change_axis>(89),  // X44
    parameter(90).range(-999999, 999999).in("0.001 mm"),  // X16
    parameter(91).range(0, 9999).in("ms"),  // X45
    parameter(92).range(0, 9999).in("ms"),  // X46
    parameter(93).range(0, 999).in("pulse").from_factory(5),  // X25
    parameter(94).range(1, 9999).in("RPM").from_factory(50),  // X53
    parameter(95).range(1, 9999).in("RPM").from_factory(100),  // X54
    parameter(96).range(1, 9999).in("RPM").from_factory(250),  // X55
    parameter(97).range(0, 1),  // X52
    parameter(98).range(0, 111111111),  // X56
    parameter(99).range(0, 4),  // X50
});
// clang-format on

}  // namespace understudy::emulator::models::super_40nc
