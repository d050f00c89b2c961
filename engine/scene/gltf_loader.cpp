#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <future>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <thread>

#include "engine/core/error.h"
#include "engine/core/files.h"
#include "engine/core/image.h"
#include "engine/scene/mesh_build.h"
#include "engine/scene/scene.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;
namespace gltf = tinygltf;
using Json = nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

constexpr const char* supported_extensions[] = {"KHR_lights_punctual", "KHR_materials_emissive_strength",
                                                "KHR_mesh_quantization", "EXT_mesh_gpu_instancing"};
constexpr float faintest_illuminance = 0.01f;  // lx; where a lamp without a range ends

/// Files that the glTF names, read through tinygltf's callbacks, from inside the scene's folder only.
struct SceneFolder {
    fs::path path;
    std::string first_error;
};

bool read_scene_file(std::vector<unsigned char>* out, std::string*, const std::string& uri, void* user) {
    auto& folder = *static_cast<SceneFolder*>(user);
    try {
        *out = read_bytes(resolve_inside(folder.path, uri));
        return true;
    } catch (const Error& e) {
        if (folder.first_error.empty()) folder.first_error = e.what();
        return false;
    }
}

/// Keeps the encoded bytes of a picture in a file or a data URI. Those in a buffer view are read later, when the
/// view's range is checked: tinygltf passes a pointer it has not checked.
bool keep_encoded(gltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char* bytes,
                  int size, void*) {
    if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
    return true;
}

std::string one_line(std::string text) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.pop_back();
    std::ranges::replace(text, '\n', ' ');
    if (text.size() > 300) text = text.substr(0, 297) + "...";
    return text;
}

class Loader {
  public:
    explicit Loader(const fs::path& path) { scene_.path = path; }

    Scene load() {
        parse();
        load_materials();
        load_meshes();
        load_nodes();
        load_animations();
        load_scene_extras();
        finish();
        return std::move(scene_);
    }

  private:
    template <class... Args>
    [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
        throw Error(one_line(scene_.path.string() + ": " + fmt::format(format, std::forward<Args>(args)...)));
    }
    template <class... Args>
    void skip(fmt::format_string<Args...> format, Args&&... args) const {
        spdlog::warn("{}: {}", scene_.path.string(), fmt::format(format, std::forward<Args>(args)...));
    }

    template <class T>
    const T& at(const std::vector<T>& items, int index, const std::string& what) const {
        if (index < 0 || static_cast<std::size_t>(index) >= items.size())
            fail("{} {} does not exist; there are {}", what, index, items.size());
        return items[static_cast<std::size_t>(index)];
    }
    float number(double value, const std::string& what, double min = -HUGE_VAL, double max = HUGE_VAL) const {
        const auto result = static_cast<float>(value);
        if (!std::isfinite(result) || value < min || value > max)
            fail("{}: {} given, a number in [{}, {}] expected", what, value, min, max);
        return result;
    }
    template <int n>
    glm::vec<n, float> vector(const std::vector<double>& values, const std::string& what,
                              double min = -HUGE_VAL) const {
        if (values.size() != n) fail("{}: {} numbers given, {} expected", what, values.size(), n);
        glm::vec<n, float> v;
        for (int i = 0; i < n; ++i) v[i] = number(values[static_cast<std::size_t>(i)], what, min);
        return v;
    }
    bool boolean(const Json& value, const std::string& what) const {
        if (value.is_boolean()) return value.get<bool>();
        if (value == 0 || value == 1) return value == 1;  // Blender's custom properties before 3.3
        fail("{}: true or false expected", what);
    }
    float number(const Json& value, const std::string& what, double min = -HUGE_VAL) const {
        if (!value.is_number()) fail("{}: a number expected", what);
        return number(value.get<double>(), what, min);
    }
    /// The extras object of an item, as tinygltf stored it; an empty object where there is none.
    template <class Item>
    static Json extras(const Item& item) {
        Json json = item.extras_json_string.empty() ? Json::object() : Json::parse(item.extras_json_string);
        return json.is_object() ? json : Json::object();
    }
    /// An integer or number member of an item's extension.
    template <class Item>
    static const gltf::Value* extension(const Item& item, const char* name, const char* key) {
        const auto found = item.extensions.find(name);
        return found != item.extensions.end() && found->second.Has(key) ? &found->second.Get(key) : nullptr;
    }

    // --- the file
    // -------------------------------------------------------------------------------------------------

