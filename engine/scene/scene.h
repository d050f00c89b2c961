#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/aabb.h"
#include "engine/scene/medium.h"
#include "engine/scene/particles.h"

namespace tyndall {

struct Vertex {
    glm::vec3 position;
    glm::vec3 normal;
    glm::vec4 tangent;  ///< w is the sign of the bitangent
    glm::vec2 uv;
    glm::vec4 color{1};  ///< linear; multiplies the material's base colour
};

/// How a picture goes on beyond its edges. Numbers of glTF, which are OpenGL's.
enum class Wrap { repeat = 10497, clamp = 33071, mirror = 33648 };

/// How a picture is read between and beyond its texels.
struct Sampling {
    Wrap u = Wrap::repeat, v = Wrap::repeat;
    bool nearest = false;          ///< magnified: the nearest texel, not a mix of four
    unsigned minification = 9987;  ///< GL_LINEAR_MIPMAP_LINEAR, or another of glTF's six
    bool operator==(const Sampling&) const = default;
};

/// A texture's picture, 8 bit RGBA, rows from the top. Whether it is sRGB follows from the slot that uses it.
struct Picture {
    std::string name;
    glm::ivec2 size{0};
    std::vector<std::uint8_t> rgba;
    Sampling sampling{};
};

/// glTF metallic-roughness. Picture indices are -1 where absent.
struct Material {
    std::string name;
    glm::vec4 base_color{1};
    float metallic = 1, roughness = 1;
    /// Reflectance at normal incidence where not metal, 0..1: KHR_materials_ior's ((ior - 1) / (ior + 1))², times
    /// KHR_materials_specular's factor and the largest channel of its colour factor. Below 2% the whole specular
    /// lobe fades out (shaders/lib/brdf.glsl): 0 is a Lambert surface.
    float dielectric_f0 = 0.04f;
    glm::vec3 emissive{0};  ///< luminance in cd/m²: emissiveFactor * KHR_materials_emissive_strength
    float normal_scale = 1, occlusion_strength = 1;
    int base_color_picture = -1, metallic_roughness_picture = -1, normal_picture = -1, occlusion_picture = -1,
        emissive_picture = -1;
    bool alpha_mask = false, alpha_blend = false, double_sided = false;
    /// KHR_materials_transmission, 0..1; above 0 only with alpha_blend, and with an alpha of 1 where the file says
    /// OPAQUE. Light that crosses a transparent surface is multiplied by (1 - alpha) + alpha * transmission *
    /// colour.
    float transmission = 0;
    float alpha_cutoff = 0.5f;
};

/// One glTF primitive (triangles).
struct Mesh {
    std::string name;
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    int material = 0;
    Aabb bounds;
};

struct Node {
    std::string name;
    int parent = -1;
    glm::vec3 translation{0};
    glm::quat rotation{1, 0, 0, 0};
    glm::vec3 scale{1};
    std::vector<int> meshes;
    int light = -1, camera = -1;
    bool cast_shadow = true;  ///< extras.cast_shadow
    /// m, extras.draw_distance: its transparent parts are left out farther away; 0: never.
    float draw_distance = 0;
    bool dynamic = false;  ///< it or an ancestor is animated
    glm::mat4 world{1};
};

enum class LightType { sun, point, spot };

/// KHR_lights_punctual. It shines along -Z of its node's node_pose().
struct Light {
    std::string name;
    LightType type = LightType::point;
    glm::vec3 intensity{1};  ///< colour * intensity: lux for the sun, candela for point and spot
    /// m; 0 in a file means infinite: the loader replaces it by the distance where the lamp changes no pixel.
    float range = 0;
    float inner_cone = 0, outer_cone = 0.785398f;  ///< half angles, rad
    float radius = 0.01f;                          ///< m; extras.radius: d² is clamped at its square
    bool shadow = true;                            ///< extras.shadow
    int node = -1;
};

struct Camera {
    std::string name;
    float yfov = 1;      ///< vertical, rad
    float znear = 0.1f;  ///< m; the far plane is infinite
    int node = -1;
};

struct Animation {
    enum class Path { translation, rotation, scale };
    enum class Interpolation { step, linear, cubic };
    struct Channel {
        int node;
        Path path;
        Interpolation interpolation;
        std::vector<float> times;
        std::vector<glm::vec4> values;  ///< cubic: in-tangent, value, out-tangent per key; rotation as xyzw
    };
    struct Place {
        std::string name;
        float time;
    };
    std::string name;
    std::vector<Channel> channels;
    float duration = 0;         ///< s
    std::vector<Place> places;  ///< extras.places, of the animation "flythrough"
};

struct Scene {
    std::filesystem::path path;
    std::vector<Picture> pictures;
    std::vector<Material> materials;  ///< at least one
    std::vector<Mesh> meshes;
    std::vector<Node> nodes;  ///< parents before children
    std::vector<Light> lights;
    std::vector<Camera> cameras;
    std::vector<Animation> animations;
    std::vector<Medium> media;              ///< scene extras.media
    std::vector<ParticleEmitter> emitters;  ///< node extras.particles
    float exposure_ev100 =
        0;        ///< scene extras.exposure, or what suits its sun: a luminance of 1.2 * 2^EV shows as 1
    Aabb bounds;  ///< world, of all meshes at time 0

