#pragma once
// The physics of a scene: bodies of any shape under gravity, against one another and against every shape that does not move.
//
// A step is made of equal parts. In each: (1) the contacts of the bodies that touch are found; (2) overlaps are pushed
// apart, without velocity; (3) slow approaches end and resting contacts get the impulses that carry them through the part
// (rest.cpp); (4) every body flies to the part's end, from impact to impact (flight.h); (5) what lies still falls asleep.
// What it does is the same on every machine and compiler, to the bit: see stateHash().
//
// Each of these is there if a row of the table of effects calls for it (stages.h): a part is composed of the stages that the
// bodies and solids of the scene need, and a stage that is left out would have changed nothing. Where no body is awake a
// step only counts the time.
#include "core/measure/parallel.h"
#include "physics/crowd.h"
#include "physics/flight.h"
#include "physics/islands.h"

#include <string>

namespace mb {

inline constexpr double kTopSpeed = 1e4;       // m/s: a faster body is slowed down to this, and noted
inline constexpr double kTopSpin = 1e6;        // rad/s
inline constexpr double kPushOutSpeed = 3;     // m/s: how fast an overlap is undone at most
inline constexpr double kStillTime = 0.5;      // s: a body sleeps that touches something and is still for so long
inline constexpr double kWeakFall = 0.03;      // m/s: where gravity gives less in a part, what is still is slower in proportion

struct Energy {
    double kinetic = 0, potential = 0;         // J; potential is 0 at the origin
    double total() const { return kinetic + potential; }
};

inline constexpr double kGrabRate = 30;        // rad/s: of the spring that holds what is grabbed
inline constexpr double kGrabPull = 300;       // m/s²: no stronger, times the body's mass
inline constexpr double kGrabSpeed = 20;       // m/s: the spring wants no faster approach
inline constexpr double kGrabCalm = 4;         // 1/s: at which what is held stops turning
inline constexpr std::size_t kMostNotes = 100; // beyond which one more says that there are others

/// A body held by hand.
struct Grab {
    ObjectId object;
    glm::dvec3 arm{0};                         // of the point, from the centre of mass, in the body's frame, m
    glm::dvec3 target{0};
};

class PhysicsWorld {
public:
    /// `choice`: to price a stage, and for tests; else the world is composed of what its scene calls for.
    explicit PhysicsWorld(const Scene& scene, StageChoice choice = {});

    /// How many threads look for contacts, at least 1; what a step does is the same for any number. At first as many as the machine
    /// has cores, and 4 at most.
    void setThreads(unsigned threads) { threads_ = std::max(threads, 1u); }
    /// One dt of the scene's physics record.
    void step();
    std::uint64_t steps() const { return steps_; }
    double time_s() const { return static_cast<double>(steps_) * knobs_.dt; }
    double dt_s() const { return knobs_.dt; }
    Stages stages() const { return stages_; }
    const StepCounts& counts() const { return counts_; }

    std::span<const Body> bodies() const { return bodies_; }
    int awake() const;
    int contacts() const { return contacts_; }                 // that carried something in the last part
    int removed() const { return removed_; }                   // out of bounds, or nowhere from the start
    /// Those whose state became no number: they stay where they last were, are met by nothing, and are named in notes().
    std::span<const Body> frozen() const { return frozen_; }
    std::uint64_t impacts() const { return impacts_; }
    std::uint64_t held() const { return held_; }               // waits for the next part, see flight.h
    std::uint64_t evaluations() const { return field_.evaluations() + before_; }  // of the static field
    /// What the user should know: shapes that take no part, bodies slowed down, frozen or removed, contacts that could not be resolved;
    /// each once.
    std::span<const std::string> notes() const { return notes_; }

    Energy energy() const;
    glm::dvec3 momentum() const;                               // kg·m/s
    glm::dvec3 angularMomentum() const;                        // kg·m²/s, about the origin
    double maxPenetration() const;                             // m, the deepest overlap there is now; 0: none
    /// FNV-1a over all that steps change and over the knobs, field by field. What the scene says of the world, of shapes and of surfaces
    /// is not in it.
    std::uint64_t stateHash() const;
    std::string stateText() const;                             // 16 hex digits of it
    /// That a copy of it takes, but for the static shapes, about.
    std::size_t bytes() const;
    /// Over what stateHash() takes of that body, by a quicker hash: to tell which body differs.
    std::uint64_t bodyHash(std::size_t body) const;