    /// tinygltf walks extras recursively and takes the binary chunk's length on trust: both are checked first.
    void check_container(const Bytes& bytes, bool binary) const {
        std::string_view json(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        if (bytes.size() > std::numeric_limits<std::uint32_t>::max()) fail("larger than 4 GiB");
        if (binary) {
            const auto word = [&](std::size_t offset) {
                std::uint32_t value = 0;
                if (offset + 4 <= bytes.size()) std::memcpy(&value, &bytes[offset], 4);
                return std::size_t(value);
            };
            const std::size_t size = word(8), json_end = 20 + word(12);
            const std::size_t end = json_end < size ? json_end + 8 + word(json_end) : json_end;
            if (bytes.size() < 20 || size > bytes.size() || end > size)
                fail("the file has {} bytes, its header and chunks ask for {}: it is cut off or damaged",
                     bytes.size(), std::max(size, end));
            if (word(4) != 2) fail("binary glTF version {}, 2 expected", word(4));
            json = json.substr(20, json_end - 20);
        }
        constexpr int deepest = 100;
        int depth = 0;
        bool in_string = false;
        for (std::size_t i = 0; i < json.size(); ++i) {
            const char c = json[i];
            if (in_string && c == '\\') ++i;
            if (c == '"') in_string = !in_string;
            if (in_string) continue;
            if (c == '[' || c == '{') ++depth;
            if (c == ']' || c == '}') --depth;
            if (depth > deepest) fail("the JSON is nested deeper than {} levels", deepest);
        }
    }

    void parse() {
        const Bytes bytes = read_bytes(scene_.path);
        const bool binary = bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
        check_container(bytes, binary);

        SceneFolder folder{scene_.path.parent_path().empty() ? "." : scene_.path.parent_path(), {}};
        gltf::TinyGLTF parser;
        parser.SetStoreOriginalJSONForExtrasAndExtensions(true);
        parser.SetImageLoader(keep_encoded, nullptr);
        // The default ExpandFilePath and the search of the working folder must not find anything.
        parser.SetFsCallbacks(
            {[](const std::string&, void*) { return true; }, [](const std::string& file, void*) { return file; },
             read_scene_file,
             [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; },
             &folder});
        std::string error, warning;
        const auto size = static_cast<unsigned>(bytes.size());
        bool parsed = false;
        try {
            parsed = binary ? parser.LoadBinaryFromMemory(&model_, &error, &warning, bytes.data(), size, "")
                            : parser.LoadASCIIFromString(&model_, &error, &warning,
                                                         reinterpret_cast<const char*>(bytes.data()), size, "");
        } catch (const std::exception& e) {
            error += e.what();
        }
        check_extensions();  // first: why a file does not load is often the extension it requires
        if (!folder.first_error.empty()) fail("{}", folder.first_error);
        if (!parsed || !error.empty()) fail("not a valid glTF 2.0 file: {}", one_line(error));
        if (!model_.asset.version.starts_with("2."))
            fail("glTF version {}, 2.0 expected", one_line(model_.asset.version));
    }

    void check_extensions() const {
        const auto known = [](const std::string& name) {
            return std::ranges::find(supported_extensions, name) != std::end(supported_extensions);
        };
        for (const std::string& name : model_.extensionsRequired)
            if (!known(name)) fail("requires the extension {}, which is not supported", name);
        std::vector<std::string> ignored = model_.extensionsUsed;
        std::erase_if(ignored, known);
        if (!ignored.empty())
            spdlog::info("{}: extensions ignored: {}", scene_.path.string(), fmt::join(ignored, ", "));
    }

    // --- accessors
    // ------------------------------------------------------------------------------------------------

    /// The bytes of a buffer view from `offset` on.
    std::span<const std::uint8_t> view_bytes(int index, std::size_t offset, const std::string& what) const {
        const gltf::BufferView& view = at(model_.bufferViews, index, what + ": buffer view");
        const Bytes& data = at(model_.buffers, view.buffer, what + ": buffer").data;
        if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
            fail("{}: buffer view {} ends outside its buffer of {} bytes", what, index, data.size());
        if (offset > view.byteLength) fail("{}: starts outside its buffer view {}", what, index);
        return std::span(data).subspan(view.byteOffset + offset, view.byteLength - offset);
    }

    static double component(const std::uint8_t* p, int type, bool normalized) {
        const auto read = [&]<class T>(T value) {
            std::memcpy(&value, p, sizeof value);
            if constexpr (std::is_floating_point_v<T>) return static_cast<double>(value);
            const double v = static_cast<double>(value);
            return normalized ? std::max(v / std::numeric_limits<T>::max(), -1.0) : v;
        };
        switch (type) {
            case TINYGLTF_COMPONENT_TYPE_BYTE:
                return read(std::int8_t{});
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
                return read(std::uint8_t{});
            case TINYGLTF_COMPONENT_TYPE_SHORT:
                return read(std::int16_t{});
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
                return read(std::uint16_t{});
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
                return read(std::uint32_t{});
            default:
                return read(float{});
        }
    }

    /// Calls `element(i, pointer)` for `count` elements of `size` bytes, after checking that they lie in the view.
    template <class Visit>
    void visit(int view, std::size_t offset, std::size_t count, std::size_t size, const std::string& what,
               Visit element) const {
        const auto bytes = view_bytes(view, offset, what);
        const std::size_t stride = std::max(model_.bufferViews[static_cast<std::size_t>(view)].byteStride, size);
        if (count > 0 && (bytes.size() < size || (count - 1) > (bytes.size() - size) / stride))
            fail("{}: {} elements do not fit in its buffer view of {} bytes", what, count, bytes.size());
        for (std::size_t i = 0; i < count; ++i) element(i, bytes.data() + i * stride);
    }

    /// All elements of an accessor as double (which holds every index and every float), components interleaved.
    std::vector<double> read(int index, int type, const std::string& name) const {
        const std::string what = fmt::format("{} (accessor {})", name, index);
        const gltf::Accessor& accessor = at(model_.accessors, index, name + ": accessor");
        if (accessor.type != type) fail("{}: has the wrong type", what);
        const int component_type = accessor.componentType;
        if (component_type == TINYGLTF_COMPONENT_TYPE_INT || component_type == TINYGLTF_COMPONENT_TYPE_DOUBLE)
            fail("{}: component type {} is not allowed", what, component_type);
        const auto components = static_cast<std::size_t>(gltf::GetNumComponentsInType(static_cast<unsigned>(type)));
        const int component_size = gltf::GetComponentSizeInBytes(static_cast<unsigned>(component_type));
        if (component_size <= 0) fail("{}: component type {} is not allowed", what, component_type);
        const std::size_t size = components * static_cast<std::size_t>(component_size);
        constexpr std::size_t most = 1u << 28;
        if (accessor.count == 0 || accessor.count > most) fail("{}: {} elements", what, accessor.count);
        if (accessor.bufferView < 0 && !accessor.sparse.isSparse) fail("{}: has no buffer view", what);

        std::vector<double> values;
        const auto store = [&](std::size_t i, const std::uint8_t* p) {
            for (std::size_t c = 0; c < components; ++c) {
                const double v = component(p + c * static_cast<std::size_t>(component_size), component_type,
                                           accessor.normalized);
                if (!std::isfinite(v)) fail("{}: element {} is not a finite number", what, i);
                values[i * components + c] = v;
            }
        };
        if (accessor.bufferView >= 0) {
            // Nothing is allocated for a count that does not fit.
            visit(accessor.bufferView, accessor.byteOffset, accessor.count, size, what, [](auto, auto) {});
            values.resize(accessor.count * components);
            visit(accessor.bufferView, accessor.byteOffset, accessor.count, size, what, store);
        } else {
            values.resize(accessor.count * components);
        }
        if (accessor.sparse.isSparse) replace_sparse(accessor, size, what, store);
        return values;
    }

    template <class Store>
    void replace_sparse(const gltf::Accessor& accessor, std::size_t size, const std::string& what,
                        Store store) const {
        const auto& sparse = accessor.sparse;
        const int type = sparse.indices.componentType;
        const int index_size = gltf::GetComponentSizeInBytes(static_cast<unsigned>(type));
        if (sparse.count < 1 || static_cast<std::size_t>(sparse.count) > accessor.count || index_size <= 0 ||
            sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
            fail("{}: its sparse part is damaged", what);
        const auto count = static_cast<std::size_t>(sparse.count);
        std::vector<std::size_t> targets(count);
        visit(sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), count,
              static_cast<std::size_t>(index_size), what, [&](std::size_t i, const std::uint8_t* p) {
                  const double target = component(p, type, false);
                  if (!(target >= 0 && target < static_cast<double>(accessor.count)))
                      fail("{}: sparse index {} is out of range", what, target);
                  targets[i] = static_cast<std::size_t>(target);
              });
        visit(sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), count, size, what,
              [&](std::size_t i, const std::uint8_t* p) { store(targets[i], p); });
    }