    [[nodiscard]] const Camera* find_camera(const std::string& name) const;
    [[nodiscard]] const Animation* find_animation(const std::string& name) const;
    [[nodiscard]] const Node* find_node(const std::string& name) const;
    /// Indices of the suns that shine, by luminance, the brightest first; of equals the earlier one.
    [[nodiscard]] std::vector<std::size_t> suns() const;
    /// The luminance (cd/m²) that is 1 in shaders and textures: the power of two nearest to 2^EV, from 2^-10 to
    /// 2^50, so that half floats hold what is up to 16 stops brighter than white, and what is far below the
    /// faintest step of a display.
    [[nodiscard]] float light_unit() const;
    /// The brightest: the one whose sky is seen and that has cascades. The others are lamps, see find_lamps().
    [[nodiscard]] std::optional<std::size_t> sun() const;
};

/// Evaluates every animation except `except` (looped over its duration) at `time`, moves media with the wind and
/// updates world transforms.
void animate(Scene& scene, double time, const std::string& except = "flythrough");
/// Evaluates one animation (clamped to its duration), for the fly-through.
void animate_one(Scene& scene, const Animation& animation, double time);
void update_world_transforms(Scene& scene);

/// Whether a transform mirrors, so that triangles are wound the other way. One that flattens does not.
[[nodiscard]] bool mirrors(const glm::mat4& world);
/// Where a node is and how it is turned, as orthonormal right-handed axes: what lights and cameras take of it, for
/// they have no size. -Z is the world transform's; where that has none, because a scale of 0 took it, the limit of
/// small scales. +Y is its own as far as it is orthogonal to that.
[[nodiscard]] glm::mat4 node_pose(const Scene& scene, int node);

/// Adds a camera that frames the bounds, if the scene has none.
void add_missing_camera(Scene& scene);
/// Adds a sun, if the scene has no light at all: for a visitor of an unlit model. Pictures and measurements do not.
void add_missing_sun(Scene& scene);

/// What a glTF file says beside its scene, and what the loader has to say of it.
struct GltfNotes {
    std::string generator;                ///< the program that wrote it; may be empty
    std::vector<std::string> extensions;  ///< that it uses
    bool exposure = false;                ///< whether it gives one
    std::vector<std::string> left_out;    ///< what is not read, and why: a line each
    std::vector<std::string> doubts;      ///< what looks like a mistake: a line each
};

/// Loads .gltf or .glb. Only files inside the scene's folder are read. Throws Error: path, what, expected. Bad
/// numbers (NaN, Inf, negative intensity, indices out of range) are errors. What is left out and what looks like a
/// mistake is logged, once the whole file is found right, or handed over in `notes`. Of the animations only the one
/// that is named is kept, and "flythrough"; throws UsageError where there is none of the name.
[[nodiscard]] Scene load_gltf(const std::filesystem::path& path,
                              const std::optional<std::string>& animation = std::nullopt);
[[nodiscard]] Scene load_gltf(const std::filesystem::path& path, GltfNotes& notes,
                              const std::optional<std::string>& animation = std::nullopt);

}  // namespace tyndall
