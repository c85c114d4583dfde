#pragma once
// The bin of balls in Bullet, a library of its own (Debian: libbullet-dev). Defined where the build found it.
#include "bench/bin.h"

namespace mb::bench {

std::unique_ptr<BinPeer> bulletBin(const SphereBin& bin);

}  // namespace mb::bench
