#pragma once
// One part of a step: every body along its path, from impact to impact in the order of time.
//
// Between impacts a body's acceleration is constant, so its path is exact for any length of step; an impact is resolved
// at the moment it happens. Each body keeps its own clock inside the part and is brought forward when something happens
// to it (event-driven dynamics; Lubachevsky, "How to Simulate Billiards and Similar Systems", 1991).
//
// Impacts are looked for along the paths of balls that bounce, and of whatever is so fast that it might pass through something.
// The others' are met at the start of the part, by contacts that look ahead (rest.cpp, crowd.cpp).
#include "core/effects/effect.h"
#include "physics/approach.h"
#include "physics/broadphase.h"
#include "physics/collide.h"

#include <queue>

namespace mb {

inline constexpr int kEventsAPart = 48;  // of one body; beyond it the body waits for the next part

struct FlightRules {
    const World& world;
    double duration = 0;      // s, of the part
    double bounce = 0;        // m/s: a slower approach has no restitution
    Stages stages;            // that the flight is composed of
    bool proofs = true;       // a search that is proved to find nothing is not made
};

/// How far a point of the body may get in a part, m; and one of a against one of b.
inline double travelOf(const Body& body, const FlightRules& rules) {
    const double h = rules.duration;
    return (glm::length(body.velocity) + turningSpeed(body) + std::fabs(rules.world.gravity) * h) * h;
}
inline double travelBetween(const Body& a, const Body& b, const FlightRules& rules, bool balls = false) {
    const double h = rules.duration, turning = balls ? 0 : turningSpeed(a) + turningSpeed(b);
    return (glm::length(a.velocity - b.velocity) + turning + std::fabs(rules.world.gravity) * h) * h;
}
/// Whether a contact of the two, or of a with what does not move, is met in flight: balls that bounce, and what is fast. (What
/// lies ahead of the others is within the margin of their contacts. A ball that was hit on its way looks ahead anew,
/// if it still gets far: kStruck.)
/// `balls`: nothing else has a part in it; `inner`: the lesser; `travel`: of the two against one another, travelOf() or travelBetween().
inline bool metInFlight(bool balls, double inner, const Pairing& pairing, const FlightRules& rules, double travel) {
    return (balls && pairing.restitution != 0) || (rules.stages.has(Stage::continuous) && travel > kNear * inner);
}
inline bool metInFlight(const Body& a, const FlightRules& rules, double travel) {
    return metInFlight(a.isBall(), a.inner, pairing(rules.world, a), rules, travel);
}
inline bool metInFlight(const Body& a, const FlightRules& rules) { return metInFlight(a, rules, travelOf(a, rules)); }
inline bool metInFlight(const Body& a, const Body& b, const FlightRules& rules) {
    return metInFlight(a.isBall() && b.isBall(), std::min(a.inner, b.inner), pairing(rules.world, a, b), rules, travelBetween(a, b, rules));
}
/// Moves a body that meets nothing: at that acceleration (m/s², rad/s²) for a time, exactly but for a shape's turning.
void advance(Body& io_body, const Motion& acceleration, double time, bool spins, StepCounts& io_counts);
/// False only if nothing at all is.
bool anyMetInFlight(std::span<const Body> bodies, const FlightRules& rules);

class Flight {
public:
    /// `accelerations` (m/s², rad/s²) hold from the start of the part to the body's first impact; `pairs` are those that may meet
    /// until then.
    Flight(std::vector<Body>& bodies, std::vector<NearStatics>& near, const StaticField& field, const FlightRules& rules,
           std::span<const Motion> accelerations, std::span<const std::pair<int, int>> pairs, StepCounts& io_counts);
    /// Moves every body to the end of the part.
    void run();

    int impacts = 0;
    std::vector<int> held;    // bodies that met more than fits into one part, or whose path is not known: they wait for the next where they are

private:
    struct Path {
        double time = 0;      // that the body's position, velocity and spin are of
        glm::dvec3 acceleration{0}, turning{0};
        std::uint32_t version = 0;
        int events = 0, slow = 0;  // impacts so far; those of them that nothing approached fast at
        bool held = false, carried = false;  // carried: contacts bear it from the start of the part on
    };
    struct Event {
        double time;
        int a, b;
        std::uint32_t version_a, version_b;
        /// The queue gives the greatest first: the earliest event, then the lowest numbers.
        friend bool operator<(const Event& x, const Event& y) {
            return x.time != y.time ? x.time > y.time : x.a != y.a ? x.a > y.a : x.b > y.b;
        }
    };

    bool has(Stage s) const { return rules_.stages.has(s); }
    // Along the paths (flight.cpp).
    void rememberReach();
    glm::dvec3 positionAt(std::size_t i, double t) const;
    Pose poseAt(std::size_t i, double t) const;
    Motion motionAt(std::size_t i, double t) const;
    double fastest(std::size_t i) const;
    double depthOf(std::size_t i, std::size_t j) const;
    GapAt shapeGap(std::size_t i, std::size_t j, double t, double margin);
    glm::dvec3 velocityAt(std::size_t i, double t) const;
    void advance(std::size_t i, double t);
    void expect(const Meeting& meeting, std::size_t i, std::size_t j);
    void expectStatic(std::size_t i);
    void expectStaticOfShape(std::size_t i);
    bool noStaticAhead(std::size_t i, double duration, const ApproachLimits& limits);
    void expectPair(std::size_t i, std::size_t j);
    void expectPairOfShapes(std::size_t i, std::size_t j);
    void expectAll(std::size_t i);
    void growReach(std::size_t i);
    // At an impact (impact.cpp).
    void meet(const Event& event);
    std::vector<Contact> contactsOf(int a, int b);
    void addStaticContacts(int i, bool alone, std::vector<Contact>& io_contacts);
    bool bounceApart(std::vector<Contact>& contacts, int a, int b);
    double energyOf(int i) const;
    glm::dvec3 accelerationAt(std::size_t i, const glm::dvec3& arm) const;
    void bear(std::size_t i, const glm::dvec3& arm, const glm::dvec3& force);
    double yieldOf(std::size_t i, const glm::dvec3& arm, const glm::dvec3& normal) const;
    void support(const std::vector<Contact>& contacts);
    void hold(std::size_t i);

    std::vector<Body>& bodies_;
    std::vector<NearStatics>& near_;
    const StaticField& field_;
    FlightRules rules_;
    StepCounts& counts_;
    Collider collider_;
    std::vector<Path> paths_;
    std::vector<Motion> motion_;                 // scratch of the solver
    std::span<const std::pair<int, int>> pairs_;
    std::vector<Reach> reach_;                   // from the first impact on: where each may get, from the start of the part
    std::vector<std::vector<int>> neighbours_;   // the same as the pairs, and more where an impact makes a body faster
    std::priority_queue<Event> events_;
};

}  // namespace mb
