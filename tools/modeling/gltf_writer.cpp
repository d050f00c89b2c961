#include "tools/modeling/gltf_writer.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

namespace tyndall::modeling {

namespace {

using tinygltf::Value;
using Object = Value::Object;

// Micrometres are enough; short numbers keep the text small.
double rounded(float x) {
    return std::round(static_cast<double>(x) * 1e6) / 1e6;
}
std::vector<double> numbers(vec3 v) {
    return {rounded(v.x), rounded(v.y), rounded(v.z)};
}

Value to_value(const nlohmann::json& j) {
    if (j.is_object()) {
        Object o;
        for (const auto& [key, item] : j.items()) o[key] = to_value(item);
        return Value(o);
    }
    if (j.is_array()) {
        Value::Array a;
        for (const auto& item : j) a.push_back(to_value(item));
        return Value(a);
    }
    if (j.is_boolean()) return Value(j.get<bool>());
    if (j.is_number_integer()) return Value(j.get<int>());
    if (j.is_number()) return Value(rounded(j.get<float>()));
    return Value(j.get<std::string>());
}

struct Writer {
    tinygltf::Model model;
    std::vector<unsigned char> bytes;

    int view(const void* data, size_t size, int target = 0) {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        tinygltf::BufferView v;
        v.buffer = 0;
        v.byteOffset = bytes.size();
        v.byteLength = size;
        v.target = target;
        const auto* p = static_cast<const unsigned char*>(data);
        bytes.insert(bytes.end(), p, p + size);
        model.bufferViews.push_back(v);
        return static_cast<int>(model.bufferViews.size()) - 1;
    }
    int accessor(int buffer_view, int component, int type, size_t count) {
        tinygltf::Accessor a;
        a.bufferView = buffer_view;
        a.componentType = component;
        a.type = type;
        a.count = count;
        model.accessors.push_back(a);
        return static_cast<int>(model.accessors.size()) - 1;
    }
    // Tightly packed floats, `width` to an element.
    int floats(const std::vector<float>& data, int width, int type, int target, bool bounds) {
        const size_t count = data.size() / static_cast<size_t>(width);
        const int index =
            accessor(view(data.data(), data.size() * 4, target), TINYGLTF_COMPONENT_TYPE_FLOAT, type, count);
        if (bounds) {
            auto& a = model.accessors.back();
            for (int k = 0; k < width; ++k) {
                float low = data[static_cast<size_t>(k)], high = low;
                for (size_t i = static_cast<size_t>(k); i < data.size(); i += static_cast<size_t>(width)) {
                    low = std::min(low, data[i]);
                    high = std::max(high, data[i]);
                }
                a.minValues.push_back(low);
                a.maxValues.push_back(high);
            }
        }
        return index;
    }

    void materials(const MaterialSet& set) {
        for (const EncodedImage& from : set.images) {
            tinygltf::Image image;
            image.name = from.name;
            image.mimeType = from.mime;
            image.bufferView = view(from.bytes.data(), from.bytes.size());
            model.images.push_back(image);
            tinygltf::Texture texture;
            texture.source = static_cast<int>(model.images.size()) - 1;
            texture.sampler = 0;
            model.textures.push_back(texture);
        }
        tinygltf::Sampler sampler;
        sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
        sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
        model.samplers.push_back(sampler);
        for (const Material& from : set.materials) {
            tinygltf::Material m;
            m.name = from.name;
            auto& pbr = m.pbrMetallicRoughness;
            pbr.baseColorFactor = numbers(vec3(from.base_color));
            pbr.baseColorFactor.push_back(rounded(from.base_color.a));
            pbr.metallicFactor = rounded(from.metallic);
            pbr.roughnessFactor = rounded(from.roughness);
            pbr.baseColorTexture.index = from.albedo;
            pbr.metallicRoughnessTexture.index = from.surface;
            m.occlusionTexture.index = from.surface;
            m.normalTexture.index = from.normal;
            m.doubleSided = from.double_sided;
            if (from.mask) m.alphaMode = "MASK";
            if (from.blend) m.alphaMode = "BLEND";
            if (from.transmission > 0.0f)
                m.extensions["KHR_materials_transmission"] =
                    Value(Object{{"transmissionFactor", Value(rounded(from.transmission))}});
            if (from.emissive_strength > 0.0f) {
                m.emissiveFactor = numbers(from.emissive);
                if (from.glow_from_albedo) m.emissiveTexture.index = from.albedo;
                m.extensions["KHR_materials_emissive_strength"] =
                    Value(Object{{"emissiveStrength", Value(rounded(from.emissive_strength))}});
            }
            model.materials.push_back(m);
        }
    }

