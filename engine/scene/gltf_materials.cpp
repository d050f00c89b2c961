#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <future>
#include <thread>

#include "engine/core/image.h"
#include "engine/scene/gltf_parts.h"

namespace tyndall::gltf {
namespace {

/// The scene's pictures, as materials come to name them: images that no material uses are not decoded.
class Pictures {
  public:
    explicit Pictures(const GltfFile& file) : file_(file) {}

    /// The index of a material's picture; -1 where it has none. `opaque`: with an alpha of 1.
    int index(int texture, bool opaque, const std::string& what) {
        if (texture == -1) return -1;
        const tinygltf::Texture& from = file_.at(file_.model().textures, texture, what + ": texture");
        (void)file_.at(file_.model().images, from.source, what + ": image");
        const Use use{from.source, sampling(from.sampler, what), opaque};
        const auto found = std::ranges::find(uses_, use);
        if (found == uses_.end()) {
            uses_.push_back(use);
            return static_cast<int>(uses_.size()) - 1;
        }
        return static_cast<int>(found - uses_.begin());
    }

    /// Decoding is most of a level's loading time: every core takes the next picture.
    [[nodiscard]] std::vector<Picture> decode() const {
        std::vector<Picture> pictures(uses_.size());
        std::atomic<std::size_t> next = 0;
        const auto work = [&] {
            for (std::size_t i = next++; i < pictures.size(); i = next++) pictures[i] = decode(uses_[i]);
        };
        const std::size_t cores = std::max(std::thread::hardware_concurrency(), 1u);
        std::vector<std::future<void>> workers;
        for (std::size_t i = 0; i < std::min(cores, pictures.size()); ++i)
            workers.push_back(std::async(std::launch::async, work));
        for (std::future<void>& worker : workers) worker.wait();
        for (std::future<void>& worker : workers) worker.get();
        return pictures;
    }

  private:
    /// An image of the file, read in one way: in another it is another picture.
    struct Use {
        int image;
        Sampling sampling;
        bool opaque;
        bool operator==(const Use&) const = default;
    };

    [[nodiscard]] Sampling sampling(int index, const std::string& what) const {
        Sampling to;
        if (index == -1) return to;
        const tinygltf::Sampler& from = file_.at(file_.model().samplers, index, what + ": sampler");
        const auto one_of = [&](int value, const char* key, std::initializer_list<int> known) {
            if (std::ranges::find(known, value) == known.end())
                file_.fail("{}: sampler {}: {} {} given, one of {} expected", what, index, key, value,
                           fmt::join(known, ", "));
            return value;
        };
        to.u = static_cast<Wrap>(one_of(from.wrapS, "wrapS", {10497, 33071, 33648}));
        to.v = static_cast<Wrap>(one_of(from.wrapT, "wrapT", {10497, 33071, 33648}));
        constexpr int nearest = 9728, linear = 9729;
        if (from.magFilter != -1) to.nearest = one_of(from.magFilter, "magFilter", {nearest, linear}) == nearest;
        if (from.minFilter != -1)
            to.minification = static_cast<unsigned>(
                one_of(from.minFilter, "minFilter", {nearest, linear, 9984, 9985, 9986, 9987}));
        return to;
    }

    [[nodiscard]] Picture decode(const Use& use) const {
        const tinygltf::Image& from = file_.model().images[static_cast<std::size_t>(use.image)];
        const std::string what =
            one_line(fmt::format("image {} \"{}\"", use.image, from.name.empty() ? from.uri : from.name));
        const std::span<const std::uint8_t> bytes =
            from.bufferView >= 0 ? file_.view_bytes(from.bufferView, 0, what) : std::span(from.image);
        const Image image = decode_image(bytes, file_.path().string() + ": " + what, 4);
        Picture to{from.name, image.size, std::vector<std::uint8_t>(image.pixels.size()), use.sampling};
        std::ranges::transform(image.pixels, to.rgba.begin(), [](float v) {
            return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f);
        });
        if (use.opaque)
            for (std::size_t i = 3; i < to.rgba.size(); i += 4) to.rgba[i] = 255;
        return to;
    }

