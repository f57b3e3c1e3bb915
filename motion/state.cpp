#include "motion/state.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/state/state_bytes.h"
#include "base/state/state_error.h"
#include "motion/bad_motion.h"
#include "motion/state_fields.h"  // IWYU pragma: keep, save() and restore() go through the fields

namespace understudy::motion {

template <class T>
std::vector<std::byte> save(const T& value) {
  StateWriter writer(sizeof value);
  writer.write(value);
  return writer.take();
}

template <class T>
std::size_t restore(T& value, std::span<const std::byte> bytes) {
  T restored;
  StateReader reader(bytes);
  const auto refuse = [](const char* what) { throw BadMotion(Refusal::out_of_range, "saved state", what); };
  try {
    reader.read(restored);
  } catch (const StateError& error) {
    refuse(error.what());
  }
  value = restored;
  return bytes.size() - reader.rest().size();
}

template <class T>
std::uint64_t hash(const T& value) {
  return hash_of(save(value));
}

#define UNDERSTUDY_STATE(Type)                                     \
  template std::vector<std::byte> save(const Type&);               \
  template std::size_t restore(Type&, std::span<const std::byte>); \
  template std::uint64_t hash(const Type&)

UNDERSTUDY_STATE(Axis);
UNDERSTUDY_STATE(Coordinated);
UNDERSTUDY_STATE(Counter);
UNDERSTUDY_STATE(ExternalDrive);
UNDERSTUDY_STATE(Follower);
UNDERSTUDY_STATE(Path);
UNDERSTUDY_STATE(PathRun);
UNDERSTUDY_STATE(Profile);
UNDERSTUDY_STATE(PulseDrive);
UNDERSTUDY_STATE(SpeedLaw);
UNDERSTUDY_STATE(Environment);
UNDERSTUDY_STATE(SyncTable);
UNDERSTUDY_STATE(UnitScale);

#undef UNDERSTUDY_STATE

}  // namespace understudy::motion

namespace understudy {

#define UNDERSTUDY_STATE_HERE(Type)                      \
  template void StateWriter::write(const motion::Type&); \
  template void StateReader::read(motion::Type&);        \
  template std::string first_difference(const motion::Type&, const motion::Type&, const std::string&)

UNDERSTUDY_STATE_HERE(Axis);
UNDERSTUDY_STATE_HERE(Coordinated);
UNDERSTUDY_STATE_HERE(Environment);
UNDERSTUDY_STATE_HERE(UnitScale);

#undef UNDERSTUDY_STATE_HERE

}  // namespace understudy