    /// Gives a body a velocity (m/s) and a spin (rad/s) and wakes it, and what it touches.
    void setMotion(std::size_t body, glm::dvec3 velocity, glm::dvec3 spin);
    /// Throws every body about: velocities up to `speed`, upwards more than down, the same for the same seed.
    void throwAbout(std::uint64_t seed, double speed);
    /// Holds a body's point to a target by a spring, critically damped and no stronger than kGrabPull, until it is let go, and calms
    /// its turning; done again, moves the target. `arm` is from its centre of mass, in the body's frame. What is held does not sleep.
    void grab(ObjectId object, glm::dvec3 arm, glm::dvec3 target);
    void letGo(ObjectId object);
    std::span<const Grab> grabs() const { return grabs_; }
    /// Gives every body whose centre of mass is nearer to `at` than `radius` a velocity away from there, and wakes it: `speed` next to
    /// it, falling linearly to 0 at the radius. What is exactly there goes up. Nothing shields, and nothing is turned.
    void explode(glm::dvec3 at, double speed, double radius);
    /// Takes the static shapes, the world and the knobs from an edited scene and wakes everything; the bodies stay.
    void changeStatics(const Scene& scene);
    /// Takes a body out and wakes what touched it.
    void remove(ObjectId object);
    /// Writes pos, rot, vel and spin of each body into its object; objects of removed bodies leave the scene.
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

