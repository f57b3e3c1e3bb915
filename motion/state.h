// Motion state as bytes: saved, restored, hashed.
//
// Every value of this folder can be saved. The bytes are the same on every machine: little-endian numbers,
// the bit patterns of doubles, no padding. state_fields.h is the only definition of the parts of each value.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace understudy::motion {

struct Axis;
struct Coordinated;
struct Counter;
struct ExternalDrive;
struct Follower;
struct Path;
class PathRun;
struct Profile;
struct PulseDrive;
struct SpeedLaw;
struct Environment;
struct SyncTable;
struct UnitScale;

/// Saves `value` as bytes. T must be one of the types above; other types do not link.
template <class T>
std::vector<std::byte> save(const T& value);

/// Restores `value` from the first bytes of `bytes`, and returns how many bytes it used. Throws
/// BadMotion(out_of_range) if there are too few bytes, or if they contain values that the type cannot have (a
/// bool of 7, an enumerator that does not exist, a count beyond its table). In that case, `value` does not
/// change.
template <class T>
std::size_t restore(T& value, std::span<const std::byte> bytes);

/// Returns the FNV-1a hash of the saved bytes.
template <class T>
std::uint64_t hash(const T& value);

}  // namespace understudy::motion
