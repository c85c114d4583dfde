#pragma once
// How light is written for a screen.
#include <cmath>

namespace mb {

/// Linear light as sRGB, both from 0 to 1 (IEC 61966-2-1, 1999); clamped, and 0 for NaN.
inline double toSrgb(double linear) {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 1;
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

}  // namespace mb