    void mesh(const Mesh& from, const MaterialSet& set) {
        tinygltf::Mesh mesh;
        mesh.name = from.name;
        for (const auto& [surface, part] : from.parts) {
            if (part.indices.empty()) continue;
            tinygltf::Primitive p;
            p.mode = TINYGLTF_MODE_TRIANGLES;
            p.material = surface.material;
            std::vector<float> position, normal, uv, tangent;
            for (const Vertex& v : part.vertices) {
                position.insert(position.end(), {v.position.x, v.position.y, v.position.z});
                normal.insert(normal.end(), {v.normal.x, v.normal.y, v.normal.z});
                uv.insert(uv.end(), {v.uv.x, v.uv.y});
            }
            const int target = TINYGLTF_TARGET_ARRAY_BUFFER;
            p.attributes["POSITION"] = floats(position, 3, TINYGLTF_TYPE_VEC3, target, true);
            p.attributes["NORMAL"] = floats(normal, 3, TINYGLTF_TYPE_VEC3, target, false);
            p.attributes["TEXCOORD_0"] = floats(uv, 2, TINYGLTF_TYPE_VEC2, target, false);
            if (set.materials[static_cast<size_t>(surface.material)].normal >= 0) {
                for (const vec4& t : tangents(part)) tangent.insert(tangent.end(), {t.x, t.y, t.z, t.w});
                p.attributes["TANGENT"] = floats(tangent, 4, TINYGLTF_TYPE_VEC4, target, false);
            }
            const int elements = TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
            if (part.vertices.size() < 65535) {
                const std::vector<uint16_t> small(part.indices.begin(), part.indices.end());
                p.indices = accessor(view(small.data(), small.size() * 2, elements),
                                     TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_SCALAR, small.size());
            } else {
                p.indices =
                    accessor(view(part.indices.data(), part.indices.size() * 4, elements),
                             TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, part.indices.size());
            }
            mesh.primitives.push_back(p);
        }
        model.meshes.push_back(mesh);
    }

    void light(const Light& from) {
        tinygltf::Light light;
        light.name = from.name;
        light.type = from.type == Light::Type::Sun     ? "directional"
                     : from.type == Light::Type::Point ? "point"
                                                       : "spot";
        light.color = numbers(from.color);
        light.intensity = rounded(from.intensity);
        if (from.type != Light::Type::Sun) {
            light.range = rounded(from.range);
            light.extras = Value(Object{{"radius", Value(rounded(from.radius))}, {"shadow", Value(from.shadow)}});
        }
        light.spot.innerConeAngle = rounded(from.inner);
        light.spot.outerConeAngle = rounded(from.outer);
        model.lights.push_back(light);
    }

    void nodes(const Scene& scene) {
        for (const Node& from : scene.nodes) {
            tinygltf::Node node;
            node.name = from.name;
            if (from.translation != vec3(0.0f)) node.translation = numbers(from.translation);
            const quat& q = from.rotation;
            if (q != quat(1, 0, 0, 0)) node.rotation = {q.x, q.y, q.z, q.w};
            if (from.scale != 1.0f) node.scale = numbers(vec3(from.scale));
            node.mesh = from.mesh;
            node.camera = from.camera;
            if (from.light >= 0) {
                node.extensions["KHR_lights_punctual"] = Value(Object{{"light", Value(from.light)}});
            }
            nlohmann::json extras = from.extras;
            if (!from.cast_shadow) extras["cast_shadow"] = false;
            if (!extras.empty()) node.extras = to_value(extras);
            model.nodes.push_back(node);
        }
        tinygltf::Scene root;
        root.name = scene.name;
        for (size_t i = 0; i < scene.nodes.size(); ++i) {
            const int parent = scene.nodes[i].parent, self = static_cast<int>(i);
            (parent < 0 ? root.nodes : model.nodes[static_cast<size_t>(parent)].children).push_back(self);
        }
        nlohmann::json extras = scene.extras;
        extras["media"] = scene.media;
        extras["exposure"] = scene.exposure;
        root.extras = to_value(extras);
        model.scenes.push_back(root);
        model.defaultScene = 0;
    }