    template <int n>
    std::vector<glm::vec<n, float>> read_vectors(int index, const std::string& what) const {
        const std::vector<double> values = read(index, n == 1 ? TINYGLTF_TYPE_SCALAR : n, what);
        std::vector<glm::vec<n, float>> vectors(values.size() / n);
        for (std::size_t i = 0; i < values.size(); ++i)
            vectors[i / n][static_cast<int>(i % n)] = static_cast<float>(values[i]);
        return vectors;
    }

    // --- materials
    // ------------------------------------------------------------------------------------------------

    /// The index in scene_.pictures of a material's texture; -1 where it has none. The file's images that no
    /// material uses are not decoded.
    int picture(int texture_index, int tex_coord, const std::string& what) {
        if (texture_index < 0) return -1;
        if (tex_coord != 0) skip("{} uses texture coordinates {}; TEXCOORD_0 is used instead", what, tex_coord);
        const int image = at(model_.textures, texture_index, what + ": texture").source;
        (void)at(model_.images, image, what + ": image");
        const auto found = std::ranges::find(picture_images_, image);
        if (found == picture_images_.end()) {
            picture_images_.push_back(image);
            return static_cast<int>(picture_images_.size()) - 1;
        }
        return static_cast<int>(found - picture_images_.begin());
    }

