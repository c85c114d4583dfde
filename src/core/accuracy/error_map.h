#pragma once
// A picture tinted by its distance from the true one.
#include "core/accuracy/picture_errors.h"

namespace mb {

/// What a pixel of the map shows beside a fading picture: from nothing at kFaintest, half a step of an 8-bit picture, over yellow
/// to red at kStrongest and beyond.
inline constexpr double kFaintest = 0.5 / 255, kStrongest = 0.25;
/// A pixel whose middle shows the wrong thing; one whose ray is undecided.
inline constexpr glm::vec3 kWrongTint{0.05f, 0.25f, 1.0f}, kUndecidedTint{1.0f, 0.0f, 1.0f};

/// The map of the color error or of the shade error, linear light, the top row first.
std::vector<glm::vec3> errorMap(const DrawnPicture& drawn, const TruePicture& truth, Error error = Error::color);
/// The same of two pictures, light after the film, of which the second is the true one.
std::vector<glm::vec3> differenceMap(std::span<const glm::vec3> shown, std::span<const glm::vec3> truth);
/// The tint of an error, from 0 to 1, and how much of it shows.
struct Tint {
    glm::vec3 color{0};
    float share = 0;
};
Tint tintOf(double error);

}  // namespace mb