    void animation(const Animation& from) {
        tinygltf::Animation animation;
        animation.name = from.name;
        if (!from.extras.is_null()) animation.extras = to_value(from.extras);
        const std::vector<float>* last_times = nullptr;  // channels that share their times share the accessor
        int times = -1;
        for (const Channel& c : from.channels) {
            if (!last_times || *last_times != c.times) times = floats(c.times, 1, TINYGLTF_TYPE_SCALAR, 0, true);
            last_times = &c.times;
            std::vector<float> values;
            for (const vec4& v : c.values) {
                values.insert(values.end(), {v.x, v.y, v.z});
                if (c.rotation) values.push_back(v.w);
            }
            tinygltf::AnimationSampler sampler;
            sampler.input = times;
            sampler.output = c.rotation ? floats(values, 4, TINYGLTF_TYPE_VEC4, 0, false)
                                        : floats(values, 3, TINYGLTF_TYPE_VEC3, 0, false);
            sampler.interpolation = "LINEAR";
            tinygltf::AnimationChannel channel;
            channel.sampler = static_cast<int>(animation.samplers.size());
            channel.target_node = c.node;
            channel.target_path = c.rotation ? "rotation" : "translation";
            animation.samplers.push_back(sampler);
            animation.channels.push_back(channel);
        }
        model.animations.push_back(animation);
    }
};

uint32_t word(const std::string& s, size_t at) {
    uint32_t x;
    std::memcpy(&x, s.data() + at, 4);
    return x;
}

// tinygltf always writes a camera's zfar, 0 where there is none, which glTF does not allow: take it out again.
std::string without_zero_zfar(const std::string& glb) {
    const uint32_t size = word(glb, 12);
    auto json = nlohmann::json::parse(glb.substr(20, size));
    for (auto& camera : json["cameras"]) camera["perspective"].erase("zfar");
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string out = glb.substr(0, 8);
    for (const auto x :
         {static_cast<uint32_t>(glb.size() - size + text.size()), static_cast<uint32_t>(text.size())}) {
        out.append(reinterpret_cast<const char*>(&x), 4);
    }
    return out + glb.substr(16, 4) + text + glb.substr(20 + size);
}

}  // namespace

std::string to_glb(const Scene& scene, const MaterialSet& set, const std::string& generator) {
    Writer w;
    w.model.asset.version = "2.0";
    w.model.asset.generator = generator;
    w.materials(set);
    for (const Mesh& mesh : scene.meshes) w.mesh(mesh, set);
    for (const Light& light : scene.lights) w.light(light);
    for (const Camera& from : scene.cameras) {
        tinygltf::Camera camera;
        camera.name = from.name;
        camera.type = "perspective";
        camera.perspective.yfov = rounded(from.yfov);
        camera.perspective.aspectRatio = 16.0 / 9.0;
        camera.perspective.znear = 0.1;
        w.model.cameras.push_back(camera);
    }
    w.nodes(scene);
    for (const Animation& animation : scene.animations) w.animation(animation);
    w.model.extensionsUsed = {"KHR_materials_emissive_strength", "KHR_lights_punctual"};
    tinygltf::Buffer buffer;
    buffer.data = std::move(w.bytes);
    w.model.buffers.push_back(std::move(buffer));
    std::ostringstream out;
    tinygltf::TinyGLTF writer;
    writer.WriteGltfSceneToStream(&w.model, out, false, true);
    return without_zero_zfar(out.str());
}

}  // namespace tyndall::modeling
