#pragma once
// The physics of a scene: bodies of any shape under gravity, against one another and against every shape that does not move.
//
// A step is made of equal parts. In each: (1) the contacts of the bodies that touch are found; (2) overlaps are pushed
// apart, without velocity; (3) slow approaches end and resting contacts get the impulses that carry them through the part
// (rest.cpp); (4) every body flies to the part's end, from impact to impact (flight.h); (5) what lies still falls asleep.
// What it does is the same on every machine and compiler, to the bit: see stateHash().
//
// Each of these is there if a row of the table of effects calls for it (stages.h): a part is composed of the stages that the
// bodies and solids of the scene need, and a stage that is left out would have changed nothing. Where no ball is awake a
// step only counts the time.
#include "physics/flight.h"

#include <string>

namespace mb {

inline constexpr double kTopSpeed = 1e4;       // m/s: a faster ball is slowed down to this, and noted
inline constexpr double kTopSpin = 1e6;        // rad/s
inline constexpr double kPushOutSpeed = 3;     // m/s: how fast an overlap is undone at most
inline constexpr double kStillTime = 0.5;      // s: a ball sleeps that touches something and is still for so long
inline constexpr double kWeakFall = 0.03;      // m/s: where gravity gives less in a part, what is still is slower in proportion

struct Energy {
    double kinetic = 0, potential = 0;         // J; potential is 0 at y = 0
    double total() const { return kinetic + potential; }
};

class PhysicsWorld {
public:
    /// `choice`: to price a stage, and for tests; else the world is composed of what its scene calls for.
    explicit PhysicsWorld(const Scene& scene, StageChoice choice = {});

    /// One dt of the scene's physics record.
    void step();
    std::uint64_t steps() const { return steps_; }
    double time_s() const { return static_cast<double>(steps_) * knobs_.dt; }
    double dt_s() const { return knobs_.dt; }
    Stages stages() const { return stages_; }
    const StepCounts& counts() const { return counts_; }

    std::span<const Body> bodies() const { return bodies_; }
    int awake() const;
    int contacts() const { return contacts_; }                 // that balls rested on in the last part
    int removed() const { return removed_; }                   // out of bounds, or no longer numbers
    std::uint64_t impacts() const { return impacts_; }
    std::uint64_t held() const { return held_; }               // waits for the next part, see flight.h
    std::uint64_t evaluations() const { return field_.evaluations() + before_; }  // of the static field
    /// What the user should know: shapes that take no part, balls slowed down or removed; each once.
    std::span<const std::string> notes() const { return notes_; }

    Energy energy() const;
    glm::dvec3 momentum() const;                               // kg·m/s
    glm::dvec3 angularMomentum() const;                        // kg·m²/s, about the origin
    double maxPenetration() const;                             // m, the deepest overlap there is now; 0: none
    /// FNV-1a over everything the next step depends on, field by field.
    std::uint64_t stateHash() const;
    std::string stateText() const;                             // 16 hex digits of it
    /// Over what stateHash() takes of that body, by a quicker hash: to tell which body differs.
    std::uint64_t bodyHash(std::size_t body) const;

    /// Gives a ball a velocity (m/s) and a spin (rad/s) and wakes it, and what it touches.
    void setMotion(std::size_t body, glm::dvec3 velocity, glm::dvec3 spin);
    /// Throws every ball about: velocities up to `speed`, upwards more than down, the same for the same seed.
    void throwAbout(std::uint64_t seed, double speed);
    /// Takes the static shapes, the world and the knobs from an edited scene and wakes everything; the balls stay.
    void changeStatics(const Scene& scene);
    /// Takes a ball out and wakes what touched it.
    void remove(ObjectId object);
    /// Writes pos, rot, vel and spin of each ball into its object; objects of removed balls leave the scene.
    void writeTo(Scene& scene) const;

private:
    struct Kept {                                              // an impulse to begin the next part with
        std::uint32_t a = 0, b = 0;                            // ids of objects; 0: static
        std::uint64_t feature = 0;
        glm::dvec3 normal{0}, arm{0};
        double push = 0;
        glm::dvec3 drag{0};
        double twist = 0;
    };

    struct Made {                                              // a shape that a body was made of
        Scene shape;
        double mass = 0, density = 0;
        std::size_t body = 0;
    };
    void addBody(const Scene& scene, std::size_t object, std::vector<Made>& io_made);
    bool has(Stage s) const { return stages_.has(s); }
    void compose();
    void countShapes();
    void part(double h);
    FlightRules rulesFor(double h) const { return {world_, h, bounceSpeed(h), stages_, choice_.proofs}; }
    bool flown(const Contact& c, const FlightRules& rules) const;
    bool allBalls() const { return shapes_ == 0; }
    std::vector<Contact> touching(double h);
    void touchStatics(std::vector<Contact>& io_contacts, double h);
    void touchBodies(std::vector<Contact>& io_contacts, double h);
    std::vector<Motion> rest(std::vector<Contact>& io_contacts, double h);
    void dropImpacts(std::vector<Contact>& io_contacts, double h) const;
    std::vector<Motion> falling() const;
    void fly(std::span<const Motion> accelerations, double h);
    void wakeAndSleep(std::span<const Contact> contacts);
    void pushApart(std::span<const Contact> contacts, double h);
    void stopApproaches(std::span<Contact> contacts, double h);
    void carry(std::span<const Contact> contacts, double h, std::span<Motion> io_accelerations);
    std::vector<Contact> atMidway(std::span<const Contact> contacts, double h);
    void setTargets(std::span<Contact> contacts, double h) const;
    bool isOf(const Kept& kept, const Contact& c) const;
    void takeKept(std::span<Contact> contacts) const;
    void keep(std::span<const Contact> contacts);
    void countStill(std::span<const Contact> contacts, double h);
    void setMotionOf(Body& io_body, glm::dvec3 velocity, glm::dvec3 spin);
    void tame();
    void removeWhere(const std::function<bool(const Body&)>& gone);
    void note(std::string text);
    double bounceSpeed(double h) const;

    World world_;
    PhysicsKnobs knobs_;
    StaticField field_;
    std::vector<Body> bodies_;
    std::vector<NearStatics> near_;                            // of each body; remembered, not state
    std::vector<Kept> kept_;
    ManifoldMemory memory_;
    std::vector<std::string> notes_;
    std::vector<ObjectId> gone_;
    StageChoice choice_;
    Stages stages_;
    StepCounts counts_;
    std::uint64_t steps_ = 0, impacts_ = 0, held_ = 0, before_ = 0;
    int removed_ = 0, contacts_ = 0, shapes_ = 0;              // shapes: bodies that are no balls
};

}  // namespace mb
