#include "sample_game/player.h"

#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletDynamics/Character/btKinematicCharacterController.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace tyndall {
namespace {

constexpr float eye_height = 1.65f;
constexpr float capsule_radius = 0.3f;
constexpr float capsule_height = 1.75f;  // over all
constexpr float step_height = 0.3f;
constexpr float walk_speed = 2.4f, run_speed = 5.0f, fly_speed = 6.0f, fast_fly_speed = 24.0f;  // m/s
constexpr float jump_speed = 4.2f;                                                              // m/s: 0.9 m high
constexpr float gravity = 9.81f;
constexpr float pointer_gain = 0.0022f;  // rad per pixel
constexpr float stick_gain = 2.6f;       // rad/s
constexpr float pulled = 0.5f;           // of a trigger's way
constexpr float max_pitch = 1.54f;
constexpr double longest_step = 1.0 / 120;  // s, of what moves
constexpr float stair_time = 0.08f;         // s in which the eye makes up for all but 1/e of a step
constexpr float way_step = 2.0f;            // m between the places that a walker goes back to
constexpr float fall_margin = 30.0f;        // m below the level's lowest point

btVector3 to_bullet(glm::vec3 v) {
    return {v.x, v.y, v.z};
}

/// Ground round the level, on which nobody who walks is meant to be.
bool is_surroundings(const Node& node) {
    return node.name == "terrain";
}

bool is_solid(const Scene& scene, const Node& node, const Mesh& mesh) {
    const Material& material = scene.materials[mesh.material];
    return !material.alpha_mask && !material.alpha_blend && !node.dynamic;
}

}  // namespace

struct Player::World {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
    btGhostPairCallback ghost_callback;
    struct Ground {
        btTriangleMesh triangles{true, false};
        std::unique_ptr<btBvhTriangleMeshShape> shape;
        btCollisionObject object;
    };
    Ground level, surroundings;
    btCapsuleShape capsule{capsule_radius, capsule_height - 2 * capsule_radius};
    btPairCachingGhostObject ghost;
    std::unique_ptr<btKinematicCharacterController> character;

    explicit World(const Scene& scene) {
        for (const Node& node : scene.nodes)
            for (const int index : node.meshes)
                if (is_solid(scene, node, scene.meshes[index]))
                    add(scene.meshes[index], node.world, is_surroundings(node) ? surroundings : level);
        broadphase.getOverlappingPairCache()->setInternalGhostPairCallback(&ghost_callback);
        for (Ground* ground : {&level, &surroundings}) {
            if (ground->triangles.getNumTriangles() == 0) continue;
            ground->shape = std::make_unique<btBvhTriangleMeshShape>(&ground->triangles, true);
            ground->object.setCollisionShape(ground->shape.get());
            world.addCollisionObject(&ground->object, btBroadphaseProxy::StaticFilter,
                                     btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter);
        }
        ghost.setCollisionShape(&capsule);
        ghost.setCollisionFlags(btCollisionObject::CF_CHARACTER_OBJECT);
        world.addCollisionObject(&ghost, btBroadphaseProxy::CharacterFilter,
                                 btBroadphaseProxy::StaticFilter | btBroadphaseProxy::DefaultFilter);
        character =
            std::make_unique<btKinematicCharacterController>(&ghost, &capsule, step_height, btVector3(0, 1, 0));
        character->setGravity(btVector3(0, -gravity, 0));
        character->setJumpSpeed(jump_speed);
        character->setFallSpeed(40);
        character->setMaxSlope(glm::radians(50.0f));
        world.addAction(character.get());
    }

    ~World() {
        world.removeAction(character.get());
        world.removeCollisionObject(&ghost);
        for (Ground* ground : {&level, &surroundings})
            if (ground->shape) world.removeCollisionObject(&ground->object);
    }

    static void add(const Mesh& mesh, const glm::mat4& transform, Ground& ground) {
        const auto corner = [&](std::size_t i) {
            return to_bullet(glm::vec3(transform * glm::vec4(mesh.vertices[mesh.indices[i]].position, 1)));
        };
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
            ground.triangles.addTriangle(corner(i), corner(i + 1), corner(i + 2));
    }

    void warp(glm::vec3 eye) {
        character->reset(&world);
        character->warp(to_bullet(eye + glm::vec3(0, capsule_height / 2 - eye_height, 0)));
    }

    [[nodiscard]] bool stands_on_surroundings() const {
        const btVector3 center = ghost.getWorldTransform().getOrigin();
        const btVector3 below = center - btVector3(0, capsule_height / 2 + step_height, 0);
        struct Hit : btCollisionWorld::ClosestRayResultCallback {
            using ClosestRayResultCallback::ClosestRayResultCallback;
            bool needsCollision(btBroadphaseProxy* proxy) const override {
                return proxy->m_collisionFilterGroup == btBroadphaseProxy::StaticFilter;
            }
        } hit(center, below);
        world.rayTest(center, below, hit);
        return hit.m_collisionObject == &surroundings.object;
    }

    [[nodiscard]] glm::vec3 eye() const {
        const btVector3 center = ghost.getWorldTransform().getOrigin();
        return {center.x(), center.y() - capsule_height / 2 + eye_height, center.z()};
    }
};

Player::Player(const Scene& scene) : world_(std::make_unique<World>(scene)) {
    if (!scene.bounds.empty()) lowest_ = scene.bounds.min.y - fall_margin;
    if (const Node* start = scene.find_node("player_start")) {
        const glm::vec3 feet(start->world[3]);
        place(feet + glm::vec3(0, eye_height, 0),
              -glm::vec3(node_pose(scene, static_cast<int>(start - scene.nodes.data()))[2]));
    } else if (!scene.cameras.empty()) {
        const glm::mat4 camera = node_pose(scene, scene.cameras.front().node);
        place(glm::vec3(camera[3]), -glm::vec3(camera[2]));
        starts_flying_ = flying_ = true;
    }
    start_ = eye_;
    start_direction_ = direction();
}

