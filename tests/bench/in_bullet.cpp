#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>

#include "engine.h"
#include "physics/scene_file.h"

namespace tweenfall::bench {

namespace {

btVector3 bullets(const Vec3& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}
Vec3 ours(const btVector3& v) {
  return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}

btTransform bullets(const Pose& pose) {
  const Quat& turn = pose.rotation;
  const btQuaternion rotation(static_cast<btScalar>(turn.x()), static_cast<btScalar>(turn.y()),
                              static_cast<btScalar>(turn.z()), static_cast<btScalar>(turn.w()));
  return btTransform(rotation, bullets(pose.position));
}

std::unique_ptr<btCollisionShape> bullets(const Solid& solid) {
  if (const auto* sphere = std::get_if<Sphere>(&solid))
    return std::make_unique<btSphereShape>(static_cast<btScalar>(sphere->radius));
  if (const auto* box = std::get_if<Box>(&solid)) return std::make_unique<btBoxShape>(bullets(box->half_extents));
  if (const auto* capsule = std::get_if<Capsule>(&solid))
    return std::make_unique<btCapsuleShape>(static_cast<btScalar>(capsule->radius),
                                            static_cast<btScalar>(2 * capsule->half_height));
  if (const auto* plane = std::get_if<Plane>(&solid))
    return std::make_unique<btStaticPlaneShape>(bullets(plane->normal), static_cast<btScalar>(plane->offset));
  auto hull = std::make_unique<btConvexHullShape>();
  for (const Vec3& point : std::get<Hull>(solid).convex.vertices()) hull->addPoint(bullets(point), false);
  hull->recalcLocalAabb();
  return hull;
}

btScalar larger_restitution(const btCollisionObject* a, const btCollisionObject* b) {
  return std::max(a->getRestitution(), b->getRestitution());
}

class BulletEngine : public Engine {
 public:
  explicit BulletEngine(const test::Scene& scene) : dt_(static_cast<btScalar>(scene.dt)) {
    gCalculateCombinedRestitutionCallback = &larger_restitution;
    world_.setGravity(bullets(test::vector_from(scene.file.at("gravity"))));
    const bool collisions = scene.file.value("collisions", true);
    for (const BodySettings& settings : scene.settings) {
      shapes_.push_back(bullets(settings.shape.solid));
      const btScalar mass = settings.fixed ? 0 : static_cast<btScalar>(settings.mass.value_or(1));
      btVector3 inertia(0, 0, 0);
      if (mass > 0) shapes_.back()->calculateLocalInertia(mass, inertia);
      btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shapes_.back().get(), inertia);
      const Quat& turn = settings.motion.pose.rotation;
      info.m_startWorldTransform.setOrigin(bullets(settings.motion.pose.position));
      info.m_startWorldTransform.setRotation({static_cast<btScalar>(turn.x()), static_cast<btScalar>(turn.y()),
                                              static_cast<btScalar>(turn.z()), static_cast<btScalar>(turn.w())});
      // Bullet takes the product where scenes want its square root.
      info.m_friction = static_cast<btScalar>(std::sqrt(settings.friction));
      info.m_restitution = static_cast<btScalar>(settings.restitution);
      info.m_linearDamping = static_cast<btScalar>(settings.linear_damping);
      info.m_angularDamping = static_cast<btScalar>(settings.angular_damping);
      bodies_.push_back(std::make_unique<btRigidBody>(info));
      btRigidBody& body = *bodies_.back();
      body.setLinearVelocity(bullets(settings.motion.twist.linear));
      body.setAngularVelocity(bullets(settings.motion.twist.angular));
      body.setActivationState(DISABLE_DEACTIVATION);
      if (collisions)
        world_.addRigidBody(&body);
      else
        world_.addRigidBody(&body, 1, 0);
    }
    for (const JointSettings& joint : scene.joints) {
      const auto& limb = std::get<SwingTwistJoint>(joint.kind);
      auto made = std::make_unique<btConeTwistConstraint>(*bodies_[joint.a.index], *bodies_[joint.b.index],
                                                          bullets(joint.frame_a), bullets(joint.frame_b));
      // Its cone takes z first; its twist is the same both ways.
      made->setLimit(static_cast<btScalar>(limb.swing_z), static_cast<btScalar>(limb.swing_y),
                     static_cast<btScalar>(limb.twist.high));
      world_.addConstraint(made.get(), true);
      joints_.push_back(std::move(made));
    }
  }
  ~BulletEngine() override {
    for (const auto& joint : joints_) world_.removeConstraint(joint.get());
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }
  void step() override { world_.stepSimulation(dt_, 0); }
  [[nodiscard]] Motion motion(std::size_t body) const override {
    const btTransform& at = bodies_[body]->getWorldTransform();
    const btQuaternion turn = at.getRotation();
    Motion motion;
    motion.pose.position = ours(at.getOrigin());
    motion.pose.rotation = Quat(static_cast<double>(turn.w()), static_cast<double>(turn.x()),
                                static_cast<double>(turn.y()), static_cast<double>(turn.z()))
                               .normalized();
    motion.twist = {ours(bodies_[body]->getLinearVelocity()), ours(bodies_[body]->getAngularVelocity())};
    return motion;
  }

 private:
  btScalar dt_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broad_phase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broad_phase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::vector<std::unique_ptr<btConeTwistConstraint>> joints_;
};

}  // namespace

std::unique_ptr<Engine> in_bullet(const test::Scene& scene) {
  return std::make_unique<BulletEngine>(scene);
}

}  // namespace tweenfall::bench