    const GltfFile& file_;
    std::vector<Use> uses_;  ///< of each picture
};

std::vector<double> numbers(const tinygltf::Value& array) {
    std::vector<double> values(array.ArrayLen());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = array.Get(i).GetNumberAsDouble();
    return values;
}

/// Material::dielectric_f0.
float load_dielectric_f0(const GltfFile& file, const tinygltf::Material& from, const std::string& what) {
    double ior = 1.5, factor = 1, color = 1;
    constexpr const char *ior_name = "KHR_materials_ior", *specular_name = "KHR_materials_specular";
    if (const auto* value = file.extension(from, ior_name, "ior")) {
        ior = file.number(value->GetNumberAsDouble(), what + ": ior", 0);
        if (ior > 0 && ior < 1) file.fail("{}: ior {} given, 0 or a number from 1 on expected", what, ior);
    }
    if (const auto* value = file.extension(from, specular_name, "specularFactor"))
        factor = file.number(value->GetNumberAsDouble(), what + ": specularFactor", 0, 1);
    if (const auto* value = file.extension(from, specular_name, "specularColorFactor")) {
        const glm::vec3 rgb = file.vector<3>(numbers(*value), what + ": specularColorFactor", 0);
        color = std::max({rgb.r, rgb.g, rgb.b});
        if (rgb != glm::vec3(rgb.r))
            file.skip("{}: specularColorFactor is taken as grey, its largest channel", what);
    }
    for (const char* texture : {"specularTexture", "specularColorTexture"})
        if (file.extension(from, specular_name, texture) != nullptr)
            file.skip("{}: {} is not supported", what, texture);
    const double amplitude = (ior - 1) / (ior + 1);
    return static_cast<float>(std::min(amplitude * amplitude * factor * color, 1.0));
}

float load_transmission(const GltfFile& file, const tinygltf::Material& from, const std::string& what) {
    constexpr const char* name = "KHR_materials_transmission";
    if (file.extension(from, name, "transmissionTexture") != nullptr)
        file.skip("{}: transmissionTexture is not supported", what);
    const auto* value = file.extension(from, name, "transmissionFactor");
    return value == nullptr ? 0 : file.number(value->GetNumberAsDouble(), what + ": transmissionFactor", 0, 1);
}

/// It says nothing of its surface, as what an exporter leaves of a volume alone, which glTF cannot express.
bool is_empty(const tinygltf::Material& from, const Material& to) {
    const bool pictures = std::max({to.base_color_picture, to.metallic_roughness_picture, to.normal_picture,
                                    to.occlusion_picture, to.emissive_picture}) >= 0;
    const bool factors = to.base_color != glm::vec4(1) || to.metallic != 1 || to.roughness != 1;
    return !pictures && !factors && to.emissive == glm::vec3(0) && from.extensions.empty();
}

Material load_material(const GltfFile& file, const tinygltf::Material& from, Pictures& pictures,
                       const std::string& what) {
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    Material to;
    to.name = from.name;
    to.base_color = file.vector<4>(pbr.baseColorFactor, what + ": baseColorFactor", 0, 1);
    to.metallic = file.number(pbr.metallicFactor, what + ": metallicFactor", 0, 1);
    to.roughness = file.number(pbr.roughnessFactor, what + ": roughnessFactor", 0, 1);
    to.dielectric_f0 = load_dielectric_f0(file, from, what);
    to.emissive = file.vector<3>(from.emissiveFactor, what + ": emissiveFactor", 0);
    if (const auto* strength = file.extension(from, "KHR_materials_emissive_strength", "emissiveStrength"))
        to.emissive *= file.number(strength->GetNumberAsDouble(), what + ": emissiveStrength", 0);
    if (!std::isfinite(glm::length(to.emissive))) file.fail("{}: emission is not finite", what);
    to.normal_scale = file.number(from.normalTexture.scale, what + ": normal scale", -1e4, 1e4);
    to.occlusion_strength = file.number(from.occlusionTexture.strength, what + ": occlusion strength", 0, 1);

    if (from.alphaMode != "OPAQUE" && from.alphaMode != "MASK" && from.alphaMode != "BLEND")
        file.fail("{}: alphaMode {} given, OPAQUE, MASK or BLEND expected", what, from.alphaMode);
    to.transmission = load_transmission(file, from, what);
    to.alpha_mask = from.alphaMode == "MASK" && to.transmission == 0;
    to.alpha_blend = from.alphaMode == "BLEND" || to.transmission > 0;
    if (from.alphaMode == "MASK" && to.transmission > 0)
        file.skip("{}: alphaMode MASK is taken as BLEND, as it transmits light", what);
    const bool alpha_is_one = to.alpha_blend && from.alphaMode == "OPAQUE";
    if (alpha_is_one) to.base_color.a = 1;
    to.alpha_cutoff = file.number(from.alphaCutoff, what + ": alphaCutoff", 0);
    to.double_sided = from.doubleSided;

    const auto texture = [&](const auto& info, const char* slot, bool opaque = false) {
        return pictures.index(info.index, opaque, fmt::format("{}: {}", what, slot));
    };
    to.base_color_picture = texture(pbr.baseColorTexture, "baseColorTexture", alpha_is_one);
    to.metallic_roughness_picture = texture(pbr.metallicRoughnessTexture, "metallicRoughnessTexture");
    to.normal_picture = texture(from.normalTexture, "normalTexture");
    to.occlusion_picture = texture(from.occlusionTexture, "occlusionTexture");
    to.emissive_picture = texture(from.emissiveTexture, "emissiveTexture");
    return to;
}

}  // namespace

