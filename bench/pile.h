#pragma once
// A pile of carved dice: bodies that are no balls, thrown into a tray, until all of them sleep.
#include "core/scene/scene.h"

#include <cstdint>

namespace mb::bench {

inline constexpr double kDie = 0.5, kDieApart = 0.9;  // m: a die's side, and how far apart they begin

/// A tray without a lid, and dice above its floor: boxes with rounded edges less six balls, turned at random, each moved by up to
/// 0.05 m along each axis. They lie in as many layers as there are dice in a row of the cube they fill.
Scene pileScene(int dice, std::uint64_t seed);

/// How deep a die is inside another, or in the tray, at its deepest, m; from the scene's places and turns alone: many points of each
/// die's surface in the distance of every other. 0: nowhere.
double deepestOverlap(const Scene& pile);

}  // namespace mb::bench
