// A scene as a list of nodes, meshes, lights, cameras and animations: what the glTF file will hold.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include "tools/modeling/materials.h"
#include "tools/modeling/mesh.h"

namespace tyndall::modeling {

struct Light {
    std::string name;
    enum class Type { Sun, Point, Spot } type = Type::Point;
    vec3 color{1.0f, 0.6f, 0.3f};
    float intensity = 100.0f;  // lux for the sun, candela otherwise
    float range = 8.0f;        // m; 0: without end
    float radius = 0.06f;      // m
    bool shadow = true;
    float inner = 0.3f, outer = 0.8f;  // spot cone half angles, radians; spots point along the node's -Z
};

struct Camera {
    std::string name;
    float yfov;  // radians
};

struct Node {
    std::string name;
    vec3 translation{0.0f};
    quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
    float scale = 1.0f;
    int mesh = -1, light = -1, camera = -1, parent = -1;
    bool cast_shadow = true;
    nlohmann::json extras = nlohmann::json::object();  // besides cast_shadow
};

struct Channel {
    int node;
    bool rotation;  // else translation
    std::vector<float> times;
    std::vector<vec4> values;  // quaternion x, y, z, w or translation x, y, z
};

struct Animation {
    std::string name;
    std::vector<Channel> channels;
    nlohmann::json extras;
};

// Where a camera stands. Yaw 0 looks along -Z and grows to the left (counter-clockwise from above); degrees.
struct Pose {
    vec3 eye{0.0f};
    float yaw = 0.0f, pitch = 0.0f;
    [[nodiscard]] quat rotation() const;
    [[nodiscard]] vec3 forward() const;
};

// The pose at `eye` that looks along a direction of unit length.
Pose looking_along(vec3 eye, vec3 direction);

struct Scene {
    std::string name;
    std::vector<Mesh> meshes;
    std::vector<Light> lights;
    std::vector<Camera> cameras;
    std::vector<Node> nodes;
    std::vector<Animation> animations;
    nlohmann::json media = nlohmann::json::array();
    float exposure = 0.0f;                             // EV100
    nlohmann::json extras = nlohmann::json::object();  // of the scene, besides media and exposure

    int add_mesh(Mesh mesh);
    int add_node(Node node);
    // A mesh seen once, at the origin.
    int add_static(Mesh mesh);
    // One more instance of a mesh.
    int add_instance(const std::string& name, int mesh, vec3 position, float yaw_degrees = 0.0f,
                     float scale = 1.0f);
    int add_light(const Light& light, vec3 position, quat rotation = quat(1, 0, 0, 0));
    void add_camera(const std::string& name, float yfov_degrees, const Pose& pose);
    [[nodiscard]] mat4 world(int node) const;
    [[nodiscard]] size_t triangles() const;  // with every instance counted
};

quat yaw_rotation(float degrees);

}  // namespace tyndall::modeling
