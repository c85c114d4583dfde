#include "core/effects/effect.h"
namespace mb {
std::span<const Effect> motionEffects() { return {}; }
}  // namespace mb