    void load_materials() {
        for (const gltf::Material& from : model_.materials) {
            const std::string what = fmt::format("material {} \"{}\"", scene_.materials.size(), from.name);
            const gltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
            Material to;
            to.name = from.name;
            to.base_color = vector<4>(pbr.baseColorFactor, what + ": baseColorFactor", 0);
            to.metallic = number(pbr.metallicFactor, what + ": metallicFactor", 0, 1);
            to.roughness = number(pbr.roughnessFactor, what + ": roughnessFactor", 0, 1);
            to.emissive = vector<3>(from.emissiveFactor, what + ": emissiveFactor", 0);
            if (const auto* strength = extension(from, "KHR_materials_emissive_strength", "emissiveStrength"))
                to.emissive *= number(strength->GetNumberAsDouble(), what + ": emissiveStrength", 0);
            if (!std::isfinite(glm::length(to.emissive))) fail("{}: emission is not finite", what);
            to.normal_scale = number(from.normalTexture.scale, what + ": normal scale");
            to.occlusion_strength = number(from.occlusionTexture.strength, what + ": occlusion strength", 0, 1);
            const auto texture = [&](const auto& info, const char* slot) {
                return picture(info.index, info.texCoord, fmt::format("{}: {}", what, slot));
            };
            to.base_color_picture = texture(pbr.baseColorTexture, "baseColorTexture");
            to.metallic_roughness_picture = texture(pbr.metallicRoughnessTexture, "metallicRoughnessTexture");
            to.normal_picture = texture(from.normalTexture, "normalTexture");
            to.occlusion_picture = texture(from.occlusionTexture, "occlusionTexture");
            to.emissive_picture = texture(from.emissiveTexture, "emissiveTexture");
            if (from.alphaMode != "OPAQUE" && from.alphaMode != "MASK" && from.alphaMode != "BLEND")
                fail("{}: alphaMode {} given, OPAQUE, MASK or BLEND expected", what, from.alphaMode);
            to.alpha_mask = from.alphaMode == "MASK";
            to.alpha_blend = from.alphaMode == "BLEND";
            to.alpha_cutoff = number(from.alphaCutoff, what + ": alphaCutoff", 0);
            to.double_sided = from.doubleSided;
            scene_.materials.push_back(to);
        }
        scene_.pictures.resize(picture_images_.size());
        decode_pictures();
    }