    struct Place {
        glm::dvec3 position;
        glm::dquat orientation;
    };
    /// Memory of a part that the next uses again. A copy of a world has its own.
    struct Scratch {
        std::vector<Place> before;                             // of every body, where it was when the part began
        std::vector<Contact> found, others;
        std::vector<std::uint32_t> crowds;
        Crowd crowd;
        std::vector<double> apart;                             // of every contact: how far it is to part, m
        Crowd::Motions motions;
        std::vector<std::uint64_t> used;                       // of every body; 0 between uses
        std::vector<int> members;                              // of an island
        std::vector<Motion> motion;                            // of every body, that of the members
        std::vector<std::uint32_t> ids;                        // of every body: its object's
        std::vector<double> travel;                            // of every body: how far a point of it may get in the part, m
        std::vector<Reach> reach;
        std::vector<std::pair<int, int>> near;                 // the pairs that may touch, and room for more
        std::vector<char> taken;                               // of every impulse kept
        Scratch() = default;
        Scratch(const Scratch&) {}
        /// Those of a contact, unless they are members already; they are marked as used until unmark().
        void addMembers(const Contact& c) {
            for (const int i : {c.a, c.b})
                if (i != kStatic && used[static_cast<std::size_t>(i)] == 0) used[static_cast<std::size_t>(i)] = 1, members.push_back(i);
        }
        void unmark() {
            for (const int i : members) used[static_cast<std::size_t>(i)] = 0;
        }
        Scratch& operator=(const Scratch&) { return *this; }
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
    bool allBalls() const { return shapes_ == 0; }
    std::span<Contact> touching(double h);
    void remember();
    void noteWaysOut();
    struct Found {                                             // of some bodies or pairs, by one thread
        std::vector<Contact> contacts;
        ManifoldMemory::Share memory;
        StepCounts counts;
        explicit Found(ManifoldMemory& of) : memory(of) {}
    };
    template <class Find> void findAll(std::size_t count, Find find);
    void touchStatics(std::size_t i, const FlightRules& rules, Found& io_found);
    void touchBodies(const FlightRules& rules);
    void touchPair(int i, int j, const FlightRules& rules, Found& io_found);
    Reach reachOf(std::size_t i, glm::dvec3 drift, double pull, double time) const;
    void coverPairs(double h, std::span<const Motion> accelerations = {});
    std::vector<Motion> rest(std::span<Contact> contacts, const Islands& islands, double h);
    bool isImpact(const Contact& c, const FlightRules& rules) const;
    void dropImpacts(std::vector<Contact>& io_contacts, double h) const;
    std::vector<Motion> falling() const;
    void fly(std::span<const Motion> accelerations, double h);
    void wakeAndSleep(const Islands& islands);
    void pushApart(std::span<Contact> io_contacts, double h);
    void stopApproaches(std::span<Contact> contacts, double h);
    void temperIslands(std::span<const Contact> contacts);
    std::vector<Contact> carry(std::span<Contact> contacts, double h, std::span<Motion> io_accelerations);
    void settleCrowds(std::span<Contact> contacts, std::span<const std::uint32_t> numbers, double h, std::span<Motion> io_accelerations);
    double aimCrowd(Contact& io_c, const FlightRules& rules);
    void settleCrowd(std::span<Contact> contacts, std::span<const std::uint32_t> island, const FlightRules& rules, std::span<Motion> io_accelerations);
    std::span<const int> membersOf(std::span<const Contact> contacts);
    /// How far the bodies of a contact are to be moved apart in a part, m; below 0: how far they may come nearer.
    double apartOf(const Contact& c) const {
        const double deep = -c.gap - 0.5 * c.depth;
        return deep > 0 ? knobs_.push_out * deep : deep;
    }
    static double move(Body& io_body, const Motion& by, double h);
    struct Moment {                                            // of a body in a part
        int body;
        glm::dvec3 position;
        glm::dquat orientation;
        glm::dvec3 spin;
    };
    std::vector<Moment> goMidway(std::span<const int> members, double h);
    void goBack(std::span<const Moment> before);
    void ballsMidway(std::span<const Contact> start, std::vector<Contact>& io_midway);
    double halfTravelOf(const Contact& c, double h) const;
    bool movesOn(std::span<const Contact> start, double h) const;
    void findMidway(std::span<const Contact> start, double h, std::vector<Contact>& io_midway, StepCounts& io_counts) const;
    std::vector<Contact> atMidway(std::span<const Contact> contacts, double h);
    void aim(Contact& io_c, double h) const;
    bool isOf(const Kept& kept, const Contact& c) const;
    struct Range {
        std::size_t begin = 0, end = 0;
    };
    Range keptOf(const Contact& c) const;
    void take(Contact& io_c, std::size_t kept, std::vector<char>& io_taken) const;
    void takeKept(Contact& io_c, bool same_feature, std::vector<char>& io_taken) const;
    void takeKept(std::span<Contact> contacts);
    void keep(std::span<const Contact> carried, std::span<const Contact> contacts, std::span<const std::uint32_t> settled);
    void findKept();
    void countStill(std::span<const Contact> contacts, double h);
    void noteStuck(std::span<const Contact> contacts, double h);
    void setMotionOf(Body& io_body, glm::dvec3 velocity, glm::dvec3 spin);
    void pullGrabbed(double h);
    void tame();
    void leaveOut();
    void freezeBroken();
    void takeOut(const std::function<bool(const Body&)>& wanted, const std::function<void(Body&)>& taken);
    void removeWhere(const std::function<bool(const Body&)>& gone);
    void note(std::string text);
    double bounceSpeed(double h) const;

    World world_;
    PhysicsKnobs knobs_;
    StaticField field_;
    std::vector<Body> bodies_;
    std::vector<NearStatics> near_;                            // of each body; remembered, not state
    PairList pairs_;                                           // remembered, not state
    std::vector<Body> frozen_;
    std::vector<Grab> grabs_;
    std::vector<Kept> kept_;
    std::vector<std::uint32_t> kept_begin_;                    // of each body's; one more, the end
    ManifoldMemory memory_;
    Scratch scratch_;
    std::vector<std::string> notes_;
    std::vector<ObjectId> gone_;
    StageChoice choice_;
    Stages stages_;
    StepCounts counts_;
    std::uint64_t steps_ = 0, impacts_ = 0, held_ = 0, before_ = 0;
    unsigned threads_ = std::min(coresOf(), 4u);
    int removed_ = 0, contacts_ = 0;
    int ways_named_ = 0;                                       // notes of ways out
    int shapes_ = 0, owners_ = 0;                              // bodies that are no balls; whose surface is of its own
};

}  // namespace mb
