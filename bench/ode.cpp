// As ODE's demos set it up: QuickStep with its default 20 iterations, error reduction and softness.
#include "bench/ode.h"

#include <ode/ode.h>

namespace mb::bench {
namespace {

/// ODE is started once and ends with the program.
void startOde() {
    static const bool started = dInitODE2(0) != 0;
    static_cast<void>(started);
}

class OdeBin : public BinPeer {
public:
    explicit OdeBin(const SphereBin& bin) {
        startOde();
        dRandSetSeed(1);  // QuickStep shuffles the order of its rows
        world_ = dWorldCreate();
        dWorldSetGravity(world_, 0, -SphereBin::kGravity, 0);
        dWorldSetQuickStepNumIterations(world_, 20);
        dWorldSetAutoDisableFlag(world_, 0);
        contacts_ = dJointGroupCreate(0);
        walls_ = dSimpleSpaceCreate(nullptr);
        space_ = dHashSpaceCreate(nullptr);  // as fast as sweep and prune on 2,000 balls, faster on 8,000
        for (const SphereBin::Wall& wall : bin.walls()) {  // planes take no less time
            const dGeomID geom = dCreateBox(walls_, 2 * wall.half.x, 2 * wall.half.y, 2 * wall.half.z);
            dGeomSetPosition(geom, wall.centre.x, wall.centre.y, wall.centre.z);
        }
        for (const glm::dvec3& at : bin.balls) {
            dMass mass;
            dMassSetSphereTotal(&mass, SphereBin::kMass, SphereBin::kRadius);
            const dBodyID body = dBodyCreate(world_);
            dBodySetMass(body, &mass);
            dGeomSetBody(dCreateSphere(space_, SphereBin::kRadius), body);
            dBodySetPosition(body, at.x, at.y, at.z);
            balls_.push_back(body);
        }
    }
    ~OdeBin() override {
        dJointGroupDestroy(contacts_);
        dSpaceDestroy(space_), dSpaceDestroy(walls_);
        dWorldDestroy(world_);
    }
    OdeBin(const OdeBin&) = delete;
    OdeBin& operator=(const OdeBin&) = delete;

    void step() override {
        dSpaceCollide(space_, this, touch);
        dSpaceCollide2(reinterpret_cast<dGeomID>(space_), reinterpret_cast<dGeomID>(walls_), this, touch);
        dWorldQuickStep(world_, SphereBin::kStep);
        dJointGroupEmpty(contacts_);
    }
    std::vector<glm::dvec3> positions() const override {
        std::vector<glm::dvec3> all;
        for (const dBodyID body : balls_) {
            const dReal* p = dBodyGetPosition(body);
            all.push_back({p[0], p[1], p[2]});
        }
        return all;
    }

private:
    static void touch(void* self, dGeomID a, dGeomID b) {
        const OdeBin& bin = *static_cast<OdeBin*>(self);
        dContact contact{};
        contact.surface.mode = dContactApprox1;  // a friction pyramid of mu times the normal force
        contact.surface.mu = SphereBin::kFriction;
        if (dCollide(a, b, 1, &contact.geom, sizeof contact) > 0)
            dJointAttach(dJointCreateContact(bin.world_, bin.contacts_, &contact), dGeomGetBody(a), dGeomGetBody(b));
    }

    dWorldID world_;
    dJointGroupID contacts_;
    dSpaceID walls_, space_;
    std::vector<dBodyID> balls_;
};

}  // namespace

std::unique_ptr<BinPeer> odeBin(const SphereBin& bin) { return std::make_unique<OdeBin>(bin); }

}  // namespace mb::bench