void load_materials(const GltfFile& file, Scene& scene) {
    Pictures pictures(file);
    for (const tinygltf::Material& from : file.model().materials) {
        const std::string what = fmt::format("material {} \"{}\"", scene.materials.size(), from.name);
        scene.materials.push_back(load_material(file, from, pictures, what));
    }
    scene.pictures = pictures.decode();
}

void light_unlit(const GltfFile& file, Scene& scene) {
    const float white = 1.2f * std::exp2(scene.exposure_ev100);  // cd/m²
    for (std::size_t i = 0; i < file.model().materials.size(); ++i) {
        if (!file.model().materials[i].extensions.contains("KHR_materials_unlit")) continue;
        Material& material = scene.materials[i];
        material.emissive = white * glm::vec3(material.base_color);
        material.emissive_picture = material.base_color_picture;
        material.base_color = glm::vec4(0, 0, 0, material.base_color.a);
        material.metallic = material.dielectric_f0 = 0;
        material.normal_picture = material.metallic_roughness_picture = material.occlusion_picture = -1;
    }
    for (const Mesh& mesh : scene.meshes) {
        const auto index = static_cast<std::size_t>(mesh.material);
        if (index >= file.model().materials.size() ||
            !file.model().materials[index].extensions.contains("KHR_materials_unlit"))
            continue;
        if (std::ranges::any_of(mesh.vertices, [](const Vertex& v) { return glm::vec3(v.color) != glm::vec3(1); }))
            file.skip("mesh \"{}\": vertex colours of unlit materials are not supported", mesh.name);
    }
}

void doubt_empty_materials(const GltfFile& file, const Scene& scene) {
    for (const Node& node : scene.nodes)
        for (const int mesh : node.meshes) {
            const auto index = static_cast<std::size_t>(scene.meshes[static_cast<std::size_t>(mesh)].material);
            const auto& materials = file.model().materials;  // the default one is none of the file's
            if (index < materials.size() && is_empty(materials[index], scene.materials[index]))
                file.doubt(
                    "material {} \"{}\": it says nothing of its surface, drawn as white metal; exporters leave "
                    "that of a "
                    "volume alone",
                    index, materials[index].name);
        }
}

}  // namespace tyndall::gltf