    Picture decode_picture(int index) const {
        const gltf::Image& from = model_.images[static_cast<std::size_t>(index)];
        const std::string what =
            fmt::format("image {} \"{}\"", index, one_line(from.name.empty() ? from.uri : from.name));
        const std::span<const std::uint8_t> bytes =
            from.bufferView >= 0 ? view_bytes(from.bufferView, 0, what) : std::span(from.image);
        const Image image = decode_image(bytes, scene_.path.string() + ": " + what, 4);
        Picture to{from.name, image.size, std::vector<std::uint8_t>(image.pixels.size())};
        std::ranges::transform(image.pixels, to.rgba.begin(), [](float v) {
            return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f);
        });
        return to;
    }

    /// Decoding is most of a level's loading time: one picture after the other on every core.
    void decode_pictures() {
        std::atomic<std::size_t> next = 0;
        const auto work = [&] {
            for (std::size_t i = next++; i < picture_images_.size(); i = next++)
                scene_.pictures[i] = decode_picture(picture_images_[i]);
        };
        std::vector<std::future<void>> workers;
        const std::size_t cores = std::max(std::thread::hardware_concurrency(), 1u);
        for (std::size_t i = 0; i < std::min(cores, picture_images_.size()); ++i)
            workers.push_back(std::async(std::launch::async, work));
        for (std::future<void>& worker : workers) worker.wait();
        for (std::future<void>& worker : workers) worker.get();
    }

    /// A primitive without a material has glTF's default one.
    int material(int index, const std::string& what) {
        if (index >= 0) {
            if (static_cast<std::size_t>(index) >= model_.materials.size())
                fail("{}: material {} does not exist; there are {}", what, index, model_.materials.size());
            return index;
        }
        if (default_material_ < 0) {
            default_material_ = static_cast<int>(scene_.materials.size());
            scene_.materials.emplace_back().name = "default";
        }
        return default_material_;
    }

    // --- meshes
    // ---------------------------------------------------------------------------------------------------

    void load_meshes() {
        for (const gltf::Mesh& from : model_.meshes) {
            std::vector<int>& primitives = mesh_primitives_.emplace_back();
            for (std::size_t i = 0; i < from.primitives.size(); ++i) {
                const std::string what =
                    fmt::format("mesh {} \"{}\" primitive {}", mesh_primitives_.size() - 1, from.name, i);
                const gltf::Primitive& primitive = from.primitives[i];
                if (!primitive.targets.empty()) skip("{}: morph targets are not supported, ignored", what);
                if (primitive.mode >= TINYGLTF_MODE_POINTS && primitive.mode < TINYGLTF_MODE_TRIANGLES) {
                    skip("{}: points and lines are not supported, left out", what);
                    continue;
                }
                primitives.push_back(static_cast<int>(scene_.meshes.size()));
                scene_.meshes.push_back(load_primitive(primitive, what));
                scene_.meshes.back().name = from.name;
            }
        }
    }

    std::vector<std::uint32_t> load_indices(const gltf::Primitive& from, std::size_t vertex_count,
                                            const std::string& what) const {
        std::vector<std::uint32_t> indices;
        if (from.indices < 0) {
            for (std::uint32_t i = 0; i < vertex_count; ++i) indices.push_back(i);
        } else {
            const int type = at(model_.accessors, from.indices, what + ": accessor").componentType;
            if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
                type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
                fail("{}: indices of component type {}, an unsigned integer expected", what, type);
            for (const double index : read(from.indices, TINYGLTF_TYPE_SCALAR, what + " indices")) {
                if (!(index >= 0 && index < static_cast<double>(vertex_count)))
                    fail("{}: index {} is out of range; there are {} vertices", what, index, vertex_count);
                indices.push_back(static_cast<std::uint32_t>(index));
            }
        }
        if (from.mode == TINYGLTF_MODE_TRIANGLE_STRIP) return triangles_of_strip(indices);
        if (from.mode == TINYGLTF_MODE_TRIANGLE_FAN) return triangles_of_fan(indices);
        if (from.mode != TINYGLTF_MODE_TRIANGLES) fail("{}: mode {} does not exist", what, from.mode);
        if (indices.size() % 3 != 0) fail("{}: {} indices are not whole triangles", what, indices.size());
        return indices;
    }

    Mesh load_primitive(const gltf::Primitive& from, const std::string& what) {
        const auto attribute = [&](const char* name) {
            const auto found = from.attributes.find(name);
            return found == from.attributes.end() ? -1 : found->second;
        };
        const auto fill = [&](Mesh& mesh, const char* name, auto vectors, auto member) {
            if (vectors.size() != mesh.vertices.size())
                fail("{}: {} has {} elements, POSITION has {}", what, name, vectors.size(), mesh.vertices.size());
            for (std::size_t i = 0; i < vectors.size(); ++i) mesh.vertices[i].*member = vectors[i];
        };
        if (from.extensions.contains("KHR_draco_mesh_compression"))
            fail("{}: Draco compression is not supported", what);
        if (attribute("POSITION") < 0) fail("{}: has no POSITION", what);

        Mesh mesh;
        mesh.material = material(from.material, what);
        const auto positions = read_vectors<3>(attribute("POSITION"), what + " POSITION");
        mesh.vertices.resize(positions.size(), Vertex{glm::vec3(0), glm::vec3(0), glm::vec4(0), glm::vec2(0)});
        fill(mesh, "POSITION", positions, &Vertex::position);
        for (const glm::vec3& p : positions) mesh.bounds.add(p);
        mesh.indices = load_indices(from, positions.size(), what);
        if (const int uv = attribute("TEXCOORD_0"); uv >= 0)
            fill(mesh, "TEXCOORD_0", read_vectors<2>(uv, what + " TEXCOORD_0"), &Vertex::uv);
        const int normal = attribute("NORMAL"), tangent = attribute("TANGENT");
        if (normal < 0) {
            make_flat(mesh);
        } else {
            fill(mesh, "NORMAL", read_vectors<3>(normal, what + " NORMAL"), &Vertex::normal);
            for (Vertex& v : mesh.vertices) {
                const float length = glm::length(v.normal);
                v.normal = length > 0 && std::isfinite(length) ? v.normal / length : glm::vec3(0, 1, 0);
            }
        }
        if (tangent >= 0 && normal >= 0) {  // glTF: tangents without normals are ignored
            fill(mesh, "TANGENT", read_vectors<4>(tangent, what + " TANGENT"), &Vertex::tangent);
        } else if (scene_.materials[static_cast<std::size_t>(mesh.material)].normal_picture >= 0) {
            compute_tangents(mesh);
        } else {
            make_arbitrary_tangents(mesh);
        }
        return mesh;
    }

    // --- nodes
    // ----------------------------------------------------------------------------------------------------

    /// The scene's nodes, parents before children.
    void load_nodes() {
        std::vector<int> parents(model_.nodes.size(), -1);
        for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
            for (const int child : model_.nodes[i].children) {
                (void)at(model_.nodes, child, fmt::format("node {}: child", i));
                int& parent = parents[static_cast<std::size_t>(child)];
                if (parent >= 0) fail("node {} has two parents, {} and {}", child, parent, i);
                parent = static_cast<int>(i);
            }
        }
        std::vector<int> roots;
        for (std::size_t i = 0; i < parents.size(); ++i)
            if (parents[i] < 0) roots.push_back(static_cast<int>(i));
        // Every node has one parent at most: what no root leads to is on or below a cycle.
        std::vector<int> reached = roots;
        for (std::size_t i = 0; i < reached.size(); ++i) {
            const auto& children = model_.nodes[static_cast<std::size_t>(reached[i])].children;
            reached.insert(reached.end(), children.begin(), children.end());
        }
        if (reached.size() != model_.nodes.size()) fail("the node hierarchy has a cycle");

        if (!model_.scenes.empty()) {
            roots = at(model_.scenes, std::max(model_.defaultScene, 0), "scene").nodes;
            for (const int root : roots)
                if (at(parents, root, "scene: node") >= 0) fail("scene: node {} is not a root", root);
            if (std::set(roots.begin(), roots.end()).size() != roots.size()) fail("scene: names a node twice");
        }
        node_of_.assign(model_.nodes.size(), -1);
        for (std::size_t i = 0; i < roots.size(); ++i) {
            const int index = roots[i];
            const int parent = parents[static_cast<std::size_t>(index)];
            load_node(index, parent < 0 ? -1 : node_of_[static_cast<std::size_t>(parent)]);
            const auto& children = model_.nodes[static_cast<std::size_t>(index)].children;
            roots.insert(roots.end(), children.begin(), children.end());
        }
    }

    void load_node(int index, int parent) {
        const gltf::Node& from = model_.nodes[static_cast<std::size_t>(index)];
        const std::string what = fmt::format("node {} \"{}\"", index, from.name);
        const int id = node_of_[static_cast<std::size_t>(index)] = static_cast<int>(scene_.nodes.size());
        Node node;
        node.name = from.name;
        node.parent = parent;
        if (!from.matrix.empty()) {
            decompose(from.matrix, node, what);
        } else {
            if (!from.translation.empty()) node.translation = vector<3>(from.translation, what + ": translation");
            if (!from.scale.empty()) node.scale = vector<3>(from.scale, what + ": scale");
            if (!from.rotation.empty())
                node.rotation = quaternion(vector<4>(from.rotation, what + ": rotation"), what + ": rotation");
        }
        const Json extra = extras(from);
        if (extra.contains("cast_shadow"))
            node.cast_shadow = boolean(extra["cast_shadow"], what + ": extras.cast_shadow");
        if (from.skin >= 0) skip("{}: skins are not supported, drawn in its rest pose", what);
        if (from.camera >= 0) node.camera = load_camera(from, id, what);
        if (const auto* light = extension(from, "KHR_lights_punctual", "light"))
            node.light = load_light(light->GetNumberAsInt(), id, what);
        if (from.mesh >= 0) node.meshes = at(mesh_primitives_, from.mesh, what + ": mesh");
        scene_.nodes.push_back(node);
        if (from.mesh >= 0 && from.extensions.contains("EXT_mesh_gpu_instancing")) load_instances(from, id, what);
    }

    glm::quat quaternion(glm::vec4 xyzw, const std::string& what) const {
        const float length = glm::length(xyzw);
        if (!(length > 1e-6f) || !std::isfinite(length)) fail("{}: a unit quaternion expected", what);
        return glm::quat(xyzw.w, xyzw.x, xyzw.y, xyzw.z) / length;
    }

    /// glTF: a matrix must be a product of translation, rotation and scale. A mirroring is put in the scale of x.
    void decompose(const std::vector<double>& values, Node& node, const std::string& what) const {
        if (values.size() != 16) fail("{}: matrix has {} numbers, 16 expected", what, values.size());
        glm::mat4 matrix;
        for (std::size_t i = 0; i < 16; ++i) glm::value_ptr(matrix)[i] = number(values[i], what + ": matrix");
        const glm::mat3 linear(matrix);
        for (int axis = 0; axis < 3; ++axis) node.scale[axis] = glm::length(linear[axis]);
        if (glm::determinant(linear) < 0) node.scale.x = -node.scale.x;
        const glm::mat3 rotation(linear[0] / node.scale.x, linear[1] / node.scale.y, linear[2] / node.scale.z);
        const glm::mat3 residual = glm::transpose(rotation) * rotation - glm::mat3(1);
        for (int axis = 0; axis < 3; ++axis)
            if (!(glm::length(residual[axis]) < 1e-3f))
                fail("{}: matrix is not a product of translation, rotation and scale", what);
        node.translation = glm::vec3(matrix[3]);
        node.rotation = glm::normalize(glm::quat_cast(rotation));
    }

    int load_camera(const gltf::Node& node, int id, const std::string& what) {
        const gltf::Camera& from = at(model_.cameras, node.camera, what + ": camera");
        if (from.type != "perspective") {
            skip("{}: orthographic cameras are not supported, left out", what);
            return -1;
        }
        Camera camera;
        camera.name = from.name.empty() ? node.name : from.name;
        camera.node = id;
        camera.yfov = number(from.perspective.yfov, what + ": yfov", 1e-4, std::numbers::pi - 1e-4);
        camera.znear = number(from.perspective.znear, what + ": znear", 1e-6);
        scene_.cameras.push_back(camera);
        return static_cast<int>(scene_.cameras.size()) - 1;
    }

    int load_light(int index, int id, const std::string& node) {
        const gltf::Light& from = at(model_.lights, index, node + ": light");
        const std::string what = fmt::format("light {} \"{}\"", index, from.name);
        Light light;
        light.name = from.name;
        light.node = id;
        if (from.type == "directional") {
            light.type = LightType::sun;
        } else if (from.type == "spot") {
            light.type = LightType::spot;
        } else if (from.type != "point") {
            fail("{}: type {} given, directional, point or spot expected", what, from.type);
        }
        light.intensity = number(from.intensity, what + ": intensity", 0) *
                          (from.color.empty() ? glm::vec3(1) : vector<3>(from.color, what + ": color", 0));
        const float brightest = std::max({light.intensity.x, light.intensity.y, light.intensity.z});
        if (!std::isfinite(brightest)) fail("{}: intensity times color is not finite", what);
        if (light.type == LightType::spot) {
            light.outer_cone =
                number(from.spot.outerConeAngle, what + ": outerConeAngle", 1e-4, std::numbers::pi / 2 + 1e-4);
            light.inner_cone = number(from.spot.innerConeAngle, what + ": innerConeAngle", 0, light.outer_cone);
        }
        const Json extra = extras(from);
        if (extra.contains("radius")) light.radius = number(extra["radius"], what + ": extras.radius", 1e-6);
        if (extra.contains("shadow")) light.shadow = boolean(extra["shadow"], what + ": extras.shadow");
        light.range = number(from.range, what + ": range", 0);
        if (light.range == 0) light.range = std::max(std::sqrt(brightest / faintest_illuminance), light.radius);
        scene_.lights.push_back(light);
        return static_cast<int>(scene_.lights.size()) - 1;
    }

    /// EXT_mesh_gpu_instancing: one child node for each instance.
    void load_instances(const gltf::Node& from, int id, const std::string& what) {
        const gltf::Value* attributes = extension(from, "EXT_mesh_gpu_instancing", "attributes");
        if (attributes == nullptr) fail("{}: EXT_mesh_gpu_instancing without attributes", what);
        std::size_t count = 0;
        const auto read_attribute = [&]<int n>(const char* key, std::integral_constant<int, n>) {
            std::vector<glm::vec<n, float>> values;
            if (!attributes->Has(key)) return values;
            values = read_vectors<n>(attributes->Get(key).GetNumberAsInt(), what + " " + key);
            if (count != 0 && values.size() != count) fail("{}: instance attributes differ in count", what);
            count = values.size();
            return values;
        };
        const auto translations = read_attribute("TRANSLATION", std::integral_constant<int, 3>());
        const auto rotations = read_attribute("ROTATION", std::integral_constant<int, 4>());
        const auto scales = read_attribute("SCALE", std::integral_constant<int, 3>());
        Node instance;
        instance.name = from.name;
        instance.parent = id;
        instance.cast_shadow = scene_.nodes.back().cast_shadow;
        std::swap(instance.meshes, scene_.nodes.back().meshes);
        for (std::size_t i = 0; i < count; ++i) {
            if (!translations.empty()) instance.translation = translations[i];
            if (!rotations.empty()) instance.rotation = quaternion(rotations[i], what + " ROTATION");
            if (!scales.empty()) instance.scale = scales[i];
            scene_.nodes.push_back(instance);
        }
    }

    // --- animations
    // -----------------------------------------------------------------------------------------------

    void load_animations() {
        for (const gltf::Animation& from : model_.animations) {
            const std::string what = fmt::format("animation {} \"{}\"", scene_.animations.size(), from.name);
            Animation to;
            to.name = from.name;
            for (const gltf::AnimationChannel& channel : from.channels) {
                if (channel.target_node < 0) continue;  // glTF: to be ignored
                const int node = at(node_of_, channel.target_node, what + ": node");
                if (channel.target_path == "weights") skip("{}: morph targets are not supported, ignored", what);
                if (node < 0 || channel.target_path == "weights") continue;
                to.channels.push_back(load_channel(from, channel, node, what));
                to.duration = std::max(to.duration, to.channels.back().times.back());
                scene_.nodes[static_cast<std::size_t>(node)].dynamic = true;
            }
            load_places(extras(from), to, what);
            scene_.animations.push_back(std::move(to));
        }
        for (Node& node : scene_.nodes)
            if (node.parent >= 0 && scene_.nodes[static_cast<std::size_t>(node.parent)].dynamic)
                node.dynamic = true;
    }

    Animation::Channel load_channel(const gltf::Animation& animation, const gltf::AnimationChannel& from, int node,
                                    const std::string& what) const {
        const gltf::AnimationSampler& sampler = at(animation.samplers, from.sampler, what + ": sampler");
        Animation::Channel to{node, {}, {}, {}, {}};
        if (from.target_path == "translation") {
            to.path = Animation::Path::translation;
        } else if (from.target_path == "rotation") {
            to.path = Animation::Path::rotation;
        } else if (from.target_path == "scale") {
            to.path = Animation::Path::scale;
        } else {
            fail("{}: path {} does not exist", what, from.target_path);
        }
        if (sampler.interpolation == "STEP") {
            to.interpolation = Animation::Interpolation::step;
        } else if (sampler.interpolation == "LINEAR") {
            to.interpolation = Animation::Interpolation::linear;
        } else if (sampler.interpolation == "CUBICSPLINE") {
            to.interpolation = Animation::Interpolation::cubic;
        } else {
            fail("{}: interpolation {} does not exist", what, sampler.interpolation);
        }
        for (const double time : read(sampler.input, TINYGLTF_TYPE_SCALAR, what + " times")) {
            const auto t = static_cast<float>(time);
            if (t < 0 || (!to.times.empty() && t <= to.times.back()))
                fail("{}: time {} s; times must not be negative and must rise", what, t);
            to.times.push_back(t);
        }
        if (to.path == Animation::Path::rotation) {
            to.values = read_vectors<4>(sampler.output, what + " values");
        } else {
            for (const glm::vec3& v : read_vectors<3>(sampler.output, what + " values"))
                to.values.emplace_back(v, 0);
        }
        const bool cubic = to.interpolation == Animation::Interpolation::cubic;
        if (to.values.size() != to.times.size() * (cubic ? 3 : 1))
            fail("{}: {} values for {} times", what, to.values.size(), to.times.size());
        if (to.path == Animation::Path::rotation) {
            for (std::size_t i = cubic ? 1 : 0; i < to.values.size(); i += cubic ? 3 : 1) {
                const glm::quat q = quaternion(to.values[i], what + " values");
                to.values[i] = {q.x, q.y, q.z, q.w};
            }
        }
        return to;
    }

    void load_places(const Json& extra, Animation& animation, const std::string& what) const {
        if (!extra.contains("places")) return;
        const Json& places = extra["places"];
        if (!places.is_array()) fail("{}: extras.places: a list expected", what);
        for (const Json& place : places) {
            if (!place.is_object() || !place.contains("name") || !place["name"].is_string() ||
                !place.contains("time"))
                fail("{}: extras.places: {{\"name\": text, \"time\": seconds}} expected", what);
            animation.places.push_back(
                {place["name"].get<std::string>(), number(place["time"], what + ": extras.places: time", 0)});
        }
    }

    // --- the scene as a whole
    // -------------------------------------------------------------------------------------

    void load_scene_extras() {
        if (model_.scenes.empty()) return;
        const Json extra = extras(model_.scenes[static_cast<std::size_t>(std::max(model_.defaultScene, 0))]);
        if (extra.contains("exposure")) scene_.exposure_ev100 = number(extra["exposure"], "extras.exposure");
        if (!extra.contains("media")) return;
        Json media = extra["media"];
        const std::string where = scene_.path.string() + ": extras";
        if (media.is_string()) {  // a text property of a modelling program
            media = Json::parse(media.get<std::string>(), nullptr, false);
            if (media.is_discarded()) fail("extras.media: the text is not valid JSON");
        }
        scene_.media = parse_media(media, where);
    }

    void finish() {
        if (scene_.materials.empty()) (void)material(-1, "");
        animate(scene_, 0);
        std::map<int, int> mirrored_meshes;
        for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
            Node& node = scene_.nodes[i];
            for (int column = 0; column < 4; ++column)
                if (!std::isfinite(glm::length(node.world[column])))
                    fail("node \"{}\": its place in the world is not finite", node.name);
            const bool mirrors = glm::determinant(glm::mat3(node.world)) < 0;
            for (int& mesh : node.meshes) {
                if (mirrors) {
                    const auto [entry, added] = mirrored_meshes.try_emplace(mesh, int(scene_.meshes.size()));
                    if (added) scene_.meshes.push_back(mirrored(scene_.meshes[static_cast<std::size_t>(mesh)]));
                    mesh = entry->second;
                }
                const Aabb box = transformed(scene_.meshes[static_cast<std::size_t>(mesh)].bounds, node.world);
                scene_.bounds.add(box.min);
                scene_.bounds.add(box.max);
            }
        }
    }

    Scene scene_;
    gltf::Model model_;
    std::vector<int> picture_images_;                ///< of each picture, the file's image
    std::vector<std::vector<int>> mesh_primitives_;  ///< of each mesh of the file, the scene's meshes
    std::vector<int> node_of_;  ///< of each node of the file, the scene's; -1 outside the scene
    int default_material_ = -1;
};

}  // namespace

Scene load_gltf(const fs::path& path) {
    try {
        return Loader(path).load();
    } catch (const Error&) {
        throw;
    } catch (const std::exception& e) {  // what tinygltf and the JSON library throw on odd input
        throw Error(one_line(fmt::format("{}: not a valid glTF 2.0 file: {}", path.string(), e.what())));
    }
}

}  // namespace tyndall