Player::~Player() = default;

void Player::restart() {
    place(start_, start_direction_);
    flying_ = starts_flying_;
}

void Player::place(glm::vec3 eye, glm::vec3 direction) {
    const glm::vec3 d = glm::normalize(direction);
    yaw_ = std::atan2(-d.x, -d.z);
    pitch_ = std::clamp(std::asin(d.y), -max_pitch, max_pitch);
    eye_ = eye;
    stair_offset_ = last_drop_ = 0;
    way_.clear();
    world_->warp(eye);
}

glm::vec3 Player::direction() const {
    return {-std::sin(yaw_) * std::cos(pitch_), std::sin(pitch_), -std::cos(yaw_) * std::cos(pitch_)};
}

glm::mat4 Player::camera_to_world() const {
    glm::mat4 m = glm::translate(glm::mat4(1), eye_);
    m = glm::rotate(m, yaw_, glm::vec3(0, 1, 0));
    return glm::rotate(m, pitch_, glm::vec3(1, 0, 0));
}

void Player::set_flying(bool flying) {
    if (flying_ && !flying) place(eye_, direction());
    flying_ = flying;
}

bool Player::on_ground() const {
    return !flying_ && world_->character->onGround();
}

bool Player::update(const Input& input, double dt, bool look_with_pointer) {
    const glm::vec2 gain = look_speed * glm::vec2(1, invert_look ? -1 : 1);
    if (look_with_pointer) turn(glm::vec2(input.pointer_delta) * pointer_gain * gain);
    if (dt <= 0) return false;
    const auto axis = [&](Key positive, Key negative) {
        return static_cast<float>(input.down(positive)) - static_cast<float>(input.down(negative));
    };
    const glm::vec2 stick = input.gamepad.left;  // +y is down
    glm::vec2 move(axis(keys.right, keys.left) + stick.x, axis(keys.forward, keys.back) - stick.y);
    const glm::vec2 arrows(axis(Key::right, Key::left), axis(Key::down, Key::up));
    if (glm::length(move) > 1) move = glm::normalize(move);
    btKinematicCharacterController& character = *world_->character;
    if (!flying_ && (input.pressed(keys.jump) || input.gamepad.jump) && character.onGround()) character.jump();

    // Equal steps that end with the frame: with a fixed step, frames would hold two or three of them in turn.
    const int steps = std::max(1, static_cast<int>(std::ceil(dt / longest_step - 1e-6)));
    const float step = static_cast<float>(dt / steps);
    for (int i = 0; i < steps; ++i) {
        turn((input.gamepad.right + arrows) * stick_gain * step * gain);
        if (flying_)
            fly_step(input, move, step);
        else
            walk_step(input, move, step);
    }
    if (flying_) return false;
    stair_offset_ = std::clamp(stair_offset_, -step_height, step_height);
    eye_ = world_->eye() + glm::vec3(0, stair_offset_, 0);
    if (eye_.y < lowest_) {
        place(start_, start_direction_);
        return true;
    }
    return on_ground() && strayed();
}

/// Keeps the way in mind, and goes back on it from ground that nobody is meant to walk on.
bool Player::strayed() {
    if (!world_->stands_on_surroundings()) {
        const glm::vec3 here = world_->eye();
        if (way_.empty()) way_ = {here, here};
        if (glm::distance(here, way_.back()) > way_step) way_ = {way_.back(), here};
        return false;
    }
    if (way_.empty()) return false;  // came flying
    const glm::vec3 back = way_.front();
    place(back, direction());
    way_ = {back, back};
    return true;
}

void Player::turn(glm::vec2 angles) {
    yaw_ = std::remainder(yaw_ - angles.x, glm::two_pi<float>());
    pitch_ = std::clamp(pitch_ - angles.y, -max_pitch, max_pitch);
}

void Player::fly_step(const Input& input, glm::vec2 move, float dt) {
    const float up = static_cast<float>(input.down(keys.jump)) - static_cast<float>(input.down(Key::control)) +
                     input.gamepad.up - input.gamepad.down;
    const glm::vec3 right(std::cos(yaw_), 0, -std::sin(yaw_));
    const float speed = input.down(keys.run) ? fast_fly_speed : fly_speed;
    eye_ += (direction() * move.y + right * move.x + glm::vec3(0, up, 0)) * speed * dt;
}

void Player::walk_step(const Input& input, glm::vec2 move, float dt) {
    const glm::vec3 forward(-std::sin(yaw_), 0, -std::cos(yaw_)), right(std::cos(yaw_), 0, -std::sin(yaw_));
    const bool runs = input.down(keys.run) || input.gamepad.up > pulled;
    const glm::vec3 velocity = (forward * move.y + right * move.x) * (runs ? run_speed : walk_speed);
    btKinematicCharacterController& character = *world_->character;
    const bool stood = character.onGround();
    const float before = world_->eye().y;
    character.setWalkDirection(to_bullet(velocity * dt));
    world_->world.stepSimulation(dt, 0);
    const float drop = before - world_->eye().y;
    if (character.onGround()) stair_offset_ += stood ? drop : std::max(drop - last_drop_, 0.0f);
    last_drop_ = character.onGround() ? 0 : drop;
    stair_offset_ *= std::exp(-dt / stair_time);
}

}  // namespace tyndall
