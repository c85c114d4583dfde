#include "core/accuracy/run.h"

namespace mb {
namespace {

constexpr Quantity<Error> kErrors[] = {
    {Error::color, "color", "of white", "How far the colors of the picture are from the true ones: the root mean square over all pixels, as shown on a screen, where 1 is the way from black to white.", false, 1e-4},
    {Error::shade, "shade", "of white", "The same at the pixels' middles alone, without the stairs of edges: what the rays, the slopes, the shadows and the mirrors got wrong.", false, 1e-4},
    {Error::state, "state", "of the pixels", "The share of pixels that show the wrong thing at their middle: a hole, a ghost, another object or another surface.", false, 0},
    {Error::depth, "depth", "of the distance", "How far from the truth the surfaces stand, as a share of their distance from the eye: the root mean square over the pixels that show one smooth surface.", false, 1e-6},
    {Error::normal, "normal", "degrees", "By what angle the surfaces' directions are off: the root mean square over the same pixels.", false, 1.5e-3},
    {Error::position, "position", "m", "How far the bodies are from their true paths, a path being straight from one part of a step to the next: the root mean square over all bodies and moments.", true, 1e-4},
    {Error::energy, "energy", "of the energy", "By how much the energy at the end is wrong, as a share of the greatest energy of motion there was.", true, 1e-3},
    {Error::penetration, "penetration", "m", "The deepest that two things overlapped after any step.", true, 2e-4},
    {Error::restitution, "restitution", "of the speed", "By how much the speed with which a dropped ball leaves the floor is off, as a share of the speed it came with.", true, 1e-4},
};
constexpr Quantity<Cost> kCosts[] = {
    {Cost::evaluations, "evaluations", "a pixel", "How often the scene's distance was asked for, for each pixel of the picture: the same on every machine.", false, 0},
    {Cost::ms, "ms", "a frame", "How long a frame takes on this machine: the shortest of several, after one that does not count.", false, 0},
    {Cost::visits, "visits", "a second", "How much work a second of motion was: evaluations of the distance to what stands still, turns of the solver, pairs measured and searches for impacts. The same on every machine.", true, 0},
    {Cost::step_ms, "motion_ms", "a second", "How long a second of motion takes on this machine: the shortest of several.", true, 0},
};

template <class Row, std::size_t N> constexpr bool inOrder(const Quantity<Row> (&rows)[N]) {
    for (std::size_t i = 0; i < N; ++i)
        if (rows[i].row != static_cast<Row>(i)) return false;
    return N == static_cast<std::size_t>(Row::count);
}
static_assert(inOrder(kErrors) && inOrder(kCosts));

}  // namespace

std::span<const Quantity<Error>> errorRows() { return kErrors; }
std::span<const Quantity<Cost>> costRows() { return kCosts; }

}  // namespace mb
