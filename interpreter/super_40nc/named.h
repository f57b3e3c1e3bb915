// The registers and contacts of the device that programs use implicitly.
#pragma once

namespace understudy::interpreter::super_40nc::named {

inline constexpr int kSingleStep = 8001;  // M8x01 of an axis program
inline constexpr int kEmergencyStop = 8002;
inline constexpr int kReset = 8102;  // M8x02 of X; add 100 for each further axis
inline constexpr int kMotionInhibit = 8004;
inline constexpr int kContinuous = 8007;
inline constexpr int kContinuousKey = 8600;
inline constexpr int kAlwaysOn = 8003;
inline constexpr int kFeed = 8006;            // D
inline constexpr int kPlane = 8007;           // D
inline constexpr int kOwnedAxes = 9003;       // C21
inline constexpr int kContinuousPath = 9005;  // D
inline constexpr int kDefaultFeed = 9004;     // C10
inline constexpr int kTargetsOfC = 9006;      // C20
inline constexpr int kDefaultPlane = 9016;    // C23
inline constexpr int kTargetsOfX = 9173;      // X15; add 100 for each further axis

}  // namespace understudy::interpreter::super_40nc::named
