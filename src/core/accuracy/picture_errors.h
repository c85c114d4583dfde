#pragma once
// How far a drawn picture is from the true one.
#include "core/accuracy/reference.h"
#include "core/accuracy/run.h"
#include "core/measure/channels.h"

#include <glm/vec3.hpp>

namespace mb {

/// A picture as it was drawn: what its pixels' middles show, and its colors as light after the film.
struct DrawnPicture {
    Channels channels;
    std::vector<glm::vec3> shown, middle;  // of all its samples; of one at each pixel's middle
};

/// A surface whose depth is off by more than this share is another one: its pixel is wrong, and not counted as depth.
inline constexpr double kOtherSurface = 0.1;

/// color: root mean square of the difference as sRGB, over pixels and primaries. shade: the same of the pixels' middles. state: the share of pixels whose middle is a hit for
/// a miss or a miss for a hit, another object, another surface, or undecided. depth (relative) and normal (degrees): root mean square
/// over the smooth pixels that are none of these.
/// `out_off`, if there is one, takes the standard error of each.
Values<Error> errorsOf(const DrawnPicture& drawn, const TruePicture& truth, Values<Error>* out_off = nullptr);

/// Whether a pixel shows the wrong thing at its middle.
bool isWrong(const DrawnPicture& drawn, const TruePicture& truth, std::size_t pixel);
/// How far light after the film is from a color as it is shown: root mean square over the primaries, 0 to 1.
double difference(const glm::vec3& light, const glm::dvec3& shown);
/// How far its color is off, from 0 to 1: root mean square over the primaries. The same at its middle.
double colorError(const DrawnPicture& drawn, const TruePicture& truth, std::size_t pixel);
double shadeError(const DrawnPicture& drawn, const TruePicture& truth, std::size_t pixel);

/// Why a picture is no point of a curve, or nothing: a color that is no number, or more than one undecided pixel and more than
/// kMostUndecided of all, those left out that no single precision can tell (TruePictureWork::isTooCloseToTell).
std::string failureOf(const DrawnPicture& drawn, const TruePictureWork& truth);
inline constexpr double kMostUndecided = 1e-4;

}  // namespace mb
