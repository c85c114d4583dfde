#pragma once
// The bin of balls in ODE, a library of its own (Debian: libode-dev). Defined where the build found it.
#include "bench/bin.h"

namespace mb::bench {

std::unique_ptr<BinPeer> odeBin(const SphereBin& bin);

}  // namespace mb::bench
