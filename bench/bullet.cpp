// As Bullet's examples set it up: one thread, the solver and the broad phase that they begin with.
#include "bench/bullet.h"

#include <btBulletDynamicsCommon.h>

#include <cmath>

namespace mb::bench {
namespace {

btVector3 vector(glm::dvec3 v) { return {static_cast<btScalar>(v.x), static_cast<btScalar>(v.y), static_cast<btScalar>(v.z)}; }

class BulletBin : public BinPeer {
public:
    explicit BulletBin(const SphereBin& bin) {
        world_.setGravity({0, static_cast<btScalar>(-SphereBin::kGravity), 0});
        world_.getSolverInfo().m_numIterations = 10;
        for (const SphereBin::Wall& wall : bin.walls()) add(std::make_unique<btBoxShape>(vector(wall.half)), 0, wall.centre);
        walls_ = bodies_.size();
        for (const glm::dvec3& at : bin.balls)
            add(std::make_unique<btSphereShape>(static_cast<btScalar>(SphereBin::kRadius)), static_cast<btScalar>(SphereBin::kMass), at);
    }
    ~BulletBin() override {
        for (const auto& body : bodies_) world_.removeRigidBody(body.get());
    }
    BulletBin(const BulletBin&) = delete;
    BulletBin& operator=(const BulletBin&) = delete;

    void step() override { world_.stepSimulation(static_cast<btScalar>(SphereBin::kStep), 0); }
    std::vector<glm::dvec3> positions() const override {
        std::vector<glm::dvec3> all;
        for (std::size_t i = walls_; i < bodies_.size(); ++i) {
            const btVector3& p = bodies_[i]->getWorldTransform().getOrigin();
            all.push_back({p.x(), p.y(), p.z()});
        }
        return all;
    }

private:
    /// A body without mass is a wall.
    void add(std::unique_ptr<btCollisionShape> shape, btScalar mass, glm::dvec3 at) {
        btVector3 inertia(0, 0, 0);
        if (mass > 0) shape->calculateLocalInertia(mass, inertia);
        btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape.get(), inertia);
        info.m_startWorldTransform.setIdentity();
        info.m_startWorldTransform.setOrigin(vector(at));
        // Bullet multiplies the two bodies' frictions.
        info.m_friction = static_cast<btScalar>(std::sqrt(SphereBin::kFriction));
        info.m_restitution = static_cast<btScalar>(SphereBin::kRestitution);
        shapes_.push_back(std::move(shape));
        bodies_.push_back(std::make_unique<btRigidBody>(info));
        bodies_.back()->setActivationState(DISABLE_DEACTIVATION);
        world_.addRigidBody(bodies_.back().get());
    }

    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_;
    std::size_t walls_ = 0;
};

}  // namespace

std::unique_ptr<BinPeer> bulletBin(const SphereBin& bin) { return std::make_unique<BulletBin>(bin); }

}  // namespace mb::bench
