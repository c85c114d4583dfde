// Motions that have a closed form: balls that fall, and bounce off a level plane.
#include "physics/true_motion.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace mb {
namespace {

/// The height of the only thing that does not move, if that is a level plane; -inf where nothing is there.
std::optional<double> levelOf(const Scene& scene) {
    std::optional<double> level;
    for (std::size_t i = 0; i < scene.objects.size(); i = subtreeEnd(scene, i)) {
        const Object& o = scene.objects[i];
        if (o.hidden || o.isBody()) continue;
        const bool upright = o.type->name == "plane" && o.numbers[0] == 0 && o.numbers[1] > 0 && o.numbers[2] == 0 && o.rot.x == 0 && o.rot.z == 0;
        if (!upright || level) return std::nullopt;
        level = o.pos.y + o.scale * o.numbers[3] / o.numbers[1];
    }
    return level.value_or(-INFINITY);
}

/// A ball between two impacts.
struct Flying {
    glm::dvec3 place, velocity, spin;
    double since = 0;
    Flying at(double t, double g) const {
        const double s = t - since;
        return {place + s * velocity + glm::dvec3{0, -0.5 * g * s * s, 0}, velocity - glm::dvec3{0, g * s, 0}, spin, t};
    }
};

/// When it next is at that height on its way down; infinite where it never is.
double meets(const Flying& f, double height, double g) {
    const double above = f.place.y - height;
    if (g <= 0) return f.velocity.y < 0 ? f.since + above / -f.velocity.y : INFINITY;
    const double root = std::sqrt(f.velocity.y * f.velocity.y + 2 * g * std::max(above, 0.0));
    return f.since + (f.velocity.y + root) / g;
}

/// Newton's impact, and Coulomb's friction on the slip of the lowest point: what sticks, or what the normal impulse allows. A solid
/// ball's point weighs 2/7 of it along the plane.
void bounce(Flying& io_f, double radius, Pairing p) {
    const double approach = -io_f.velocity.y;
    const glm::dvec3 down{0, -radius, 0};
    glm::dvec3 slip = io_f.velocity + glm::cross(io_f.spin, down);
    slip.y = 0;
    const double speed = glm::length(slip);
    const double drag = std::min(p.friction * (1 + p.restitution) * approach, 2.0 / 7 * speed);  // per kilogram
    if (speed > 0) {
        const glm::dvec3 impulse = -drag / speed * slip;
        io_f.velocity += impulse;
        io_f.spin += 2.5 / (radius * radius) * glm::cross(down, impulse);
    }
    io_f.velocity.y = p.restitution * approach;
}

/// One ball at each moment; nothing where it comes to rest, or starts on or in the plane.
std::optional<std::vector<Flying>> pathOf(const Body& body, double level, const World& world, double g, double seconds, double every_s) {
    const double height = level + body.radius, slowest = 0.3;
    if (body.position.y <= height + 1e-6) return std::nullopt;
    Flying f{body.position, body.velocity, body.spin, 0};
    std::vector<Flying> path;
    const auto moments = static_cast<std::size_t>(std::llround(seconds / every_s)) + 1;
    double impact = meets(f, height, g);
    for (std::size_t m = 0; m < moments; ++m) {
        const double t = static_cast<double>(m) * every_s;
        while (impact <= t) {
            f = f.at(impact, g);
            f.place.y = height;
            bounce(f, body.radius, pairing(world, body));
            if (f.velocity.y < slowest) return std::nullopt;
            impact = meets(f, height, g);
        }
        path.push_back(f.at(t, g));
    }
    return path;
}

/// Whether any two come near one another, between the moments too.
bool meetEachOther(std::span<const Body> bodies, const std::vector<std::vector<Flying>>& paths, double every_s, double top_speed) {
    for (std::size_t a = 0; a < paths.size(); ++a)
        for (std::size_t b = a + 1; b < paths.size(); ++b)
            for (std::size_t m = 0; m < paths[a].size(); ++m)
                if (glm::length(paths[a][m].place - paths[b][m].place) < bodies[a].radius + bodies[b].radius + 2 * top_speed * every_s) return true;
    return false;
}

}  // namespace

std::optional<Track> closedTrack(const Scene& scene, double seconds, double every_s) {
    const std::optional<double> level = levelOf(scene);
    const PhysicsWorld world(scene);
    const glm::dvec3 fall = scene.world.fall();
    const double g = -fall.y;
    if (!level || world.bodies().empty() || g < 0 || fall.x != 0 || fall.z != 0) return std::nullopt;
    Track track;
    track.every_s = every_s;
    std::vector<std::vector<Flying>> paths;
    double top = 0;  // m/s: faster is nothing in the time
    for (const Body& b : world.bodies()) {
        std::optional<std::vector<Flying>> path = pathOf(b, *level, scene.world, g, seconds, every_s);
        if (!path) return std::nullopt;
        track.bodies.push_back(b.object);
        top = std::max(top, glm::length(b.velocity) + g * seconds);
        paths.push_back(std::move(*path));
    }
    if (meetEachOther(world.bodies(), paths, every_s, top)) return std::nullopt;
    for (std::size_t m = 0; m < paths.front().size(); ++m) {
        std::vector<glm::dvec3>& places = track.places.emplace_back();
        double kinetic = 0, potential = 0;
        for (std::size_t i = 0; i < paths.size(); ++i) {
            const Flying& f = paths[i][m];
            const Body& b = world.bodies()[i];
            if (glm::length(f.place) > scene.world.bounds) return std::nullopt;
            places.push_back(f.place);
            kinetic += 0.5 * (glm::dot(f.velocity, f.velocity) / b.inverse_mass + glm::dot(f.spin, f.spin) / b.inverse_inertia[0][0]);
            potential += g * f.place.y / b.inverse_mass;
        }
        track.energy.push_back(kinetic + potential), track.kinetic.push_back(kinetic);
    }
    return track;
}

}  // namespace mb
